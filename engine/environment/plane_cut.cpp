#include "engine/environment/plane_cut.h"

#include <algorithm>

namespace carom {
namespace {

Plane opposite(const Plane& plane) {
  return {-plane.normal, -plane.offset};
}

// A border piece with its plane at `height` over the apex.
void addCone(VolumeMoments& sum, const PolygonArea& piece, const Vec3& apex, const Vec3& normal,
             const Vec3& on_plane) {
  const double height = dot(normal, on_plane - apex);
  sum.volume_m3 += height * piece.area_m2 / 3.0;
  sum.first_m4 += (height * piece.area_m2 / 4.0) * (piece.centroid - apex);
}

// The region's plane as far as it lies inside the polyhedron and behind the region's other planes.
void cutSquare(const ConvexPolyhedron& polyhedron, std::span<const Plane> region, std::size_t which,
               CutScratch& scratch) {
  const Plane& plane = region[which];
  const TangentBasis basis = tangentBasis(plane.normal);
  const Vec3 middle = polyhedron.center() - plane.signedDistance(polyhedron.center()) * plane.normal;
  const double half = 2.0 * polyhedron.radius();
  scratch.polygon.clear();
  for (const Vec2& corner : {Vec2(-1, -1), Vec2(1, -1), Vec2(1, 1), Vec2(-1, 1)})
    scratch.polygon.push_back(middle + half * (corner.x() * basis.t1 + corner.y() * basis.t2));
  const auto clip = [&](const Plane& by) {
    clipPolygon(scratch.polygon, by, scratch.next);
    std::swap(scratch.polygon, scratch.next);
  };
  for (int f = 0; f < polyhedron.faceCount(); ++f) clip(polyhedron.plane(f));
  for (std::size_t i = 0; i < region.size(); ++i)
    if (i != which) clip(region[i]);
}

// Leaves of the scratch's polygon what lies behind all planes; the rest goes to `outside` where that is
// given.
void cutOffPlanes(const Vec3& normal, std::span<const Plane> region, CutScratch& scratch,
                  FacetList* outside) {
  for (const Plane& plane : region) {
    if (outside != nullptr) {
      clipPolygon(scratch.polygon, opposite(plane), scratch.rest);
      outside->add(normal, scratch.rest);
    }
    clipPolygon(scratch.polygon, plane, scratch.next);
    std::swap(scratch.polygon, scratch.next);
  }
}

}  // namespace

void FacetList::add(const Vec3& normal, std::span<const Vec3> polygon) {
  if (polygon.size() < 3) return;
  const std::size_t begin = corners.size();
  corners.insert(corners.end(), polygon.begin(), polygon.end());
  facets.push_back({normal, begin, corners.size()});
}

void clipPolygon(std::span<const Vec3> polygon, const Plane& plane, std::vector<Vec3>& kept) {
  kept.clear();
  if (polygon.empty()) return;
  Vec3 from = polygon.back();
  double from_height = plane.signedDistance(from);
  for (const Vec3& to : polygon) {
    const double to_height = plane.signedDistance(to);
    if ((from_height < 0.0 && to_height > 0.0) || (from_height > 0.0 && to_height < 0.0)) {
      const bool rises = from_height < 0.0;
      const Vec3& low = rises ? from : to;
      const Vec3& high = rises ? to : from;
      const double low_height = rises ? from_height : to_height;
      const double high_height = rises ? to_height : from_height;
      kept.push_back(low + (low_height / (low_height - high_height)) * (high - low));
    }
    if (to_height <= 0.0) kept.push_back(to);
    from = to;
    from_height = to_height;
  }
}

PolygonArea areaOf(std::span<const Vec3> polygon, const Vec3& normal) {
  if (polygon.size() < 3) return {};
  PolygonArea sum;
  Vec3 first = Vec3::Zero();
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    const Vec3 b = polygon[i] - polygon[0];
    const Vec3 c = polygon[i + 1] - polygon[0];
    const double triangle = 0.5 * dot(normal, b.cross(c));
    sum.area_m2 += triangle;
    first += (triangle / 3.0) * (b + c);
  }
  sum.centroid = sum.area_m2 > 0.0 ? Vec3(polygon[0] + first / sum.area_m2) : polygon[0];
  return sum;
}

void cutFacets(const FacetList& facets, std::span<const Plane> region, CutScratch& scratch, FacetList& inside,
               FacetList* outside) {
  for (const Facet& facet : facets.facets) {
    const std::span<const Vec3> corners = facets.cornersOf(facet);
    scratch.polygon.assign(corners.begin(), corners.end());
    cutOffPlanes(facet.normal, region, scratch, outside);
    inside.add(facet.normal, scratch.polygon);
  }
}

void appendUncovered(std::span<const Vec3> polygon, std::span<const Vec3> cover, const Vec3& normal,
                     CutScratch& scratch, FacetList& uncovered) {
  scratch.polygon.assign(polygon.begin(), polygon.end());
  Vec3 middle = Vec3::Zero();
  for (const Vec3& corner : cover) middle += corner / static_cast<double>(cover.size());
  for (std::size_t i = 0; i < cover.size(); ++i) {
    const Vec3& corner = cover[i];
    Plane edge{(cover[(i + 1) % cover.size()] - corner).cross(normal).normalized(), 0.0};
    edge.offset = dot(edge.normal, corner);
    if (edge.signedDistance(middle) > 0.0) edge = opposite(edge);
    cutOffPlanes(normal, std::span(&edge, 1), scratch, &uncovered);
  }
}

VolumeMoments cutPolyhedron(const ConvexPolyhedron& polyhedron, std::span<const Plane> region,
                            CutScratch& scratch, FacetList* inside, FacetList* outside) {
  Vec3 apex = polyhedron.center();
  if (!region.empty()) apex -= region[0].signedDistance(apex) * region[0].normal;
  VolumeMoments sum;
  for (int f = 0; f < polyhedron.faceCount(); ++f) {
    const Vec3& normal = polyhedron.plane(f).normal;
    scratch.polygon.clear();
    for (int v : polyhedron.faceVertices(f)) scratch.polygon.push_back(polyhedron.vertex(v));
    const Vec3 on_plane = scratch.polygon[0];
    cutOffPlanes(normal, region, scratch, outside);
    if (scratch.polygon.size() < 3) continue;
    addCone(sum, areaOf(scratch.polygon, normal), apex, normal, on_plane);
    if (inside != nullptr) inside->add(normal, scratch.polygon);
  }
  for (std::size_t i = 1; i < region.size(); ++i) {
    cutSquare(polyhedron, region, i, scratch);
    if (scratch.polygon.size() < 3) continue;
    addCone(sum, areaOf(scratch.polygon, region[i].normal), apex, region[i].normal, scratch.polygon[0]);
  }
  sum.first_m4 += sum.volume_m3 * apex;
  return sum;
}

}  // namespace carom
