#include "demos/asset/mesh_import.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <map>
#include <new>
#include <stdexcept>
#include <string>
#include <system_error>

#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/scene.h>

#include "demos/asset/asset_path.h"
#include "demos/asset/assimp_file.h"
#include "demos/asset/gltf_nodes.h"
#include "demos/asset/mesh_answer.h"
#include "demos/asset/mesh_header.h"
#include "demos/asset/picture_file.h"
#include "demos/format/formatted.h"
#include "demos/format/written_precision.h"
#include "demos/system/bounded_process.h"
#include "engine/foundation/contract.h"
#include "engine/foundation/input_file.h"
#include "engine/solid/decomposition/polygon_triangles.h"

namespace carom::demos {
namespace fs = std::filesystem;
namespace {

constexpr double kRounding = 0x1p-24;  // of assimp's single-precision coordinates

/// What reading a file of `size` bytes may take: a second for each four megabytes is a tenth of assimp's
/// usual speed, and ten million vertices fit into the answer.
ProcessBounds boundsFor(std::uintmax_t size) {
  const int cpu_s = 5 + static_cast<int>(std::min<std::uintmax_t>(size >> 22, 1000));
  return {.memory_bytes = std::size_t{1} << 30,
          .cpu_s = cpu_s,
          .wall_s = 10 * cpu_s,
          .answer_bytes = std::size_t{256} << 20};
}

using Place = ReadPart::Place;
using Point = ReadPart::Point;
using Corners = ReadPart::Corners;

/// A file that was read, but is none of ours.
class Unsuitable : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

Vec3 vectorOf(const aiVector3D& v) {
  return {v.x, v.y, v.z};
}

std::vector<Place> placedVertices(const aiMesh& mesh, const AffineMap& X_FM) {
  std::vector<Place> points;
  for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
    const Vec3 written = vectorOf(mesh.mVertices[i]);
    const Vec3 p = X_FM * written;
    points.push_back({p.x(), p.y(), p.z()});
    if (p.allFinite()) continue;
    // By its coordinates: assimp's numbers are none of the file.
    const Vec3& shown = written.allFinite() ? p : written;
    throw Unsuitable("a vertex at " + formatted("(%g, %g, %g)", shown.x(), shown.y(), shown.z()) +
                     " of mesh \"" + mesh.mName.C_Str() + "\" is not finite; accepted: finite coordinates");
  }
  return points;
}

/// Turned by the inverse transpose, as a plane is; none where one of them is no direction.
std::vector<Point> placedNormals(const aiMesh& mesh, const AffineMap& X_FM) {
  std::vector<Point> normals;
  if (!mesh.HasNormals()) return normals;
  const Mat3 turn = X_FM.linear.inverse().transpose();
  for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
    const Vec3 n = turn * vectorOf(mesh.mNormals[i]);
    const double length = n.norm();
    if (!std::isfinite(length) || !(length > 0.0)) return {};
    const Eigen::Vector3f unit = (n / length).cast<float>();
    normals.push_back({unit.x(), unit.y(), unit.z()});
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

/// The corners of a face's triangles. Each version of assimp cuts polygons in another way.
std::vector<std::array<int, 3>> cutFace(const std::vector<Vec3>& corners) {
  const int count = static_cast<int>(corners.size());
  if (count == 3) return {{0, 1, 2}};
  Vec3 twice_area = Vec3::Zero();
  for (std::size_t i = 1; i + 1 < corners.size(); ++i)
    twice_area += (corners[i] - corners[0]).cross(corners[i + 1] - corners[0]);
  double reach = 0.0;
  for (const Vec3& corner : corners) reach = std::max(reach, corner.cwiseAbs().maxCoeff());
  if (const double length = twice_area.norm(); length > 0.0) {
    const PlaneCoordinates inPlane{tangentBasis(twice_area / length)};
    std::vector<int> ring;
    std::vector<Vec2> points;
    for (int i = 0; i < count; ++i) {
      ring.push_back(i);
      points.push_back(inPlane(corners[static_cast<std::size_t>(i)] - corners[0]));
    }
    if (auto cut = polygonTriangles({ring}, points, kRounding * reach)) return std::move(cut->triangles);
  }
  std::vector<std::array<int, 3>> fan;
  for (int i = 1; i + 1 < count; ++i) fan.push_back({0, i, i + 1});
  return fan;
}

/// Points and lines are left out.
std::vector<Corners> trianglesOf(const aiMesh& mesh, bool mirrored) {
  std::vector<Corners> triangles;
  for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
    const aiFace& face = mesh.mFaces[i];
    if (face.mNumIndices < 3) continue;
    std::vector<Vec3> corners;
    for (unsigned k = 0; k < face.mNumIndices; ++k) {
      if (face.mIndices[k] >= mesh.mNumVertices)
        throw Unsuitable("a face of mesh \"" + std::string(mesh.mName.C_Str()) +
                         "\" names a vertex that is not there");
      corners.push_back(vectorOf(mesh.mVertices[face.mIndices[k]]));
    }
    for (const std::array<int, 3>& t : cutFace(corners)) {
      triangles.push_back({face.mIndices[t[0]], face.mIndices[t[1]], face.mIndices[t[2]]});
      if (mirrored) std::swap(triangles.back()[1], triangles.back()[2]);
    }
  }
  return triangles;
}

/// The pictures that materials name, each read once.
class PictureBook {
 public:
  PictureBook(const aiScene& scene, fs::path folder) : scene_(scene), folder_(std::move(folder)) {}

