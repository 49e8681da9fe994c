#pragma once
// Small PNG files for the tests of comparing.

#include <filesystem>
#include <fstream>
#include <string>

#include "renderer/image/png.h"

namespace carom::demos {

inline renderer::Raster flatRaster(int width, int height, std::uint16_t value, int channels = 3,
                                   int bits = 8) {
  const std::size_t samples = static_cast<std::size_t>(width) * static_cast<std::size_t>(height * channels);
  return {width, height, channels, bits, std::vector<std::uint16_t>(samples, value)};
}

/// Adds `step` to the first channel of one pixel.
inline renderer::Raster changed(renderer::Raster raster, int x, int y, int step) {
  std::uint16_t& sample = raster.samples[static_cast<std::size_t>((y * raster.width + x) * raster.channels)];
  sample = static_cast<std::uint16_t>(sample + step);
  return raster;
}

inline std::filesystem::path writePng(const std::filesystem::path& path, const renderer::Raster& raster,
                                      const renderer::PngText& text = {}) {
  std::filesystem::create_directories(path.parent_path());
  const std::vector<std::uint8_t> bytes = renderer::encodePng(raster, text);
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  return path;
}

/// Leaves the first half of a file.
inline void truncateFile(const std::filesystem::path& path) {
  std::filesystem::resize_file(path, std::filesystem::file_size(path) / 2);
}

}  // namespace carom::demos
