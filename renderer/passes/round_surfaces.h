#pragma once
// Where rays meet the rounded parts of solids: balls, capsules and rounded polyhedra, in closed form rather
// than through triangles, so that depth is exact and a silhouette is the true one. A rounded polyhedron is
// the union of a ball at each vertex, a capsule about each edge and a prism on each face. Tested in
// tests/renderer/image/surface_image_test.cpp.

#include <span>

#include "engine/solid/solid.h"
#include "renderer/image/surface_image.h"
#include "renderer/view/projection.h"
#include "renderer/view/view.h"

namespace carom::renderer {

/// Puts the rounded parts of all instances but `ground` (-1: none) in front of what `surfaces` holds behind
/// them. Cost: some 30 ns a pixel of a ball's bounding rectangle, and as much per edge and face of a rounded
/// polyhedron.
void addRoundSurfaces(std::span<const Instance> instances, std::span<const Solid> solids,
                      const Camera& camera, int ground, SurfaceImage& surfaces);

}  // namespace carom::renderer
