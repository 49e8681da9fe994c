// How far points of two bodies come nearer to each other, against where they are along their paths.

#include "engine/contact/relative_motion.h"

#include <gtest/gtest.h>

#include "tests/oracle/test_shapes.h"

namespace carom {
namespace {

using oracle::Random;

Trajectory anyPath(Random& random, const Pose& X_WB) {
  Trajectory path{0.0, X_WB, random.logUniform(1e-3, 30.0) * random.direction()};
  path.acceleration = random.logUniform(1e-2, 30.0) * random.direction();
  path.spin = random.logUniform(1e-3, 50.0) * random.direction();
  return path;
}

TEST(RelativeMotion, HoldsHowFarPointsOfTwoBodiesComeNearer) {
  Random random(49);
  for (int c = 0; c < 2000; ++c) {
    const double way = random.logUniform(1e-4, 0.1), reach_a = 0.7, reach_b = 0.4;
    const Trajectory before_a = anyPath(random, random.pose(3.0)),
                     before_b = anyPath(random, random.pose(3.0));
    const RelativePose then = relativePose(PathBound(before_a, 0.0, way), PathBound(before_b, 0.0, way));
    const Trajectory path_a = anyPath(random, before_a.at(way)), path_b = anyPath(random, before_b.at(way));
    const double begin = random.uniform(0.0, 0.5) * way, end = random.uniform(0.5, 1.0) * way;
    const RelativeMotion motion =
        motionSince(then, PathBound(path_a, begin, end), reach_a, PathBound(path_b, begin, end), reach_b);
    const Vec3 p_A = reach_a * random.direction(), p_B = reach_b * random.direction();
    const double distance = (before_b.X_WB * p_B - before_a.X_WB * p_A).norm();
    for (int k = 0; k <= 20; ++k) {
      const double t = begin + (end - begin) * k / 20;
      const Vec3 gone = path_b.positionAt(t) - path_a.positionAt(t) - then.offset_m;
      ASSERT_GE((gone - motion.way_m.low).minCoeff(), -1e-12) << c;
      ASSERT_GE((motion.way_m.high - gone).minCoeff(), -1e-12) << c;
      ASSERT_LE(distance - (path_b.at(t) * p_B - path_a.at(t) * p_A).norm(), motion.most() + 1e-12) << c;
    }
  }
}

TEST(RelativeMotion, OfWhatFallsSideBySide_IsNone) {
  Trajectory a{0.0, {Quat::Identity(), Vec3(1, 2, 3)}, Vec3(0, 0, -50)}, b = a;
  a.acceleration = b.acceleration = Vec3(0, 0, -10);
  b.X_WB.position.x() = 2.0;
  const PathBound path_a(a, 0.0, 0.1), path_b(b, 0.0, 0.1);
  EXPECT_EQ(motionSince(relativePose(path_a, path_b), path_a, 1.0, path_b, 1.0).most(), 0.0);
}

TEST(RelativeMotion, GoesBeyondAnotherByWhatThatDoesNotReach) {
  const RelativeMotion known{{Vec3(-1, 0, 0), Vec3(2, 1, 0)}, 0.5};
  EXPECT_EQ(known.beyond(known), 0.0);
  EXPECT_EQ((RelativeMotion{{Vec3(0, 0, 0), Vec3(1, 1, 0)}, 0.1}.beyond(known)), 0.0);
  EXPECT_NEAR((RelativeMotion{{Vec3(-4, 0, 0), Vec3(2, 5, 0)}, 0.75}.beyond(known)), 5.25, 1e-15);
}

}  // namespace
}  // namespace carom
