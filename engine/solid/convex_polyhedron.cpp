#include "engine/solid/convex_polyhedron.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "engine/foundation/contract.h"
#include "engine/foundation/index.h"

namespace carom {
namespace {

// A face may be bent, and a neighbour stand out of its plane, by this much relative to the polyhedron's
// radius: far above rounding (1e-15), far below the distances that matter (1e-9).
constexpr double kPlanarity = 1e-9;

// An edge climbs along a direction if its slope is above the rounding of the product of two unit vectors.
constexpr double kRisingSlope = 1e-15;
// Faces whose normals are this close may all be level.
constexpr double kLevelCosine = 1.0 - 1e-12;

// Newell's normal: robust for any planar polygon, whatever its first corner looks like.
Plane fitPlane(const std::vector<Vec3>& vertices, const std::vector<int>& loop) {
  Vec3 normal = Vec3::Zero();
  Vec3 center = Vec3::Zero();
  for (int v : loop) center += vertices[at(v)];
  center /= static_cast<double>(loop.size());
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vec3 a = vertices[at(loop[i])] - center;
    const Vec3 b = vertices[at(loop[(i + 1) % loop.size()])] - center;
    normal += a.cross(b);
  }
  const double twice_area = normal.norm();
  if (!(twice_area > 0.0)) throw InputError("a face has no area");
  normal /= twice_area;
  return {normal, dot(normal, center)};
}

// How far all faces are from a point; not positive outside.
double clearanceAbout(const ConvexPolyhedron& polyhedron, const Vec3& p) {
  double least = std::numeric_limits<double>::infinity();
  for (int f = 0; f < polyhedron.faceCount(); ++f)
    least = std::min(least, -polyhedron.plane(f).signedDistance(p));
  return least;
}

struct HalfEdge {
  int low, high, face, slot;
  bool forward;  // runs low to high in its face
};

}  // namespace

ConvexPolyhedron ConvexPolyhedron::point(const Vec3& p) {
  if (!p.allFinite()) throw InputError("a point has a coordinate that is not finite");
  ConvexPolyhedron result;
  result.vertices_ = {p};
  result.buildSpokes();
  result.measure();
  return result;
}

ConvexPolyhedron ConvexPolyhedron::segment(const Vec3& a, const Vec3& b) {
  const Vec3 d = b - a;
  if (!d.allFinite() || !(d.norm() > 0.0)) throw InputError("a segment needs two distinct finite ends");
  ConvexPolyhedron result;
  result.vertices_ = {a, b};
  Edge e;
  e.tail = 0;
  e.head = 1;
  e.length_m = d.norm();
  e.direction = d / e.length_m;
  result.edges_ = {e};
  result.buildSpokes();
  result.measure();
  return result;
}

ConvexPolyhedron ConvexPolyhedron::fromFaces(std::vector<Vec3> vertices,
                                             const std::vector<std::vector<int>>& loops) {
  if (vertices.size() < 4 || loops.size() < 4)
    throw InputError("a polyhedron needs at least 4 vertices and 4 faces");
  for (const Vec3& v : vertices)
    if (!v.allFinite()) throw InputError("a vertex has a coordinate that is not finite");
  ConvexPolyhedron result;
  result.vertices_ = std::move(vertices);
  for (const std::vector<int>& loop : loops) {
    if (loop.size() < 3) throw InputError("a face needs at least 3 vertices");
    for (int v : loop)
      if (v < 0 || v >= result.vertexCount()) throw InputError("a face names a vertex that does not exist");
    result.planes_.push_back(fitPlane(result.vertices_, loop));
    result.face_vertices_.insert(result.face_vertices_.end(), loop.begin(), loop.end());
    result.face_begin_.push_back(static_cast<int>(result.face_vertices_.size()));
  }
  result.buildEdges(loops);
  result.buildSpokes();
  result.buildSides();
  result.validate();
  result.measure();
  return result;
}

