#include "demos/asset/mesh_import.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <new>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <system_error>

#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include "demos/asset/asset_path.h"
#include "demos/asset/mesh_header.h"
#include "demos/format/written_precision.h"
#include "demos/system/bounded_process.h"
#include "engine/foundation/contract.h"
#include "engine/foundation/input_file.h"

namespace carom::demos {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kMostParts = 1024;
constexpr double kRounding = 0x1p-24;  // of assimp's single-precision coordinates

/// What reading a file of `size` bytes may take: a second for each four megabytes is a tenth of assimp's
/// usual speed, and ten million vertices in single precision fit into the answer.
ProcessBounds boundsFor(std::uintmax_t size) {
  const int cpu_s = 5 + static_cast<int>(std::min<std::uintmax_t>(size >> 22, 1000));
  return {.memory_bytes = std::size_t{1} << 30,
          .cpu_s = cpu_s,
          .wall_s = 10 * cpu_s,
          .answer_bytes = std::size_t{128} << 20};
}

using Point = std::array<float, 3>;  // as assimp has it
using Corners = std::array<std::uint32_t, 3>;
struct Part {
  std::vector<Point> vertices, normals, colors;
  std::vector<Corners> triangles;
};
using Parts = std::vector<Part>;

/// A file that was read, but is none of ours.
class Unsuitable : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

std::vector<Point> placedVertices(const aiMesh& mesh, const aiMatrix4x4& X_FM) {
  std::vector<Point> points;
  for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
    const aiVector3D p = X_FM * mesh.mVertices[i];
    points.push_back({p.x, p.y, p.z});
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
      throw Unsuitable("vertex " + std::to_string(i) + " of mesh \"" + mesh.mName.C_Str() +
                       "\" is not finite; accepted: finite coordinates");
  }
  return points;
}

/// Turned by the inverse transpose, as a plane is; none where one of them is no direction.
std::vector<Point> placedNormals(const aiMesh& mesh, const aiMatrix4x4& X_FM) {
  std::vector<Point> normals;
  if (!mesh.HasNormals()) return normals;
  const aiMatrix3x3 turn = aiMatrix3x3(X_FM).Inverse().Transpose();
  for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
    const aiVector3D n = turn * mesh.mNormals[i];
    const float length = std::sqrt(n.x * n.x + n.y * n.y + n.z * n.z);
    if (!std::isfinite(length) || !(length > 0.0f)) return {};
    normals.push_back({n.x / length, n.y / length, n.z / length});
  }
  return normals;
}

Point colorPoint(const aiColor4D& color) {
  const auto channel = [](float c) { return std::isfinite(c) ? std::clamp(c, 0.0f, 1.0f) : 1.0f; };
  return {channel(color.r), channel(color.g), channel(color.b)};
}

/// Its vertices' own, or its material's; none where the file says nothing (assimp makes up materials).
std::vector<Point> colorsOf(const aiMesh& mesh, const aiScene& scene) {
  std::vector<Point> colors;
  if (mesh.HasVertexColors(0)) {
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) colors.push_back(colorPoint(mesh.mColors[0][i]));
    return colors;
  }
  if (mesh.mMaterialIndex >= scene.mNumMaterials) return colors;
  const aiMaterial& material = *scene.mMaterials[mesh.mMaterialIndex];
  aiString name;
  aiColor4D color;
  if (material.Get(AI_MATKEY_NAME, name) != aiReturn_SUCCESS || name.length == 0 ||
      std::string(name.C_Str()) == AI_DEFAULT_MATERIAL_NAME ||
      material.Get(AI_MATKEY_COLOR_DIFFUSE, color) != aiReturn_SUCCESS)
    return colors;
  colors.assign(mesh.mNumVertices, colorPoint(color));
  return colors;
}

/// Of what assimp has triangulated: points and lines are left out.
std::vector<Corners> trianglesOf(const aiMesh& mesh, bool mirrored) {
  std::vector<Corners> triangles;
  for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
    const aiFace& face = mesh.mFaces[i];
    if (face.mNumIndices != 3) continue;
    Corners corners{face.mIndices[0], face.mIndices[1], face.mIndices[2]};
    if (mirrored) std::swap(corners[1], corners[2]);
    if (std::max({corners[0], corners[1], corners[2]}) >= mesh.mNumVertices)
      throw Unsuitable("a face of mesh \"" + std::string(mesh.mName.C_Str()) +
                       "\" names a vertex that is not there");
    triangles.push_back(corners);
  }
  return triangles;
}

