#include "engine/closest_features/canonical_features.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "engine/closest_features/separated/level_axes.h"
#include "engine/foundation/index.h"
#include "engine/foundation/stack_arena.h"

namespace carom {
namespace {

// Edges closer to parallel than this do not cross: their ends lie over each other.
constexpr double kNoCrossingSine = 1e-9;
// Slabs that agree with the distance to this share of the noise are preferred to those that only just do.
constexpr double kEqual = 0.125;
// Witnesses this many times the noise beside an axis still are its witnesses.
constexpr double kOffAxis = 32.0;

// Bytes for what touches two support planes: faces of some hundreds of corners, and the axes level with them.
constexpr std::size_t kSupportBytes = std::size_t{32} << 10;

// Relative poses that differ by less than this, relative to the bodies' size, are the same.
constexpr double kSamePose = 1e-9;

int sign(double x, double tolerance) {
  return x > tolerance ? 1 : x < -tolerance ? -1 : 0;
}

// The order of two solids: negative if the first comes first, 0 if they are equal.
int compareSolids(const ConvexPolyhedron& a, const ConvexPolyhedron& b) {
  if (&a == &b) return 0;
  if (a.vertexCount() != b.vertexCount()) return a.vertexCount() - b.vertexCount();
  if (a.edgeCount() != b.edgeCount()) return a.edgeCount() - b.edgeCount();
  for (int v = 0; v < a.vertexCount(); ++v)
    for (Eigen::Index k = 0; k < 3; ++k)
      if (const int s = sign(a.vertex(v)[k] - b.vertex(v)[k], 0.0)) return s;
  return 0;
}

// Whether A is the first of the two, in an order that swapping them turns around and moving both keeps: by
// their solids, of equal ones by where each sees the other.
bool firstIsA(const PolyhedronPair& pair) {
  if (const int s = compareSolids(pair.a, pair.b)) return s < 0;
  const PolyhedronPair swapped = pair.swapped();
  const double size = pair.t_AB.lpNorm<1>() + pair.a.reach();
  for (Eigen::Index k = 0; k < 3; ++k)
    if (const int s = sign(pair.t_AB[k] - swapped.t_AB[k], kSamePose * size)) return s < 0;
  for (Eigen::Index k = 0; k < 9; ++k)
    if (const int s = sign(pair.R_AB(k % 3, k / 3) - swapped.R_AB(k % 3, k / 3), kSamePose)) return s < 0;
  return true;
}

// Everything of a polyhedron that touches its support plane along a direction, within a tolerance.
class SupportSet {
 public:
  SupportSet(const ConvexPolyhedron& polyhedron, Arena* memory)
      : polyhedron_(&polyhedron), vertices_(memory), edges_(memory), faces_(memory), seen_(memory) {}

  void gather(const Vec3& n, int start, double level_m, double shift_m) {
    const ConvexPolyhedron& polyhedron = *polyhedron_;
    n_ = n;
    shift_m_ = shift_m;
    seen_.assign(polyhedron.vertices().size(), 0);
    const int top = polyhedron.support(n, start);
    vertices_.clear();
    add(top);
    for (std::size_t i = 0; i < vertices_.size(); ++i)
      for (const Spoke& spoke : polyhedron.spokes(vertices_[i]))
        if (!contains(spoke.head) &&
            dot(n, polyhedron.vertex(top) - polyhedron.vertex(spoke.head)) <= level_m)
          add(spoke.head);
    std::sort(vertices_.begin(), vertices_.end());
    gatherEdges();
    gatherFaces();
  }

  std::span<const int> vertices() const { return vertices_; }
  const Vec3& top() const { return polyhedron_->vertex(vertices_[0]); }

  // The lowest feature of the set over or under p.
  std::optional<Feature> holding(const Vec3& p) const {
    bool at_a_border = faces_.empty();
    for (const int f : faces_) {
      const double inside = insideFace(f, p);
      if (inside > shift_m_) return faceFeature(f);
      at_a_border = at_a_border || inside >= -shift_m_;
    }
    if (!at_a_border) return std::nullopt;
    for (const int v : vertices_)
      if (alongPlane(p - polyhedron_->vertex(v)).squaredNorm() <= shift_m_ * shift_m_)
        return vertexFeature(v);
    for (const int e : edges_)
      if (isOver(e, p)) return edgeFeature(e);
    return std::nullopt;
  }

  std::span<const int> edges() const { return edges_; }