void ConvexPolyhedron::buildEdges(const std::vector<std::vector<int>>& loops) {
  std::vector<HalfEdge> halves;
  int slot = 0;
  for (std::size_t f = 0; f < loops.size(); ++f) {
    for (std::size_t i = 0; i < loops[f].size(); ++i, ++slot) {
      const int a = loops[f][i];
      const int b = loops[f][(i + 1) % loops[f].size()];
      halves.push_back({std::min(a, b), std::max(a, b), static_cast<int>(f), slot, a < b});
    }
  }
  std::sort(halves.begin(), halves.end(), [](const HalfEdge& x, const HalfEdge& y) {
    return std::array{x.low, x.high, x.forward ? 0 : 1, x.face} <
           std::array{y.low, y.high, y.forward ? 0 : 1, y.face};
  });
  face_edges_.assign(face_vertices_.size(), -1);
  if (halves.size() % 2 != 0) throw InputError("the surface is not closed");
  for (std::size_t i = 0; i < halves.size(); i += 2) {
    const HalfEdge& left = halves[i];
    const HalfEdge& right = halves[i + 1];
    const bool paired = left.low == right.low && left.high == right.high && left.forward && !right.forward;
    if (!paired || left.low == left.high)
      throw InputError("the surface is not closed, or its faces disagree in orientation");
    Edge e;
    e.tail = left.low;
    e.head = left.high;
    e.left = left.face;
    e.right = right.face;
    const Vec3 d = vertex(e.head) - vertex(e.tail);
    e.length_m = d.norm();
    if (!(e.length_m > 0.0)) throw InputError("an edge has no length");
    e.direction = d / e.length_m;
    e.into_left = plane(e.left).normal.cross(e.direction).normalized();
    e.into_right = e.direction.cross(plane(e.right).normal).normalized();
    face_edges_[at(left.slot)] = face_edges_[at(right.slot)] = edgeCount();
    edges_.push_back(e);
  }
}

void ConvexPolyhedron::buildSpokes() {
  std::vector<std::vector<Spoke>> stars(vertices_.size());
  for (int i = 0; i < edgeCount(); ++i) {
    const Edge& e = edge(i);
    stars[at(e.tail)].push_back({e.direction, i, e.head});
    stars[at(e.head)].push_back({-e.direction, i, e.tail});
  }
  for (const std::vector<Spoke>& star : stars) {
    spokes_.insert(spokes_.end(), star.begin(), star.end());
    vertex_begin_.push_back(static_cast<int>(spokes_.size()));
  }
}

void ConvexPolyhedron::buildSides() {
  face_sides_.clear();
  for (int f = 0; f < faceCount(); ++f)
    for (int e : faceEdges(f)) {
      const Vec3& into = intoFace(e, f);
      face_sides_.push_back({into, dot(into, vertex(edge(e).tail))});
    }
}

void ConvexPolyhedron::validate() const {
  if (vertexCount() - edgeCount() + faceCount() != 2)
    throw InputError("the surface is not that of one convex body (Euler)");
  Vec3 center = Vec3::Zero();
  for (const Vec3& v : vertices_) center += v;
  center /= static_cast<double>(vertices_.size());
  const double tolerance = kPlanarity * radiusAbout(center);
  for (int f = 0; f < faceCount(); ++f) {
    if (plane(f).signedDistance(center) >= 0.0)
      throw InputError("a face is turned inside out, or the solid is flat");
    for (int v : faceVertices(f))
      if (std::abs(plane(f).signedDistance(vertex(v))) > tolerance) throw InputError("a face is not planar");
    // Local convexity at every edge makes a closed surface convex everywhere.
    for (int e : faceEdges(f))
      for (int v : faceVertices(faceAcross(e, f)))
        if (plane(f).signedDistance(vertex(v)) > tolerance) throw InputError("the surface is not convex");
  }
  for (int v = 0; v < vertexCount(); ++v)
    if (spokes(v).size() < 3) throw InputError("a vertex has fewer than three edges");
}

void ConvexPolyhedron::measure() {
  Vec3 low = vertices_[0];
  Vec3 high = vertices_[0];
  for (const Vec3& v : vertices_) {
    low = low.cwiseMin(v);
    high = high.cwiseMax(v);
  }
  center_ = 0.5 * (low + high);
  radius_m_ = radiusAbout(center_);
  reach_m_ = center_.lpNorm<Eigen::Infinity>() + radius_m_;
  inverse_shortest_edge_ = 0.0;
  for (const Edge& e : edges_) inverse_shortest_edge_ = std::max(inverse_shortest_edge_, 1.0 / e.length_m);
  has_flat_vertices_ = false;
  for (int v = 0; v < vertexCount() && !planes_.empty(); ++v) has_flat_vertices_ |= isFlat(v);
  support_table_ =
      SupportTable(vertexCount(), [this](const Vec3& d, int start) { return support(d, start); });
  width_m_ = planes_.empty() ? 0.0 : std::numeric_limits<double>::infinity();
  for (const Plane& plane : planes_)
    width_m_ = std::min(width_m_, -plane.signedDistance(vertex(support(-plane.normal))));
  inner_ball_ = largestInnerBall();
  fingerprint_ = computeFingerprint();
}

