#include "demos/frames/manifest.h"

#include <gtest/gtest.h>

#include "demos/asset/asset_path.h"
#include "demos/format/json.h"
#include "tests/support/temporary_folder.h"

namespace carom::demos {
namespace {

TEST(Manifest, HoldsTheIdentityOfTheRunAndOfEachFrame) {
  const TemporaryFolder folder;
  Manifest manifest;
  manifest.command = "carom render resting";
  manifest.scene = "resting";
  manifest.scene_hash = 0xabcull;
  manifest.seed = 7;
  manifest.width = 64;
  manifest.height = 36;
  manifest.fps = 24.0;
  manifest.steps_per_second = 240.0;
  manifest.gl.version = "4.5 Mesa";
  manifest.gl.backend = renderer::GlBackend::kEgl;
  manifest.gl.reason = "there is no OSMesa";
  manifest.frames_planned = 2;
  FrameRecord record;
  record.frame = 1;
  record.file = "frame_0001.png";
  record.time_s = 1.0 / 24.0;
  record.step = 10;
  record.state_hash = 0x1234ull;
  record.pixel_hash = 0x5678ull;
  record.timings = {1.5, 20.25, 3.125};
  manifest.frames = {record};
  const std::filesystem::path path = folder.path() / "manifest.json";
  writeManifest(manifest, path);

  const Json json = Json::parse(readTextFile(path), path.string());
  EXPECT_EQ(json.at("command").asString(), "carom render resting");
  EXPECT_EQ(json.at("sceneHash").asString(), "0000000000000abc");
  EXPECT_EQ(json.at("gl").at("version").asString(), "4.5 Mesa");
  EXPECT_EQ(json.at("gl").at("context").asString(), "egl");
  EXPECT_EQ(json.at("gl").at("reason").asString(), "there is no OSMesa");
  EXPECT_FALSE(json.at("complete").asBoolean());  // one frame of two
  EXPECT_FALSE(json.at("version").asString().empty());
  EXPECT_FALSE(json.at("build").asString().empty());
  EXPECT_FALSE(json.at("cpu").asString().empty());
  const Json& frame = json.at("frames").items().at(0);
  EXPECT_EQ(frame.at("time_s").asNumber(), 1.0 / 24.0);
  EXPECT_EQ(frame.at("step").asNumber(), 10.0);
  EXPECT_EQ(frame.at("stateHash").asString(), "0000000000001234");
  EXPECT_EQ(frame.at("pixelHash").asString(), "0000000000005678");
  EXPECT_EQ(frame.at("ms").at("draw").asNumber(), 20.25);
  EXPECT_EQ(json.at("total_ms").at("encode").asNumber(), 3.125);

  manifest.frames.push_back(record);
  writeManifest(manifest, path);
  EXPECT_TRUE(Json::parse(readTextFile(path), path.string()).at("complete").asBoolean());
}

}  // namespace
}  // namespace carom::demos
