#include "demos/frames/frame_identity.h"

#include <algorithm>
#include <iterator>

#include "demos/format/content_hash.h"
#include "demos/format/formatted.h"
#include "demos/system/build_info.h"
#include "engine/foundation/contract.h"
#include "engine/foundation/input_file.h"
#include "renderer/image/cutout.h"

namespace carom::demos {
namespace {

bool holdsExactly(const std::filesystem::path& path, const std::vector<std::uint8_t>& bytes) {
  std::ifstream file = openInputFile(path);
  const std::string held{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  return std::equal(held.begin(), held.end(), bytes.begin(), bytes.end(),
                    [](char a, std::uint8_t b) { return static_cast<std::uint8_t>(a) == b; });
}

EncodedFrame encodedCutout(const renderer::Image& image, const renderer::PngText& text) {
  const renderer::Raster raster = renderer::rasterOf(image);
  const std::vector<std::uint8_t> bytes(raster.samples.begin(), raster.samples.end());
  EncodedFrame frame;
  frame.pixel_hash = ContentHash().add(bytes.data(), bytes.size()).value();
  renderer::PngText signed_text = text;
  signed_text.emplace_back("Pixels", hexText(frame.pixel_hash));
  frame.bytes = renderer::encodePng(raster, signed_text, renderer::PngPacking::kQuick);
  return frame;
}

/// A frame's file with the alpha that it may have.
renderer::DecodedPng readFrame(const std::filesystem::path& path) {
  renderer::DecodedRaster file = renderer::readPngRaster(path);
  if (file.raster.channels == 4 && file.raster.bits == 8)
    return {renderer::imageOf(file.raster), std::move(file.text)};
  return renderer::readPng(path);
}

}  // namespace

renderer::PngText frameText(const Manifest& manifest, const FrameRecord& record) {
  renderer::PngText text = {{"Software", "carom " + programVersion()},
                            {"Build", buildName()},
                            {"Renderer", manifest.gl.renderer + ", " + manifest.gl.version},
                            {"Scene", manifest.scene + " " + hexText(manifest.scene_hash)},
                            {"Camera", manifest.camera},
                            {"Frame", std::to_string(record.frame)},
                            {"Time", formatted("%.17g", record.time_s)},
                            {"State", hexText(record.state_hash)}};
  if (manifest.preset != renderer::Preset::kRealtime) text.emplace_back("Preset", nameOf(manifest.preset));
  if (manifest.style != renderer::Style::kDaylight) text.emplace_back("Style", nameOf(manifest.style));
  if (!manifest.light.empty()) text.emplace_back("Light", manifest.light);
  if (manifest.shutter_degrees > 0.0)
    text.emplace_back("Shutter", formatted("%.9g degrees", manifest.shutter_degrees));
  if (manifest.cutout) text.emplace_back("Background", "none");
  if (!manifest.overlays.empty()) text.emplace_back("Overlays", manifest.overlays);
  if (manifest.has_caption) text.emplace_back("Caption", "on");
  // Golden frames, which are kept, are portable.
  if (!manifest.portable) text.emplace_back("Portable", "no");
  return text;
}

EncodedFrame encodedFrame(const renderer::Image& image, const renderer::PngText& text) {
  return FrameEncoder().encode(image, text);
}

EncodedFrame FrameEncoder::encode(const renderer::Image& image, const renderer::PngText& text) {
  if (!image.alpha.empty()) return encodedCutout(image, text);
  EncodedFrame frame;
  frame.pixel_hash = ContentHash().add(image.rgb.data(), image.rgb.size()).value();
  renderer::PngText signed_text = text;
  signed_text.emplace_back("Pixels", hexText(frame.pixel_hash));
  frame.bytes = pictures_.encode(image, signed_text);
  return frame;
}

EncodedFrame encodedOutput(const renderer::Raster& raster, const renderer::PngText& text) {
  EncodedFrame frame;
  frame.pixel_hash =
      ContentHash().add(raster.samples.data(), raster.samples.size() * sizeof(std::uint16_t)).value();
  renderer::PngText signed_text = text;
  signed_text.emplace_back("Pixels", hexText(frame.pixel_hash));
  frame.bytes = renderer::encodePng(raster, signed_text, renderer::PngPacking::kQuick);
  return frame;
}

namespace {

// `Decode` reads a file's pixels and text, `Encode` makes the file's bytes of them.
template <typename Decode, typename Encode>
std::optional<std::uint64_t> wanted(const std::filesystem::path& path, const renderer::PngText& text,
                                    const FrameSize& size, const Decode& decode, const Encode& encode) {
  try {
    const auto [pixels, found] = decode(path);
    if (pixels.width != size.width || pixels.height != size.height) return std::nullopt;
    // The text is compared first: it is what differs in a stale frame, and encoding costs more.
    if (found.size() != text.size() + 1 || !std::equal(text.begin(), text.end(), found.begin()))
      return std::nullopt;
    // The bytes hold the hash of the pixels, so that a file of other pixels differs.
    const EncodedFrame expected = encode(pixels, text);
    if (!holdsExactly(path, expected.bytes)) return std::nullopt;
    return expected.pixel_hash;
  } catch (const InputError&) {
    return std::nullopt;  // no whole PNG
  }
}

}  // namespace

std::optional<std::uint64_t> wantedFrame(const std::filesystem::path& path, const renderer::PngText& text,
                                         const FrameSize& size) {
  return wanted(path, text, size, readFrame, encodedFrame);
}

std::optional<std::uint64_t> wantedOutput(const std::filesystem::path& path, const renderer::PngText& text,
                                          const FrameSize& size) {
  return wanted(path, text, size, renderer::readPngRaster, encodedOutput);
}

}  // namespace carom::demos
