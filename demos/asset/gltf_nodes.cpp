#include "demos/asset/gltf_nodes.h"

#include <array>
#include <string>
#include <utility>

#include "demos/asset/asset_path.h"
#include "demos/format/byte_message.h"
#include "demos/format/json.h"
#include "engine/foundation/contract.h"

namespace carom::demos {
namespace fs = std::filesystem;
namespace {

template <std::size_t N>
std::array<double, N> numbersOf(const Json& node, const char* key, std::array<double, N> otherwise) {
  const Json* list = node.find(key);
  if (list == nullptr) return otherwise;
  if (list->items().size() != N) list->fail("must have " + std::to_string(N) + " numbers");
  for (std::size_t i = 0; i < N; ++i) otherwise[i] = list->items()[i].asNumber();
  return otherwise;
}

std::vector<int> indicesOf(const Json& holder, const char* key) {
  std::vector<int> indices;
  if (const Json* list = holder.find(key))
    for (const Json& item : list->items()) {
      const double index = item.asNumber();
      indices.push_back(index >= 0.0 && index < kMostJsonValues ? static_cast<int>(index) : -1);
    }
  return indices;
}

/// A matrix, column by column, or the product of translation, rotation (x, y, z, w) and scale.
AffineMap placementOf(const Json& node) {
  AffineMap X_PN;
  if (node.find("matrix") != nullptr) {
    const auto m = numbersOf<16>(node, "matrix", {});
    X_PN.linear << m[0], m[4], m[8], m[1], m[5], m[9], m[2], m[6], m[10];
    X_PN.origin = Vec3(m[12], m[13], m[14]);
    return X_PN;
  }
  const auto t = numbersOf<3>(node, "translation", {0.0, 0.0, 0.0});
  const auto r = numbersOf<4>(node, "rotation", {0.0, 0.0, 0.0, 1.0});
  const auto s = numbersOf<3>(node, "scale", {1.0, 1.0, 1.0});
  X_PN.linear = Quat(r[3], r[0], r[1], r[2]).normalized().toRotationMatrix();
  for (int column = 0; column < 3; ++column) X_PN.linear.col(column) *= s[static_cast<std::size_t>(column)];
  X_PN.origin = Vec3(t[0], t[1], t[2]);
  return X_PN;
}

GltfNodes nodesOf(const Json& file) {
  GltfNodes tree;
  for (const Json& node : file.at("nodes").items())
    tree.nodes.push_back({placementOf(node), indicesOf(node, "children")});
  const Json* chosen = file.find("scene");
  const std::vector<Json>& scenes = file.at("scenes").items();
  const double scene = chosen == nullptr ? 0.0 : chosen->asNumber();
  if (!(scene >= 0.0 && scene < static_cast<double>(scenes.size()))) return {};
  std::vector<int> roots = indicesOf(scenes[static_cast<std::size_t>(scene)], "nodes");
  if (roots.size() == 1) {
    tree.root = roots[0];
  } else {
    tree.root = static_cast<int>(tree.nodes.size());
    tree.nodes.push_back({AffineMap(), std::move(roots)});
  }
  return tree;
}

}  // namespace

std::string gltfText(const fs::path& path) {
  std::string file = readTextFile(path);
  // A header of twelve bytes, then the chunk's own of eight, which begins with its length.
  constexpr std::size_t kHeader = 12, kChunkHeader = 8;
  if (!file.starts_with("glTF")) return file;
  if (file.size() < kHeader + kChunkHeader) return {};
  return file.substr(kHeader + kChunkHeader, littleEndianWord(&file[kHeader], 4));
}

GltfNodes gltfNodes(const fs::path& path) {
  if (path.extension() != ".gltf" && path.extension() != ".glb") return {};
  try {
    return nodesOf(Json::parse(gltfText(path), path.string()));
  } catch (const InputError&) {
    return {};
  }
}

}  // namespace carom::demos