 private:
  void add(int v) {
    seen_[at(v)] = 1;
    vertices_.push_back(v);
  }
  bool contains(int v) const { return seen_[at(v)] != 0; }

  void gatherEdges() {
    edges_.clear();
    for (const int v : vertices_)
      for (const Spoke& spoke : polyhedron_->spokes(v))
        if (spoke.head > v && contains(spoke.head)) edges_.push_back(spoke.edge);
  }
  void gatherFaces() {
    faces_.clear();
    if (vertices_.size() < 3) return;
    for (const int v : vertices_)
      for (const Spoke& spoke : polyhedron_->spokes(v)) {
        const Edge& edge = polyhedron_->edge(spoke.edge);
        const int face = edge.tail == v ? edge.left : edge.right;
        if (contains(spoke.head) && std::find(faces_.begin(), faces_.end(), face) == faces_.end() &&
            isLevel(face))
          faces_.push_back(face);
      }
    std::sort(faces_.begin(), faces_.end());
  }
  bool isLevel(int f) const {
    if (f < 0) return false;
    const auto corners = polyhedron_->faceVertices(f);
    return dot(polyhedron_->plane(f).normal, n_) > 0.0 &&
           std::all_of(corners.begin(), corners.end(), [this](int v) { return contains(v); });
  }

  Vec3 alongPlane(const Vec3& d) const { return d - dot(n_, d) * n_; }
  bool isOver(int e, const Vec3& p) const {
    const Edge& edge = polyhedron_->edge(e);
    const Vec3 from_tail = p - polyhedron_->vertex(edge.tail);
    const double s = dot(edge.direction, from_tail);
    return s > 0.0 && s < edge.length_m &&
           alongPlane(from_tail - s * edge.direction).squaredNorm() <= shift_m_ * shift_m_;
  }
  // How far p is inside the sides of a face; of a point beyond one of them, only that it is. It is beyond all
  // sides of one stretch, which long strides around the face soon meet.
  double insideFace(int f, const Vec3& p) const {
    const std::span<const Plane> sides = polyhedron_->faceSides(f);
    const std::size_t stride = std::max<std::size_t>(1, sides.size() / 8);
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t first = 0; first < stride; ++first)
      for (std::size_t i = first; i < sides.size(); i += stride) {
        least = std::min(least, sides[i].signedDistance(p));
        if (least < -shift_m_) return least;
      }
    return least;
  }

  const ConvexPolyhedron* polyhedron_;
  Vec3 n_ = Vec3::Zero();
  double shift_m_ = 0.0;
  ArenaVector<int> vertices_, edges_, faces_;
  ArenaVector<char> seen_;  // by vertex
};

struct SupportSets {
  SupportSets(const PolyhedronPair& pair, Arena* memory) : a(pair.a, memory), b(pair.b, memory) {}

  void gather(const PolyhedronPair& pair, const FeaturePair& start, const Vec3& n, double noise_m,
              double shift_m) {
    a.gather(n, vertexOf(pair.a, start.a), noise_m, shift_m);
    b.gather(-pair.directionToB(n), vertexOf(pair.b, start.b), noise_m, shift_m);
  }

