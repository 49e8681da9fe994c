#include "demos/mesh_import.h"

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

#include "demos/bounded_process.h"
#include "demos/mesh_header.h"
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
using Parts = std::vector<std::vector<Point>>;

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
      if (hasFaces(mesh)) parts.push_back(placedVertices(mesh, visit.X_FN));
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
// the number of points and the points.
constexpr std::uint8_t kError = 'e', kParts = 'p', kRefused = 'r';  // of the last: the system's number

using Bytes = std::vector<std::uint8_t>;

Bytes errorBytes(const std::string& text) {
  Bytes bytes(1 + text.size(), kError);
  std::copy(text.begin(), text.end(), bytes.begin() + 1);
  return bytes;
}

Bytes partsBytes(const Parts& parts) {
  std::size_t size = 1 + sizeof(std::size_t);
  for (const std::vector<Point>& part : parts) size += sizeof(std::size_t) + part.size() * sizeof(Point);
  Bytes bytes(size, kParts);
  std::uint8_t* to = bytes.data() + 1;
  const auto put = [&to](const void* from, std::size_t count) {
    if (count > 0) std::memcpy(to, from, count);
    to += count;
  };
  const auto putCount = [&put](std::size_t count) { put(&count, sizeof count); };
  putCount(parts.size());
  for (const std::vector<Point>& part : parts) {
    putCount(part.size());
    put(part.data(), part.size() * sizeof(Point));
  }
  return bytes;
}

/// In the process that reads.
Bytes readFile(const fs::path& path) {
  try {
    Assimp::Importer importer;
    const aiScene* scene = importer.ReadFile(path.string(), aiProcess_JoinIdenticalVertices);
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
      const std::optional<std::size_t> points = count();
      if (!points || *points > rest_.size() / sizeof(Point)) return std::nullopt;
      mesh.parts.emplace_back();
      for (std::size_t k = 0; k < *points; ++k) {
        Point p;
        take(&p, sizeof p);
        mesh.parts.back().emplace_back(p[0], p[1], p[2]);
        if (!mesh.parts.back().back().allFinite()) return std::nullopt;
      }
    }
    if (!rest_.empty()) return std::nullopt;
    return mesh;
  }

 private:
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

ImportedMesh importMesh(const fs::path& path) {
  std::error_code ignored;
  if (!fs::exists(path, ignored)) throw InputError(path.string() + ": no such mesh file");
  if (!fs::is_regular_file(path, ignored))
    throw InputError(path.string() + ": is no file; accepted: a mesh file");
  requireSoundHeader(path);
  ImportedMesh mesh = readApart(path);
  if (mesh.parts.empty()) throw InputError(path.string() + ": holds no mesh with faces");
  for (const std::vector<Vec3>& part : mesh.parts)
    for (const Vec3& p : part)
      mesh.coordinate_error_m = std::max(mesh.coordinate_error_m, kRounding * p.cwiseAbs().maxCoeff());
  return mesh;
}

}  // namespace carom::demos
