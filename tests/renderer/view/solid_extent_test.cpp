#include "renderer/view/solid_extent.h"

#include <cmath>

#include <gtest/gtest.h>

#include "engine/solid/convex_hull.h"

namespace carom::renderer {
namespace {

TEST(RoundedBox, IsExactForABox) {
  const RoundedBox box = roundedBox(Solid::box(Vec3(1.0, 2.0, 0.6)).parts()[0]);
  EXPECT_LT((box.half - Vec3(0.5, 1.0, 0.3)).norm(), 1e-9);
  EXPECT_NEAR(box.radius, 0.0, 1e-9);
}

TEST(RoundedBox, IsExactForABall) {
  const RoundedBox box = roundedBox(Solid::ball(0.4).parts()[0]);
  EXPECT_DOUBLE_EQ(box.half.norm(), 0.0);
  EXPECT_DOUBLE_EQ(box.radius, 0.4);
}

TEST(RoundedBox, IsExactForACapsuleInAnyDirection) {
  const Vec3 a(0.1, -0.2, 0.3), b(0.7, 0.5, -0.4);
  const RoundedBox box = roundedBox({ConvexPolyhedron::segment(a, b), 0.2});
  const Vec3 end = box.X_BR * Vec3(0.0, 0.0, box.half.z());
  EXPECT_LT(std::min((end - a).norm(), (end - b).norm()), 1e-12);
  EXPECT_NEAR(2.0 * box.half.z(), (b - a).norm(), 1e-12);
  EXPECT_DOUBLE_EQ(box.radius, 0.2);
}

TEST(RoundedBox, OfATetrahedronHasItsVolumeAndCentre) {
  const std::vector<Vec3> points = {Vec3(1, 1, 1), Vec3(-1, -1, 1), Vec3(-1, 1, -1), Vec3(1, -1, -1)};
  const Solid solid = Solid::polyhedron(convexHull(points).polyhedron);
  const RoundedBox box = roundedBox(solid.parts()[0]);
  // Its vertices are corners of the box around it, so nothing is rounded: a cube with the tetrahedron's 8/3
  // m^3.
  EXPECT_NEAR(box.radius, 0.0, 1e-9);
  EXPECT_LT((box.half - Vec3::Constant(0.5 * std::cbrt(8.0 / 3.0))).norm(), 1e-9);
  EXPECT_LT(box.X_BR.position.norm(), 1e-9);
}

TEST(RoundedBox, OfADrumIsNoLargerThanTheDrum) {
  std::vector<Vec3> points;
  for (int i = 0; i < 12; ++i)
    for (double z : {-0.9, 0.9}) points.push_back(Vec3(std::cos(i * 0.5236), std::sin(i * 0.5236), z));
  const Solid drum = Solid::polyhedron(convexHull(points).polyhedron);
  const RoundedBox box = roundedBox(drum.parts()[0]);
  EXPECT_GT(box.radius, 0.1);
  const Vec3 reach = (box.half.array() + box.radius).matrix();
  EXPECT_LT(reach.x(), 1.0);
  EXPECT_LT(reach.z(), 0.9);
  EXPECT_GT(reach.z(), 0.8);
}

TEST(SolidExtent, EnclosesAllPartsTightly) {
  const Solid solid(
      {{ConvexPolyhedron::point(Vec3(0, 0, 0)), 0.5}, {ConvexPolyhedron::point(Vec3(2, 0, 0)), 0.25}});
  const Extent extent = solidExtent(solid);
  EXPECT_LT((extent.half - Vec3(1.375, 0.5, 0.5)).norm(), 1e-12);
  EXPECT_LT((extent.center - solid.origin_B() - Vec3(0.875, 0, 0)).norm(), 1e-9);
}

TEST(WhatIsDrawnOfASolid, IsRoundOnlyWhereItsPartsAreSeen) {
  const Solid ball = Solid::ball(0.4);
  EXPECT_TRUE(isBall(ball));
  EXPECT_TRUE(hasRoundPart(ball));
  EXPECT_FALSE(isBall(Solid::capsule(0.4, 1.0)));
  EXPECT_TRUE(hasRoundPart(Solid::capsule(0.4, 1.0)));
  BoundingSurface leaf;
  leaf.mesh.vertices = {Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(0, 2, 0)};
  leaf.mesh.triangles = {{0, 1, 2}};
  const Solid shown = ball.shownAs(leaf);
  EXPECT_FALSE(isBall(shown));
  EXPECT_FALSE(hasRoundPart(shown));
}

}  // namespace
}  // namespace carom::renderer
