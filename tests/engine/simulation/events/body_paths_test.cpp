// What events make of the path of a single body.

#include "engine/simulation/events/body_paths.h"

#include <gtest/gtest.h>

#include <vector>

namespace carom {
namespace {

// A box that falls and turns, in a world of its own, and is told to fly when the step begins.
struct OneBody {
  std::vector<Body> bodies{1};
  std::vector<Shape> shapes;
  PairTable table;
  ActiveBodies active;
  WorldSettings settings{.step_s = 1.0 / 60.0};
  Crew crew;
  FlightPlanner planner{settings};
  StepCounters counters;
  BodyPaths paths{{bodies, shapes, table, active, settings, crew}, planner, counters, nullptr};

  OneBody() {
    const Solid solid = Solid::box({0.3, 0.2, 0.1});
    planner.add({}, std::nullopt);
    planner.begin(std::span(&solid, 1), {0});
    planner.beginStep(0.0, settings.step_s);
    body().inertia = inertiaOf(700.0, solid.volume(), solid.unitInertia());
    body().radius_m = 0.19;
    body().X_WB = {Quat(0.5, -0.5, 0.1, 0.7).normalized(), Vec3(1.0, 2.0, 3.0)};
    body().velocity = {Vec3(0.3, -0.2, -1.0), Vec3(2.0, 1.0, -3.0)};
    planner.planStep(0, body());
  }
  Body& body() { return bodies[0]; }
};

// The forces of its contacts act on, whose opposites the others have.
TEST(BodyPaths, OfAFrozenBody_StandStillWhileItsMomentumGoesWhereForcesTakeIt) {
  OneBody world;
  const double frozen_s = 0.3 * world.settings.step_s, end_s = world.settings.step_s;
  const Pose X_then = world.body().path.at(frozen_s);
  const Velocity then = world.body().velocityAt(frozen_s);
  world.paths.bring(0, frozen_s);
  world.paths.hold(0);
  EXPECT_TRUE(world.body().frozen);
  const Velocity end{Vec3(0.1, 0.4, 0.2), Vec3(-1.0, 2.0, 0.5)};
  world.paths.driveHeld(0, end);
  EXPECT_LT((world.body().path.at(end_s).position - X_then.position).norm(), 1e-15);
  EXPECT_LT(world.body().path.at(end_s).rotation.angularDistance(X_then.rotation), 1e-14);
  const Velocity found = world.body().velocityAt(end_s);
  EXPECT_LT((found.linear - end.linear).norm(), 1e-14);
  EXPECT_LT((found.angular - end.angular).norm(), 1e-12);
  const Velocity halfway = world.body().velocityAt(0.5 * (frozen_s + end_s));
  EXPECT_LT((halfway.linear - 0.5 * (then.linear + end.linear)).norm(), 1e-14);
}

TEST(BodyPaths, OfABodyFrozenAtTheEndOfTheStep_LeaveItTheVelocityThatItHas) {
  OneBody world;
  const double end_s = world.settings.step_s;
  world.paths.bring(0, end_s);
  world.paths.hold(0);
  const Velocity before = world.body().velocityAt(end_s);
  world.paths.driveHeld(0, before);
  EXPECT_EQ(world.body().velocityAt(end_s).linear, before.linear);
  EXPECT_EQ(world.body().velocityAt(end_s).angular, before.angular);
  EXPECT_TRUE(world.body().acceleration.allFinite());
}

}  // namespace
}  // namespace carom
