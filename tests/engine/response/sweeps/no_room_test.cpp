// Who is pressed between what cannot give way has no room; who can go on, or aside by a lever that is not
// endless, has.

#include "engine/response/sweeps/no_room.h"

#include <gtest/gtest.h>

#include "tests/engine/response/sweeps/random_contact.h"

namespace carom {
namespace {

ImpulseBody driven(const Vec3& velocity) {
  ImpulseBody body = immovable();
  body.velocity.linear = velocity;
  return body;
}

struct Row {
  std::vector<ImpulseBody> bodies;
  std::vector<ContactRow> rows;
  void touch(int a, int b, const Vec3& n, const Vec3& p_W, double friction = 0.3) {
    rows.push_back(
        rowAt({.a = a, .b = b, .n = n.normalized(), .p_W = p_W, .friction = {friction, friction}}, bodies));
  }
  bool hasNoRoom(int sweeps = 80) {
    solveContacts(rows, bodies, {.sweeps = sweeps, .residual_mps = 1e-9});
    return !leavingNoRoom(rows, bodies, true).empty();
  }
};

// Balls of two masses in a row along z, and what pushes the first with a speed of 1.7 m/s.
Row pushedRow(int balls, bool against_a_wall, double mass_kg = 1.0) {
  Row row;
  row.bodies.push_back(driven(Vec3(0.3, 0.0, 1.7)));
  for (int i = 0; i < balls; ++i)
    row.bodies.push_back(impulseBody(boxInertia(i % 2 == 0 ? mass_kg : 3.0 * mass_kg, Vec3(0.5, 0.5, 0.5)),
                                     Quat::Identity(), Vec3(0.0, 0.0, i + 0.5), {}));
  if (against_a_wall) row.bodies.push_back(immovable());
  for (int i = 0; i + 1 < static_cast<int>(row.bodies.size()); ++i)
    row.touch(i, i + 1, Vec3::UnitZ(), Vec3(0.0, 0.0, i));
  return row;
}

TEST(LeavingNoRoom, WhatIsPushedAgainstAWall_InARowOfAnyLength) {
  for (const int balls : {1, 2, 5, 10})
    for (const double mass_kg : {1e-6, 1.0, 1e6})
      EXPECT_TRUE(pushedRow(balls, true, mass_kg).hasNoRoom()) << balls << " of " << mass_kg;
}

TEST(LeavingNoRoom, NotWhatIsPushedOn_ConvergedOrNot) {
  for (const int balls : {1, 2, 5, 10})
    for (const double mass_kg : {1e-6, 1.0, 1e6})
      for (const int sweeps : {1, 4, 80})
        EXPECT_FALSE(pushedRow(balls, false, mass_kg).hasNoRoom(sweeps)) << balls << " of " << mass_kg;
}

TEST(LeavingNoRoom, NotWhatLiesBetweenThingsThatStandStill) {
  Row row = pushedRow(2, true);
  row.bodies.front().velocity = {};
  row.bodies[1].velocity.linear.z() = 2.0;
  EXPECT_FALSE(row.hasNoRoom());
}

TEST(LeavingNoRoom, NotWhereStandingStillIsWhatHasNone) {
  // Two walls that ask for gaps they cannot have, and a body that moves away.
  Row row = pushedRow(1, true);
  row.bodies.front().velocity.linear.z() = -1.0;
  for (ContactRow& contact : row.rows) contact.lowest_speed = 0.1;
  EXPECT_FALSE(row.hasNoRoom());
}

// Pressed between two faces that open by an angle towards x: it gives way 1 / (2 tan(angle / 2)) times as
// fast as they close.
TEST(LeavingNoRoom, NotWhatAWedgePressesOut_UnlessFrictionHoldsItOrTheWedgeIsTooThin) {
  const auto wedged = [](double half_angle, double friction) {
    Row row;
    row.bodies = {driven(Vec3(0.0, 0.0, 1.0)),
                  impulseBody(boxInertia(1.0, Vec3::Ones()), Quat::Identity(), Vec3::Zero(), {}),
                  immovable()};
    const double s = std::sin(half_angle), c = std::cos(half_angle);
    row.touch(0, 1, Vec3(s, 0.0, c), Vec3::Zero(), friction);
    row.touch(1, 2, Vec3(-s, 0.0, c), Vec3::Zero(), friction);
    return row.hasNoRoom();
  };
  EXPECT_FALSE(wedged(0.5, 0.0));
  EXPECT_FALSE(wedged(0.1, 0.0));
  EXPECT_TRUE(wedged(0.001, 0.0));
  EXPECT_FALSE(wedged(0.3, 0.2)) << "tan 0.3 = 0.31";
  EXPECT_TRUE(wedged(0.3, 0.5));
}

// Two faces at an angle 2 h, pressed together at 1 m/s, press out what is between them with 1 / (2 sin h)
// times that, as their impulses are equal: blocked where that is more than thirty times, whatever it weighs.
TEST(LeavingNoRoom, AWedgeBlocksFromALeverageOfThirtyOn_WhateverTheMass) {
  for (const double mass : {1e-3, 1.0, 1e3})
    for (const double share : {0.98, 1.02}) {
      const double s = share / 60.0, c = std::sqrt(1.0 - s * s);
      Row row;
      row.bodies = {driven(Vec3(0.0, 0.0, 1.0)),
                    impulseBody(boxInertia(mass, Vec3::Ones()), Quat::Identity(), Vec3::Zero(), {}),
                    immovable()};
      row.touch(0, 1, Vec3(s, 0.0, c), Vec3::Zero(), 0.0);
      row.touch(1, 2, Vec3(-s, 0.0, c), Vec3::Zero(), 0.0);
      EXPECT_EQ(row.hasNoRoom(), share < 1.0) << mass << " kg, " << share;
    }
}

}  // namespace
}  // namespace carom
