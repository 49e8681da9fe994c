#include "demos/frames/frame_outputs.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "demos/system/exit_code.h"
#include "tests/support/thrown_message.h"

namespace carom::demos {
namespace {

using renderer::SurfaceImage;

SurfaceImage twoPixels(float depth_m) {
  SurfaceImage image;
  image.depth = {2, 1, {depth_m, std::numeric_limits<float>::infinity()}};
  image.normal_W = {{0.6f, -0.8f, 0.0f}, {0.0f, 0.0f, 0.0f}};
  image.instance = {41, renderer::kSky};
  return image;
}

TEST(FrameOutputs, DepthIsInUnitsAndTheSkyApart) {
  const OutputScale scale{65.534};  // a millimetre a unit
  EXPECT_DOUBLE_EQ(scale.metresPerUnit(), 0.001);
  const auto sample = [&](float depth_m) {
    return outputRaster(FrameOutput::kDepth, twoPixels(depth_m), scale).samples.at(0);
  };
  EXPECT_EQ(sample(0.0f), 0);
  EXPECT_EQ(sample(1.0f), 1000);
  EXPECT_EQ(sample(1.2344f), 1234);
  EXPECT_EQ(sample(1.2346f), 1235);
  EXPECT_EQ(sample(65.5f), 65500);
  EXPECT_EQ(sample(1e6f), 65534);
  const renderer::Raster raster = outputRaster(FrameOutput::kDepth, twoPixels(1.0f), scale);
  EXPECT_EQ(raster.samples.at(1), 65535);
  EXPECT_EQ(raster.channels, 1);
  EXPECT_EQ(raster.bits, 16);
}

TEST(FrameOutputs, NormalsAndIdsDecodeToWhatTheyWere) {
  const renderer::Raster normals = outputRaster(FrameOutput::kNormal, twoPixels(1.0f), {1.0});
  ASSERT_EQ(normals.channels, 3);
  const double expected[] = {0.6, -0.8, 0.0};
  for (int i = 0; i < 3; ++i)
    EXPECT_NEAR((normals.pixel(0, 0)[i] - 32768) / 32767.0, expected[i], 0.5 / 32767);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(normals.pixel(1, 0)[i], 0);
  const renderer::Raster ids = outputRaster(FrameOutput::kId, twoPixels(1.0f), {1.0});
  EXPECT_EQ(ids.samples, (std::vector<std::uint16_t>{42, 0}));
}

TEST(FrameOutputs, TheRangeHoldsTwiceTheFarthestBodyButNotTheGround) {
  const std::vector<Solid> solids = {Solid::box(Vec3(1000, 1000, 1)), Solid::ball(0.5)};
  const renderer::Camera camera{Vec3(0, -10, 0), Vec3(0, 0, 0), 40.0};
  const std::vector<renderer::Instance> start = {{0, {}, {}, true},
                                                 {1, {Quat::Identity(), Vec3(3, 12, 1)}, {}, false}};
  EXPECT_DOUBLE_EQ(outputScale(start, solids, camera).depth_range_m, 50.0);  // 2 x 22.5 m
  EXPECT_DOUBLE_EQ(outputScale(std::span(start).first(1), solids, camera).depth_range_m, 20.0);
}

TEST(FrameOutputs, TheRangeHoldsWhatIsDrawnInPlaceOfABody) {
  BoundingSurface leaf;
  leaf.mesh.vertices = {Vec3(0, 0, 0), Vec3(0, 30, 0), Vec3(1, 0, 0)};
  leaf.mesh.triangles = {{0, 1, 2}};
  const std::vector<Solid> solids = {Solid::ball(0.5).shownAs(leaf)};
  const renderer::Camera camera{Vec3(0, -10, 0), Vec3(0, 0, 0), 40.0};
  const std::vector<renderer::Instance> start = {{0, {Quat::Identity(), Vec3(3, 12, 1)}, {}, false}};
  EXPECT_DOUBLE_EQ(outputScale(start, solids, camera).depth_range_m, 200.0);  // 2 x 52 m
}

TEST(FrameOutputs, ListsAreReadOnceEachAndMisspellingsRefused) {
  EXPECT_TRUE(readOutputs("").empty());
  EXPECT_EQ(readOutputs("id,depth,id"), (std::vector{FrameOutput::kDepth, FrameOutput::kId}));
  EXPECT_EQ(readOutputs("normal"), std::vector{FrameOutput::kNormal});
  const std::string message = thrownMessage<UsageError>([] { readOutputs("depht"); });
  EXPECT_NE(message.find("did you mean \"depth\"?"), std::string::npos) << message;
}

TEST(FrameOutputs, TheTextSaysWhatTheNumbersMean) {
  const auto text = outputText(FrameOutput::kDepth, {{"Frame", "7"}}, {65.534});
  EXPECT_EQ(text[0], (std::pair<std::string, std::string>("Frame", "7")));
  EXPECT_EQ(text[1].second, "depth");
  EXPECT_DOUBLE_EQ(std::stod(text[2].second), 0.001);
  EXPECT_EQ(text[3].second, "65535");
}

}  // namespace
}  // namespace carom::demos
