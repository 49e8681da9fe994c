#include "engine/closest_features/penetrating/inner_polytope.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/foundation/index.h"

namespace carom {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// A triangle lower than this share of its length has no trustworthy normal, and no point farther than that
// from its edges.
constexpr double kSliver = 0x1p-46;
// Corners that are no longer extreme dent the surface, and each dent must be raised anew: a polytope that has
// gained this many since it was built is better begun again.
constexpr std::size_t kAgeing = 16;
// Planes whose normals are this close are of one facet.
constexpr double kSameDirection = 1.0 - 1e-12;
// The start is a tetrahedron of at least this share of its size.
constexpr double kThinnestStart = 1e-12;
// Of a remembered polytope at most one triangle in this many may be low: with more it is made anew as fast.
constexpr int kFewLow = 4;

// Of the edges at a vertex, the two most level across n.
struct LevelEdges {
  LevelEdges(const ConvexPolyhedron& polyhedron, int v, const Vec3& n) {
    for (const Spoke& spoke : polyhedron.spokes(v)) {
      const double slope = std::abs(dot(spoke.direction, n));
      if (slope < slopes[0]) {
        slopes[1] = slopes[0];
        edges[1] = edges[0];
        slopes[0] = slope;
        edges[0] = spoke.edge;
      } else if (slope < slopes[1]) {
        slopes[1] = slope;
        edges[1] = spoke.edge;
      }
    }
  }
  std::array<int, 2> edges{-1, -1};
  std::array<double, 2> slopes{kInfinity, kInfinity};
};

double distanceToSegment(const Vec3& from, const Vec3& to) {
  const Vec3 side = to - from;
  const double squared = side.squaredNorm();
  const double s = squared > 0.0 ? std::clamp(-dot(side, from) / squared, 0.0, 1.0) : 0.0;
  return (from + s * side).norm();
}

}  // namespace

MinimumTranslation InnerPolytope::minimumTranslation(const PolyhedronPair& pair, double noise_m,
                                                     const MinimumTranslation* known) {
  if (const auto followed = follow(pair, noise_m, known)) return *followed;
  begin(noise_m, known);
  if (!build(pair) || !raise(pair, From::kNothing)) {
    forget();
    return largestGap(pair);
  }
  if (best_.gap_m >= -noise_m) forget();
  return best_;
}

std::optional<MinimumTranslation> InnerPolytope::follow(const PolyhedronPair& pair, double noise_m,
                                                        const MinimumTranslation* known) {
  if (triangles_.empty()) return std::nullopt;
  if (!isOf(pair)) {
    forget();
    return std::nullopt;
  }
  const double motion = motionTo(pair);
  const bool still_winds = provenDepth() - motion > noise_m;
  const bool aged = corners_.size() > corners_when_built_ + kAgeing;
  if (still_winds && !aged) {
    odometer_m_ += motion;
    R_AB_ = pair.R_AB;
    t_AB_ = pair.t_AB;
    const FeaturePair last = best_.features;
    begin(noise_m, known);
    if (known == nullptr) recall(pair, last);
    if (raise(pair, From::kMemory)) return best_;
  }
  forget();
  if (still_winds) return minimumTranslation(pair, noise_m, known);
  // Whether the bodies still intersect is not known, but that they overlap along the given axis: from there a
  // new polytope takes fewer points, unless they turn out to have parted.
  if (known == nullptr) return std::nullopt;
  begin(noise_m, known);
  if (build(pair) && raise(pair, From::kFacet)) return best_;
  forget();
  return std::nullopt;
}

void InnerPolytope::begin(double noise_m, const MinimumTranslation* known) {
  noise_m_ = noise_m;
  expansions_ = 0;
  ++query_;
  best_.gap_m = -kInfinity;
  if (known != nullptr) keep(*known);
}

double InnerPolytope::provenDepth() const {
  double least = kInfinity;
  for (const double reach : reach_) least = std::min(least, reach);
  return least - odometer_m_;
}

