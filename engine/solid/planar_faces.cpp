#include "engine/solid/planar_faces.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/foundation/index.h"

namespace carom {
namespace {

// Newton's method squares the bend relative to the shortest edge in each round: 1e-6 is rounding after three.
constexpr int kNewtonRounds = 6;
// So no round needs to be solved to more than that relative bend (inexact Newton, Dembo, Eisenstat and
// Steihaug 1982) or to rounding, nor to less than a tenth.
constexpr double kLeastSolved = 0.1;
// Conjugate gradients need as many sweeps as the conditions have clusters of eigenvalues: few for faces at
// wide angles, n/2 for a ring of n faces. Visits of a corner, over all rounds: half a second or so.
constexpr std::size_t kMostVisits = 50'000'000;
constexpr double kNoBend = 4e-16;  // of the polyhedron's reach: a bend below is none

Vec3 meanOf(std::span<const Vec3> vertices, const std::vector<int>& loop) {
  Vec3 mean = Vec3::Zero();
  for (int v : loop) mean += vertices[at(v)];
  return mean / static_cast<double>(loop.size());
}

/// One number for each corner of each face that can bend, face after face.
using Heights = std::vector<double>;

/// The faces that can bend, with their corners one after the other: most of an import's time can be spent on
/// them, and plain numbers in plain arrays are what every compiler makes fast.
class BentFaces {
 public:
  BentFaces(std::span<const Vec3> vertices, std::span<const std::vector<int>> loops) {
    for (const std::vector<int>& loop : loops)
      if (loop.size() > 3) add(vertices, loop);
  }
  std::size_t cornerCount() const { return vertex_.size(); }

  /// B: the bends that displacements of the vertices make.
  void bendsOf(std::span<const Vec3> moves, Heights& bends) const {
    const int* const vertex = vertex_.data();
    const Vec3* const move = moves.data();
    double* const bend = bends.data();
    for (const Face& face : faces_) {
      const double x = face.normal.x(), y = face.normal.y(), z = face.normal.z();
      for (std::size_t k = face.first; k < face.end; ++k) {
        const double* const m = move[vertex[k]].data();
        bend[k] = x * m[0] + y * m[1] + z * m[2];
      }
      removePlane(face, bend);
    }
  }

  /// B transposed: each face pushes its corners along its normal.
  void movesOf(const Heights& pushes, std::vector<Vec3>& moves) const {
    std::fill(moves.begin(), moves.end(), Vec3::Zero());
    const int* const vertex = vertex_.data();
    const double* const push = pushes.data();
    Vec3* const move = moves.data();
    for (const Face& face : faces_) {
      const double x = face.normal.x(), y = face.normal.y(), z = face.normal.z();
      for (std::size_t k = face.first; k < face.end; ++k) {
        double* const m = move[vertex[k]].data();
        m[0] += push[k] * x;
        m[1] += push[k] * y;
        m[2] += push[k] * z;
      }
    }
  }

  /// How far each corner is from its face's plane.
  Heights bendsAt(std::span<const Vec3> vertices) const {
    Heights bends(cornerCount());
    for (const Face& face : faces_) {
      for (std::size_t k = face.first; k < face.end; ++k)
        bends[k] = dot(face.normal, vertices[at(vertex_[k])] - face.mean);
      // Twice: what the rounding of the heights leaves of a plane would not be in the range of B.
      removePlane(face, bends.data());
      removePlane(face, bends.data());
    }
    return bends;
  }

 private:
  struct Face {
    std::size_t first, end;  // its corners
    Vec3 normal, mean;
    double xx, yy;  // sums of the squares of its corners' coordinates
  };

  /// Newell's normal, then the principal axes of the corners in that plane.
  void add(std::span<const Vec3> vertices, const std::vector<int>& loop) {
    const Vec3 mean = meanOf(vertices, loop);
    Vec3 area = Vec3::Zero();
    for (std::size_t i = 0; i < loop.size(); ++i)
      area += (vertices[at(loop[i])] - mean).cross(vertices[at(loop[(i + 1) % loop.size()])] - mean);
    Face face{cornerCount(), cornerCount() + loop.size(), area.normalized(), mean, 0.0, 0.0};
    const TangentBasis basis = tangentBasis(face.normal);
    std::vector<Vec2> flat;
    double xx = 0.0, xy = 0.0, yy = 0.0;
    for (int v : loop) {
      const Vec3 p = vertices[at(v)] - mean;
      flat.emplace_back(dot(p, basis.t1), dot(p, basis.t2));
      xx += flat.back().x() * flat.back().x();
      xy += flat.back().x() * flat.back().y();
      yy += flat.back().y() * flat.back().y();
    }
    // One Jacobi rotation makes the two coordinates uncorrelated.
    const double half_difference = 0.5 * (xx - yy);
    const double root = std::sqrt(half_difference * half_difference + xy * xy);
    Vec2 axis(half_difference + root, xy);
    if (half_difference < 0.0) axis = Vec2(xy, root - half_difference);
    axis = root > 0.0 ? Vec2(axis / axis.norm()) : Vec2(1.0, 0.0);
    for (std::size_t i = 0; i < loop.size(); ++i) {
      vertex_.push_back(loop[i]);
      x_.push_back(dot(axis, flat[i]));
      y_.push_back(axis.x() * flat[i].y() - axis.y() * flat[i].x());
      face.xx += x_.back() * x_.back();
      face.yy += y_.back() * y_.back();
    }
    faces_.push_back(face);
  }

