#include "demos/asset/assimp_file.h"

#include <algorithm>
#include <cstdint>
#include <sstream>
#include <vector>

#include <tiny_gltf.h>

#include "demos/asset/asset_path.h"
#include "demos/asset/gltf_nodes.h"
#include "demos/format/base64.h"
#include "demos/format/byte_message.h"
#include "demos/format/json.h"
#include "engine/foundation/contract.h"

namespace carom::demos {
namespace fs = std::filesystem;
namespace {

// A head of text, the number of triangles, and of each triangle twelve coordinates and two bytes of colour.
constexpr std::size_t kHead = 80, kCount = 4, kCoordinate = 4, kCoordinates = 12, kColor = 2;
constexpr std::size_t kTriangle = kCoordinates * kCoordinate + kColor;

bool isBinaryStl(const std::string& bytes) {
  return bytes.size() >= kHead + kCount &&
         bytes.size() == kHead + kCount + littleEndianWord(&bytes[kHead], kCount) * kTriangle;
}

AssimpFile turnedStl(const fs::path& path) {
  std::string bytes = readTextFile(path);
  if (!isBinaryStl(bytes)) return {};
  auto at = bytes.begin() + kHead;
  const auto turnRound = [&at](std::size_t size) {
    const auto end = at + static_cast<std::ptrdiff_t>(size);
    std::reverse(at, end);
    at = end;
  };
  turnRound(kCount);
  while (at != bytes.end()) {
    for (std::size_t i = 0; i < kCoordinates; ++i) turnRound(kCoordinate);
    turnRound(kColor);
  }
  return {std::move(bytes), "stl"};
}

/// The buffers of a glTF file, whose arrays may share bytes: each is turned once.
class Buffers {
 public:
  explicit Buffers(tinygltf::Model& model) : model_(model) {
    for (const tinygltf::Buffer& buffer : model.buffers) turned_.emplace_back(buffer.data.size(), false);
  }

  void turnRound(const tinygltf::Accessor& array) {
    const std::size_t size = componentSize(array.componentType);
    const int components = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(array.type));
    if (components < 1) return;
    const std::size_t many = static_cast<std::size_t>(components);
    if (known(array.bufferView)) {
      const int stride = array.ByteStride(view(array.bufferView));
      if (stride > 0)
        turnRound({array.bufferView, array.byteOffset, array.count, many, size},
                  static_cast<std::size_t>(stride));
    }
    if (!array.sparse.isSparse) return;
    const std::size_t count = static_cast<std::size_t>(std::max(array.sparse.count, 0));
    const std::size_t index = componentSize(array.sparse.indices.componentType);
    turnRound({array.sparse.indices.bufferView, static_cast<std::size_t>(array.sparse.indices.byteOffset),
               count, 1, index},
              index);
    turnRound({array.sparse.values.bufferView, static_cast<std::size_t>(array.sparse.values.byteOffset),
               count, many, size},
              many * size);
  }

 private:
  struct Elements {
    int view;
    std::size_t offset, count, components, component_bytes;
  };
  bool known(int index) const {
    return index >= 0 && static_cast<std::size_t>(index) < model_.bufferViews.size();
  }
  const tinygltf::BufferView& view(int index) const {
    return model_.bufferViews[static_cast<std::size_t>(index)];
  }
  static std::size_t componentSize(int type) {
    return static_cast<std::size_t>(
        std::max(tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(type)), 1));
  }
  void turnRound(const Elements& elements, std::size_t stride) {
    if (!known(elements.view)) return;
    const tinygltf::BufferView& view = this->view(elements.view);
    if (view.buffer < 0 || static_cast<std::size_t>(view.buffer) >= turned_.size()) return;
    std::vector<unsigned char>& data = model_.buffers[static_cast<std::size_t>(view.buffer)].data;
    std::vector<bool>& turned = turned_[static_cast<std::size_t>(view.buffer)];
    const std::size_t size = elements.component_bytes;
    for (std::size_t i = 0; i < elements.count; ++i)
      for (std::size_t c = 0; c < elements.components; ++c) {
        const std::size_t at = view.byteOffset + elements.offset + i * stride + c * size;
        if (at + size > data.size()) return;
        if (turned[at]) continue;
        turned[at] = true;
        const auto begin = data.begin() + static_cast<std::ptrdiff_t>(at);
        std::reverse(begin, begin + static_cast<std::ptrdiff_t>(size));
      }
  }

  tinygltf::Model& model_;
  std::vector<std::vector<bool>> turned_;
};

/// Its buffers are embedded, so that one text is all of it.
AssimpFile turnedGltf(const fs::path& path) {
  tinygltf::TinyGLTF loader;
  loader.SetImageLoader([](tinygltf::Image*, int, std::string*, std::string*, int, int, const unsigned char*,
                           int, void*) { return true; },
                        nullptr);
  tinygltf::Model model;
  std::string error, warning;
  const bool is_read = path.extension() == ".glb"
                           ? loader.LoadBinaryFromFile(&model, &error, &warning, path.string())
                           : loader.LoadASCIIFromFile(&model, &error, &warning, path.string());
  if (!is_read) return {};
  Buffers buffers(model);
  for (const tinygltf::Accessor& array : model.accessors) buffers.turnRound(array);
  Json file = Json::parse(gltfText(path), path.string()).without("buffers");
  Json embedded = Json::array();
  for (const tinygltf::Buffer& buffer : model.buffers)
    embedded.push(Json::object({{"byteLength", static_cast<double>(buffer.data.size())},
                                {"uri", "data:application/octet-stream;base64," + base64(buffer.data)}}));
  file.set("buffers", std::move(embedded));
  return {file.text(), "gltf"};
}

/// In text: assimp reads no binary one.
AssimpFile offWithoutComments(const fs::path& path) {
  std::istringstream lines(readTextFile(path));
  std::string text;
  bool is_changed = false;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t comment = line.find('#');
    is_changed = is_changed || comment != std::string::npos;
    line.resize(std::min(line.size(), comment));
    if (line.find_first_not_of(" \t\r") != std::string::npos) text += line + '\n';
  }
  if (!is_changed) return {};
  return {std::move(text), "off"};
}

}  // namespace

AssimpFile assimpFile(const fs::path& path, std::endian order) {
  const std::string ending = path.extension().string();
  try {
    if (ending == ".off") return offWithoutComments(path);
    if (order == std::endian::little) return {};
    if (ending == ".stl") return turnedStl(path);
    if (ending == ".gltf" || ending == ".glb") return turnedGltf(path);
  } catch (const InputError&) {  // assimp says it in its own words
  }
  return {};
}

}  // namespace carom::demos