void InnerPolytope::forget() {
  corners_.clear();
  triangles_.clear();
  reach_.clear();
  free_.clear();
  odometer_m_ = 0.0;
}

// How far a corner may move from where the last query left it.
double InnerPolytope::motionTo(const PolyhedronPair& pair) const {
  const Mat3 turn = pair.R_AB - R_AB_;
  // The norm of the difference of two rotations is that of Frobenius over the root of two.
  return (turn * pair.b.center() + (pair.t_AB - t_AB_)).norm() +
         std::sqrt(0.5) * turn.norm() * pair.b.radius();
}

// The facet of the last answer is an axis of this query too, and mostly the best.
void InnerPolytope::recall(const PolyhedronPair& pair, FeaturePair last) {
  if (last.a.kind == FeatureKind::kFace) {
    keep(gapOverFaceOfA(pair, last.a.index, last.b.index));
  } else if (last.b.kind == FeatureKind::kFace) {
    keep(gapOverFaceOfB(pair, last.b.index, last.a.index));
  } else if (last.a.kind == FeatureKind::kEdge && last.b.kind == FeatureKind::kEdge) {
    if (const auto across = gapAcrossEdges(pair, last.a.index, last.b.index, best_.normal)) keep(*across);
  }
}

void InnerPolytope::keep(const MinimumTranslation& found) {
  if (found.gap_m > best_.gap_m) best_ = found;
}

// A tetrahedron between support points: far apart along a line, far from the line, far from the plane.
bool InnerPolytope::build(const PolyhedronPair& pair) {
  forget();
  bodies_ = {pair.a.fingerprint(), pair.b.fingerprint()};
  R_AB_ = pair.R_AB;
  t_AB_ = pair.t_AB;
  const Corner any = cornerOf(pair, 0, 0);
  const auto farthest = [&](std::initializer_list<Vec3> directions, auto&& distance) {
    Corner best = any;
    double most = -kInfinity;
    for (const Vec3& d : directions)
      for (const double sign : {1.0, -1.0}) {
        const Corner c = supportAlong(pair, sign * d, any);
        if (const double far = distance(c.w); far > most) {
          most = far;
          best = c;
        }
      }
    return best;
  };
  const auto axes = {Vec3(Vec3::UnitX()), Vec3(Vec3::UnitY()), Vec3(Vec3::UnitZ())};
  const Corner c0 = farthest(axes, [&](const Vec3& w) { return (w - any.w).norm(); });
  const Corner c1 = farthest(axes, [&](const Vec3& w) { return (w - c0.w).norm(); });
  const double length = (c1.w - c0.w).norm();
  if (!(length > 0.0)) return false;
  const Vec3 along = (c1.w - c0.w) / length;
  const TangentBasis across = tangentBasis(along);
  const Corner c2 =
      farthest({across.t1, across.t2}, [&](const Vec3& w) { return along.cross(w - c0.w).norm(); });
  const Vec3 normal = along.cross(c2.w - c0.w);
  const double breadth = normal.norm();
  if (!(breadth > kThinnestStart * length)) return false;
  const Vec3 up = normal / breadth;
  const Corner c3 = farthest({up}, [&](const Vec3& w) { return std::abs(dot(up, w - c0.w)); });
  const double rise = dot(up, c3.w - c0.w);
  if (!(std::abs(rise) > kThinnestStart * length)) return false;
  corners_ = {c0, c1, c2, c3};
  if (rise > 0.0) std::swap(corners_[1], corners_[2]);  // 0, 1, 2 counter-clockwise seen from opposite 3
  for (const auto& corners : {std::array{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}})
    addTriangle(pair, corners);
  triangles_[0].neighbours = {1, 2, 3};
  triangles_[1].neighbours = {3, 2, 0};
  triangles_[2].neighbours = {1, 3, 0};
  triangles_[3].neighbours = {2, 1, 0};
  corners_when_built_ = 0;
  return true;
}

