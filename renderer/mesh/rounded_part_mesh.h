#pragma once
// Triangles of a rounded polyhedron: its core's faces moved out by the radius, a strip of a cylinder about
// each edge and a patch of a ball about each vertex. The corners of all of them lie on the true surface and
// are shared to the bit, so that no gap shows. Tested in tests/renderer/mesh/solid_mesh_test.cpp.

#include "renderer/mesh/solid_mesh.h"

namespace carom::renderer {

/// Appends the part, whose core has faces, with `segments` sides to a full turn.
void addRoundedPolyhedron(TriangleMesh& mesh, const ConvexPart& part, int segments);

}  // namespace carom::renderer