  /// Takes out of the heights of a face's corners what a shift and a tilt of its plane explain: what remains
  /// is bend.
  void removePlane(const Face& face, double* heights) const {
    const double *const x = x_.data(), *const y = y_.data();
    double mean = 0.0, tilt_x = 0.0, tilt_y = 0.0;
    for (std::size_t k = face.first; k < face.end; ++k) {
      mean += heights[k];
      tilt_x += heights[k] * x[k];
      tilt_y += heights[k] * y[k];
    }
    mean /= static_cast<double>(face.end - face.first);
    tilt_x /= face.xx;
    tilt_y /= face.yy;
    for (std::size_t k = face.first; k < face.end; ++k) heights[k] -= mean + (tilt_x * x[k] + tilt_y * y[k]);
  }

  std::vector<Face> faces_;
  std::vector<int> vertex_;    // of each corner
  std::vector<double> x_, y_;  // its place in its face's plane about the corners' mean, along principal axes
};

/// The shortest displacements with B moves = bends, to `share` of the bends: moves = B^T y with B B^T y =
/// bends, by conjugate gradients from zero. All vectors y stay in the range of B, where B B^T is positive.
std::vector<Vec3> shortestMoves(const BentFaces& faces, std::size_t vertex_count, Heights bends, double share,
                                std::size_t& visits) {
  std::vector<Vec3> moves(vertex_count, Vec3::Zero()), step(vertex_count);
  Heights direction = bends, image(bends.size());
  double residual = dot(bends, bends);
  const double solved = share * share * residual;
  for (; visits < kMostVisits && residual > solved; visits += bends.size()) {
    faces.movesOf(direction, step);
    faces.bendsOf(step, image);
    const double curvature = dot(direction, image);
    if (!(curvature > 0.0)) break;
    const double length = residual / curvature;
    for (std::size_t v = 0; v < vertex_count; ++v) moves[v] += length * step[v];
    for (std::size_t i = 0; i < bends.size(); ++i) bends[i] -= length * image[i];
    const double next = dot(bends, bends);
    for (std::size_t i = 0; i < bends.size(); ++i) direction[i] = bends[i] + next / residual * direction[i];
    residual = next;
  }
  return moves;
}

double largestOf(const Heights& heights) {
  double most = 0.0;
  for (double h : heights) most = std::max(most, std::abs(h));
  return most;
}

double shortestEdge(std::span<const Vec3> vertices, std::span<const std::vector<int>> loops) {
  double shortest = std::numeric_limits<double>::infinity();
  for (const std::vector<int>& loop : loops)
    for (std::size_t i = 0; i < loop.size(); ++i)
      shortest =
          std::min(shortest, (vertices[at(loop[i])] - vertices[at(loop[(i + 1) % loop.size()])]).norm());
  return shortest;
}

}  // namespace

double largestBend(std::span<const Vec3> vertices, std::span<const std::vector<int>> loops) {
  return largestOf(BentFaces(vertices, loops).bendsAt(vertices));
}

double flattenFaces(std::vector<Vec3>& vertices, std::span<const std::vector<int>> loops) {
  // About a point near the vertices: no cancellation far from the origin.
  const Vec3 origin = vertices[0];
  std::vector<Vec3> given;
  double reach = 0.0;
  for (const Vec3& v : vertices) {
    given.push_back(v - origin);
    reach = std::max(reach, given.back().norm());
  }
  std::vector<Vec3> flattest = given;
  std::vector<Vec3> moved = given;
  const double shortest = shortestEdge(given, loops);
  double least_bend = std::numeric_limits<double>::infinity();
  std::size_t visits = 0;
  for (int round = 0; round < kNewtonRounds; ++round) {
    const BentFaces faces(moved, loops);
    const Heights bends = faces.bendsAt(moved);
    const double bend = largestOf(bends);
    if (!(bend < least_bend)) break;
    flattest = moved;
    least_bend = bend;
    if (bend <= kNoBend * reach) break;
    const double share = std::max(std::min(bend / shortest, kLeastSolved), kNoBend * reach / bend);
    const std::vector<Vec3> moves = shortestMoves(faces, moved.size(), bends, share, visits);
    for (std::size_t v = 0; v < moved.size(); ++v) moved[v] -= moves[v];
  }
  double farthest = 0.0;
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    farthest = std::max(farthest, (flattest[v] - given[v]).norm());
    vertices[v] = origin + flattest[v];
  }
  return farthest;
}

}  // namespace carom
