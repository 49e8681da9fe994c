#pragma once
// Exact convex pieces of a solid that is not convex: cut by planes through its notches (edges at which the
// solid's angle is more than 180 degrees; Chazelle 1984, Hachenberger 2007), each time the plane that removes
// most of them and crosses fewest, then put together again where two pieces make a convex one. The pieces'
// volumes add up to the solid's to rounding. Tested in
// tests/engine/solid/decomposition/convex_decomposition_test.cpp.

#include <vector>

#include "engine/solid/convex_polyhedron.h"
#include "engine/solid/surface_mesh.h"

namespace carom {

struct DecompositionSettings {
  /// How far each coordinate may be from what was meant, metres: a surface that is concave by no more is
  /// taken for flat.
  double coordinate_error_m = 0.0;
  /// A solid that needs more is refused.
  int most_pieces = 1024;
};

struct DecompositionReport {
  int notches = 0;  ///< Of the surface.
  int cuts = 0;
  int merged = 0;   ///< Pieces that became part of another.
  int slivers = 0;  ///< Too thin for a polyhedron, convex with no neighbour: left out.
  double sliver_volume_m3 = 0.0;
  double tolerance_m = 0.0;  ///< What counted as flat.
  double volume_m3 = 0.0;    ///< Of all pieces.
};

struct ConvexDecomposition {
  std::vector<ConvexPolyhedron> pieces;
  DecompositionReport report;
};

/// What counts as flat in a mesh whose coordinates may be off by that much, metres: that, and the rounding of
/// the largest coordinate.
double flatTolerance(const SurfaceMesh& mesh, double coordinate_error_m);

/// Throws InputError where more than `most_pieces` are needed, and where rounding leaves a part that is not
/// convex. Cost: about the notches times the triangles, and a hull for each pair of pieces that may be one.
ConvexDecomposition convexDecomposition(const ClosedSurface& surface,
                                        const DecompositionSettings& settings = {});

}  // namespace carom
