// A stack of ten cubes (experiments/standing_boxes.h) stays where it is for a minute.
//
// With the resting mode off its top drifts by 0.97 mm at 60 steps a second (GOALS: < 1 mm) and 0.02 mm at
// 240; with it on it rests after 0.25 s, 0.54 mm and 0.02 mm aside (GOALS: < 0.1 mm). Cubes that are turned
// by 0.05 on each other drift by 20 mm and 0.5 mm with the mode off.

#include <gtest/gtest.h>

#include "tests/physics/experiments/carom_simulation.h"
#include "tests/physics/experiments/standing_boxes.h"

namespace carom::physics {
namespace {

TEST(StandingStack, OfTenCubes_StandsForAMinuteWithoutTheRestingMode) {
  const Standing standing = standFor(Trial(kCarom, boxStack(10, 60.0, false)), 60.0);
  EXPECT_LT(standing.drift_m, 1e-3);
  EXPECT_LE(standing.sag_m, 0.0);
}

TEST(StandingStack, OfTenCubes_HardlyDriftsAtFinerSteps) {
  for (double side_m : {0.2, 0.5, 1.0})
    EXPECT_LT(standFor(Trial(kCarom, boxStack(10, 240.0, false, side_m)), 5.0).drift_m, 1e-4) << side_m;
}

class RestingStack : public testing::TestWithParam<std::tuple<double, double>> {};  // Hz, turn

TEST_P(RestingStack, ComesToRestAndThenDoesNotMoveByABit) {
  const auto [rate_hz, turn] = GetParam();
  Trial trial(kCarom, boxStack(10, rate_hz, true, 0.5, turn));
  trial.run(turn == 0.0 ? 1.0
                        : 3.0);  // turned ones, which shift first, after 0.5 s here and 1.1 s with mu 0.48
  std::vector<Pose> poses;
  for (int i = 1; i <= 10; ++i) {
    EXPECT_TRUE(trial.atRest(i)) << i;
    poses.push_back(trial.motion(i).X_WB);
  }
  trial.run(60.0);
  for (int i = 1; i <= 10; ++i) {
    const Pose X = trial.motion(i).X_WB, &before = poses[static_cast<std::size_t>(i - 1)];
    EXPECT_EQ(X.position, before.position) << i;
    EXPECT_EQ(X.rotation.coeffs(), before.rotation.coeffs()) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(RatesAndTurns, RestingStack,
                         testing::Combine(testing::Values(60.0, 120.0, 240.0), testing::Values(0.0, 0.05)));

}  // namespace
}  // namespace carom::physics
