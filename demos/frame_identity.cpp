#include "demos/frame_identity.h"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <iterator>

#include "demos/build_info.h"
#include "demos/content_hash.h"
#include "engine/foundation/contract.h"

namespace carom::demos {
namespace {

bool holdsExactly(const std::filesystem::path& path, const std::vector<std::uint8_t>& bytes) {
  std::ifstream file(path, std::ios::binary);
  const std::string held{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  return std::equal(held.begin(), held.end(), bytes.begin(), bytes.end(),
                    [](char a, std::uint8_t b) { return static_cast<std::uint8_t>(a) == b; });
}

}  // namespace

renderer::PngText frameText(const Manifest& manifest, const FrameRecord& record) {
  char time[32];
  std::snprintf(time, sizeof time, "%.17g", record.time_s);
  return {{"Software", "carom " + programVersion()},
          {"Build", buildName()},
          {"Renderer", manifest.gl.renderer + ", " + manifest.gl.version},
          {"Scene", manifest.scene + " " + hexText(manifest.scene_hash)},
          {"Camera", manifest.camera},
          {"Frame", std::to_string(record.frame)},
          {"Time", time},
          {"State", hexText(record.state_hash)}};
}

EncodedFrame encodedFrame(const renderer::Image& image, const renderer::PngText& text) {
  EncodedFrame frame;
  frame.pixel_hash = ContentHash().add(image.rgb.data(), image.rgb.size()).value();
  renderer::PngText signed_text = text;
  signed_text.emplace_back("Pixels", hexText(frame.pixel_hash));
  frame.bytes = renderer::encodePng(image, signed_text);
  return frame;
}

std::optional<std::uint64_t> wantedFrame(const std::filesystem::path& path, const renderer::PngText& text,
                                         const FrameSize& size) {
  try {
    std::error_code unreadable;
    if (!std::filesystem::is_regular_file(path, unreadable)) return std::nullopt;
    const renderer::DecodedPng png = renderer::readPng(path);
    if (png.image.width != size.width || png.image.height != size.height) return std::nullopt;
    // The text is compared first: it is what differs in a stale frame, and encoding costs more.
    if (png.text.size() != text.size() + 1 || !std::equal(text.begin(), text.end(), png.text.begin()))
      return std::nullopt;
    const std::uint64_t pixel_hash = ContentHash().add(png.image.rgb.data(), png.image.rgb.size()).value();
    if (png.text.back() != std::pair<std::string, std::string>("Pixels", hexText(pixel_hash)))
      return std::nullopt;
    const EncodedFrame expected = encodedFrame(png.image, text);
    if (!holdsExactly(path, expected.bytes)) return std::nullopt;
    return expected.pixel_hash;
  } catch (const InputError&) {
    return std::nullopt;  // no whole PNG
  }
}

}  // namespace carom::demos
