#include "demos/mesh_import.h"

#include <algorithm>
#include <fstream>
#include <string>

#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include "engine/foundation/contract.h"
#include "engine/foundation/input_file.h"

namespace carom::demos {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kMostParts = 1024;
constexpr double kRounding = 0x1p-24;  // of assimp's single-precision coordinates

std::string oneLine(std::string text) {
  for (char& c : text)
    if (c == '\n' || c == '\r') c = ' ';
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

std::vector<Vec3> placedVertices(const aiMesh& mesh, const aiMatrix4x4& X_FM, const fs::path& path) {
  std::vector<Vec3> points;
  for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
    const aiVector3D p = X_FM * mesh.mVertices[i];
    points.emplace_back(static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z));
    if (!points.back().allFinite())
      throw InputError(path.string() + ": vertex " + std::to_string(i) + " of mesh \"" + mesh.mName.C_Str() +
                       "\" is not finite; accepted: finite coordinates");
  }
  return points;
}

/// Points and lines enclose nothing; only meshes with faces count.
bool hasFaces(const aiMesh& mesh) {
  return (mesh.mPrimitiveTypes & (aiPrimitiveType_TRIANGLE | aiPrimitiveType_POLYGON)) != 0;
}

/// Walks the node tree from the root with a list in place of recursion: files may be deep.
std::vector<std::vector<Vec3>> collectParts(const aiScene& scene, const fs::path& path) {
  struct Visit {
    const aiNode* node;
    aiMatrix4x4 X_FN;  // node frame in the file's frame
  };
  std::vector<std::vector<Vec3>> parts;
  std::vector<Visit> visits;
  visits.push_back({scene.mRootNode, scene.mRootNode->mTransformation});
  while (!visits.empty()) {
    const Visit visit = visits.back();
    visits.pop_back();
    for (unsigned i = 0; i < visit.node->mNumMeshes; ++i) {
      const aiMesh& mesh = *scene.mMeshes[visit.node->mMeshes[i]];
      if (hasFaces(mesh)) parts.push_back(placedVertices(mesh, visit.X_FN, path));
    }
    if (parts.size() > kMostParts)
      throw InputError(path.string() + ": more than " + std::to_string(kMostParts) +
                       " meshes; accepted: at most that many");
    for (unsigned i = visit.node->mNumChildren; i > 0; --i) {
      const aiNode* child = visit.node->mChildren[i - 1];
      visits.push_back({child, visit.X_FN * child->mTransformation});
    }
  }
  return parts;
}

/// assimp 5.2 reads a PLY header without an end for ever.
void requireEndOfPlyHeader(const fs::path& path) {
  std::ifstream file = openInputFile(path);
  std::string line;
  if (!std::getline(file, line) || line.rfind("ply", 0) != 0) return;
  while (std::getline(file, line))
    if (line.rfind("end_header", 0) == 0) return;
  throw InputError(path.string() + ": cannot be read as a mesh: the PLY header has no end_header");
}

}  // namespace

ImportedMesh importMesh(const fs::path& path) {
  std::error_code ignored;
  if (!fs::exists(path, ignored)) throw InputError(path.string() + ": no such mesh file");
  if (!fs::is_regular_file(path, ignored))
    throw InputError(path.string() + ": is no file; accepted: a mesh file");
  requireEndOfPlyHeader(path);
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(path.string(), aiProcess_JoinIdenticalVertices);
  if (scene == nullptr || scene->mRootNode == nullptr)
    throw InputError(path.string() + ": cannot be read as a mesh: " + oneLine(importer.GetErrorString()));
  ImportedMesh mesh{collectParts(*scene, path), 0.0};
  if (mesh.parts.empty()) throw InputError(path.string() + ": holds no mesh with faces");
  for (const std::vector<Vec3>& part : mesh.parts)
    for (const Vec3& p : part)
      mesh.coordinate_error_m = std::max(mesh.coordinate_error_m, kRounding * p.cwiseAbs().maxCoeff());
  return mesh;
}

}  // namespace carom::demos