  /// The index of the picture of the mesh's base colour, and the set of the mesh's places on it.
  struct Choice {
    std::int32_t picture = -1;
    unsigned set = 0;
  };
  Choice of(const aiMesh& mesh) {
    Choice choice;
    if (mesh.mMaterialIndex >= scene_.mNumMaterials) return choice;
    const aiMaterial& material = *scene_.mMaterials[mesh.mMaterialIndex];
    aiString name;
    if (material.GetTexture(aiTextureType_BASE_COLOR, 0, &name, nullptr, &choice.set) != aiReturn_SUCCESS &&
        material.GetTexture(aiTextureType_DIFFUSE, 0, &name, nullptr, &choice.set) != aiReturn_SUCCESS)
      return choice;
    if (choice.set >= AI_MAX_NUMBER_OF_TEXTURECOORDS || !mesh.HasTextureCoords(choice.set)) return choice;
    choice.picture = indexOf(name.C_Str());
    return choice;
  }
  std::vector<SurfacePicture> pictures;
  std::vector<std::string> notes;

 private:
  std::int32_t indexOf(const std::string& name) {
    const auto [known, is_new] = indices_.insert({name, -1});
    if (!is_new) return known->second;
    try {
      SurfacePicture picture = read(name);
      bytes_ += picture.rgb.size();
      if (bytes_ > kMostPictureBytes) throw InputError(name + ": beyond 96 MB of pictures in one file");
      pictures.push_back(std::move(picture));
      known->second = static_cast<std::int32_t>(pictures.size() - 1);
    } catch (const std::exception& error) {
      notes.push_back("picture left out: " + std::string(error.what()));
    }
    return known->second;
  }
  SurfacePicture read(std::string name) const {
    if (const aiTexture* inside = scene_.GetEmbeddedTexture(name.c_str())) {
      if (inside->mHeight > 0) return unpacked(*inside);
      const auto* bytes = reinterpret_cast<const std::uint8_t*>(inside->pcData);
      return decodePicture({bytes, inside->mWidth},
                           name.starts_with('*') ? "picture " + name.substr(1) : name);
    }
    std::replace(name.begin(), name.end(), '\\', '/');
    return readPicture(folder_ / name);
  }
  static SurfacePicture unpacked(const aiTexture& texture) {
    SurfacePicture picture{static_cast<int>(texture.mWidth), static_cast<int>(texture.mHeight), {}};
    const std::size_t pixels = std::size_t{texture.mWidth} * texture.mHeight;
    for (std::size_t i = 0; i < pixels; ++i) {
      const aiTexel& texel = texture.pcData[i];
      picture.rgb.insert(picture.rgb.end(), {texel.r, texel.g, texel.b});
    }
    return picture;
  }

