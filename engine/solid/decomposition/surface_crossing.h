#pragma once
// Where a surface goes through itself: such a one bounds no solid. Tested in
// tests/engine/solid/surface_mesh_test.cpp.

#include <optional>

#include "engine/solid/surface_mesh.h"

namespace carom {

/// A place at which an edge goes through a triangle by more than `tolerance_m`; the surface may touch itself.
/// Cost: O(n log n), and the pairs of triangles whose boxes meet.
std::optional<Vec3> findCrossing(const SurfaceMesh& mesh, double tolerance_m);

}  // namespace carom