// False if it takes too many points, or, but from nothing, the bodies have parted.
bool InnerPolytope::raise(const PolyhedronPair& pair, From from) {
  // The least support so far: the depth is at most that.
  double depth = -best_.gap_m;
  Corner deepest{};
  Vec3 normal = best_.normal;
  findLow(pair, depth - noise_m_);
  if (from == From::kMemory && kFewLow * static_cast<int>(low_.size()) > triangleCount()) return false;
  const int limit = 200 + 20 * (pair.a.vertexCount() + pair.b.vertexCount());
  for (int i = 0; i < limit; ++i) {
    if (from != From::kNothing && depth <= noise_m_) return false;
    const int lowest = takeLowest(depth - noise_m_);
    if (lowest < 0) {
      if (depth < -best_.gap_m) nameFacet(pair, deepest, normal, depth);
      if (corners_when_built_ == 0) corners_when_built_ = corners_.size();
      return true;
    }
    const Triangle& t = triangles_[at(lowest)];
    const Corner support = supportAlong(pair, t.normal, corners_[at(t.corners[0])]);
    const double height = dot(t.normal, support.w);
    if (height < depth) {
      depth = height;
      deepest = support;
      normal = t.normal;
    }
    if (height > t.height_m + 0.5 * noise_m_) expand(pair, support, lowest);
  }
  return false;
}

// Every triangle that is lower than `enough_m`, measured.
void InnerPolytope::findLow(const PolyhedronPair& pair, double enough_m) {
  low_.clear();
  const double reached = odometer_m_ + enough_m;
  for (std::size_t i = 0; i < reach_.size(); ++i) {
    if (!(reach_[i] < reached)) continue;
    if (triangles_[i].measured != query_) measure(pair, static_cast<int>(i));
    if (triangles_[i].height_m < enough_m) low_.push_back(static_cast<int>(i));
  }
}

// The lowest of the low triangles that stand, if it is below `enough_m`; -1 if none is.
int InnerPolytope::takeLowest(double enough_m) {
  int lowest = -1;
  double least = enough_m;
  std::size_t kept = 0;
  for (const int i : low_) {
    const Triangle& t = triangles_[at(i)];
    if (t.removed || t.height_m >= enough_m) continue;
    low_[kept++] = i;
    if (t.height_m < least) {
      least = t.height_m;
      lowest = i;
    }
  }
  low_.resize(kept);
  return lowest;
}

// The features of the facet of M that a plane with this normal, at this height, touches at a corner.
void InnerPolytope::nameFacet(const PolyhedronPair& pair, const Corner& corner, const Vec3& normal,
                              double height_m) {
  considerFacetsAt(pair, corner, normal);
  if (height_m < -best_.gap_m - 0.5 * noise_m_)
    best_ = {-height_m,
             normal,
             {vertexFeature(corner.a), vertexFeature(corner.b)},
             pair.a.vertex(corner.a),
             pair.toA(pair.b.vertex(corner.b))};
}

void InnerPolytope::equalFacets(const PolyhedronPair& pair, MinimumTranslations& facets) {
  const MinimumTranslation best = best_;
  facets.assign(1, best);
  for (std::size_t i = 0; i < reach_.size(); ++i) {
    if (!(boundNow(i) <= noise_m_ - best.gap_m)) continue;
    if (triangles_[i].measured != query_) measure(pair, static_cast<int>(i));
    const Triangle& t = triangles_[i];
    const bool known = std::any_of(facets.begin(), facets.end(), [&](const MinimumTranslation& facet) {
      return dot(facet.normal, t.normal) > kSameDirection;
    });
    if (known || t.height_m > noise_m_ - best.gap_m) continue;
    best_.gap_m = -kInfinity;
    considerFacetsAt(pair, supportAlong(pair, t.normal, corners_[at(t.corners[0])]), t.normal);
    if (best_.gap_m >= best.gap_m - noise_m_) facets.push_back(best_);
  }
  best_ = best;
}

