// SimBenchmark's elastic scenes: the bouncing balls in full, the cube of 216 in a shorter version (its whole
// length is run by `stress energy`, tests/bench/).

#include "tests/physics/sim_benchmark.h"

#include <gtest/gtest.h>

namespace carom::physics {
namespace {

TEST(SimBenchmark, BouncingBalls_KeepTheirEnergyForTwentySeconds) {
  ElasticBalls scene = ElasticBalls::bouncing(0.01);
  EXPECT_NEAR(scene.begin_J(), 24034.5, 1e-9);  // 49 x 10 kg x 9.81 m/s2 x 5 m
  scene.run(20.0);
  EXPECT_LE(scene.meanSquare(), 1e-6);
  EXPECT_EQ(scene.held(), 0);
  EXPECT_GT(scene.smallest_gap_m(), 0.0);
}

class ElasticCube : public testing::TestWithParam<std::tuple<double, double>> {};  // step, length; s

TEST_P(ElasticCube, KeepsItsEnergy) {
  const auto [step_s, length_s] = GetParam();
  ElasticBalls scene = ElasticBalls::cube(step_s, 1);
  scene.run(length_s);
  EXPECT_LE(scene.meanSquare(), 1e-3) << "worst " << scene.worst_J() << " J of " << scene.begin_J();
  EXPECT_EQ(scene.held(), 0);
  EXPECT_GT(scene.smallest_gap_m(), 0.0);
}

// The first blows fall 0.45 s after the start; within the second all 216 have met.
INSTANTIATE_TEST_SUITE_P(Steps, ElasticCube, testing::Values(std::tuple(0.01, 1.5), std::tuple(0.001, 1.0)));

}  // namespace
}  // namespace carom::physics
