#include "engine/solid/planar_faces.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/foundation/index.h"

namespace carom {
namespace {

// Newton's method squares the bend relative to the shortest edge in each round: 1e-6 is rounding after three.
constexpr int kNewtonRounds = 6;
// Conjugate gradients need as many sweeps as the conditions have clusters of eigenvalues: few for faces at
// wide angles, n/2 for a ring of n faces. Visits of a corner, over all rounds: about a second.
constexpr std::size_t kMostVisits = 50'000'000;
constexpr double kSolved = 1e-8;   // of the right-hand side; the next round repairs the rest
constexpr double kNoBend = 4e-16;  // of the polyhedron's reach: a bend below is none

/// The corners of a face relative to their mean, in a basis in which heights can be compared with planes.
struct BentFace {
  const std::vector<int>* loop;
  Vec3 normal;
  std::vector<Vec2> flat;  // corner positions in the fitted plane, about their mean, along principal axes
  Vec2 spread;             // sums of the squares of each of the two coordinates

  /// Takes out of `heights` what a shift and a tilt of the plane explain: what remains is bend.
  void removePlane(std::span<double> heights) const {
    double mean = 0.0;
    Vec2 tilt = Vec2::Zero();
    for (std::size_t i = 0; i < heights.size(); ++i) {
      mean += heights[i];
      tilt += heights[i] * flat[i];
    }
    mean /= static_cast<double>(heights.size());
    tilt = tilt.cwiseQuotient(spread);
    for (std::size_t i = 0; i < heights.size(); ++i) heights[i] -= mean + dot(tilt, flat[i]);
  }
};

Vec3 meanOf(std::span<const Vec3> vertices, const std::vector<int>& loop) {
  Vec3 mean = Vec3::Zero();
  for (int v : loop) mean += vertices[at(v)];
  return mean / static_cast<double>(loop.size());
}

/// Newell's normal, then the principal axes of the corners in that plane.
BentFace bentFace(std::span<const Vec3> vertices, const std::vector<int>& loop) {
  const Vec3 mean = meanOf(vertices, loop);
  Vec3 area = Vec3::Zero();
  for (std::size_t i = 0; i < loop.size(); ++i)
    area += (vertices[at(loop[i])] - mean).cross(vertices[at(loop[(i + 1) % loop.size()])] - mean);
  BentFace face{&loop, area.normalized(), {}, Vec2::Zero()};
  const TangentBasis basis = tangentBasis(face.normal);
  double xx = 0.0, xy = 0.0, yy = 0.0;
  for (int v : loop) {
    const Vec3 p = vertices[at(v)] - mean;
    face.flat.emplace_back(dot(p, basis.t1), dot(p, basis.t2));
    xx += face.flat.back().x() * face.flat.back().x();
    xy += face.flat.back().x() * face.flat.back().y();
    yy += face.flat.back().y() * face.flat.back().y();
  }
  // One Jacobi rotation makes the two coordinates uncorrelated.
  const double half_difference = 0.5 * (xx - yy);
  const double root = std::sqrt(half_difference * half_difference + xy * xy);
  Vec2 axis(half_difference + root, xy);
  if (half_difference < 0.0) axis = Vec2(xy, root - half_difference);
  axis = root > 0.0 ? Vec2(axis / axis.norm()) : Vec2(1.0, 0.0);
  for (Vec2& p : face.flat) {
    p = Vec2(dot(axis, p), axis.x() * p.y() - axis.y() * p.x());
    face.spread += p.cwiseProduct(p);
  }
  return face;
}

std::vector<BentFace> facesThatCanBend(std::span<const Vec3> vertices,
                                       std::span<const std::vector<int>> loops) {
  std::vector<BentFace> faces;
  for (const std::vector<int>& loop : loops)
    if (loop.size() > 3) faces.push_back(bentFace(vertices, loop));
  return faces;
}

/// One number for each corner of each face that can bend, face after face.
using Heights = std::vector<double>;

/// B: the bends that displacements of the vertices make.
void bendsOf(std::span<const BentFace> faces, std::span<const Vec3> moves, Heights& bends) {
  std::size_t k = 0;
  for (const BentFace& face : faces) {
    const std::size_t first = k;
    for (int v : *face.loop) bends[k++] = dot(face.normal, moves[at(v)]);
    face.removePlane(std::span(bends).subspan(first, k - first));
  }
}

/// B transposed: each face pushes its corners along its normal.
void movesOf(std::span<const BentFace> faces, const Heights& pushes, std::vector<Vec3>& moves) {
  std::fill(moves.begin(), moves.end(), Vec3::Zero());
  std::size_t k = 0;
  for (const BentFace& face : faces)
    for (int v : *face.loop) moves[at(v)] += pushes[k++] * face.normal;
}

/// The shortest displacements with B moves = bends: moves = B^T y with B B^T y = bends, by conjugate
/// gradients from zero. All vectors y stay in the range of B, where B B^T is positive.
std::vector<Vec3> shortestMoves(std::span<const BentFace> faces, std::size_t vertex_count, Heights bends,
                                std::size_t& visits) {
  std::vector<Vec3> moves(vertex_count, Vec3::Zero()), step(vertex_count);
  Heights direction = bends, image(bends.size());
  double residual = dot(bends, bends);
  const double solved = kSolved * kSolved * residual;
  for (; visits < kMostVisits && residual > solved; visits += bends.size()) {
    movesOf(faces, direction, step);
    bendsOf(faces, step, image);
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

Heights currentBends(std::span<const BentFace> faces, std::span<const Vec3> vertices) {
  Heights bends;
  for (const BentFace& face : faces) {
    const Vec3 mean = meanOf(vertices, *face.loop);
    const std::size_t first = bends.size();
    for (int v : *face.loop) bends.push_back(dot(face.normal, vertices[at(v)] - mean));
    // Twice: what the rounding of the heights leaves of a plane would not be in the range of B.
    const std::span<double> own = std::span(bends).subspan(first);
    face.removePlane(own);
    face.removePlane(own);
  }
  return bends;
}

}  // namespace

double largestBend(std::span<const Vec3> vertices, std::span<const std::vector<int>> loops) {
  return largestOf(currentBends(facesThatCanBend(vertices, loops), vertices));
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
  double least_bend = std::numeric_limits<double>::infinity();
  std::size_t visits = 0;
  for (int round = 0; round < kNewtonRounds; ++round) {
    const std::vector<BentFace> faces = facesThatCanBend(moved, loops);
    const Heights bends = currentBends(faces, moved);
    const double bend = largestOf(bends);
    if (!(bend < least_bend)) break;
    flattest = moved;
    least_bend = bend;
    if (bend <= kNoBend * reach) break;
    const std::vector<Vec3> moves = shortestMoves(faces, moved.size(), bends, visits);
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
