#pragma once
// Reads a mesh file of any format that assimp knows: the triangles of each of the file's meshes with their
// normals, colours and pictures, every one placed by the transforms of the nodes it hangs from. Axes and
// units are taken as they stand. The file is read by a process of its own under limits of memory and time,
// for assimp's readers may crash, run for ever or allocate by a file's word. mesh_import.cpp is the only file
// that names assimp. Tested in tests/demos/asset/mesh_import_test.cpp.

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "engine/foundation/frames.h"
#include "engine/solid/solid.h"
#include "engine/solid/surface_mesh.h"

namespace carom::demos {

/// One mesh of a file, in the file's own frame.
struct MeshPart {
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
  std::vector<Vec3> normals;  ///< Of each vertex, unit; or none.
  std::vector<Vec3>
      colors;            ///< Of each vertex, red, green, blue of 0 to 1: its own or its material's; or none.
  std::vector<Vec2> uv;  ///< Of each vertex, its place on the picture from the upper left corner; or none.
  std::vector<int> picture_of;  ///< Of each triangle its picture; or none has one.
};

struct ImportedMesh {
  std::vector<MeshPart> parts;
  std::vector<SurfacePicture> pictures;  ///< Of the materials' base colours.
  std::vector<std::string> notes;        ///< What of its looks is left out, and why, a line each.
  bool y_up = false;                     ///< The file's format says that y is up: glTF and Collada.
  /// How far a coordinate may be from what the file means: single precision, where it came through assimp or
  /// has no more digits than that.
  double coordinate_error_m = 0.0;
  double written_error_m = 0.0;  ///< Of a text: half of the last digit of its longest numbers.
};

/// Throws InputError for a file that is missing, unreadable, empty, that takes more than 1 GB of memory, 10 s
/// or ten million vertices, or has a vertex that is not finite; OutOfResources where no process can be
/// started.
ImportedMesh importMesh(const std::filesystem::path& path);

/// Mesh files of one scene, each imported once however many bodies have it.
class MeshFiles {
 public:
  /// As `importMesh` does.
  const ImportedMesh& imported(const std::filesystem::path& path);

 private:
  std::map<std::filesystem::path, ImportedMesh> files_;
};

}  // namespace carom::demos
