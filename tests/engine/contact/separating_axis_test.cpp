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

// About its middle, or about any other point in it.
CoreBall ballOf(Random& random, const ConvexPolyhedron& core) {
  Vec3 middle_B = core.center();
  if (random.integer(0, 1) == 1) middle_B += 0.3 * (core.vertex(random.integer(0, 7)) - middle_B);
  return {middle_B, middle_B.norm(), core.radiusAbout(middle_B)};
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
    const CoreBall ball_a = ballOf(random, a.core), ball_b = ballOf(random, b.core);
    const SeparatingAxis axis = separatingAxis(closest.n_W, closest.distance_m, X_WA, ball_a, X_WB, ball_b);
    const double way = random.logUniform(1e-4, 0.1);
    const Trajectory path_a = anyPath(random, anyPath(random, X_WA, 0.0).at(way), 0.0);
    const Trajectory path_b = anyPath(random, anyPath(random, X_WB, 0.0).at(way), 0.1 * way);
    const double begin = random.uniform(0.1, 0.5) * way, end = random.uniform(0.5, 1.0) * way;
    const auto gapAt = [&](double t) {
      return closestFeatures(a, path_a.at(t), b, path_b.at(t), tracked).distance_m;
    };
    const GapBound bound =
        boundGap(axis, PathBound(path_a, begin, end), ball_a, PathBound(path_b, begin, end), ball_b);
    const double least = bound.within_m;
    if (least > 0.0) ++proven;
    ASSERT_LE(bound.at_begin_m, gapAt(begin) + 1e-12) << c;
    ASSERT_LE(least, bound.at_begin_m) << c;
    double smallest = std::numeric_limits<double>::infinity();
    for (int k = 0; k <= 50; ++k) smallest = std::min(smallest, gapAt(begin + (end - begin) * k / 50));
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
  const CoreBall ball{Vec3::Zero(), 0.0, reach};
  const SeparatingAxis axis = separatingAxis(Vec3::UnitX(), 0.3, X_WA, ball, X_WB, ball);
  const auto leastOn = [&](const Vec3& velocity, const Vec3& acceleration, const Vec3& spin) {
    Trajectory moving{0.0, X_WB, velocity};
    moving.acceleration = acceleration;
    moving.spin = spin;
    const Trajectory still{0.0, X_WA};
    return boundGap(axis, PathBound(still, 0.0, 0.1), ball, PathBound(moving, 0.0, 0.1), ball).within_m;
  };
  const Vec3 none = Vec3::Zero();
  EXPECT_NEAR(leastOn(Vec3(0, 5, 2), none, none), 0.3, 1e-15);
  EXPECT_NEAR(leastOn(Vec3(-1, 5, 2), none, none), 0.2, 1e-15);
  EXPECT_NEAR(leastOn(Vec3(1, 0, 0), none, none), 0.3, 1e-15) << "at the beginning it is no farther";
  EXPECT_NEAR(leastOn(none, Vec3(-10, 0, 0), none), 0.25, 1e-15);
  EXPECT_NEAR(leastOn(none, none, Vec3(0, 0, 1)), 0.3 - 0.1 * reach, 1e-15);
  EXPECT_NEAR(leastOn(none, none, Vec3(0, 0, 1e3)), 0.3 - 2.0 * reach, 1e-15) << "no farther than across";
}

// A small part 1 m from its body's centre of mass, as this turns by 0.1: it goes as that takes it.
TEST(SeparatingAxis, OfAPartFarFromItsCentre_LosesWhereItIsTaken) {
  const Pose X_WA{Quat::Identity(), Vec3::Zero()}, X_WB{Quat::Identity(), Vec3(0.0, -1.0, 0.0)};
  const CoreBall still{Vec3::Zero(), 0.0, 0.1}, far{Vec3::UnitY(), 1.0, 0.02};
  const auto leastAlong = [&](const Vec3& n_W) {
    const SeparatingAxis axis = separatingAxis(n_W, 0.2, X_WA, still, X_WB, far);
    Trajectory turning{0.0, X_WB};
    turning.spin = Vec3(0, 0, 1);  // to -x
    return boundGap(axis, PathBound(Trajectory{0.0, X_WA}, 0.0, 0.1), still, PathBound(turning, 0.0, 0.1),
                    far)
        .within_m;
  };
  const double around = 0.1 * 0.02 + 0.5 * 0.1 * 0.1;
  EXPECT_NEAR(leastAlong(Vec3::UnitX()), 0.2 - 0.1 - around, 1e-15);
  EXPECT_NEAR(leastAlong(-Vec3::UnitX()), 0.2 - around, 1e-15);
  EXPECT_NEAR(leastAlong(Vec3::UnitZ()), 0.2 - around, 1e-15);
}

}  // namespace
}  // namespace carom