Part placedPart(const aiMesh& mesh, const aiScene& scene, const aiMatrix4x4& X_FM) {
  return {placedVertices(mesh, X_FM), placedNormals(mesh, X_FM), colorsOf(mesh, scene),
          trianglesOf(mesh, aiMatrix3x3(X_FM).Determinant() < 0.0f)};
}

/// Points and lines enclose nothing; only meshes with faces count.
bool hasFaces(const aiMesh& mesh) {
  return (mesh.mPrimitiveTypes & (aiPrimitiveType_TRIANGLE | aiPrimitiveType_POLYGON)) != 0;
}

/// Walks the node tree from the root with a list in place of recursion: files may be deep.
Parts collectParts(const aiScene& scene) {
  struct Visit {
    const aiNode* node;
    aiMatrix4x4 X_FN;  // node frame in the file's frame
  };
  Parts parts;
  std::vector<Visit> visits;
  visits.push_back({scene.mRootNode, scene.mRootNode->mTransformation});
  while (!visits.empty()) {
    const Visit visit = visits.back();
    visits.pop_back();
    for (unsigned i = 0; i < visit.node->mNumMeshes; ++i) {
      const aiMesh& mesh = *scene.mMeshes[visit.node->mMeshes[i]];
      if (hasFaces(mesh)) parts.push_back(placedPart(mesh, scene, visit.X_FN));
    }
    if (parts.size() > kMostParts)
      throw Unsuitable("more than " + std::to_string(kMostParts) + " meshes; accepted: at most that many");
    for (unsigned i = visit.node->mNumChildren; i > 0; --i) {
      const aiNode* child = visit.node->mChildren[i - 1];
      visits.push_back({child, visit.X_FN * child->mTransformation});
    }
  }
  return parts;
}

// The answer of the process that reads: a letter, then an error's text, or the number of parts and of each
// its four lists, with the number of their items before them.
constexpr std::uint8_t kError = 'e', kParts = 'p', kRefused = 'r';  // of the last: the system's number

using Bytes = std::vector<std::uint8_t>;

Bytes errorBytes(const std::string& text) {
  Bytes bytes(1 + text.size(), kError);
  std::copy(text.begin(), text.end(), bytes.begin() + 1);
  return bytes;
}

Bytes partsBytes(const Parts& parts) {
  Bytes bytes(1, kParts);
  const auto put = [&bytes](const void* from, std::size_t count) {
    const std::size_t before = bytes.size();
    bytes.resize(before + count);
    if (count > 0) std::memcpy(bytes.data() + before, from, count);
  };
  const auto putList = [&put](const auto& list) {
    const std::size_t count = list.size();
    put(&count, sizeof count);
    put(list.data(), count * sizeof list[0]);
  };
  const std::size_t count = parts.size();
  put(&count, sizeof count);
  for (const Part& part : parts) {
    putList(part.vertices);
    putList(part.normals);
    putList(part.colors);
    putList(part.triangles);
  }
  return bytes;
}

/// In the process that reads.
Bytes readFile(const fs::path& path) {
  try {
    Assimp::Importer importer;
    const aiScene* scene =
        importer.ReadFile(path.string(), aiProcess_JoinIdenticalVertices | aiProcess_Triangulate);
    const std::string reason = importer.GetErrorString();
    if (reason.find("bad_alloc") != std::string::npos) throw std::bad_alloc();
    if (scene == nullptr) tryInputFile(path);  // assimp does not say whether the system refused the file
    if (scene == nullptr || scene->mRootNode == nullptr)
      return errorBytes("cannot be read as a mesh: " + reason);
    return partsBytes(collectParts(*scene));
  } catch (const Unsuitable& error) {
    return errorBytes(error.what());
  } catch (const std::system_error& error) {
    return {kRefused, static_cast<std::uint8_t>(error.code().value())};
  }
}

/// Takes the answer apart; nothing where it is no answer.
class AnswerReader {
 public:
  explicit AnswerReader(std::span<const std::uint8_t> rest) : rest_(rest) {}

