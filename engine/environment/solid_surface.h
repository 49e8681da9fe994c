#pragma once
// What the environment has to know of a solid, found once: the form of each part, the flat facets that a
// stream presses on, and volumes. A rounded polyhedron shows the stream the hull of its offset faces, which
// is inscribed in it and has a bevel for each edge and vertex; what it displaces is exact all the same
// (rounded_cut.h). Pieces of a mesh show it the mesh's surface, and not the cuts between them. Tested in
// tests/engine/environment/body_forces_test.cpp.

#include <optional>
#include <vector>

#include "engine/environment/plane_cut.h"
#include "engine/solid/solid.h"

namespace carom {

struct PartSurface {
  enum class Form : std::uint8_t { kBall, kCapsule, kPolyhedron };
  Form form = Form::kPolyhedron;
  const ConvexPart* part = nullptr;
  std::optional<ConvexPolyhedron> bevelled;  ///< Of a rounded polyhedron.
  std::optional<FacetList> open;  ///< Of a piece of a mesh: its faces where no other piece lies against them.
  VolumeMoments whole;            ///< In the frame of the solid.
  double area_m2 = 0.0;
  double reach_m = 0.0;  ///< From the core's middle to the farthest point.

  const ConvexPolyhedron& facets() const { return bevelled ? *bevelled : part->core; }
  /// The drag coefficient of this form where the body has none of its own.
  double standardDrag() const;
};

struct SolidSurface {
  std::vector<PartSurface> parts;
  double volume_m3 = 0.0;
  double area_m2 = 0.0;
  double width_m = 0.0;   ///< Of the thinnest part.
  double radius_m = 0.0;  ///< About the centre of mass.
};

/// The solid must stay where it is: parts are referred to.
SolidSurface surfaceOf(const Solid& solid);

}  // namespace carom
