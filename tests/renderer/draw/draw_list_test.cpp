#include "renderer/draw/draw_list.h"

#include <vector>

#include <gtest/gtest.h>

#include "renderer/gl/offscreen_context.h"
#include "tests/support/pose_at.h"

namespace carom::renderer {
namespace {

const Camera kCamera{Vec3(1.0, -7.0, 3.0), Vec3(0.0, 0.0, 0.5), 40.0};
enum : int { kFloor, kBall, kBox };
const FaceLight kSunlit{kAllFaces, 0, 0}, kShadowed{0, 0, kAllFaces};

class DrawListTest : public testing::Test {
 protected:
  DrawListTest()
      : context_(createOffscreenContext(PixelPolicy::kFast)),
        geometry_(context_->gl(), std::vector<Solid>{Solid::box(Vec3(40.0, 40.0, 1.0)), Solid::ball(0.5),
                                                     Solid::box(Vec3(1.0, 1.0, 1.0))}) {}
  DrawList list(const std::vector<Instance>& instances, std::vector<FaceLight> lights = {}) const {
    lights.resize(instances.size(), FaceLight{0, 0, kAllFaces});
    return buildDrawList(instances, kCamera, Settings{}, geometry_, lights);
  }
  static int count(const std::vector<DrawGroup>& groups) {
    int sum = 0;
    for (const DrawGroup& g : groups) sum += g.count;
    return sum;
  }