  std::optional<ImportedMesh> mesh() {
    ImportedMesh mesh;
    const std::optional<std::size_t> parts = count();
    if (!parts || *parts > kMostParts + 1) return std::nullopt;
    for (std::size_t i = 0; i < *parts; ++i) {
      MeshPart part;
      if (!points(part.vertices) || !points(part.normals) || !points(part.colors)) return std::nullopt;
      const std::size_t vertices = part.vertices.size();
      if (!part.normals.empty() && part.normals.size() != vertices) return std::nullopt;
      if (!part.colors.empty() && part.colors.size() != vertices) return std::nullopt;
      const std::optional<std::size_t> triangles = count();
      if (!triangles || *triangles > rest_.size() / sizeof(Corners)) return std::nullopt;
      for (std::size_t k = 0; k < *triangles; ++k) {
        Corners c;
        take(&c, sizeof c);
        if (std::max({c[0], c[1], c[2]}) >= vertices) return std::nullopt;
        part.triangles.push_back({static_cast<int>(c[0]), static_cast<int>(c[1]), static_cast<int>(c[2])});
      }
      mesh.parts.push_back(std::move(part));
    }
    if (!rest_.empty()) return std::nullopt;
    return mesh;
  }

 private:
  bool points(std::vector<Vec3>& into) {
    const std::optional<std::size_t> number = count();
    if (!number || *number > rest_.size() / sizeof(Point)) return false;
    for (std::size_t k = 0; k < *number; ++k) {
      Point p;
      take(&p, sizeof p);
      into.emplace_back(p[0], p[1], p[2]);
      if (!into.back().allFinite()) return false;
    }
    return true;
  }
  std::optional<std::size_t> count() {
    std::size_t value = 0;
    if (rest_.size() < sizeof value) return std::nullopt;
    take(&value, sizeof value);
    return value;
  }
  void take(void* to, std::size_t size) {
    std::memcpy(to, rest_.data(), size);
    rest_ = rest_.subspan(size);
  }

  std::span<const std::uint8_t> rest_;
};

/// assimp's readers may crash, run for ever or allocate by a file's word: another process runs them.
ImportedMesh readApart(const fs::path& path) {
  const std::string place = path.string() + ": ";
  std::error_code failed;
  const std::uintmax_t size = fs::file_size(path, failed);
  const ProcessAnswer answer =
      answerOfProcess([&path] { return readFile(path); }, boundsFor(failed ? 0 : size));
  if (!answer.failure.empty())
    throw InputError(place + "cannot be read as a mesh: its reader " + answer.failure);
  const std::span<const std::uint8_t> bytes(answer.bytes);
  if (!bytes.empty() && bytes[0] == kError)
    throw InputError(place + std::string(bytes.begin() + 1, bytes.end()));
  if (bytes.size() == 2 && bytes[0] == kRefused)
    throw std::system_error(bytes[1], std::generic_category(), "cannot read '" + path.string() + "'");
  std::optional<ImportedMesh> mesh;
  if (!bytes.empty() && bytes[0] == kParts) mesh = AnswerReader(bytes.subspan(1)).mesh();
  if (!mesh) throw InputError(place + "cannot be read as a mesh: its reader gave no answer");
  return *std::move(mesh);
}

}  // namespace

namespace {

/// The digits of a text in place of assimp's rounding.
void takeText(const fs::path& path, ImportedMesh& mesh) {
  const std::string ending = path.extension().string();
  if (ending != ".obj" && ending != ".off" && ending != ".ply" && ending != ".stl") return;
  const std::string text = readTextFile(path);
  mesh.written_error_m = halfLastDigit(text);
  std::vector<Vec3*> points;
  for (MeshPart& part : mesh.parts)
    for (Vec3& p : part.vertices) points.push_back(&p);
  if (takeWritten(writtenVertices(text), points) && hasDoubleDigits(text))
    mesh.coordinate_error_m = mesh.written_error_m;
}

}  // namespace

ImportedMesh importMesh(const fs::path& path) {
  std::error_code ignored;
  if (!fs::exists(path, ignored)) throw InputError(path.string() + ": no such mesh file");
  if (!fs::is_regular_file(path, ignored))
    throw InputError(path.string() + ": is no file; accepted: a mesh file");
  requireSoundHeader(path);
  ImportedMesh mesh = readApart(path);
  if (mesh.parts.empty()) throw InputError(path.string() + ": holds no mesh with faces");
  const std::string ending = path.extension().string();
  mesh.y_up = ending == ".gltf" || ending == ".glb" || ending == ".dae";
  double reach = 0.0;
  for (const MeshPart& part : mesh.parts)
    for (const Vec3& p : part.vertices) reach = std::max(reach, p.cwiseAbs().maxCoeff());
  mesh.coordinate_error_m = kRounding * reach;
  takeText(path, mesh);
  return mesh;
}

}  // namespace carom::demos
