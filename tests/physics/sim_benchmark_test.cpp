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

}  // namespace
}  // namespace carom::physics
