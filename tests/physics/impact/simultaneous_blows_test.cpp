// Blows of one instant and speed on bodies that others join: none of them comes before another.

#include "tests/physics/small_world.h"

namespace carom::physics {
namespace {

// A loaded plate on balls, a square of them, which come down together on a floor that throws them back. The
// floor strikes each ball once, all at one instant, and then the plate meets all of them at once. Were the
// plate supported after the first ball's blow, before the others had theirs, it would be turned.
TEST(SimultaneousBlows, OfAFloorOnBallsUnderAPlate_AreOneEach) {
  constexpr double kRadius = 0.1, kApart = 0.3, kHeight = 0.0137;
  for (const int side : {2, 3, 4})
    for (const double restitution : {0.1, 0.8}) {
      SCOPED_TRACE(testing::Message() << side << " by " << side << ", restitution " << restitution);
      World world({1.0 / 240.0, Vec3::Zero()});
      const auto falling = [&](const Solid& solid, const Vec3& p, double e) {
        BodyDescription body;
        body.solid = world.addSolid(solid);
        body.X_WB.position = p;
        body.linear_velocity = -Vec3::UnitZ();
        body.material = rubbing(0.3, e);
        return body;
      };
      BodyDescription floor = falling(Solid::box({40.0, 40.0, 1.0}), Vec3(0.0, 0.0, -0.5), restitution);
      floor.is_static = true;
      floor.linear_velocity.setZero();
      world.addBody(floor);
      for (int i = 0; i < side; ++i)
        for (int j = 0; j < side; ++j)
          world.addBody(falling(Solid::ball(kRadius), Vec3(kApart * i, kApart * j, kHeight + kRadius), 0.0));
      const double middle = 0.5 * kApart * (side - 1);
      const double above = kHeight + 2.0 * kRadius + restGap(2.0 * kRadius) + 0.1;
      BodyDescription plate =
          falling(Solid::box({kApart * side, kApart * side, 0.2}), Vec3(middle, middle, above), 0.0);
      plate.load.force_W = Vec3(0.0, 0.0, -100.0);
      const auto last = static_cast<std::size_t>(world.addBody(plate));
      ASSERT_TRUE(world.start().empty());
      int events = 0;
      while (events == 0 && world.time() < 0.1) {
        world.step();
        events += world.audit().last_step.events;
      }
      EXPECT_EQ(events, side * side + 1);
      EXPECT_LT(world.states()[last].angular_velocity.norm(), 1e-6);
    }
}

}  // namespace
}  // namespace carom::physics
