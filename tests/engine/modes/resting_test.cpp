// The resting question, asked of a box on a slope and of stacks: the answer is that of statics.

#include "engine/modes/resting.h"

#include <gtest/gtest.h>

#include "engine/foundation/tolerances.h"
#include "tests/engine/response/sweeps/random_contact.h"

namespace carom {
namespace {

constexpr double kStep = 1.0 / 120;
const Vec3 kGravity(0, 0, -9.81);

// Boxes stacked along the slope's normal, each on the four corners of the one below; body 0 is what they lie
// on.
struct Stack {
  std::vector<ImpulseBody> bodies{immovable()};
  std::vector<ContactRow> rows;
  std::vector<double> radii{0.0};
  std::vector<double> slack_m;
  Quat tilt;

  explicit Stack(double tangent, double heading = 0.0)
      : tilt(oracle::turned(Vec3::UnitZ(), heading) * oracle::turned(Vec3::UnitY(), std::atan(tangent))) {}

  void put(const Vec3& size, double friction, double mass = 2.0, const Vec2& shift = Vec2::Zero()) {
    const Vec3 center_F(shift.x(), shift.y(), top_ + 0.5 * size.z());
    bodies.push_back(impulseBody(boxInertia(mass, size), tilt, tilt * center_F, {}));
    radii.push_back(0.5 * size.norm());
    const int upper = static_cast<int>(bodies.size()) - 1;
    for (double x : {-0.5, 0.5})
      for (double y : {-0.5, 0.5}) {
        const Vec3 p_W = tilt * Vec3(shift.x() + x * size.x(), shift.y() + y * size.y(), top_);
        rows.push_back(rowAt({.a = upper - 1,
                              .b = upper,
                              .n = tilt * Vec3::UnitZ(),
                              .p_W = p_W,
                              .friction = {friction, friction}},
                             bodies));
      }
    top_ += size.z();
  }
  bool rests() {
    // The guess that a world has after many warm-started steps: the converged answer to one step's gravity.
    std::vector<ImpulseBody> falling = bodies;
    for (std::size_t i = 1; i < falling.size(); ++i) falling[i].velocity.linear = kStep * kGravity;
    std::vector<ContactRow> guess = rows;
    solveContacts(guess, falling, {20000, 1e-13, true});
    return canRest({guess, bodies, radii, kGravity, kStep, {}, slack_m});
  }

