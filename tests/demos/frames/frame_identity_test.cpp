#include "demos/frames/frame_identity.h"

#include <functional>

#include <gtest/gtest.h>

#include "demos/asset/asset_path.h"
#include "tests/support/temporary_folder.h"

namespace carom::demos {
namespace {

Manifest someManifest() {
  Manifest manifest;
  manifest.scene = "ball";
  manifest.scene_hash = 0xabcull;
  manifest.camera = "main";
  manifest.gl.renderer = "llvmpipe";
  manifest.gl.version = "4.5";
  return manifest;
}

FrameRecord someRecord() {
  FrameRecord record;
  record.frame = 7;
  record.time_s = 0.7;
  record.state_hash = 0x1234ull;
  return record;
}

renderer::Image noise() {
  renderer::Image image{16, 9, std::vector<std::uint8_t>(16 * 9 * 3)};
  std::uint32_t random = 1;
  for (std::uint8_t& byte : image.rgb)
    byte = static_cast<std::uint8_t>((random = random * 1664525u + 1u) >> 24);
  return image;
}

std::string frameBytes() {
  const EncodedFrame frame = encodedFrame(noise(), frameText(someManifest(), someRecord()));
  return {frame.bytes.begin(), frame.bytes.end()};
}

bool isWanted(const std::filesystem::path& file, const renderer::PngText& text) {
  return wantedFrame(file, text, {16, 9}).has_value();
}

TEST(FrameIdentity, AFrameAsWrittenIsWantedAndItsPixelsAreKnown) {
  const TemporaryFolder folder;
  const auto file = folder.file("f.png", frameBytes());
  const renderer::PngText text = frameText(someManifest(), someRecord());
  EXPECT_EQ(wantedFrame(file, text, {16, 9}), encodedFrame(noise(), text).pixel_hash);
  EXPECT_FALSE(wantedFrame(file, text, {9, 16}));
  EXPECT_FALSE(isWanted(folder.path() / "missing.png", text));
  EXPECT_FALSE(isWanted(folder.path(), text));
}

TEST(FrameIdentity, WhateverThePixelsDependOnMakesAFrameStale) {
  const TemporaryFolder folder;
  const auto file = folder.file("f.png", frameBytes());
  const std::vector<std::function<void(Manifest&, FrameRecord&)>> changes = {
      [](Manifest& m, FrameRecord&) { m.scene_hash ^= 1; },
      [](Manifest& m, FrameRecord&) { m.camera = "other"; },
      [](Manifest& m, FrameRecord&) { m.preset = renderer::Preset::kFast; },
      [](Manifest& m, FrameRecord&) { m.style = renderer::Style::kPrint; },
      [](Manifest& m, FrameRecord&) { m.has_caption = true; },
      [](Manifest& m, FrameRecord&) { m.portable = true; },
      [](Manifest& m, FrameRecord&) { m.gl.version = "4.6"; },
      [](Manifest& m, FrameRecord&) { m.gl.renderer = "softpipe"; },
      [](Manifest&, FrameRecord& r) { r.state_hash ^= 1; },
      [](Manifest&, FrameRecord& r) { r.time_s = 0.70000000000000007; },
      [](Manifest&, FrameRecord& r) { r.frame = 8; }};
  for (std::size_t i = 0; i < changes.size(); ++i) {
    Manifest manifest = someManifest();
    FrameRecord record = someRecord();
    changes[i](manifest, record);
    EXPECT_FALSE(isWanted(file, frameText(manifest, record))) << i;
  }
}

TEST(FrameIdentity, NoTruncationAndNoFlippedByteIsTakenForTheFrame) {
  const TemporaryFolder folder;
  const renderer::PngText text = frameText(someManifest(), someRecord());
  const std::string whole = frameBytes();
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_FALSE(isWanted(folder.file("f.png", whole.substr(0, size)), text)) << size;
  for (std::size_t at = 0; at < whole.size(); ++at) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 1);
    EXPECT_FALSE(isWanted(folder.file("f.png", damaged), text)) << at;
  }
  EXPECT_FALSE(isWanted(folder.file("f.png", whole + "x"), text));
}

TEST(FrameIdentity, OtherPixelsUnderTheSameTextAreNotTakenForTheFrame) {
  const TemporaryFolder folder;
  const renderer::PngText text = frameText(someManifest(), someRecord());
  renderer::PngText signed_text = renderer::readPng(folder.file("f.png", frameBytes())).text;
  renderer::Image painted = noise();
  painted.rgb[0] = static_cast<std::uint8_t>(painted.rgb[0] ^ 1);
  const std::vector<std::uint8_t> bytes = renderer::encodePng(painted, signed_text);
  EXPECT_FALSE(isWanted(folder.file("f.png", std::string(bytes.begin(), bytes.end())), text));
}

}  // namespace
}  // namespace carom::demos
