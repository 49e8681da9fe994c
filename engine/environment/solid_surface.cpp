#include "engine/environment/solid_surface.h"

#include <algorithm>
#include <limits>
#include <numbers>

#include "engine/environment/drag.h"
#include "engine/solid/convex_hull.h"

namespace carom {
namespace {

ConvexPolyhedron bevel(const ConvexPart& part) {
  std::vector<Vec3> points;
  for (int f = 0; f < part.core.faceCount(); ++f)
    for (int v : part.core.faceVertices(f))
      points.push_back(part.core.vertex(v) + part.radius_m * part.core.plane(f).normal);
  return convexHull(points).polyhedron;
}

double facetArea(const ConvexPolyhedron& polyhedron) {
  double area = 0.0;
  std::vector<Vec3> polygon;
  for (int f = 0; f < polyhedron.faceCount(); ++f) {
    polygon.clear();
    for (int v : polyhedron.faceVertices(f)) polygon.push_back(polyhedron.vertex(v));
    area += areaOf(polygon, polyhedron.plane(f).normal).area_m2;
  }
  return area;
}

std::vector<Vec3> cornersOf(const ConvexPolyhedron& polyhedron, int face) {
  std::vector<Vec3> corners;
  for (int v : polyhedron.faceVertices(face)) corners.push_back(polyhedron.vertex(v));
  return corners;
}

double openArea(const FacetList& list) {
  double area = 0.0;
  for (const Facet& facet : list.facets) area += areaOf(list.cornersOf(facet), facet.normal).area_m2;
  return area;
}

// Pieces of a mesh.
class Pieces {
 public:
  explicit Pieces(const Solid& solid) : solid_(solid) {
    for (std::size_t i = 0; i < solid.parts().size(); ++i)
      if (solid.isPiece(i)) pieces_.push_back(&solid.parts()[i].core);
  }

  // The faces of a piece where no other lies against them.
  FacetList openFaces(const ConvexPolyhedron& piece) {
    std::vector<const ConvexPolyhedron*> others;
    for (const ConvexPolyhedron* other : pieces_) {
      const double reach = other->radius() + piece.radius() + kTouch * solid_.radius();
      if (other != &piece && (other->center() - piece.center()).norm() <= reach) others.push_back(other);
    }
    FacetList open;
    for (int f = 0; f < piece.faceCount(); ++f) appendOpen(piece, f, others, open);
    return open;
  }

 private:
  static constexpr double kTouch = 1e-9;      // of the solid's radius
  static constexpr double kOpposite = 1e-12;  // of 2: normals that are as good as opposite

  void appendOpen(const ConvexPolyhedron& piece, int face, std::span<const ConvexPolyhedron* const> others,
                  FacetList& open) {
    const Plane& plane = piece.plane(face);
    left_.clear();
    left_.add(plane.normal, cornersOf(piece, face));
    for (const ConvexPolyhedron* other : others)
      for (int g = 0; g < other->faceCount(); ++g) {
        const Plane& against = other->plane(g);
        if (dot(plane.normal, against.normal) > kOpposite - 1.0 ||
            std::abs(plane.offset + against.offset) > kTouch * solid_.radius())
          continue;
        const std::vector<Vec3> cover = cornersOf(*other, g);
        next_.clear();
        for (const Facet& facet : left_.facets)
          appendUncovered(left_.cornersOf(facet), cover, plane.normal, scratch_, next_);
        std::swap(left_, next_);
      }
    for (const Facet& facet : left_.facets) open.add(facet.normal, left_.cornersOf(facet));
  }

  const Solid& solid_;
  std::vector<const ConvexPolyhedron*> pieces_;
  FacetList left_, next_;
  CutScratch scratch_;
};

PartSurface partSurface(const ConvexPart& part) {
  PartSurface surface;
  surface.part = &part;
  const double r = part.radius_m;
  const MassProperties mass = roundedMass(part.core, r);
  surface.whole = {mass.mass, mass.mass * mass.center};
  surface.reach_m = part.core.radius() + r;
  if (part.core.vertexCount() == 1) {
    surface.form = PartSurface::Form::kBall;
    surface.area_m2 = 4.0 * std::numbers::pi * r * r;
  } else if (part.core.vertexCount() == 2) {
    surface.form = PartSurface::Form::kCapsule;
    surface.area_m2 = 2.0 * std::numbers::pi * r * (part.core.edge(0).length_m + 2.0 * r);
  } else {
    if (r > 0.0) surface.bevelled = bevel(part);
    surface.area_m2 = facetArea(surface.facets());
  }
  return surface;
}

}  // namespace

double PartSurface::standardDrag() const {
  switch (form) {
    case Form::kBall:
      return kBallDrag;
    case Form::kCapsule:
      return kCylinderDrag;
    case Form::kPolyhedron:
      break;
  }
  return kFaceDrag;
}

SolidSurface surfaceOf(const Solid& solid) {
  SolidSurface surface;
  surface.volume_m3 = solid.volume();
  surface.radius_m = solid.radius();
  surface.width_m = std::numeric_limits<double>::infinity();
  Pieces pieces(solid);
  for (std::size_t i = 0; i < solid.parts().size(); ++i) {
    const ConvexPart& part = solid.parts()[i];
    surface.parts.push_back(partSurface(part));
    if (solid.isPiece(i)) {
      surface.parts.back().open = pieces.openFaces(part.core);
      surface.parts.back().area_m2 = openArea(*surface.parts.back().open);
    }
    surface.area_m2 += surface.parts.back().area_m2;
    surface.width_m = std::min(surface.width_m, part.width());
  }
  return surface;
}

}  // namespace carom