  static constexpr std::size_t kMostPictureBytes = std::size_t{96} << 20;
  const aiScene& scene_;
  fs::path folder_;
  std::map<std::string, std::int32_t> indices_;
  std::size_t bytes_ = 0;
};

/// From the upper left corner of the picture; assimp's begin at the lower left.
std::vector<Point> placesOnPicture(const aiMesh& mesh, unsigned set) {
  std::vector<Point> places;
  for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
    const aiVector3D& uv = mesh.mTextureCoords[set][i];
    const bool finite = std::isfinite(uv.x) && std::isfinite(uv.y);
    places.push_back(finite ? Point{uv.x, 1.0f - uv.y, 0.0f} : Point{});
  }
  return places;
}

ReadPart placedPart(const aiMesh& mesh, const aiScene& scene, const AffineMap& X_FM, PictureBook& book) {
  ReadPart part{placedVertices(mesh, X_FM),
                placedNormals(mesh, X_FM),
                colorsOf(mesh, scene),
                {},
                trianglesOf(mesh, X_FM.linear.determinant() < 0.0)};
  const PictureBook::Choice choice = book.of(mesh);
  part.picture = choice.picture;
  if (part.picture >= 0) part.uv = placesOnPicture(mesh, choice.set);
  return part;
}

/// Points and lines enclose nothing; only meshes with faces count.
bool hasFaces(const aiMesh& mesh) {
  return (mesh.mPrimitiveTypes & (aiPrimitiveType_TRIANGLE | aiPrimitiveType_POLYGON)) != 0;
}

/// Its vertices in the order in which faces name them, all of which are there: assimp's own numbers are
/// others in each version.
std::vector<unsigned> namedVertices(const aiMesh& mesh) {
  std::vector<unsigned> named;
  std::vector<bool> is_named(mesh.mNumVertices, false);
  for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
    const aiFace& face = mesh.mFaces[i];
    for (unsigned k = 0; face.mNumIndices >= 3 && k < face.mNumIndices; ++k) {
      const unsigned vertex = face.mIndices[k];
      if (is_named[vertex]) continue;
      is_named[vertex] = true;
      named.push_back(vertex);
    }
  }
  return named;
}

/// Where assimp's nodes stand: as a glTF file writes it, else as assimp has it.
class NodePlacements {
 public:
  explicit NodePlacements(GltfNodes written) : written_(std::move(written)) {}

  /// A node of assimp's, and which of the written ones it is, or -1.
  struct Node {
    const aiNode* read;
    int written;
  };
  Node root(const aiScene& scene) const { return same(scene.mRootNode, written_.root); }
  Node child(const Node& node, unsigned i) const {
    const aiNode* read = node.read->mChildren[i];
    if (node.written < 0) return {read, -1};
    const std::vector<int>& children = at(node.written).children;
    return same(read, children.size() == node.read->mNumChildren ? children[i] : -1);
  }
  AffineMap placement(const Node& node) const {
    return node.written < 0 ? asRead(*node.read) : at(node.written).X_PN;
  }

 private:
  const GltfNode& at(int written) const { return written_.nodes[static_cast<std::size_t>(written)]; }
  static AffineMap asRead(const aiNode& node) {
    const aiMatrix4x4& m = node.mTransformation;
    AffineMap X_PN;
    X_PN.linear << m.a1, m.a2, m.a3, m.b1, m.b2, m.b3, m.c1, m.c2, m.c3;
    X_PN.origin = Vec3(m.a4, m.b4, m.c4);
    return X_PN;
  }
  /// The written one, where it stands about as assimp has it: rotations are written with three digits too.
  Node same(const aiNode* read, int written) const {
    constexpr double kDigits = 1e-3;
    if (written < 0 || static_cast<std::size_t>(written) >= written_.nodes.size()) return {read, -1};
    const AffineMap theirs = asRead(*read), ours = at(written).X_PN;
    const double size = std::max(ours.linear.cwiseAbs().maxCoeff(), ours.origin.cwiseAbs().maxCoeff());
    const bool agree = (theirs.linear - ours.linear).cwiseAbs().maxCoeff() <= kDigits * size &&
                       (theirs.origin - ours.origin).cwiseAbs().maxCoeff() <= kDigits * size;
    return {read, agree ? written : -1};
  }