  std::unique_ptr<OffscreenContext> context_;
  SceneGeometry geometry_;
};

TEST_F(DrawListTest, WhatTheCameraCannotSeeOnlyCastsShadows) {
  const DrawList drawn = list({{kBox, poseAt(0, 0, 0.5), {}},
                               {kBox, poseAt(0, -20.0, 0.5), {}},
                               {kBall, poseAt(60.0, 10.0, 0.5), {}}});
  EXPECT_EQ(count(drawn.visible), 1);
  EXPECT_EQ(count(drawn.casting), 3);
  EXPECT_EQ(drawn.records.size(), 4u);
}

TEST_F(DrawListTest, ABodyHalfOutsideTheImageIsVisible) {
  const CameraAxes axes = cameraAxes(kCamera);
  const double rim = 0.5 * 1280 / focalLengthPixels(kCamera, 720);
  const Vec3 on_rim = kCamera.eye + 5.0 * (axes.forward + rim * axes.right);
  EXPECT_EQ(count(list({{kBall, {Quat::Identity(), on_rim}, {}}}).visible), 1);
  EXPECT_EQ(count(list({{kBall, {Quat::Identity(), on_rim + 1.5 * axes.right}, {}}}).visible), 0);
}

TEST_F(DrawListTest, NearAndFarEncloseEveryVisibleBody) {
  const CameraAxes axes = cameraAxes(kCamera);
  const Vec3 near = kCamera.eye + 1.2 * axes.forward, far = kCamera.eye + 1e6 * axes.forward;
  const DrawList drawn = list({{kBall, {Quat::Identity(), near}, {}}, {kBall, {Quat::Identity(), far}, {}}});
  EXPECT_LT(drawn.depth.near_m, 0.7);
  EXPECT_GT(drawn.depth.near_m, 0.2);
  EXPECT_GT(drawn.depth.far_m, 1e6 + 0.5);
}

TEST_F(DrawListTest, TheDepthsStayTheSameWhileTheNearestBodyMovesALittle) {
  const CameraAxes axes = cameraAxes(kCamera);
  int changes = 0;
  double last = 0.0;
  for (int i = 0; i < 100; ++i) {
    const Vec3 p = kCamera.eye + (2.0 + 0.01 * i) * axes.forward;
    const double near_m = list({{kBall, {Quat::Identity(), p}, {}}}).depth.near_m;
    EXPECT_LT(near_m, 1.5 + 0.01 * i);
    if (near_m != last) ++changes;
    last = near_m;
  }
  EXPECT_LE(changes, 3);
}

TEST_F(DrawListTest, SunlitBodiesNeedNoShadowsAndCheckersTheirOwnShader) {
  const DrawList drawn = list({{kBox, poseAt(0, 0, 0.5), {}},
                               {kBox, poseAt(1.5, 0, 0.5), {}},
                               {kBox, poseAt(-1.5, 0, 0.5), {}, true},
                               {kFloor, poseAt(0, 0, -0.5), {}, true}},
                              {kSunlit, kShadowed, kSunlit, kSunlit});
  ASSERT_EQ(drawn.visible.size(), 3u);
  for (const DrawGroup& group : drawn.visible) {
    ASSERT_EQ(group.count, 1);
    const float x =
        drawn.records[static_cast<std::size_t>(group.first)].rows[0][3] + static_cast<float>(kCamera.eye.x());
    const BodyShader expected = x < -1.0f  ? BodyShader::kChecker
                                : x < 1.0f ? BodyShader::kSunlit
                                           : BodyShader::kShadowed;
    EXPECT_EQ(group.look.shader, expected) << x;
  }
}

TEST_F(DrawListTest, EachFaceIsDrawnOnceByTheShaderForItsLight) {
  const Vec3 far = 2.5 * (Vec3(0, 0, 0.5) - kCamera.eye) + kCamera.eye;  // Where faces are drawn singly.
  const DrawList drawn = list({{kBox, {Quat::Identity(), far}, {}}}, {{0b000011, 0b000100, 0b001000}});
  ASSERT_EQ(drawn.visible.size(), 2u);
  for (const DrawGroup& group : drawn.visible) {
    ASSERT_EQ(group.count, 1);
    const InstanceRecord& record = drawn.records[static_cast<std::size_t>(group.first)];
    const bool looked_up = group.look.shader == BodyShader::kShadowed;
    EXPECT_EQ(record.faces, looked_up ? 0b001000u : 0b000111u);
    EXPECT_EQ(record.sunlit, looked_up ? kAllFaces : 0b000011u);
  }
  ASSERT_EQ(count(drawn.casting), 1);
  EXPECT_EQ(drawn.records.back().faces, kAllFaces);
}

TEST_F(DrawListTest, ATinyBodyIsDrawnOnceWhateverItsShadows) {
  const Vec3 far = 30.0 * (Vec3(0, 0, 0.5) - kCamera.eye) + kCamera.eye;
  const Instance box{kBox, {Quat::Identity(), far}, {}};
  const DrawList mixed = list({box}, {{0b000011, 0, 0b001000}});
  ASSERT_EQ(count(mixed.visible), 1);
  EXPECT_EQ(mixed.visible[0].look.shader, BodyShader::kShadowed);
  EXPECT_EQ(mixed.records[0].faces, 0b001011u);  // Those that the eye sees.
  const DrawList turned = list({box}, {{0, 0b000011, 0}});
  ASSERT_EQ(count(turned.visible), 1);
  EXPECT_EQ(turned.visible[0].look.shader, BodyShader::kSunlit);
  EXPECT_EQ(turned.records[0].sunlit, 0u);
}

TEST_F(DrawListTest, ABodySeenFromNearIsDrawnAsAWhole) {
  const CameraAxes axes = cameraAxes(kCamera);
  const Pose near{Quat::Identity(), kCamera.eye + 3.0 * axes.forward};
  for (const FaceLight& light : {FaceLight{0b11, 0, 0}, FaceLight{0b01, 0, 0b10}, FaceLight{0b01, 0b10, 0}}) {
    const DrawList drawn = list({{kBox, near, {}}}, {light});
    ASSERT_EQ(drawn.visible.size(), 1u);
    ASSERT_EQ(drawn.visible[0].count, 1);
    EXPECT_EQ(drawn.records[0].faces, kAllFaces);
    EXPECT_EQ(drawn.visible[0].look.shader,
              light.sunlit == 0b11u ? BodyShader::kSunlit : BodyShader::kShadowed);
  }
}

TEST_F(DrawListTest, TheLowestLevelCheckerIsTheGround) {
  const Quat tilted(Eigen::AngleAxisd(0.2, Vec3::UnitX()));
  const std::vector<Instance> instances = {{kBox, poseAt(0, 0, 0.5), {}, true},
                                           {kFloor, {tilted, Vec3(0, 0, -9.0)}, {}, true},
                                           {kFloor, poseAt(0, 0, -0.5), {}, true},
                                           {kFloor, poseAt(0, 0, -5.0), {}, false}};
  EXPECT_EQ(findGround(instances, geometry_), 2);
  EXPECT_NEAR(list(instances).ground_z_E, -kCamera.eye.z(), 1e-12);
}

TEST_F(DrawListTest, AFloorLyingOnItsSideIsStillLevel) {
  const Quat turned(Eigen::AngleAxisd(0.5 * 3.14159265358979, Vec3::UnitX()));
  const std::vector<Instance> instances = {{kBox, {turned, Vec3(0, 0, -0.5)}, {}, true}};
  EXPECT_EQ(findGround(instances, geometry_), 0);
}

TEST_F(DrawListTest, LargerOnTheImageMeansMoreDetail) {
  int last = 0;
  for (double radius_px = 1.0; radius_px < 2000.0; radius_px *= 1.3) {
    EXPECT_GE(detailLevel(radius_px), last);
    last = detailLevel(radius_px);
  }
  EXPECT_EQ(detailLevel(1.0), 0);
  EXPECT_EQ(last, kDetailLevels - 1);
  EXPECT_LT(geometry_.solid(kBall).levels[0].count, geometry_.solid(kBall).levels[4].count);
}

}  // namespace
}  // namespace carom::renderer
