#pragma once
// Triangles of a solid. Flat faces keep flat normals; edges and vertices become narrow bands and patches
// whose normals turn from face to face, so that they catch the light. The band recedes from the sharp edge by
// less than a hundredth of the solid's width: what touches in the simulation touches in the picture. Balls
// and capsules are smooth. Tested in tests/renderer/solid_mesh_test.cpp.

#include <cstdint>
#include <vector>

#include "engine/solid/solid.h"

namespace carom::renderer {

struct MeshVertex {
  float position[3];  ///< Body frame, metres.
  float normal[3];    ///< Unit, outwards.
};

struct TriangleMesh {
  std::vector<MeshVertex> vertices;
  std::vector<std::uint32_t> indices;  ///< Three a triangle, counter-clockwise seen from outside.
};

struct MeshDetail {
  double bevel_m =
      0.0;  ///< Width of the rounded band on either side of an edge; less where faces are small. 0: none.
  int segments = 32;  ///< Around a ball or capsule; even.
};

/// All parts of the solid in one mesh, in the solid's frame.
TriangleMesh buildMesh(const Solid& solid, const MeshDetail& detail);

/// The parts without rounding alone, with sharp edges: the solid's exact faces.
TriangleMesh buildFlatMesh(const Solid& solid);

/// The bevel that suits a solid: a small fraction of its smallest part's width, and not more than `cap_m`.
double bevelWidth(const Solid& solid, double cap_m);

}  // namespace carom::renderer
