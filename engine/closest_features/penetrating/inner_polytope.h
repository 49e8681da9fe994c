#pragma once
// The exact depth of two intersecting polyhedra by a polytope that grows inside their Minkowski difference
// M = A - B (the expanding polytope of van den Bergen 2001), kept from query to query.
//
// Depth = the least height of a supporting plane of M over the origin. Any direction n bounds it from above
// by its support, max n.w over M, which hill climbing finds exactly. From below it is bounded by a closed
// surface of triangles between points of M that winds around the origin: a ball about the origin that reaches
// no triangle lies inside the surface, so inside M. The lowest triangle is raised by the support point
// over it until it lies on M's own surface; then both bounds meet. The proof asks for no convexity, only that
// a triangle is replaced when the new point is not below its plane, so that what is swept holds no interior
// point; rounding can cost a needless triangle, not the bound.
//
// From query to query the corners move by less than the bodies' relative motion. A triangle whose distance,
// less the motion since it was measured, is above the depth needs no look; and the surface still winds around
// the origin as long as no triangle can have passed through it. Raising the surface never unwinds it: a
// triangle gives way to those up to a point above it, which adds the tetrahedron between them.
//
// A polytope of which that is not certain, as one of bodies that have moved by more than it was away from the
// origin, or that takes many points to mend, is forgotten. Slivers have no trustworthy normal: they are never
// raised and prove nothing, but they too can pass through the origin, so the distance of their edges counts
// in the motion that is allowed. Tested in tests/engine/closest_features/penetrating/inner_polytope_test.cpp
// and any_history_test.cpp.

#include <array>
#include <cstdint>

#include "engine/closest_features/penetrating/penetration.h"

namespace carom {

class InnerPolytope {
 public:
  InnerPolytope() : InnerPolytope(nullptr) {}
  /// Its memory comes from `memory`, that of a copy from the heap.
  explicit InnerPolytope(Arena* memory)
      : corners_(memory),
        triangles_(memory),
        reach_(memory),
        free_(memory),
        visible_(memory),
        low_(memory),
        horizon_(memory) {}

  /// The minimum translation of `pair`; what was built for the last query is used if it still holds. At least
  /// one of the two must have faces. `known`: the gap along some axis, from which on to search; else the last
  /// answer's. `gap_m` > 0: a separating axis was found. Nothing is kept of a pair that does not intersect.
  MinimumTranslation minimumTranslation(const PolyhedronPair& pair, double noise_m,
                                        const MinimumTranslation* known = nullptr);

  /// Whether it was built of these bodies, wherever they stand.
  bool isOf(const PolyhedronPair& pair) const {
    return bodies_ == std::array{pair.a.fingerprint(), pair.b.fingerprint()};
  }
  /// The same of bodies that may have parted since the last query: none, and all is forgotten, if they have,
  /// or neither the polytope nor `known` is a start.
  std::optional<MinimumTranslation> follow(const PolyhedronPair& pair, double noise_m,
                                           const MinimumTranslation* known = nullptr);

  /// Triangles of the surface that proves the last answer.
  int triangleCount() const { return static_cast<int>(triangles_.size() - free_.size()); }
  /// The facets that are as near as the last answer's, to rounding: that one, and others in exact ties.
  void equalFacets(const PolyhedronPair& pair, MinimumTranslations& facets);
  /// Witnesses of the last answer as weighted means of vertices, where no feature pair is certain to hold
  /// them.
  void placeWitnesses(const PolyhedronPair& pair, MinimumTranslation& answer);

