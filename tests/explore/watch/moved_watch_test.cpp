// What MovedWatch sees: a locked body that has moved or turned, a kinematic one beside its path.
#include "tests/explore/watch/moved_watch.h"

#include <gtest/gtest.h>

namespace carom::explore {
namespace {

struct Watched {
  Watched() : world(WorldSettings{}) {
    BodyDescription locked;
    locked.solid = world.addSolid(Solid::box(Vec3(1, 1, 1)));
    locked.X_WB.position = Vec3(0, 0, 2);
    locked.locks.free_axes = Vec3(1, 1, 0);
    locked.locks.turning = AxisLocks::Turning::kLocked;
    world.addBody(locked);
    BodyDescription moved;
    moved.solid = locked.solid;
    moved.X_WB.position = Vec3(0, 0, 5);
    moved.is_kinematic = true;
    moved.linear_velocity = Vec3(1, 0, 0);
    world.addBody(moved);
    world.start();
  }
  std::size_t found(std::vector<BodyState> states, double late_s = 0.0) const {
    Findings findings;
    MovedWatch(world).look(states, late_s, 0, findings);
    return findings.list().size();
  }
  std::vector<BodyState> states() const { return {world.states().begin(), world.states().end()}; }
  World world;
};

TEST(MovedWatch, SeesWhatMovesAlongOrAboutALockedAxis) {
  const Watched watched;
  EXPECT_EQ(watched.found(watched.states()), 0u);
  std::vector<BodyState> along = watched.states(), free = along, turned = along;
  along[0].X_WB.position.z() += 1e-9;
  free[0].X_WB.position.x() += 1.0;
  turned[0].X_WB.rotation = Quat(1.0, 0.0, 1e-9, 0.0).normalized();
  EXPECT_EQ(watched.found(along), 1u);
  EXPECT_EQ(watched.found(free), 0u);
  EXPECT_EQ(watched.found(turned), 1u);
}

TEST(MovedWatch, SeesWhatIsBesideItsPathUnlessItIsLate) {
  const Watched watched;
  std::vector<BodyState> beside = watched.states();
  beside[1].X_WB.position.x() -= 1e-6;
  EXPECT_EQ(watched.found(beside), 1u);
  EXPECT_EQ(watched.found(beside, 0.1), 0u);
}

}  // namespace
}  // namespace carom::explore