std::uint64_t ConvexPolyhedron::computeFingerprint() const {
  std::uint64_t sum = 0;
  // The finaliser of splitmix64 (Steele, Lea, Flood 2014): every bit of what is added moves all others.
  const auto add = [&sum](std::uint64_t bits) {
    sum += bits + 0x9e3779b97f4a7c15;
    sum = (sum ^ (sum >> 30)) * 0xbf58476d1ce4e5b9;
    sum = (sum ^ (sum >> 27)) * 0x94d049bb133111eb;
    sum ^= sum >> 31;
  };
  for (const Vec3& v : vertices_)
    for (const double x : v) add(std::bit_cast<std::uint64_t>(x));
  for (const std::vector<int>* loops : {&face_begin_, &face_vertices_})
    for (const int i : *loops) add(static_cast<std::uint64_t>(i));
  return sum;
}

// From the middle of two with the larger clearance, away from whatever face is nearest, in ever smaller
// steps.
InnerBall ConvexPolyhedron::largestInnerBall() const {
  Vec3 center = Vec3::Zero();
  for (const Vec3& v : vertices_) center += v;
  center /= static_cast<double>(vertices_.size());
  if (planes_.empty()) return {center, 0.0};
  if (clearanceAbout(*this, center_) >= clearanceAbout(*this, center)) center = center_;
  InnerBall best{center, std::max(0.0, clearanceAbout(*this, center))};
  constexpr int kClearanceSteps = 100;
  double step_m = 0.2 * best.radius_m;
  for (int i = 0; i < kClearanceSteps; ++i, step_m *= 0.95) {
    const Plane& nearest =
        *std::max_element(planes_.begin(), planes_.end(), [&center](const Plane& p, const Plane& q) {
          return p.signedDistance(center) < q.signedDistance(center);
        });
    if (-nearest.signedDistance(center) > best.radius_m) best = {center, -nearest.signedDistance(center)};
    center -= step_m * nearest.normal;
  }
  return best;
}

int ConvexPolyhedron::support(const Vec3& direction, int start) const {
  // Slopes, not heights: along an edge much shorter than the solid the difference of two heights is all
  // rounding. A slope above its own rounding means a truly higher vertex, so this ends.
  const double level = kRisingSlope * direction.norm();
  int here = start;
  for (int next = start; next >= 0;) {
    here = next;
    next = -1;
    double steepest = level;
    for (const Spoke& spoke : spokes(here))
      if (const double slope = dot(spoke.direction, direction); slope > steepest) {
        steepest = slope;
        next = spoke.head;
      }
  }
  return has_flat_vertices_ && facesAway(here, direction) ? farthestVertex(direction) : here;
}

// In the middle of coplanar faces all edges are level, on the far side too.
bool ConvexPolyhedron::facesAway(int v, const Vec3& direction) const {
  return std::ranges::none_of(spokes(v), [&](const Spoke& spoke) {
    return dot(plane(faceBeside(spoke, v)).normal, direction) > 0.0;
  });
}

int ConvexPolyhedron::farthestVertex(const Vec3& direction) const {
  const auto farthest =
      std::ranges::max_element(vertices_, {}, [&](const Vec3& v) { return dot(v, direction); });
  return static_cast<int>(farthest - vertices_.begin());
}

bool ConvexPolyhedron::isFlat(int v) const {
  const Vec3& first = plane(faceBeside(spokes(v)[0], v)).normal;
  return std::ranges::all_of(spokes(v), [&](const Spoke& spoke) {
    return dot(plane(faceBeside(spoke, v)).normal, first) > kLevelCosine;
  });
}

double ConvexPolyhedron::radiusAbout(const Vec3& p) const {
  double squared = 0.0;
  for (const Vec3& v : vertices_) squared = std::max(squared, (v - p).squaredNorm());
  return std::sqrt(squared);
}

ConvexPolyhedron ConvexPolyhedron::translated(const Vec3& shift) const {
  ConvexPolyhedron result = *this;
  for (Vec3& v : result.vertices_) v += shift;
  for (Plane& p : result.planes_) p.offset += dot(p.normal, shift);
  result.center_ += shift;
  result.reach_m_ = result.center_.lpNorm<Eigen::Infinity>() + radius_m_;
  if (!result.planes_.empty()) result.buildSides();
  result.inner_ball_.center += shift;
  result.fingerprint_ = result.computeFingerprint();
  if (!result.planes_.empty())
    result.inner_ball_.radius_m = std::max(0.0, clearanceAbout(result, result.inner_ball_.center));
  return result;
}

}  // namespace carom
