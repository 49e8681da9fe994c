#pragma once
// A closed surface that is cut apart by planes through its notches (Chazelle 1984): only the part of the
// section that a notch lies on is cut and closed by two caps, so that what is far away stays whole. Which
// triangle is beside which is never found by places but carried along, so that the volumes of what comes of
// it add up to what was there whatever is rounded: both caps have the same triangles, and a new point lies on
// an edge. What has come apart becomes surfaces of their own, so that a cut costs what it cuts. Tested in
// tests/engine/solid/decomposition/cut_surface_test.cpp and, whole, in convex_decomposition_test.cpp there.

#include <map>
#include <optional>
#include <span>
#include <vector>

#include "engine/solid/convex_polyhedron.h"
#include "engine/solid/surface_mesh.h"

namespace carom {

/// A plane through the notch `half` (a side of a triangle, 3 * triangle + side).
struct NotchPlane {
  Plane plane;
  int half = -1;
  int along = -1;  ///< The facet whose plane it is, if any.
};

/// What a cut would do.
struct CutEffect {
  int notches_removed = 0;
  int notches_crossed = 0;
  double area_m2 = 0.0;
};

class CutSurface {
 public:
  /// Triangles that lie in one plane to within `tolerance_m` become one facet.
  CutSurface(const ClosedSurface& surface, double tolerance_m);

  const Vec3& point(int v) const { return points_[at(v)]; }
  const std::vector<Vec3>& points() const { return points_; }
  int tail(int half) const { return triangles_[at(half / 3)][at(half % 3)]; }
  int head(int half) const { return triangles_[at(half / 3)][at((half + 1) % 3)]; }
  int mate(int half) const { return mates_[at(half)]; }
  const Triangle& triangle(int t) const { return triangles_[at(t)]; }
  int facetOf(int half) const { return facets_of_[at(half / 3)]; }
  const Plane& facet(int f) const { return facets_[at(f)].plane; }
  int triangleCount() const { return static_cast<int>(triangles_.size()); }

  /// The notches, once each: edges at which the solid's angle is more than 180 degrees.
  std::vector<int> notches() const;
  /// Whether the plane, which contains the edge, has its two facets on either side or on itself: cutting
  /// along it leaves no notch there.
  bool divides(const Plane& plane, int half) const;

  CutEffect effect(std::span<const int> notches, const NotchPlane& by);
  /// Cuts the part of the section that the notch lies on. False, with nothing but more points on edges, where
  /// rounding makes the section no polygon.
  bool cut(const NotchPlane& by);

  /// The triangles that hang together, in order.
  std::vector<std::vector<int>> shells() const;
  /// The surface of whole shells, whose triangles are in order. Everything keeps its order.
  CutSurface part(std::span<const int> triangles) const;
  /// The same surface without the points in the middle of flat facets and of straight edges between two.
  CutSurface withoutFlatPoints() &&;

 private:
  struct Facet {
    Plane plane;
    double normal_error = 0.0;  // radians
  };
  class Curves;
  class FlatPoints;
  struct Section;
  struct Rims;

  explicit CutSurface(double tolerance_m) : tolerance_m_(tolerance_m) {}
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  static int next(int half) { return half % 3 == 2 ? half - 2 : half + 1; }
  Vec3 triangleArea(int t) const;
  void growFacet(int seed);
  bool isNotch(int half) const;
  void labelPoints(const NotchPlane& by);
  Section sectionOf(const NotchPlane& by);
  void addArea(int t, Section& section) const;
  Vec3 crossing(const Plane& plane, int half) const;
  void splitEdge(int half, int point);
  int addTriangle(const Triangle& corners, int facet);
  void pair(int half, int other);
  int sideOf(int t, const Section& section) const;
  bool isRim(int half, const Section& section) const;
  void splitCrossed(Section& section);
  std::vector<std::vector<int>> rims(const Section& section) const;
  Rims rimsAround(int notch, const Section& section) const;
  bool addCaps(const std::vector<std::vector<int>>& rims, const Section& section, const NotchPlane& by);

  double tolerance_m_;
  std::vector<Vec3> points_;
  std::vector<Triangle> triangles_;
  std::vector<int> mates_;      // by half
  std::vector<int> facets_of_;  // by triangle
  std::vector<Facet> facets_;
  // Scratch of one section.
  std::vector<int> label_;  // by point: the side of the plane, -1, 0 (on it) or 1
  std::vector<int> node_of_point_, node_of_half_;
  std::map<int, int> moved_;  // sides of triangles that were divided, and which they are now
};

}  // namespace carom
