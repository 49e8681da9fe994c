#pragma once
// What a frame's PNG file says of itself, and whether a file is exactly the frame that is wanted. The text
// chunks hold everything its pixels depend on; the size is in the PNG's own header. Tested in
// tests/demos/frames/frame_identity_test.cpp.

#include <cstdint>
#include <filesystem>
#include <optional>

#include "demos/frames/manifest.h"
#include "renderer/image/image.h"
#include "renderer/image/png.h"

namespace carom::demos {

/// Scene, camera, time, state, program and renderer of a frame; preset, style and the like where they are not
/// the usual ones, and "Portable: no" of one whose pixels are of this CPU.
renderer::PngText frameText(const Manifest& manifest, const FrameRecord& record);

/// The bytes of a frame's file: `text` and, last, the hash of the pixels.
struct EncodedFrame {
  std::vector<std::uint8_t> bytes;
  std::uint64_t pixel_hash = 0;
};
EncodedFrame encodedFrame(const renderer::Image& image, const renderer::PngText& text);

/// The same of one frame after the other: what stays as it was in the frame before is not packed again.
class FrameEncoder {
 public:
  EncodedFrame encode(const renderer::Image& image, const renderer::PngText& text);

 private:
  renderer::PngSequence pictures_;
};

/// The bytes of the file of another output; its hash is that of the samples, low byte first.
EncodedFrame encodedOutput(const renderer::Raster& raster, const renderer::PngText& text);

struct FrameSize {
  int width = 0;
  int height = 0;
};
/// The pixel hash of the file when it is, byte for byte, a frame of this size and identity as it is written
/// here; nothing when it is missing, truncated, damaged, edited or stale.
std::optional<std::uint64_t> wantedFrame(const std::filesystem::path& path, const renderer::PngText& text,
                                         const FrameSize& size);

/// The same of another output's file.
std::optional<std::uint64_t> wantedOutput(const std::filesystem::path& path, const renderer::PngText& text,
                                          const FrameSize& size);

}  // namespace carom::demos
