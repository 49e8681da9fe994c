// What is said of two discs, against their supports in many directions of a cone. Seed 7610.

#include "engine/closest_features/two_discs.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/oracle/test_shapes.h"

namespace carom {
namespace {

struct Disc {
  Vec3 center;
  Vec3 normal;
  double radius_m;
  double support(const Vec3& n) const { return n.dot(center) + radius_m * n.cross(normal).norm(); }
};

// By how much the farther of the two supports exceeds the depth, at least, over directions within t0. The
// first normal is z, outwards across the side is x.
double leastExcess(const TwoDiscs& discs, double lean, double t0) {
  const Vec3 normal_across(std::sin(lean), 0.0, std::cos(lean));
  const Vec3 into_across(std::cos(lean), 0.0, -std::sin(lean));
  const Vec3 touched(discs.near_m, 0.0, discs.depth_m);
  const Disc first{touched - discs.radius_m * Vec3::UnitX(), Vec3::UnitZ(), discs.radius_m};
  const Disc second{touched + discs.across_m * into_across, normal_across, discs.across_m};
  constexpr int kAngles = 48;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= kAngles; ++i)
    for (int k = 0; k <= kAngles; ++k) {
      const double t = t0 * i / kAngles, p = std::numbers::pi * k / kAngles;
      const Vec3 n(std::sin(t) * std::cos(p), std::sin(t) * std::sin(p), std::cos(t));
      least = std::min(least, std::max(first.support(n), second.support(n)) - discs.depth_m);
    }
  return least;
}

TEST(TwoDiscs, ReachWithinTheAngleThatTheyAreSaidToReachIn) {
  oracle::Random random(7610);
  int reach = 0, said = 0;
  for (int i = 0; i < 20000; ++i) {
    TwoDiscs discs;
    discs.depth_m = random.logUniform(0.01, 1.0);
    discs.radius_m = random.logUniform(0.01, 1.0);
    discs.across_m = random.logUniform(0.01, 1.0);
    discs.near_m = random.logUniform(1e-3, 1.0) * discs.radius_m;
    // Up to where the second facet's plane would be nearer, and on to directions that one disc cannot reach.
    const double lean =
        std::min(1.2, std::atan(2.0 * discs.near_m / discs.depth_m) * random.uniform(0.5, 1.1));
    const double alone = 2.0 * std::atan(discs.near_m / discs.depth_m);
    const double t0 = std::min(1.57, alone * random.logUniform(0.8, 20.0));
    discs.lean_cosine = std::cos(lean);
    discs.lean_tangent = std::tan(lean);
    const double excess = leastExcess(discs, lean, t0);
    const bool says = reachWithin(std::tan(0.5 * t0), discs);
    if (says) {
      ASSERT_GE(excess, -1e-15) << i;
    }
    reach += excess >= 0.0;
    said += says;
  }
  EXPECT_GT(reach, 5000);
  EXPECT_GT(said, 0.8 * reach) << "it sees too little";
}

TEST(TwoDiscs, BeyondARightAngle_AreNotSaidToReach) {
  const TwoDiscs discs{0.1, 0.5, 1.0, 1.0, 1.0, 0.0};
  EXPECT_TRUE(reachWithin(1.0, discs));
  EXPECT_FALSE(reachWithin(1.1, discs));
  EXPECT_FALSE(reachWithin(std::numeric_limits<double>::infinity(), discs));
}

}  // namespace
}  // namespace carom