  /// Calls visit(corners, neighbours) for each triangle: its corners as the vertices (of A, of B) whose
  /// differences they are, counter-clockwise seen from outside, and the numbers of the triangles across the
  /// edges that begin at each, counted in the order of the visits.
  template <typename Visit>
  void forEachTriangle(Visit&& visit) const {
    std::vector<int> number(triangles_.size(), -1);
    int count = 0;
    for (std::size_t i = 0; i < triangles_.size(); ++i)
      if (!triangles_[i].removed) number[i] = count++;
    for (const Triangle& t : triangles_) {
      if (t.removed) continue;
      std::array<std::array<int, 2>, 3> corners;
      std::array<int, 3> neighbours;
      for (std::size_t k = 0; k < 3; ++k) {
        const Corner& c = corners_[static_cast<std::size_t>(t.corners[k])];
        corners[k] = {c.a, c.b};
        neighbours[k] = number[static_cast<std::size_t>(t.neighbours[k])];
      }
      visit(corners, neighbours);
    }
  }

  /// Support points added by the last query.
  int expansions() const { return expansions_; }
  /// How far all triangles are from the origin at least, as the heights of their planes tell (of slivers
  /// their edges): a lower bound of the last answer's depth.
  double provenDepth() const;
  void forget();

 private:
  struct Corner {
    int a, b;  // the vertices whose difference it is
    Vec3 w;
    int moved;  // the query at which w was computed
  };
  struct Triangle {
    std::array<int, 3> corners;     // counter-clockwise seen from outside
    std::array<int, 3> neighbours;  // across the edge from the k-th to the next corner
    Vec3 normal;
    double height_m;  // of the plane over the origin when it was measured; of a sliver infinite
    int measured;     // the query in which that was
    bool removed;
  };
  struct HorizonEdge {
    int from, to;
    int outer;  // the triangle that stays, beyond the edge
    int inner;  // the triangle that goes
  };

  double motionTo(const PolyhedronPair& pair) const;
  void begin(double noise_m, const MinimumTranslation* known);
  bool build(const PolyhedronPair& pair);
  enum class From { kMemory, kFacet, kNothing };
  bool raise(const PolyhedronPair& pair, From from);
  void findLow(const PolyhedronPair& pair, double enough_m);
  int takeLowest(double enough_m);
  void nameFacet(const PolyhedronPair& pair, const Corner& corner, const Vec3& normal, double height_m);
  void expand(const PolyhedronPair& pair, const Corner& corner, int seen);
  void findHorizon(const PolyhedronPair& pair, const Vec3& w, int seen);
  void recall(const PolyhedronPair& pair, FeaturePair last);
  void considerFacetsAt(const PolyhedronPair& pair, const Corner& corner, const Vec3& n);
  void keep(const MinimumTranslation& found);
  Corner supportAlong(const PolyhedronPair& pair, const Vec3& n, const Corner& start) const;
  Corner cornerOf(const PolyhedronPair& pair, int a, int b) const;
  const Vec3& position(const PolyhedronPair& pair, int corner);
  std::array<Vec3, 3> positions(const PolyhedronPair& pair, int triangle);
  void measure(const PolyhedronPair& pair, int triangle);
  int addTriangle(const PolyhedronPair& pair, const std::array<int, 3>& corners);
  void connect(int triangle, int from, int neighbour);
  double boundNow(std::size_t triangle) const { return reach_[triangle] - odometer_m_; }

  ArenaVector<Corner> corners_;
  ArenaVector<Triangle> triangles_;
  ArenaVector<double> reach_;  // by triangle: the odometer at which it may have come to the origin
  ArenaVector<int> free_;      // places of removed triangles
  ArenaVector<int> visible_;
  ArenaVector<int> low_;
  ArenaVector<HorizonEdge> horizon_;
  std::size_t corners_when_built_ = 0;
  int query_ = 0;
  int expansions_ = 0;
  double noise_m_ = 0.0;
  double odometer_m_ = 0.0;                // how far the corners may have moved since the polytope was built
  std::array<std::uint64_t, 2> bodies_{};  // the fingerprints of A and B
  Mat3 R_AB_ = Mat3::Identity();
  Vec3 t_AB_ = Vec3::Zero();
  MinimumTranslation best_;
};

}  // namespace carom
