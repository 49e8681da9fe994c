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
  for (const ConvexPart& part : solid.parts()) {
    surface.parts.push_back(partSurface(part));
    surface.area_m2 += surface.parts.back().area_m2;
    surface.width_m = std::min(surface.width_m, part.width());
  }
  return surface;
}

}  // namespace carom
