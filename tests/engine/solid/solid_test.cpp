// Solids: the centre of mass becomes the origin, parts move together, and impossible ones are refused.

#include "engine/solid/solid.h"

#include <gtest/gtest.h>

#include <limits>

#include "engine/foundation/contract.h"
#include "tests/oracle/test_shapes.h"

namespace carom {
namespace {

TEST(Solid, OriginIsTheCentreOfMass_AndOriginBRemembersWhereItWas) {
  const Vec3 shift(3, -1, 2);
  const Solid solid({{boxPolyhedron({1, 2, 3}).translated(shift), 0.0}});
  EXPECT_LT((solid.origin_B() + shift).norm(), 1e-14);
  EXPECT_LT(polyhedronMass(solid.parts()[0].core).center.norm(), 1e-14);
  // A corner given at p lies at p + origin_B in the solid's frame.
  EXPECT_LT((solid.parts()[0].core.vertex(7) - (shift + Vec3(0.5, 1, 1.5) + solid.origin_B())).norm(), 1e-14);
}

TEST(Solid, Box_HasTheClosedFormInertiaAndRadius) {
  const Solid box = Solid::box({1, 2, 3});
  EXPECT_NEAR(box.volume(), 6.0, 1e-14);
  EXPECT_LT((box.unitInertia() - Mat3(Vec3(6.5, 5.0, 2.5).asDiagonal())).norm(), 1e-13);
  EXPECT_NEAR(box.radius(), std::sqrt(14.0) / 2, 1e-15);
}

TEST(Solid, RoundedBox_KeepsItsOuterSize) {
  const Solid box = Solid::roundedBox({1, 2, 3}, 0.2);
  const ConvexPart& part = box.parts()[0];
  EXPECT_NEAR(part.width(), 1.0, 1e-15);
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 along = Vec3::Unit(axis);
    EXPECT_NEAR(part.core.vertex(part.core.support(along)).dot(along) + part.radius_m, 0.5 * (1 + axis),
                1e-14);
  }
  EXPECT_NEAR(box.radius(), Vec3(0.3, 0.8, 1.3).norm() + 0.2, 1e-15);
  EXPECT_LT(box.volume(), 6.0);
}

TEST(Solid, RoundedBox_EndsInBoxCapsuleAndBall) {
  EXPECT_NEAR(Solid::roundedBox({1, 2, 3}, 0.0).volume(), 6.0, 1e-14);
  const Solid capsule = Solid::roundedBox({0.5, 0.5, 2}, 0.25), pill = Solid::capsule(0.25, 1.5);
  EXPECT_NEAR(capsule.volume(), pill.volume(), 1e-15);
  EXPECT_LT((capsule.unitInertia() - pill.unitInertia()).norm(), 1e-15);
  EXPECT_EQ(Solid::roundedBox({1, 1, 1}, 0.5).volume(), Solid::ball(0.5).volume());
}

TEST(Solid, BallAndCapsule_HaveRadiusBeyondTheirCores) {
  EXPECT_EQ(Solid::ball(0.3).radius(), 0.3);
  EXPECT_NEAR(Solid::capsule(0.3, 2.0).radius(), 1.3, 1e-15);
  EXPECT_NEAR(Solid::ball(0.3).parts()[0].width(), 0.6, 1e-15);
}

// Two boxes 1x1x1 at x = 0 and 1x1x2 at x = 2: a dumb-bell worked by hand.
TEST(Solid, Compound_CombinesPartsAboutTheirCommonCentre) {
  const Solid solid({{boxPolyhedron({1, 1, 1}), 0.0}, {boxPolyhedron({1, 1, 2}).translated({2, 0, 0}), 0.0}});
  EXPECT_NEAR(solid.volume(), 3.0, 1e-14);
  EXPECT_LT((solid.origin_B() - Vec3(-4.0 / 3, 0, 0)).norm(), 1e-14);
  const double I_x = 1.0 / 6 + 2 * 5.0 / 12;
  const double I_y = 1.0 / 6 + 16.0 / 9 + 2 * (5.0 / 12 + 4.0 / 9);
  const double I_z = 1.0 / 6 + 16.0 / 9 + 2 * (2.0 / 12 + 4.0 / 9);
  EXPECT_LT((solid.unitInertia() - Mat3(Vec3(I_x, I_y, I_z).asDiagonal())).norm(), 1e-13);
  EXPECT_NEAR(solid.radius(), Vec3(11.0 / 6, 0.5, 0.5).norm(), 1e-14);
}

TEST(Solid, Compound_MayMixPolyhedraBallsAndCapsules) {
  const Solid solid({{boxPolyhedron({1, 1, 1}), 0.0},
                     {ConvexPolyhedron::point({0, 0, 2}), 0.5},
                     {ConvexPolyhedron::segment({0, 0, -3}, {0, 0, -2}), 0.25}});
  const double ball = std::numbers::pi / 6, capsule = std::numbers::pi * (0.0625 + 0.0625 / 3);
  EXPECT_NEAR(solid.volume(), 1 + ball + capsule, 1e-14);
  EXPECT_NEAR(solid.origin_B().z(), -(2 * ball - 2.5 * capsule) / (1 + ball + capsule), 1e-14);
}

TEST(Solid, RefusesWhatHasNoVolume) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(Solid({}), InputError);
  EXPECT_THROW(Solid::ball(0.0), InputError);
  EXPECT_THROW(Solid::ball(-1.0), InputError);
  EXPECT_THROW(Solid::ball(nan), InputError);
  EXPECT_THROW(Solid::capsule(0.5, 0.0), InputError);
  EXPECT_THROW(Solid::capsule(0.0, 1.0), InputError);
  EXPECT_THROW(Solid::box({1, 0, 1}), InputError);
  EXPECT_THROW(Solid::box({1, -1, 1}), InputError);
  EXPECT_THROW(Solid::box({1, nan, 1}), InputError);
  EXPECT_THROW(Solid({{boxPolyhedron({1, 1, 1}), -0.1}}), InputError);
  EXPECT_THROW(Solid({{boxPolyhedron({1, 1, 1}), nan}}), InputError);
  EXPECT_THROW(Solid::roundedBox({1, 1, 1}, -0.1), InputError);
  EXPECT_THROW(Solid::roundedBox({1, 1, 1}, nan), InputError);
  EXPECT_THROW(Solid::roundedBox({1, 1, 1}, 0.6), InputError);
  EXPECT_THROW(Solid::roundedBox({1, 2, 3}, 0.5), InputError) << "a flat core";
  EXPECT_THROW(Solid::roundedBox({0, 0, 0}, 0.0), InputError);
}

TEST(Solid, RefusesAnInfiniteVolume) {
  EXPECT_THROW(Solid::ball(std::numeric_limits<double>::infinity()), InputError);
  EXPECT_THROW(Solid::box({1e200, 1e200, 1e200}), InputError);
}

}  // namespace
}  // namespace carom