  GltfNodes written_;
};

/// Walks the node tree from the root with a list in place of recursion: files may be deep.
std::vector<ReadPart> collectParts(const aiScene& scene, const NodePlacements& placements,
                                   PictureBook& book) {
  struct Visit {
    NodePlacements::Node node;
    AffineMap X_FN;  // node frame in the file's frame
  };
  std::vector<ReadPart> parts;
  std::vector<Visit> visits;
  const NodePlacements::Node root = placements.root(scene);
  visits.push_back({root, placements.placement(root)});
  while (!visits.empty()) {
    const Visit visit = visits.back();
    visits.pop_back();
    const aiNode& node = *visit.node.read;
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
      const aiMesh& mesh = *scene.mMeshes[node.mMeshes[i]];
      if (!hasFaces(mesh)) continue;
      const ReadPart part = placedPart(mesh, scene, visit.X_FN, book);
      parts.push_back(joinedPart(part, namedVertices(mesh)));
    }
    if (parts.size() > kMostMeshParts)
      throw Unsuitable("more than " + std::to_string(kMostMeshParts) +
                       " meshes; accepted: at most that many");
    for (unsigned i = node.mNumChildren; i > 0; --i) {
      const NodePlacements::Node child = placements.child(visit.node, i - 1);
      visits.push_back({child, visit.X_FN * placements.placement(child)});
    }
  }
  return parts;
}

/// In the process that reads.
std::vector<std::uint8_t> readFile(const fs::path& path) {
  try {
    Assimp::Importer importer;
    const AssimpFile file = assimpFile(path, std::endian::native);
    const aiScene* scene =
        file.bytes.empty()
            ? importer.ReadFile(path.string(), 0)
            : importer.ReadFileFromMemory(file.bytes.data(), file.bytes.size(), 0, file.ending.c_str());
    const std::string reason = importer.GetErrorString();
    if (reason.find("bad_alloc") != std::string::npos) throw std::bad_alloc();
    if (scene == nullptr) tryInputFile(path);  // assimp does not say whether the system refused the file
    if (scene == nullptr || scene->mRootNode == nullptr)
      return errorBytes("cannot be read as a mesh: " + reason);
    PictureBook book(*scene, path.parent_path());
    std::vector<ReadPart> parts = collectParts(*scene, NodePlacements(gltfNodes(path)), book);
    return answerBytes({std::move(parts), std::move(book.pictures), std::move(book.notes)});
  } catch (const Unsuitable& error) {
    return errorBytes(error.what());
  } catch (const std::system_error& error) {
    return refusalBytes(error.code());
  }
}

/// assimp's readers may crash, run for ever or allocate by a file's word: another process runs them.
ImportedMesh readApart(const fs::path& path) {
  std::error_code failed;
  const std::uintmax_t size = fs::file_size(path, failed);
  const ProcessAnswer answer =
      answerOfProcess([&path] { return readFile(path); }, boundsFor(failed ? 0 : size));
  if (!answer.failure.empty())
    throw InputError(path.string() + ": cannot be read as a mesh: its reader " + answer.failure);
  return meshOfAnswer(answer.bytes, path);
}

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

const ImportedMesh& MeshFiles::imported(const fs::path& path) {
  const auto known = files_.find(path);
  return known != files_.end() ? known->second : files_.emplace(path, importMesh(path)).first->second;
}

}  // namespace carom::demos
