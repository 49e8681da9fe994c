#include "renderer/mesh/contact_occlusion.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/pose_at.h"

namespace carom::renderer {
namespace {

constexpr double kFocal = 1000.0;
const Vec3 kEye(0.0, -6.0, 4.0);

// Bodies of a scene with what they refer to.
struct Stage {
  std::vector<Solid> solids;
  std::vector<std::vector<RoundedBox>> boxes;
  std::vector<Pose> poses;
  std::vector<bool> endless;

  void add(const Solid& solid, const Pose& X_WB, bool endless_ground = false) {
    solids.push_back(solid);
    boxes.push_back({});
    boxes.back() = occludingBoxes(solid);
    poses.push_back({X_WB.rotation, X_WB.position - kEye});
    endless.push_back(endless_ground);
  }
  std::vector<OcclusionVertex> occlusion() const {
    std::vector<OcclusionBody> bodies;
    for (std::size_t i = 0; i < solids.size(); ++i)
      bodies.push_back({&solids[i], boxes[i], poses[i], solids[i].radius(), endless[i]});
    std::vector<OcclusionVertex> vertices;
    for (const OcclusionTriangle& triangle : contactOcclusion(bodies, kFocal))
      vertices.insert(vertices.end(), triangle.begin(), triangle.end());
    return vertices;
  }
};

double worldZ(const OcclusionVertex& v) {
  return v.p_E[2] + kEye.z();
}

TEST(ContactOcclusion, ABallOnTheGroundDarkensTheGroundUnderIt) {
  Stage stage;
  stage.add(Solid::box(Vec3(2.0, 2.0, 1.0)), poseAt(0, 0, -0.5), true);
  stage.add(Solid::ball(0.5), poseAt(3.0, 1.0, 0.5));  // Beyond the box: the ground is endless.
  const std::vector<OcclusionVertex> triangles = stage.occlusion();
  ASSERT_EQ(triangles.size(), 6u);
  for (const OcclusionVertex& v : triangles) {
    EXPECT_NEAR(worldZ(v), 0.0, 1e-6);
    EXPECT_LT(std::abs(v.p_E[0] + kEye.x() - 3.0), 0.5 + v.reach + 1e-6);
    EXPECT_NEAR(v.radius, 0.5, 1e-6);
    EXPECT_NEAR(v.p_R[2], -0.5, 1e-6);
  }
}

TEST(ContactOcclusion, PolygonsEndWhereTheFaceEnds) {
  Stage stage;
  stage.add(Solid::box(Vec3(2.0, 2.0, 1.0)), poseAt(0, 0, -0.5));
  stage.add(Solid::ball(0.5), poseAt(0.9, 0.2, 0.501));
  double highest = -1e9;
  for (const OcclusionVertex& v : stage.occlusion()) highest = std::max(highest, v.p_E[0] + kEye.x());
  EXPECT_NEAR(highest, 1.0, 1e-6);
}

TEST(ContactOcclusion, WhatCannotBeDarkenedIsNotDrawn) {
  Stage stage;
  const Quat turned(Eigen::AngleAxisd(0.6, Vec3(1.0, 0.5, 2.0).normalized()));
  stage.add(Solid::box(Vec3(9.0, 9.0, 1.0)), poseAt(0, 0, -0.5), true);
  stage.add(Solid::box(Vec3(0.8, 0.3, 0.2)), {turned, Vec3(0.3, 0.2, 0.4)});
  stage.add(Solid::box(Vec3(0.7, 0.6, 0.9)), poseAt(-0.4, -0.1, 0.451));
  const std::vector<OcclusionVertex> triangles = stage.occlusion();
  ASSERT_GT(triangles.size(), 12u);
  for (const OcclusionVertex& v : triangles)
    for (int i = 0; i < 3; ++i) EXPECT_LE(std::abs(v.p_R[i]), v.half[i] + v.radius + 0.861f * v.reach);
}

TEST(ContactOcclusion, StackedBoxesDarkenEachOther) {
  Stage stage;
  stage.add(Solid::box(Vec3(1.0, 1.0, 1.0)), poseAt(0, 0, 0.5));
  stage.add(Solid::box(Vec3(0.4, 0.4, 0.4)), poseAt(0.1, 0.0, 1.201));
  const std::vector<OcclusionVertex> triangles = stage.occlusion();
  ASSERT_FALSE(triangles.empty());
  for (const OcclusionVertex& v : triangles)
    EXPECT_NEAR(worldZ(v), 1.0, 1e-6);  // The upper one's lower face is hidden.
}

TEST(ContactOcclusion, DistantAndHiddenNeighboursChangeNothing) {
  Stage apart;
  apart.add(Solid::box(Vec3(1.0, 1.0, 1.0)), poseAt(0, 0, 0.5));
  apart.add(Solid::box(Vec3(1.0, 1.0, 1.0)), poseAt(4.0, 0, 0.5));
  EXPECT_TRUE(apart.occlusion().empty());
  Stage high;
  high.add(Solid::box(Vec3(20.0, 20.0, 1.0)), poseAt(0, 0, -0.5), true);
  high.add(Solid::ball(0.5), poseAt(0, 0, 5.0));
  EXPECT_TRUE(high.occlusion().empty());
}

TEST(ContactOcclusion, BetweenBodiesThatDoNotTouchItFadesAwayWithDistance) {
  float last = 1.0f;
  bool seen_faded = false;
  for (double away = 10.0; away < 500.0; away *= 1.2) {
    Stage stage;
    stage.add(Solid::box(Vec3(1.0, 1.0, 1.0)), poseAt(0, away, 0.5));
    stage.add(Solid::box(Vec3(1.0, 1.0, 1.0)), poseAt(0, away, 1.6));
    float strength = 0.0f;
    for (const OcclusionVertex& v : stage.occlusion()) strength = std::max(strength, v.strength);
    Stage touching;
    touching.add(Solid::box(Vec3(1.0, 1.0, 1.0)), poseAt(0, away, 0.5));
    touching.add(Solid::box(Vec3(1.0, 1.0, 1.0)), poseAt(0, away, 1.501));
    for (const OcclusionVertex& v : touching.occlusion()) EXPECT_GT(v.strength, 0.6f);
    EXPECT_EQ(touching.occlusion().empty(), away > 430.0);  // A reach of 1.5 pixels.
    EXPECT_LE(strength, last) << away;
    seen_faded = seen_faded || (strength > 0.0f && strength < 0.5f);
    last = strength;
    Stage on_ground;
    on_ground.add(Solid::box(Vec3(2.0, 2.0, 1.0)), poseAt(0, 0, -0.5), true);
    on_ground.add(Solid::ball(0.5), poseAt(0.0, away, 0.5));
    EXPECT_FALSE(on_ground.occlusion().empty());
    for (const OcclusionVertex& v : on_ground.occlusion()) EXPECT_GT(v.strength, 0.6f);
  }
  EXPECT_EQ(last, 0.0f);
  EXPECT_TRUE(seen_faded);
}

TEST(ContactOcclusion, NeitherTheOrderOfBodiesNorTheirSideMatters) {
  const auto count = [](double side, bool box_first) {
    Stage stage;
    if (box_first) stage.add(Solid::box(Vec3(1.0, 1.0, 1.0)), poseAt(0, 0, 0.5));
    stage.add(Solid::ball(0.8), poseAt(0.3 * side, 0.1, 1.81));
    if (!box_first) stage.add(Solid::box(Vec3(1.0, 1.0, 1.0)), poseAt(0, 0, 0.5));
    stage.add(Solid::ball(0.3), poseAt(5.0 * side, 0.0, 0.3));
    return stage.occlusion().size();
  };
  const std::size_t expected = count(1.0, true);
  EXPECT_GT(expected, 0u);
  EXPECT_EQ(count(1.0, false), expected);
  EXPECT_EQ(count(-1.0, true), expected);
  EXPECT_EQ(count(-1.0, false), expected);
}

}  // namespace
}  // namespace carom::renderer
