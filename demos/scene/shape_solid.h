#pragma once
// From a described shape to a solid of the engine: primitives, convex hulls of points, mesh files, compounds.
// Tested in tests/demos/scene/shape_solid_test.cpp.

#include <filesystem>
#include <optional>
#include <vector>

#include "demos/asset/mesh_solid.h"
#include "demos/scene/scene.h"
#include "engine/solid/solid.h"

namespace carom::demos {

/// The vertices of all parts.
std::vector<Vec3> cornersOf(const std::vector<ConvexPart>& parts);
/// A hull of a body has the size of any other shape, and lies as near. Throws InputError that calls it
/// `what`.
void requireLengths(const std::vector<Vec3>& points, const std::string& what);

/// One hull around all meshes of the file, where they stand in it. Throws InputError, with the path, when
/// they enclose no volume.
ConvexPolyhedron meshHull(const std::filesystem::path& path);

/// The solid of a shape; `mesh` takes the place of every replaceable file. Throws InputError, with the place
/// of the shape, for what encloses no volume.
Solid makeSolid(const Shape& shape, const std::optional<std::filesystem::path>& mesh);
/// The same, of the shapes of one scene. What was made of its mesh files is added to `reports`.
Solid makeSolid(const Shape& shape, const std::optional<std::filesystem::path>& mesh, SceneMeshes& meshes,
                std::vector<MeshReport>& reports);

/// What is drawn for it, in the frame of the shape. Throws InputError.
BoundingSurface visualSurface(const Visual& visual, SceneMeshes& meshes, MeshReport& report);

}  // namespace carom::demos
