#pragma once
// From a described shape to a solid of the engine: primitives, convex hulls of points or mesh files,
// compounds. Tested in tests/demos/shape_solid_test.cpp.

#include <filesystem>
#include <optional>

#include "demos/scene.h"
#include "engine/solid/solid.h"

namespace carom::demos {

/// What a mesh file turned into.
struct MeshSolid {
  std::vector<ConvexPart> parts;
  int flat_parts = 0;  ///< Meshes left out because they enclose no volume.
};

/// The hull of each mesh in the file, scaled by `scale`, or to a longest side of `fit_m` about the middle of
/// the bounding box. Throws InputError when nothing in it encloses a volume.
MeshSolid meshParts(const std::filesystem::path& path, double scale, const std::optional<double>& fit_m);

/// One hull around all meshes of the file, where they stand in it. Throws InputError, with the path, when
/// they enclose no volume.
ConvexPolyhedron meshHull(const std::filesystem::path& path);

/// The solid of a shape; `mesh` takes the place of every replaceable hull's file.
/// Throws InputError, with the place of the shape, for what encloses no volume.
Solid makeSolid(const Shape& shape, const std::optional<std::filesystem::path>& mesh);

}  // namespace carom::demos
