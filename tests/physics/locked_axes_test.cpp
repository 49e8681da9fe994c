// Bodies with locked axes: they never move along or turn about what is locked, whatever strikes them, and
// what is left of their motion is what theory says.

#include "tests/physics/small_world.h"

namespace carom::physics {
namespace {

using Turning = AxisLocks::Turning;

struct Locked {
  Solid solid = Solid::box(Vec3::Ones());
  Pose X_WB;
  AxisLocks locks;
  Material material;
  Vec3 velocity = Vec3::Zero();
  Vec3 spin = Vec3::Zero();
};

int addLocked(World& world, const Locked& l) {
  BodyDescription d;
  d.solid = world.addSolid(l.solid);
  d.X_WB = l.X_WB;
  d.material = l.material;
  d.locks = l.locks;
  d.linear_velocity = l.velocity;
  d.angular_velocity = l.spin;
  return world.addBody(d);
}

int addFree(World& world, const Solid& solid, const Pose& X, const Vec3& v, const Material& material) {
  return world.addBody({world.addSolid(solid), X, v, Vec3::Zero(), material});
}

const BodyState& stateOf(const World& world, int body) {
  return world.states()[static_cast<std::size_t>(body)];
}

void run(World& world, double seconds) {
  const int steps = static_cast<int>(std::round(seconds / world.settings().step_s));
  for (int i = 0; i < steps; ++i) {
    world.step();
    ASSERT_GT(world.audit().smallest_gap_m, 0.0);
  }
}

// A ball strikes a pinned box, which can only turn about z, beside its axis.
TEST(BoxThatCanOnlySpin, TakesTheImpulseOfItsMomentAlone) {
  const double e = 0.6, v = 2.0, arm = 0.35;
  World world({1.0 / 240.0, Vec3::Zero()});
  Locked door;
  door.solid = Solid::box(Vec3(1.0, 0.2, 0.6));
  door.X_WB = {oracle::turned(Vec3::UnitZ(), 0.0), Vec3::Zero()};
  door.locks = {Vec3::Zero(), Turning::kOneAxis, Vec3::UnitZ()};
  door.material = rubbing(0.0, e);
  const int box = addLocked(world, door);
  const int ball = addFree(world, Solid::ball(0.1), {Quat::Identity(), Vec3(arm, -0.5, 0.1)}, Vec3(0, v, 0),
                           rubbing(0.0, e));
  ASSERT_TRUE(world.start().empty());
  run(world, 0.5);
  const double m = world.mass(ball);
  const double moment = world.mass(box) * (1.0 + 0.04) / 12.0;
  const double impulse = (1.0 + e) * v / (1.0 / m + arm * arm / moment);
  EXPECT_NEAR(stateOf(world, box).angular_velocity.z(), impulse * arm / moment, 1e-9);
  EXPECT_NEAR(stateOf(world, ball).linear_velocity.y(), v - impulse / m, 1e-9);
  EXPECT_EQ(stateOf(world, box).X_WB.position, Vec3::Zero());
  EXPECT_EQ(stateOf(world, box).linear_velocity, Vec3::Zero());
  EXPECT_LT(stateOf(world, box).angular_velocity.head<2>().norm(), 1e-15);
}

TEST(BoxThatCannotTurn, IsStruckAsAPoint) {
  const double e = 0.5, v = 2.0;
  World world({1.0 / 240.0, Vec3::Zero()});
  Locked crate;
  crate.solid = Solid::box(Vec3(1.0, 0.2, 0.6));
  crate.X_WB = {oracle::turned(Vec3::UnitX(), 0.3), Vec3::Zero()};
  crate.locks = {Vec3::Ones(), Turning::kLocked, Vec3::UnitZ()};
  crate.material = rubbing(0.0, e);
  const int box = addLocked(world, crate);
  const Vec3 n = crate.X_WB.rotation * Vec3::UnitY();
  const int ball =
      addFree(world, Solid::ball(0.1), {Quat::Identity(), Vec3(0.4, 0, 0) - 0.5 * n}, v * n, rubbing(0.0, e));
  ASSERT_TRUE(world.start().empty());
  run(world, 0.5);
  const double m = world.mass(ball), M = world.mass(box);
  const double after = m * v * (1.0 + e) / (m + M);
  EXPECT_LT((stateOf(world, box).linear_velocity - after * n).norm(), 1e-9);
  EXPECT_EQ(stateOf(world, box).angular_velocity, Vec3::Zero());
  EXPECT_EQ(stateOf(world, box).X_WB.rotation.coeffs(), crate.X_WB.rotation.coeffs());
}

// A block that slides down an incline, but may move along x and z only; the slope goes down between x and y.
TEST(BlockOnRails, SlidesAsItsFreeDirectionLets) {
  World world({1.0 / 240.0, Vec3(0, 0, -kGravity)});
  Locked block;
  block.solid = Solid::box(Vec3(0.4, 0.3, 0.2));
  block.X_WB = {Quat::Identity(), Vec3(0, 0, 0.5)};
  block.locks = {Vec3(1, 0, 0), Turning::kLocked, Vec3::UnitZ()};
  block.material = rubbing(0.0);
  block.velocity = Vec3(0.7, 0, 0);
  const int body = addLocked(world, block);
  ASSERT_TRUE(world.start().empty());
  run(world, 2.0);
  EXPECT_LT((stateOf(world, body).X_WB.position - Vec3(1.4, 0, 0.5)).norm(), 1e-12)
      << "nothing pulls it down";
  EXPECT_EQ(stateOf(world, body).linear_velocity, Vec3(0.7, 0, 0));
}

// A box that stands on the floor and cannot turn, pushed far above its centre by another: it does not tip.
TEST(CrateThatCannotTurn, SlidesWhereAFreeOneTips) {
  for (const bool locked : {false, true}) {
    World world({1.0 / 240.0, Vec3(0, 0, -kGravity)});
    world.addBody({world.addSolid(Solid::box(Vec3(40, 40, 2))),
                   {Quat::Identity(), Vec3(0, 0, -1)},
                   Vec3::Zero(),
                   Vec3::Zero(),
                   rubbing(0.8),
                   true});
    Locked tall;
    const Vec3 size(0.3, 0.3, 1.2);
    tall.solid = Solid::box(size);
    tall.X_WB = lyingBox(size, Quat::Identity(), 0.0);
    tall.velocity = Vec3(2.0, 0, 0);
    tall.material = rubbing(0.8);
    if (locked) tall.locks.turning = Turning::kLocked;
    const int body = addLocked(world, tall);
    ASSERT_TRUE(world.start().empty());
    run(world, 2.0);
    const double tilt = stateOf(world, body).X_WB.rotation.angularDistance(Quat::Identity());
    if (!locked) {
      EXPECT_GT(tilt, 1.0);
      continue;
    }
    EXPECT_EQ(tilt, 0.0);
    EXPECT_NEAR(stateOf(world, body).X_WB.position.x() / (4.0 / (2.0 * 0.8 * kGravity)), 1.0, 1e-3);
    EXPECT_EQ(stateOf(world, body).mode, Mode::kResting);
  }
}

// A seesaw: a plank that only turns about its middle, with a heavier ball on one end than on the other, goes
// down as the balance of moments says at the beginning.
TEST(Seesaw, BeginsToTurnAsItsMomentsSay) {
  World world({1.0 / 960.0, Vec3(0, 0, -kGravity)});
  Locked plank;
  const Vec3 size(2.0, 0.4, 0.1);
  plank.solid = Solid::box(size);
  plank.locks = {Vec3::Zero(), Turning::kOneAxis, Vec3::UnitY()};
  plank.material = rubbing(0.5);
  const int board = addLocked(world, plank);
  const double heavy = 0.15, light = 0.1, arm = 0.8;
  const double rest = 0.05 + restGap(0.1);
  const int a = addFree(world, Solid::ball(heavy), {Quat::Identity(), Vec3(arm, 0, rest + heavy)},
                        Vec3::Zero(), rubbing(0.5));
  const int b = addFree(world, Solid::ball(light), {Quat::Identity(), Vec3(-arm, 0, rest + light)},
                        Vec3::Zero(), rubbing(0.5));
  ASSERT_TRUE(world.start().empty());
  const double M = world.mass(board), m1 = world.mass(a), m2 = world.mass(b);
  // The heavy ball falls faster than the plank can follow only beyond g; here both stay on it. A ball on a
  // frictional plank that begins to turn has no spin yet and accelerates as the plank does.
  const double moment = M * (size.x() * size.x() + size.z() * size.z()) / 12.0 + (m1 + m2) * arm * arm;
  const double expected = (m1 - m2) * kGravity * arm / moment;
  run(world, 0.02);
  EXPECT_NEAR(stateOf(world, board).angular_velocity.y() / (0.02 * expected), 1.0, 0.02);
  EXPECT_EQ(stateOf(world, board).X_WB.position, Vec3::Zero());
}

// Energy: a wheel on an axle, spun up, keeps its spin to the rounding; a planar body that turns about one
// axis does so for ever, whichever axis.
TEST(WheelOnAnAxle, SpinsOnForEver) {
  World world({1.0 / 60.0, Vec3(0, 0, -kGravity)});
  Locked wheel;
  wheel.solid = Solid::box(Vec3(0.3, 0.5, 0.7));
  wheel.X_WB = {oracle::turned(Vec3(3, 1, 2).normalized(), 1.0), Vec3(0, 0, 1)};
  const Vec3 axis = Vec3(1, 2, -1).normalized();  // no principal one
  wheel.locks = {Vec3::Zero(), Turning::kOneAxis, axis};
  wheel.spin = 7.0 * axis;
  const int body = addLocked(world, wheel);
  ASSERT_TRUE(world.start().empty());
  run(world, 60.0);
  EXPECT_LT((stateOf(world, body).angular_velocity - 7.0 * axis).norm(), 1e-12);
  EXPECT_LT(
      stateOf(world, body).X_WB.rotation.angularDistance(rotationBy(420.0 * axis) * wheel.X_WB.rotation),
      1e-9);
}

// A plate that can only go up and down gives way to drag along that alone, however it is tilted: what falls
// as fast as the square of its speed across each windward face holds it up.
TEST(TiltedPlateOnAnUprightRail, FallsAtItsTerminalSpeedAtEveryStep) {
  const Vec3 size(0.5, 0.4, 0.002);
  for (const double degrees : {20.0, 45.0, 60.0}) {
    const double across = std::cos(radians(degrees)), along = std::sin(radians(degrees));
    const double area = size.y() * (size.x() * std::pow(across, 3.0) + size.z() * std::pow(along, 3.0));
    const double v_t = std::sqrt(2.0 * 300.0 * size.prod() * kGravity / (1.2 * 1.05 * area));
    for (const double rate_hz : {10.0, 30.0, 240.0}) {
      WorldSettings settings{1.0 / rate_hz};
      settings.air = {1.2, Vec3::Zero(), 0.0};
      World world(settings);
      Locked plate;
      plate.solid = Solid::box(size);
      plate.X_WB.rotation = oracle::turned(Vec3::UnitY(), radians(degrees));
      plate.locks = {Vec3::UnitZ(), Turning::kLocked, Vec3::UnitZ()};
      plate.material.density_kgpm3 = 300.0;
      const int body = addLocked(world, plate);
      ASSERT_TRUE(world.start().empty());
      run(world, 20.0 * v_t / kGravity);
      EXPECT_NEAR(-stateOf(world, body).linear_velocity.z() / v_t, 1.0, 1e-9)
          << degrees << " degrees at " << rate_hz << " Hz";
    }
  }
}

// A rod whose middle is held under water that is as thick as honey, its upper end in the air: it sinks onto
// its side, as it floats there. Were it dragged as if it rose, the drag would turn it upright.
TEST(RodHeldAtItsMiddleInThickWater, TurnsOntoItsSide) {
  for (const double rate_hz : {60.0, 240.0, 2400.0}) {
    WorldSettings settings{1.0 / rate_hz};
    Fluid honey;
    honey.max.z() = 0.0;
    honey.linear_drag_mps = 10.0;
    settings.fluids.push_back(honey);
    World world(settings);
    Locked rod;
    rod.solid = Solid::capsule(0.1, 0.8);
    rod.X_WB = {oracle::turned(Vec3::UnitY(), radians(20.0)), Vec3(0.0, 0.0, -0.3)};
    rod.locks = {Vec3(1.0, 1.0, 0.0), Turning::kFree, Vec3::UnitZ()};
    rod.material.density_kgpm3 = 20.0;
    const int body = addLocked(world, rod);
    ASSERT_TRUE(world.start().empty());
    const auto upright = [&] { return std::abs((stateOf(world, body).X_WB.rotation * Vec3::UnitZ()).z()); };
    const double before = upright();
    run(world, 0.5);
    EXPECT_LT(upright(), before) << rate_hz << " Hz";
  }
}

}  // namespace
}  // namespace carom::physics
