#pragma once
// Triangles of a part that stands for a cylinder or a cone: a belt of many faces, each a little turned
// against the next. Its normals turn smoothly around the belt, and its rims are bevelled; the corners stay
// where the solid has them. Tested in tests/renderer/mesh/solid_mesh_test.cpp.

#include "renderer/mesh/solid_mesh.h"

namespace carom::renderer {

/// Whether at least 16 faces lie in belts: each meets exactly two others at less than 23.5 degrees.
/// Cylinders, cones, frustums and prisms of as many sides.
bool isCurved(const ConvexPolyhedron& core);

/// Appends a curved part; without a bevel where `bevel_m` is 0.
void addCurvedPart(TriangleMesh& mesh, const ConvexPolyhedron& core, double bevel_m);

}  // namespace carom::renderer
