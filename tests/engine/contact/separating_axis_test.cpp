// Bounds of gaps on paths, against gaps that are queried along them.

#include "engine/contact/separating_axis.h"

#include <gtest/gtest.h>

#include <limits>

#include "engine/closest_features/vclip.h"
#include "engine/solid/solid.h"
#include "tests/oracle/test_shapes.h"

namespace carom {
namespace {

using oracle::Random;

Trajectory anyPath(Random& random, const Pose& X_WB, double start_s) {
  Trajectory path{start_s, X_WB, random.logUniform(1e-3, 30.0) * random.direction()};
  path.acceleration = random.logUniform(1e-2, 30.0) * random.direction();
  path.spin = random.logUniform(1e-3, 50.0) * random.direction();
  return path;
}

// The parts first go on from where the axis was found, as far as many steps take them; then paths begin.
TEST(SeparatingAxis, IsNeverPassedByWhatMovesAndTurns) {
  Random random(47);
  const Solid block = Solid::box({0.5, 0.2, 0.7}), beam = Solid::box({2.0, 0.1, 0.2});
  const ConvexPart &a = block.parts()[0], &b = beam.parts()[0];
  int proven = 0;
  for (int c = 0; c < 3000; ++c) {
    const Pose X_WA = random.pose(3.0), X_WB = random.pose(3.0);
    FeaturePair tracked;
    const ClosestFeatures closest = closestFeatures(a, X_WA, b, X_WB, tracked);
    if (!(closest.distance_m > 0.0)) continue;
    const SeparatingAxis axis = separatingAxis(closest.n_W, closest.distance_m, X_WA, X_WB);
    const double way = random.logUniform(1e-4, 0.1);
    const Trajectory path_a = anyPath(random, anyPath(random, X_WA, 0.0).at(way), 0.0);
    const Trajectory path_b = anyPath(random, anyPath(random, X_WB, 0.0).at(way), 0.1 * way);
    const double begin = random.uniform(0.1, 0.5) * way, end = random.uniform(0.5, 1.0) * way;
    const double least = leastGap(axis, PathBound(path_a, begin, end), block.radius(),
                                  PathBound(path_b, begin, end), beam.radius());
    if (least > 0.0) ++proven;
    double smallest = std::numeric_limits<double>::infinity();
    for (int k = 0; k <= 50; ++k) {
      const double t = begin + (end - begin) * k / 50;
      smallest = std::min(smallest, closestFeatures(a, path_a.at(t), b, path_b.at(t), tracked).distance_m);
    }
    if (least > 0.0) {
      ASSERT_LE(least, smallest + 1e-12) << c;
    }
  }
  EXPECT_GT(proven, 500);
}

// Cubes face to face, 0.3 m apart: what slides past keeps its gap, what comes nearer loses its way, and what
// turns back and forth has its corners farther out.
TEST(SeparatingAxis, OfCubesFaceToFace_LosesTheirApproachAndNotTheirSliding) {
  const Pose X_WA{Quat::Identity(), Vec3::Zero()}, X_WB{Quat::Identity(), Vec3(1.3, 0.0, 0.0)};
  const double reach = 0.5 * std::sqrt(3.0);
  const SeparatingAxis axis = separatingAxis(Vec3::UnitX(), 0.3, X_WA, X_WB);
  const auto leastOn = [&](const Vec3& velocity, const Vec3& acceleration, const Vec3& spin) {
    Trajectory moving{0.0, X_WB, velocity};
    moving.acceleration = acceleration;
    moving.spin = spin;
    const Trajectory still{0.0, X_WA};
    return leastGap(axis, PathBound(still, 0.0, 0.1), reach, PathBound(moving, 0.0, 0.1), reach);
  };
  const Vec3 none = Vec3::Zero();
  EXPECT_NEAR(leastOn(Vec3(0, 5, 2), none, none), 0.3, 1e-15);
  EXPECT_NEAR(leastOn(Vec3(-1, 5, 2), none, none), 0.2, 1e-15);
  EXPECT_NEAR(leastOn(Vec3(1, 0, 0), none, none), 0.3, 1e-15) << "at the beginning it is no farther";
  EXPECT_NEAR(leastOn(none, Vec3(-10, 0, 0), none), 0.25, 1e-15);
  EXPECT_NEAR(leastOn(none, none, Vec3(0, 0, 1)), 0.3 - 0.1 * reach, 1e-15);
  EXPECT_NEAR(leastOn(none, none, Vec3(0, 0, 1e3)), 0.3 - 2.0 * reach, 1e-15) << "no farther than across";
}

}  // namespace
}  // namespace carom