 private:
  double top_ = 0.0;
};

TEST(CanRest, ABoxOnASlopeRestsExactlyWhenFrictionHoldsIt) {
  for (double mu : {0.2, 0.5, 0.9})
    for (double heading : {0.0, 0.7, 2.5})
      for (double margin : {-1e-3, 1e-3}) {
        Stack s(mu * (1 + margin), heading);
        s.put({0.6, 0.5, 0.2}, mu);
        EXPECT_EQ(s.rests(), margin < 0) << "mu " << mu << " heading " << heading << " margin " << margin;
      }
}

TEST(CanRest, ABoxBeyondItsTippingPointDoesNot) {
  for (double margin : {-0.01, 0.01}) {
    Stack s((1 + margin) * 0.3 / 0.9);
    s.put({0.3, 0.4, 0.9}, 1.0);
    EXPECT_EQ(s.rests(), margin < 0) << margin;
  }
}

TEST(CanRest, AStackRestsWhenEveryStoryDoes) {
  Stack good(0.1), slippery(0.1);
  for (int i = 0; i < 3; ++i) good.put({0.6, 0.5, 0.2}, 0.5);
  EXPECT_TRUE(good.rests());
  slippery.put({0.6, 0.5, 0.2}, 0.5);
  slippery.put({0.6, 0.5, 0.2}, 0.05);
  EXPECT_FALSE(slippery.rests());
}

TEST(CanRest, AFloatingBodyDoesNot) {
  Stack s(0.0);
  s.put({0.6, 0.5, 0.2}, 0.5);
  EXPECT_TRUE(s.rests());
  s.rows.clear();
  EXPECT_FALSE(s.rests());
}

TEST(CanRest, OnOneFootOffTheCentreDoesNot) {
  Stack s(0.0);
  s.put({0.6, 0.5, 0.2}, 0.5);
  s.rows.resize(1);
  EXPECT_FALSE(s.rests());
}

// The weight turns the box about the line through its two points, which its centre is beside.
TEST(CanRest, OnTwoPointsRestsExactlyWhenTheirMarginReachesBelowTheCentre) {
  constexpr double kMargin = 1e-4;
  for (double share : {-1.01, -0.99, -0.1, 0.1, 0.99, 1.01}) {
    Stack s(0.0);
    s.put({0.6, 0.5, 0.2}, 0.5);
    s.rows.clear();
    for (double x : {-0.3, 0.3})
      s.rows.push_back(rowAt(
          {.a = 0, .b = 1, .n = Vec3::UnitZ(), .p_W = Vec3(x, share * kMargin, 0), .friction = {0.5, 0.5}},
          s.bodies));
    EXPECT_FALSE(s.rests()) << share;
    s.slack_m.assign(2, kMargin);
    EXPECT_EQ(s.rests(), std::abs(share) < 1.0) << share;
  }
}

// Pushed on a smooth floor by hardly more than is allowed: the margin holds what turns; but what slides, no
// moment holds, were it to turn so much that one could take all its energy.
TEST(CanRest, MarginHoldsATurnButNotASlide) {
  const double push = 2.0 * tolerance::kRestAcceleration * kGravity.norm() * kStep;
  for (double slide : {0.0, push}) {
    Stack s(0.0);
    s.put({0.6, 0.5, 0.2}, 0.0);
    const std::vector<Velocity> pushes = {
        {}, {kStep * kGravity + Vec3(slide, 0, 0), Vec3(0, 0, 0.9 * push / s.radii[1])}};
    const std::vector<double> slack_m(4, 2e-3);
    EXPECT_FALSE(canRest({s.rows, s.bodies, s.radii, kGravity, kStep, pushes}));
    EXPECT_EQ(canRest({s.rows, s.bodies, s.radii, kGravity, kStep, pushes, slack_m}), slide == 0.0);
  }
}

TEST(CanRest, IsNotASinkForGravityThatPullsSideways) {
  Stack s(0.0);
  s.put({0.6, 0.5, 0.2}, 0.5);
  std::vector<ContactRow> rows = s.rows;
  EXPECT_FALSE(canRest({rows, s.bodies, s.radii, Vec3(9.81, 0, -1.0), kStep}));
  EXPECT_FALSE(canRest({rows, s.bodies, s.radii, Vec3(0, 0, 9.81), kStep})) << "upwards";
}

TEST(LiesStill, AsksForTheFastestPoint) {
  const double v = tolerance::kRestSpeed;
  EXPECT_TRUE(liesStill({Vec3(0.9 * v, 0, 0), Vec3::Zero()}, 2.0));
  EXPECT_FALSE(liesStill({Vec3(1.1 * v, 0, 0), Vec3::Zero()}, 2.0));
  EXPECT_TRUE(liesStill({Vec3::Zero(), Vec3(0, 0.4 * v, 0)}, 2.0));
  EXPECT_FALSE(liesStill({Vec3::Zero(), Vec3(0, 0.6 * v, 0)}, 2.0));
}

// On its way through a step a point may count as still at some speed; what is to rest has none.
TEST(CanRest, WhatCountedAsStillOnItsWay_IsAskedToStandStill) {
  Stack s(0.0);
  s.put({0.6, 0.5, 0.2}, 0.5);
  for (ContactRow& row : s.rows) row.still_slip = Vec2(0.1, -0.05);
  EXPECT_TRUE(s.rests());
}

}  // namespace
}  // namespace carom
