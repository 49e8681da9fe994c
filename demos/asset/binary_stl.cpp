#include "demos/asset/binary_stl.h"

#include <algorithm>
#include <cstdint>

#include "demos/asset/asset_path.h"

namespace carom::demos {
namespace {

// A head of text, the number of triangles, and of each triangle twelve coordinates and two bytes of colour.
constexpr std::size_t kHead = 80, kCount = 4, kCoordinate = 4, kCoordinates = 12, kColor = 2;
constexpr std::size_t kTriangle = kCoordinates * kCoordinate + kColor;

bool isBinaryStl(const std::string& bytes) {
  if (bytes.size() < kHead + kCount) return false;
  std::uint64_t triangles = 0;
  for (std::size_t i = kCount; i > 0; --i)
    triangles = triangles << 8 | static_cast<std::uint8_t>(bytes[kHead + i - 1]);
  return bytes.size() == kHead + kCount + triangles * kTriangle;
}

}  // namespace

std::string binaryStlInOrderOf(std::endian order, const std::filesystem::path& path) {
  if (order == std::endian::little || path.extension() != ".stl") return {};
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
  return bytes;
}

}  // namespace carom::demos
