#pragma once
// Polyhedra cut by planes, exactly: the volume and centroid of the part below, and every face's piece on
// either side. By the divergence theorem 3 V is the sum over the border of (x - o) . n, and 4 times the first
// moment that of x (x - o) . n: with o on the cutting plane the cut itself adds nothing, and need not be
// built. Tested in tests/engine/environment/plane_cut_test.cpp.

#include <span>
#include <vector>

#include "engine/solid/convex_polyhedron.h"

namespace carom {

/// Volume, and its first moment about the origin of the frame.
struct VolumeMoments {
  double volume_m3 = 0.0;
  Vec3 first_m4 = Vec3::Zero();

  /// Where the volume is not zero.
  Vec3 centroid() const { return first_m4 / volume_m3; }
};

/// A flat convex piece of a surface: counter-clockwise corners seen from outside.
struct Facet {
  Vec3 normal = Vec3::Zero();  ///< Unit, outwards.
  std::size_t begin = 0;       ///< Its corners in the list.
  std::size_t end = 0;
};
/// Facets with their corners in one array; it allocates nothing once it has held as many.
struct FacetList {
  std::vector<Vec3> corners;
  std::vector<Facet> facets;

  void clear() {
    corners.clear();
    facets.clear();
  }
  std::span<const Vec3> cornersOf(const Facet& f) const {
    return {corners.data() + f.begin, f.end - f.begin};
  }
  void add(const Vec3& normal, std::span<const Vec3> polygon);
};

/// Polygons in the making.
struct CutScratch {
  std::vector<Vec3> polygon, rest, next;
};

/// The part of convex `polygon` where n . p <= offset, appended to an emptied `kept`. A crossing is computed
/// from the corner below to the one above, whichever way the edge is walked.
void clipPolygon(std::span<const Vec3> polygon, const Plane& plane, std::vector<Vec3>& kept);
/// Of a flat convex polygon, counter-clockwise about the unit `normal`.
struct PolygonArea {
  double area_m2 = 0.0;
  Vec3 centroid = Vec3::Zero();
};
PolygonArea areaOf(std::span<const Vec3> polygon, const Vec3& normal);

/// What of flat facets lies behind all planes of `region` goes to `inside`, the rest to `outside` where that
/// is given.
void cutFacets(const FacetList& facets, std::span<const Plane> region, CutScratch& scratch, FacetList& inside,
               FacetList* outside);
/// Appends what of the flat convex `polygon` another one, in its plane, leaves uncovered: convex pieces.
/// Either may be seen from any side.
void appendUncovered(std::span<const Vec3> polygon, std::span<const Vec3> cover, const Vec3& normal,
                     CutScratch& scratch, FacetList& uncovered);

/// What of the polyhedron lies behind all planes of `region` (unit outward normals); none: all of it. Pieces
/// of its faces go to `inside` and `outside` where these are given. Cost: faces times planes, and for every
/// plane but the first one polygon clipped by all faces.
VolumeMoments cutPolyhedron(const ConvexPolyhedron& polyhedron, std::span<const Plane> region,
                            CutScratch& scratch, FacetList* inside, FacetList* outside);

}  // namespace carom
