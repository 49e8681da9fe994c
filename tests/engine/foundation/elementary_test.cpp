// Our own sine, cosine and rotation against long double ones.

#include "engine/foundation/elementary.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/oracle/test_shapes.h"

namespace carom {
namespace {

using oracle::Random;

TEST(SineCosine, AreWithinTwoUnitsInTheLastPlaceOfOne) {
  Random random(11);
  for (int i = 0; i < 200000; ++i) {
    const double angle = (i % 2 ? 1.0 : -1.0) * random.logUniform(1e-12, 1e5);
    const auto [sine, cosine] = sineCosine(angle);
    ASSERT_LE(std::abs(sine - sinl(angle)), 2 * 0x1p-53L) << angle;
    ASSERT_LE(std::abs(cosine - cosl(angle)), 2 * 0x1p-53L) << angle;
  }
}

TEST(SineCosine, HoldNextToEveryQuarterTurn) {
  for (int quarter = -1000; quarter <= 1000; ++quarter)
    for (double nudge : {-1e-3, -1e-9, 0.0, 1e-9, 1e-3, std::numbers::pi / 4}) {
      const double angle = quarter * (std::numbers::pi / 2) + nudge;
      const auto [sine, cosine] = sineCosine(angle);
      ASSERT_LE(std::abs(sine - sinl(angle)), 2 * 0x1p-53L) << angle;
      ASSERT_LE(std::abs(cosine - cosl(angle)), 2 * 0x1p-53L) << angle;
    }
}

TEST(AngleOf, IsTheArcTangentInTheRightQuarter) {
  Random random(13);
  for (int i = 0; i < 20000; ++i) {
    const double x = random.uniform(-1.0, 1.0), y = random.uniform(-1.0, 1.0) * random.logUniform(1e-12, 1.0);
    ASSERT_NEAR(angleOf(y, x), static_cast<double>(atan2l(y, x)), 1e-15) << y << " " << x;
  }
  EXPECT_EQ(angleOf(0.0, 0.0), 0.0);
  EXPECT_EQ(angleOf(0.0, 3.0), 0.0);
}

TEST(Exponential, IsWithinTwoUnitsInTheLastPlace) {
  Random random(14);
  for (int i = 0; i < 100000; ++i) {
    const double x = random.uniform(-700.0, 700.0) * (i % 2 ? 1.0 : 1e-3);
    const long double exact = expl(x);
    ASSERT_LE(std::abs(exponential(x) - exact), 2 * 0x1p-52L * exact) << x;
  }
}

TEST(RotationBy, TurnsByTheVectorsLengthAboutItsDirection) {
  Random random(12);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 axis = random.direction(), p = random.direction();
    const double angle = random.logUniform(1e-14, 20.0);
    const Quat expected(Eigen::AngleAxisd(angle, axis));
    // The length of angle * axis is itself rounded.
    EXPECT_LT((rotationBy(angle * axis) * p - expected * p).norm(), 1e-15 * (1.0 + angle)) << angle;
  }
  EXPECT_EQ(rotationBy(Vec3::Zero()).coeffs(), Quat::Identity().coeffs());
}

TEST(RotationBy, IsAUnitQuaternion) {
  Random random(13);
  for (int i = 0; i < 1000; ++i)
    EXPECT_NEAR(rotationBy(random.logUniform(1e-12, 1e3) * random.direction()).norm(), 1.0, 1e-15);
}

}  // namespace
}  // namespace carom
