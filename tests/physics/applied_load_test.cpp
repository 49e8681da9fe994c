// Constant forces and torques on bodies: flight, friction, spin, and the work that they do.

#include <numbers>
#include <tuple>

#include "tests/physics/small_world.h"
#include "tests/support/world_energy.h"

namespace carom::physics {
namespace {

const Vec3 kNoGravity = Vec3::Zero();

int addLoaded(World& world, const Solid& solid, const Pose& X, const AppliedLoad& load,
              double friction = 0.5) {
  BodyDescription d;
  d.solid = world.addSolid(solid);
  d.X_WB = X;
  d.material = rubbing(friction);
  d.load = load;
  return world.addBody(d);
}

void addFloor(World& world, double friction) {
  world.addBody({world.addSolid(Solid::box(Vec3(100, 100, 2))),
                 {Quat::Identity(), Vec3(0, 0, -1)},
                 Vec3::Zero(),
                 Vec3::Zero(),
                 rubbing(friction),
                 true});
}

void run(World& world, double seconds) {
  const int steps = static_cast<int>(std::round(seconds / world.settings().step_s));
  for (int i = 0; i < steps; ++i) world.step();
}

TEST(ConstantForce, MakesAParabolaAndItsWorkIsTheEnergy) {
  World world({1.0 / 60.0, Vec3(0, 0, -kGravity)});
  const Vec3 force(300, -100, 50);
  const int box = addLoaded(world, Solid::box(Vec3(0.3, 0.4, 0.5)),
                            {oracle::turned(Vec3::UnitX(), 0.4), Vec3(0, 0, 100)}, {.force_W = force});
  ASSERT_TRUE(world.start().empty());
  const double before = energyOf(world);
  run(world, 2.0);
  const Vec3 a = Vec3(0, 0, -kGravity) + force / world.mass(box);
  const BodyState& state = world.states()[static_cast<std::size_t>(box)];
  EXPECT_LT((state.X_WB.position - Vec3(0, 0, 100) - 2.0 * a).norm(), 1e-11);
  EXPECT_LT((state.linear_velocity - 2.0 * a).norm(), 1e-12);
  EXPECT_NEAR(world.audit().work_J, force.dot(2.0 * a), 1e-9 * force.dot(2.0 * a));
  EXPECT_NEAR((energyOf(world) - before) / world.audit().work_J, 1.0, 1e-9);
}

// Two boxes are pressed against a third from both sides, out of line, and a ball strikes it: what they gain
// is the loads' work, and none of it is a motion of all together.
TEST(ConstantForce, LoadsThatCancelMoveNothingAsAWhole) {
  for (const double force : {100.0, 1000.0})
    for (const auto& [rate_hz, friction, restitution] :
         {std::tuple(60.0, 0.4, 0.3), {60.0, 0.3, 0.0}, {120.0, 0.0, 0.5}, {240.0, 0.4, 0.8}}) {
      SCOPED_TRACE(testing::Message() << force << " N, " << rate_hz << " Hz, e " << restitution);
      World world({1.0 / rate_hz, kNoGravity});
      const Material material{friction, friction, restitution, 1000.0};
      const auto add = [&](const Solid& solid, const Vec3& place, const Vec3& velocity, double push_N) {
        BodyDescription d;
        d.solid = world.addSolid(solid);
        d.X_WB.position = place;
        d.linear_velocity = velocity;
        d.material = material;
        d.load.force_W = Vec3(push_N, 0, 0);
        world.addBody(d);
      };
      add(Solid::box({0.3, 0.4, 0.5}), {-0.31, 0.02, 0.0}, Vec3::Zero(), force);
      add(Solid::box({0.3, 0.3, 0.3}), {0.0, 0.0, 0.0}, Vec3::Zero(), 0.0);
      add(Solid::box({0.3, 0.5, 0.4}), {0.31, -0.03, 0.05}, Vec3::Zero(), -force);
      add(Solid::ball(0.12), {0.05, 1.2, 0.1}, {0.1, -3.0, 0.0}, 0.0);
      ASSERT_TRUE(world.start().empty());
      const Vec3 momentum = world.audit().linear_momentum;
      const double energy = energyOf(world);
      for (int i = 0; i < 2 * rate_hz; ++i) {
        world.step();
        const double pushed = force * (i + 1) / rate_hz;
        ASSERT_LT((world.audit().linear_momentum - momentum).norm(), 1e-10 * (momentum.norm() + pushed)) << i;
        ASSERT_LT(energyOf(world), energy + world.audit().work_J + 1e-9 * (energy + pushed)) << i;
      }
    }
}

TEST(ConstantTorque, SpinsABodyUpAboutAPrincipalAxis) {
  for (const bool in_body : {false, true}) {
    World world({1.0 / 60.0, kNoGravity});
    const Quat R = oracle::turned(Vec3(1, 2, 2).normalized(), 0.8);
    const Vec3 axis = R * Vec3::UnitY();
    AppliedLoad load;
    (in_body ? load.torque_B : load.torque_W) = in_body ? Vec3(0, 2, 0) : Vec3(2.0 * axis);
    const int box = addLoaded(world, Solid::box(Vec3(0.3, 0.4, 0.5)), {R, Vec3::Zero()}, load);
    ASSERT_TRUE(world.start().empty());
    run(world, 3.0);
    const double moment = world.mass(box) * (0.3 * 0.3 + 0.5 * 0.5) / 12.0;
    const BodyState& state = world.states()[static_cast<std::size_t>(box)];
    EXPECT_LT((state.angular_velocity - 3.0 * 2.0 / moment * axis).norm(), 1e-9);
    EXPECT_NEAR(energyOf(world) / world.audit().work_J, 1.0, 1e-9);
    EXPECT_LT(state.X_WB.rotation.angularDistance(rotationBy(0.5 * 9.0 * 2.0 / moment * axis) * R), 1e-9);
  }
}

// A flat body that is spun up to turns a step, about its axis or tumbling: its angular momentum is the
// torque's and its energy is what the torque has done.
TEST(ConstantTorque, SpinsABodyUpThroughTurnsAStep) {
  const Vec3 size(0.5, 0.3, 0.05);
  for (const auto& [tilt, is_locked] : {std::pair(1e-6, false), {0.5, false}, {0.5, true}}) {
    World world({1.0 / 60.0, kNoGravity});
    const Vec3 torque(0, 0, 200);
    BodyDescription d;
    d.solid = world.addSolid(Solid::box(size));
    d.X_WB.rotation = oracle::turned(Vec3::UnitX(), tilt);
    d.load.torque_W = torque;
    if (is_locked) d.locks.free_axes = Vec3(0, 1, 1);
    const int plate = world.addBody(d);
    ASSERT_TRUE(world.start().empty());
    const Vec3 squared = size.cwiseAbs2();
    const Vec3 moments = world.mass(plate) / 12.0 * (Vec3::Constant(squared.sum()) - squared);
    double fastest = 0.0;
    for (int i = 1; i <= 300; ++i) {
      world.step();
      const BodyState& state = world.states()[static_cast<std::size_t>(plate)];
      const Mat3 R = state.X_WB.rotation.toRotationMatrix();
      const Vec3 momentum = R * moments.cwiseProduct(R.transpose() * state.angular_velocity);
      EXPECT_LT((momentum / (i / 60.0) - torque).norm(), 1e-9 * torque.norm());
      EXPECT_NEAR(energyOf(world) / world.audit().work_J, 1.0, 1e-9);
      fastest = std::max(fastest, state.angular_velocity.norm() / 60.0);
    }
    EXPECT_GT(fastest, 4.0 * std::numbers::pi);
  }
}

// A thruster that turns with its body drives it round a circle: a constant spin and a force of constant size
// at right angles to the velocity, v = F / (m w).
TEST(ForceInTheBodysAxes, TurnsWithTheBody) {
  World world({1.0 / 960.0, kNoGravity});
  BodyDescription d;
  d.solid = world.addSolid(Solid::ball(0.2));
  d.material = rubbing(0.5);
  const double mass = 1000.0 * world.solids()[0].volume();
  const double w = 2.0, force = 10.0;
  d.angular_velocity = Vec3(0, 0, w);
  d.load.force_B = Vec3(force, 0, 0);
  d.linear_velocity = Vec3(0, -force / (mass * w), 0);
  world.addBody(d);
  ASSERT_TRUE(world.start().empty());
  run(world, 3.0);
  const Vec3 expected = rotationBy(Vec3(0, 0, 6.0)) * d.linear_velocity;
  EXPECT_LT((world.states()[0].linear_velocity - expected).norm() / expected.norm(), 1e-6);
  EXPECT_LT(world.states()[0].X_WB.position.norm(), 2.1 * force / (mass * w * w));
}

TEST(PushedBlock, SlidesWhereTheForceExceedsItsFriction) {
  const double mu = 0.4;
  const Vec3 size(0.6, 0.5, 0.2);
  for (const double share : {0.98, 1.5}) {
    World world({1.0 / 240.0, Vec3(0, 0, -kGravity)});
    addFloor(world, mu);
    const double mass = 1000.0 * size.prod();
    const double force = share * mu * mass * kGravity;
    const Pose X = lyingBox(size, Quat::Identity(), 0.3);
    const int block = addLoaded(world, Solid::box(size), X, {.force_W = Vec3(force, 0, 0)}, mu);
    ASSERT_TRUE(world.start().empty());
    run(world, 2.0);
    const BodyState& state = world.states()[static_cast<std::size_t>(block)];
    const double a = std::max(0.0, share - 1.0) * mu * kGravity;
    if (share < 1.0) {
      EXPECT_EQ(state.mode, Mode::kResting);
      EXPECT_LT((state.X_WB.position - X.position).norm(), 1e-6);
    } else {
      EXPECT_NEAR(state.linear_velocity.x() / (2.0 * a), 1.0, 1e-4);
      EXPECT_NEAR(world.audit().work_J / (force * 2.0 * a), 1.0, 1e-3);
    }
  }
}

TEST(GivenMass, ScalesTheDensity) {
  World world({1.0 / 60.0, kNoGravity});
  BodyDescription d;
  d.solid = world.addSolid(Solid::box(Vec3(0.5, 0.4, 0.3)));
  d.mass_kg = 7.5;
  const int box = world.addBody(d);
  EXPECT_NEAR(world.mass(box), 7.5, 1e-14);
  EXPECT_NEAR(world.bodies()[0].material.density_kgpm3, 7.5 / 0.06, 1e-10);
}

// In air its work is found halfway through each step. From standstill v = F / (m w) (sin w t, 1 - cos w t).
TEST(ForceInTheBodysAxes, DoesTheWorkOfTheClosedFormInAirToo) {
  WorldSettings settings{1.0 / 60.0, kNoGravity};
  settings.air.density_kgpm3 = 1e-9;
  World world(settings);
  BodyDescription d;
  d.solid = world.addSolid(Solid::ball(0.2));
  const double mass = 1000.0 * world.solids()[0].volume();
  const double w = 10.0, force = 10.0;
  d.material = rubbing(0.5);
  d.angular_velocity = Vec3(0, 0, w);
  d.load.force_B = Vec3(force, 0, 0);
  world.addBody(d);
  ASSERT_TRUE(world.start().empty());
  const double before = energyOf(world), most = 2.0 * force * force / (mass * w * w);
  for (int i = 1; i <= 60; ++i) {
    world.step();
    const double gained = 0.5 * most * (1.0 - std::cos(w * i / 60.0));
    EXPECT_NEAR(energyOf(world) - before, gained, 0.02 * most) << i;
    EXPECT_NEAR(world.audit().work_J, gained, 0.02 * most) << i;
  }
}

}  // namespace
}  // namespace carom::physics