void InnerPolytope::placeWitnesses(const PolyhedronPair& pair, MinimumTranslation& answer) {
  const Vec3 foot = -answer.gap_m * answer.normal;  // the point of M's surface nearest the origin
  double innermost = -kInfinity;
  for (std::size_t i = 0; i < reach_.size(); ++i) {
    if (!(boundNow(i) <= 4.0 * noise_m_ - answer.gap_m)) continue;
    if (triangles_[i].measured != query_) measure(pair, static_cast<int>(i));
    const Triangle& t = triangles_[i];
    if (t.height_m == kInfinity) continue;  // a sliver
    const std::array<Vec3, 3> w = positions(pair, static_cast<int>(i));
    std::array<double, 3> share{};
    double sum = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3& next = w[(k + 1) % 3];
      share[k] = dot(answer.normal, (w[(k + 2) % 3] - next).cross(foot - next));
      sum += share[k];
    }
    const double inside = std::min({share[0], share[1], share[2]}) / sum;
    if (!(sum > 0.0) || inside <= innermost) continue;
    innermost = inside;
    sum = 0.0;
    for (double& s : share) sum += s = std::max(s, 0.0);
    answer.p_a = Vec3::Zero();
    for (std::size_t k = 0; k < 3; ++k)
      answer.p_a += share[k] / sum * pair.a.vertex(corners_[at(t.corners[k])].a);
    answer.p_b = answer.p_a + answer.gap_m * answer.normal;
  }
}

// The axes of the facets of M around a corner: each is an upper bound of the depth, the facet that holds the
// corner's triangle the exact one.
void InnerPolytope::considerFacetsAt(const PolyhedronPair& pair, const Corner& corner, const Vec3& n) {
  const Vec3 minus_n_B = -pair.directionToB(n);
  if (const int f = faceTowards(pair.a, corner.a, n); f >= 0) keep(gapOverFaceOfA(pair, f, corner.b));
  if (const int f = faceTowards(pair.b, corner.b, minus_n_B); f >= 0) keep(gapOverFaceOfB(pair, f, corner.a));
  const LevelEdges on_a(pair.a, corner.a, n);
  const LevelEdges on_b(pair.b, corner.b, minus_n_B);
  for (const int e1 : on_a.edges)
    for (const int e2 : on_b.edges)
      if (e1 >= 0 && e2 >= 0)
        if (const auto across = gapAcrossEdges(pair, e1, e2, n)) keep(*across);
}

// Puts the corner over `seen` and the triangles around it that it is not below.
void InnerPolytope::expand(const PolyhedronPair& pair, const Corner& corner, int seen) {
  ++expansions_;
  const int tip = static_cast<int>(corners_.size());
  corners_.push_back(corner);
  findHorizon(pair, corner.w, seen);
  for (const int i : visible_) {
    reach_[at(i)] = kInfinity;
    free_.push_back(i);
  }
  // Each edge of the horizon carries a triangle up to the tip; `inner` now names that.
  for (HorizonEdge& edge : horizon_) {
    edge.inner = addTriangle(pair, {edge.from, edge.to, tip});
    low_.push_back(edge.inner);
    triangles_[at(edge.inner)].neighbours[0] = edge.outer;
    connect(edge.outer, edge.to, edge.inner);
  }
  for (const HorizonEdge& edge : horizon_)
    for (const HorizonEdge& next : horizon_)
      if (next.from == edge.to && triangles_[at(next.inner)].neighbours[2] < 0) {
        triangles_[at(edge.inner)].neighbours[1] = next.inner;
        triangles_[at(next.inner)].neighbours[2] = edge.inner;
        break;
      }
}

