#pragma once
// Reads a mesh file of any format that assimp knows, and makes a solid of it: the convex hull of each of the
// file's meshes, every one placed by the transforms of the nodes it hangs from. Axes and units are taken as
// they stand. The file is read by a process of its own under limits of memory and time, for assimp's readers
// may crash, run for ever or allocate by a file's word. mesh_import.cpp is the only file that names assimp.
// Tested in tests/demos/mesh_import_test.cpp.

#include <filesystem>
#include <vector>

#include "engine/foundation/frames.h"

namespace carom::demos {

/// The vertices of each mesh of a file, in the file's own frame.
struct ImportedMesh {
  std::vector<std::vector<Vec3>> parts;
  double coordinate_error_m =
      0.0;  ///< How far a coordinate may be from what the file means: single precision.
};

/// Throws InputError for a file that is missing, unreadable, empty, that takes more than 1 GB of memory, 10 s
/// or ten million vertices, or has a vertex that is not finite; OutOfResources where no process can be
/// started.
ImportedMesh importMesh(const std::filesystem::path& path);

}  // namespace carom::demos
