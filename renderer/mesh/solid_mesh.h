#pragma once
// Triangles of a solid. Flat faces keep flat normals; along edges they turn from face to face, so that edges
// catch the light: seen from near in narrow bands and patches that recede from the sharp edge by less than a
// hundredth of the solid's width (what touches in the simulation touches in the picture), from farther away
// on sharp faces, pixel by pixel. Balls, capsules and rounded polyhedra are smooth. Tested in
// tests/renderer/mesh/solid_mesh_test.cpp.

#include <cstdint>
#include <span>
#include <vector>

#include "engine/solid/solid.h"
#include "renderer/mesh/face_light.h"

namespace carom::renderer {

struct MeshVertex {
  float position[3];   ///< Body frame, metres.
  float normal[3];     ///< Unit, outwards.
  float bend[3];       ///< What is added to the normal at the edge, before it is made a unit again.
  float nearness;      ///< How much of it a pixel adds: 1 at the edge, 0 or less from a bevel's width on.
  std::uint32_t face;  ///< Its face's number; kNoFace where it has none or shares one, and from there on.
  std::uint8_t tint[4] = {255, 255, 255,
                          255};            ///< What the body's colour is multiplied by; the last is unused.
  float picture[3] = {0.0f, 0.0f, -1.0f};  ///< Its place on a picture of the solid's, and which; -1: none.
};

struct TriangleMesh {
  std::vector<MeshVertex> vertices;
  std::vector<std::uint32_t> indices;  ///< Three a triangle, counter-clockwise seen from outside.

  /// A vertex without bend or face; its index.
  std::uint32_t addVertex(const Vec3& p, const Vec3& n);
  void addTriangle(std::uint32_t a, std::uint32_t b, std::uint32_t c);
  /// The triangles of a convex polygon, counter-clockwise seen from outside.
  void addFan(std::span<const std::uint32_t> loop);
};

/// How an edge between flat faces looks.
enum class Edges {
  kSharp,
  kShaded,    ///< A bevel in its normals, on the sharp face: a quarter of the triangles.
  kBevelled,  ///< A bevel of its own triangles, rounded on the outline too.
};

struct MeshDetail {
  Edges edges = Edges::kSharp;
  double bevel_m = 0.0;  ///< Width of the bevel on either side of an edge; less where faces are small.
  int segments = 32;     ///< Around a ball or capsule; even.
};

/// All parts of the solid in one mesh, in the solid's frame; its surface as it is in place of those that are
/// pieces of it.
TriangleMesh buildMesh(const Solid& solid, const MeshDetail& detail);

/// The parts without rounding alone, with sharp edges, and the surface: the solid's exact faces.
TriangleMesh buildFlatMesh(const Solid& solid);

/// The smallest width of the parts that are drawn; of what is drawn as a surface the solid's own, metres.
double thinnestPart(const Solid& solid);

/// The bevel that suits a solid: a small fraction of its smallest part's width, and not more than `cap_m`.
double bevelWidth(const Solid& solid, double cap_m);

}  // namespace carom::renderer
