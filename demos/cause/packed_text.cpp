#include "demos/cause/packed_text.h"

#include <cstdlib>

#include "engine/foundation/contract.h"
#include "renderer/image/png.h"

namespace carom::demos {
namespace {

constexpr std::size_t kRow = 4096;
constexpr char kLength[] = "Bytes";

}  // namespace

std::vector<std::uint8_t> packedText(const std::string& text) {
  const std::size_t rows = std::max<std::size_t>(1, (text.size() + kRow - 1) / kRow);
  renderer::Raster raster{static_cast<int>(kRow), static_cast<int>(rows), 1, 8, {}};
  raster.samples.assign(kRow * rows, 0);
  for (std::size_t i = 0; i < text.size(); ++i) raster.samples[i] = static_cast<unsigned char>(text[i]);
  return renderer::encodePng(raster, {{kLength, std::to_string(text.size())}}, renderer::PngPacking::kSmall,
                             renderer::PngDeflate::kZlib);
}

std::string unpackedText(const std::filesystem::path& path) {
  const renderer::DecodedRaster decoded = renderer::readPngRaster(path);
  std::size_t length = 0;
  for (const auto& [key, value] : decoded.text)
    if (key == kLength) length = std::strtoull(value.c_str(), nullptr, 10);
  if (decoded.raster.channels != 1 || decoded.raster.bits != 8 || length > decoded.raster.samples.size())
    throw InputError(path.string() + ": not what carom render writes beside its frames");
  std::string text(length, '\0');
  for (std::size_t i = 0; i < length; ++i) text[i] = static_cast<char>(decoded.raster.samples[i]);
  return text;
}

}  // namespace carom::demos