  SupportSet a, b;
};

// A vertex of one set over the other: the corner with the lowest vertex index.
bool takeLowestVertex(const PolyhedronPair& pair, const SupportSets& sets, CoreAnswer& answer) {
  const std::span<const int> on_a = sets.a.vertices();
  const std::span<const int> on_b = sets.b.vertices();
  const auto past_end = [](std::span<const int> list, std::size_t i) { return i == list.size(); };
  for (std::size_t i = 0, j = 0; !past_end(on_a, i) || !past_end(on_b, j);) {
    const bool try_a = !past_end(on_a, i) && (past_end(on_b, j) || on_a[i] <= on_b[j]);
    const bool try_b = !past_end(on_b, j) && (past_end(on_a, i) || on_b[j] <= on_a[i]);
    std::optional<Feature> holds_a, holds_b;
    if (try_a) holds_a = sets.b.holding(pair.toB(pair.a.vertex(on_a[i])));
    if (try_b) holds_b = sets.a.holding(pair.toA(pair.b.vertex(on_b[j])));
    const auto order = [](Feature f) { return std::pair{f.kind, f.index}; };
    const bool a_holds_lower = holds_a && (!holds_b || order(*holds_a) < order(*holds_b) ||
                                           (order(*holds_a) == order(*holds_b) && firstIsA(pair)));
    if (a_holds_lower) {
      answer.features = {vertexFeature(on_a[i]), *holds_a};
      answer.p_a = pair.a.vertex(on_a[i]);
      answer.p_b = answer.p_a + answer.gap_m * answer.normal;
      return true;
    }
    if (holds_b) {
      answer.features = {*holds_b, vertexFeature(on_b[j])};
      answer.p_b = pair.toA(pair.b.vertex(on_b[j]));
      answer.p_a = answer.p_b - answer.gap_m * answer.normal;
      return true;
    }
    if (try_a) ++i;
    if (try_b) ++j;
  }
  return false;
}

// No vertex of one set lies over the other: edges of the sets cross, and the lowest indices count.
bool takeLowestCrossing(const PolyhedronPair& pair, const SupportSets& sets, CoreAnswer& answer) {
  std::optional<std::pair<int, int>> lowest;
  for (const int i : sets.a.edges())
    for (const int j : sets.b.edges()) {
      const std::pair<int, int> key = std::minmax(i, j);
      if (lowest && key >= *lowest && !(key == *lowest && i != j && (i < j) == firstIsA(pair))) continue;
      const Edge& e1 = pair.a.edge(i);
      const Edge& e2 = pair.b.edge(j);
      const Vec3 d2 = pair.directionToA(e2.direction);
      const Vec3 across = e1.direction.cross(d2);
      const double squared = across.squaredNorm();
      if (squared < kNoCrossingSine * kNoCrossingSine) continue;
      const Vec3 between = pair.toA(pair.b.vertex(e2.tail)) - pair.a.vertex(e1.tail);
      const double s1 = dot(between.cross(d2), across) / squared;
      const double s2 = dot(between.cross(e1.direction), across) / squared;
      if (!(s1 > 0.0 && s1 < e1.length_m && s2 > 0.0 && s2 < e2.length_m)) continue;
      lowest = key;
      answer.features = {edgeFeature(i), edgeFeature(j)};
      answer.p_a = pair.a.vertex(e1.tail) + s1 * e1.direction;
      answer.p_b = answer.p_a + answer.gap_m * answer.normal;
    }
  return lowest.has_value();
}

bool definesNormal(const FeaturePair& features) {
  return features.a.kind == FeatureKind::kFace || features.b.kind == FeatureKind::kFace ||
         (features.a.kind == FeatureKind::kEdge && features.b.kind == FeatureKind::kEdge);
}

}  // namespace

bool comesBefore(const PolyhedronPair& pair, const FeaturePair& x, const FeaturePair& y) {
  const auto order = [](const FeaturePair& f) {
    return std::array{static_cast<int>(f.a.kind) + static_cast<int>(f.b.kind), std::min(f.a.index, f.b.index),
                      std::max(f.a.index, f.b.index)};
  };
  if (order(x) != order(y)) return order(x) < order(y);
  const auto ofFirst = [&pair](const FeaturePair& f) {
    const Feature first = firstIsA(pair) ? f.a : f.b;
    return std::pair{first.kind, first.index};
  };
  return ofFirst(x) < ofFirst(y);
}

bool makeCanonical(const PolyhedronPair& pair, CoreAnswer& answer, double noise_m, double shift_m) {
  const CoreAnswer given = answer;
  StackArena<kSupportBytes> arena;
  SupportSets sets(pair, &arena);
  const auto takeLowest = [&] {
    sets.gather(pair, given.features, answer.normal, noise_m, shift_m);
    return takeLowestVertex(pair, sets, answer) || takeLowestCrossing(pair, sets, answer);
  };
  const double slab = slabAlong(pair, given.features, given.normal);
  if (definesNormal(given.features) && std::abs(slab - given.gap_m) <= kEqual * noise_m) return takeLowest();
  MinimumTranslations axes(&arena);
  gatherLevelAxes(pair, given, noise_m, axes);
  const MinimumTranslation* widest = nullptr;
  for (const double tolerance_m : {kEqual * noise_m, noise_m})
    for (const MinimumTranslation& axis : axes) {
      if (std::abs(axis.gap_m - given.gap_m) > tolerance_m) continue;
      if (!widest || axis.gap_m > widest->gap_m) widest = &axis;
      answer.normal = axis.normal;
      answer.gap_m = axis.gap_m;
      if (takeLowest()) return true;
    }
  answer = given;
  if (takeLowest()) return true;
  const bool on_axis =
      widest && (given.p_b - given.p_a - given.gap_m * widest->normal).norm() <= kOffAxis * noise_m;
  if (on_axis && widest->gap_m > slab) answer.normal = widest->normal;
  return false;
}

}  // namespace carom