// The connected triangles around `seen` that w is not below, and the edges where they end.
void InnerPolytope::findHorizon(const PolyhedronPair& pair, const Vec3& w, int seen) {
  visible_.assign(1, seen);
  horizon_.clear();
  triangles_[at(seen)].removed = true;
  for (std::size_t i = 0; i < visible_.size(); ++i) {
    const Triangle& t = triangles_[at(visible_[i])];
    for (std::size_t k = 0; k < 3; ++k) {
      const int n = t.neighbours[k];
      Triangle& neighbour = triangles_[at(n)];
      if (neighbour.removed) continue;
      if (neighbour.measured != query_) measure(pair, n);
      if (dot(neighbour.normal, w) > neighbour.height_m - 0.25 * noise_m_) {
        neighbour.removed = true;
        visible_.push_back(n);
      }
    }
  }
  for (const int i : visible_) {
    const Triangle& t = triangles_[at(i)];
    for (std::size_t k = 0; k < 3; ++k)
      if (!triangles_[at(t.neighbours[k])].removed)
        horizon_.push_back({t.corners[k], t.corners[(k + 1) % 3], t.neighbours[k], i});
  }
}

// The triangle's edge that begins at corner `from` now leads to `neighbour`.
void InnerPolytope::connect(int triangle, int from, int neighbour) {
  Triangle& t = triangles_[at(triangle)];
  for (std::size_t k = 0; k < 3; ++k)
    if (t.corners[k] == from) t.neighbours[k] = neighbour;
}

InnerPolytope::Corner InnerPolytope::supportAlong(const PolyhedronPair& pair, const Vec3& n,
                                                  const Corner& start) const {
  return cornerOf(pair, pair.a.support(n, start.a), pair.b.support(-pair.directionToB(n), start.b));
}

InnerPolytope::Corner InnerPolytope::cornerOf(const PolyhedronPair& pair, int a, int b) const {
  return {a, b, pair.a.vertex(a) - pair.toA(pair.b.vertex(b)), query_};
}

const Vec3& InnerPolytope::position(const PolyhedronPair& pair, int corner) {
  Corner& c = corners_[at(corner)];
  if (c.moved != query_) c = cornerOf(pair, c.a, c.b);
  return c.w;
}

std::array<Vec3, 3> InnerPolytope::positions(const PolyhedronPair& pair, int triangle) {
  const auto& corners = triangles_[at(triangle)].corners;
  return {position(pair, corners[0]), position(pair, corners[1]), position(pair, corners[2])};
}

void InnerPolytope::measure(const PolyhedronPair& pair, int triangle) {
  Triangle& t = triangles_[at(triangle)];
  const Vec3& w0 = position(pair, t.corners[0]);
  const Vec3& w1 = position(pair, t.corners[1]);
  const Vec3& w2 = position(pair, t.corners[2]);
  const Vec3 side1 = w1 - w0;
  const Vec3 side2 = w2 - w0;
  const Vec3 across = side1.cross(side2);
  const double twice_area = across.norm();
  double distance_m;
  if (twice_area > kSliver * (side1.squaredNorm() + side2.squaredNorm())) {
    t.normal = across / twice_area;
    t.height_m = std::min({dot(t.normal, w0), dot(t.normal, w1), dot(t.normal, w2)});
    distance_m = t.height_m;
  } else {
    t.normal = Vec3::Zero();
    t.height_m = kInfinity;
    distance_m = std::min({distanceToSegment(w0, w1), distanceToSegment(w1, w2), distanceToSegment(w2, w0)});
  }
  t.measured = query_;
  reach_[at(triangle)] = distance_m + odometer_m_;
}

int InnerPolytope::addTriangle(const PolyhedronPair& pair, const std::array<int, 3>& corners) {
  int place = static_cast<int>(triangles_.size());
  if (free_.empty()) {
    triangles_.emplace_back();
    reach_.emplace_back();
  } else {
    place = free_.back();
    free_.pop_back();
  }
  Triangle& t = triangles_[at(place)];
  t.corners = corners;
  t.neighbours = {-1, -1, -1};
  t.removed = false;
  measure(pair, place);
  return place;
}

}  // namespace carom
