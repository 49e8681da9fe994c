// A kinematic body that leaves others no room: it stops, and is late, rather than press without bound. What
// it does is paid for, and no more than what it takes to bring bodies to its speed, again and again.

#include "tests/physics/small_world.h"

namespace carom::physics {
namespace {

constexpr double kRoom = 1.0;       // under the piston, m
constexpr double kBlocked_s = 0.3;  // at the end

struct Pressed {
  std::string name;
  Solid solid;
  Pose X_WB;
};

std::vector<Pressed> pressedBodies() {
  const auto boxAt = [](const Vec3& p) {
    return ConvexPart{boxPolyhedron(Vec3(0.4, 0.3, 0.2)).translated(p), 0.0};
  };
  return {{"ball", Solid::ball(0.2), {Quat::Identity(), Vec3(0.03, 0.02, 0.25)}},
          {"box", Solid::box(Vec3(0.3, 0.3, 0.3)), {Quat::Identity(), Vec3(0.0, 0.0, 0.16)}},
          {"tilted box",
           Solid::box(Vec3(0.3, 0.4, 0.3)),
           {oracle::turned(Vec3(1.0, 2.0, 0.5).normalized(), 0.6), Vec3(0.0, 0.0, 0.36)}},
          {"step",
           Solid({boxAt(Vec3::Zero()), boxAt(Vec3(0.2, 0.0, 0.2))}),
           {oracle::turned(Vec3(1.0, -1.0, 0.3).normalized(), 0.4), Vec3(0.0, 0.0, 0.4)}}};
}

class PistonWorld {
 public:
  PistonWorld(double speed_mps, const Material& material, double rate_hz)
      : world(WorldSettings{1.0 / rate_hz, Vec3(0.0, 0.0, -kGravity)}) {
    BodyDescription piston;
    piston.solid = world.addSolid(Solid::box(Vec3(1.0, 1.0, 0.3)));
    piston.X_WB.position = Vec3(0.0, 0.0, kRoom + 0.15);
    piston.linear_velocity = Vec3(0.0, 0.0, -speed_mps);
    piston.material = material;
    piston.is_kinematic = true;
    world.addBody(piston);
    BodyDescription floor;
    floor.solid = world.addSolid(Solid::box(Vec3(8.0, 8.0, 1.0)));
    floor.X_WB.position = Vec3(0.0, 0.0, -0.5);
    floor.material = material;
    floor.is_static = true;
    world.addBody(floor);
  }
  int add(const Pressed& pressed, const Material& material, const Vec3& velocity = Vec3::Zero()) {
    BodyDescription body;
    body.solid = world.addSolid(pressed.solid);
    body.X_WB = pressed.X_WB;
    body.linear_velocity = velocity;
    body.material = material;
    return world.addBody(body);
  }
  double gained() const {
    const Audit audit = world.audit();
    return audit.kinetic_energy_J + audit.potential_energy_J - audit.work_J;
  }
  World world;
};

// Steps on, and expects that nothing overlaps, and that no energy comes from nowhere but what opening gaps
// lifts a body by.
void expectAllIsPaid(PistonWorld& w, int body, double seconds) {
  const double lift_J = w.world.mass(body) * kGravity * 1.1e-3;
  double least = w.gained();
  const int steps = static_cast<int>(std::ceil(seconds / w.world.settings().step_s));
  for (int i = 0; i < steps; ++i) {
    w.world.step();
    ASSERT_GT(w.world.audit().smallest_gap_m, 0.0) << w.world.time();
    ASSERT_LE(w.gained(), least + lift_J + 1e-9 * std::abs(least)) << w.world.time();
    least = std::min(least, w.gained());
  }
}

// To the speed of the piston a body is brought by m u^2 of work, of which half is its own. With restitution
// e <= 1/2 it comes back at no more than u / (1 - e) - u, so that a stroke takes (1 + e) / (1 - e) m u^2, and
// every stroke leaves at most a quarter of the room: eight until the floor of the gap. A body that turns over
// is struck at its corners, each time with less than its mass.
double mostWork(double mass_kg, double speed_mps) {
  const double strokes = 8.0, of_one = 3.0;
  return mass_kg * (strokes * of_one * speed_mps * speed_mps + 2.0 * kGravity * kRoom);
}

TEST(PistonAgainstAWall, StopsAtWhatItPresses_AndDoesNoMoreWorkThanThatTakesUp) {
  for (const double u : {0.3, 1.0, 20.0})
    for (const double friction : {0.0, 0.5})
      for (const double e : {0.0, 0.5})
        for (const Pressed& pressed : pressedBodies()) {
          SCOPED_TRACE(pressed.name + ", " + std::to_string(u) + " m/s, friction " +
                       std::to_string(friction) + ", restitution " + std::to_string(e));
          const Material material = rubbing(friction, e);
          PistonWorld w(u, material, 120.0);
          const int body = w.add(pressed, material);
          ASSERT_TRUE(w.world.start().empty());
          expectAllIsPaid(w, body, kRoom / u + kBlocked_s);
          const Audit audit = w.world.audit();
          // Friction that jams what bounces makes levers of its corners: that work is paid for, but has no
          // such bound.
          if (friction == 0.0 || e == 0.0 || pressed.name == "ball") {
            EXPECT_LE(audit.work_J, mostWork(w.world.mass(body), u));
          }
          EXPECT_GE(audit.kinematic_late_s, kBlocked_s);
          EXPECT_GT(audit.last_step.stopped_kinematic, 0);
          EXPECT_LT(w.world.states()[static_cast<std::size_t>(body)].linear_velocity.norm(), 2.0 * u + 1.0);
        }
}

// Between the two an elastic ball gains speed with every stroke, which is work, to the rounding.
TEST(PistonAgainstAWall, PaysForWhatAnElasticBallGains) {
  const Material elastic = rubbing(0.0, 1.0);
  PistonWorld w(1.0, elastic, 240.0);
  w.add(pressedBodies().front(), elastic, Vec3(0.0, 0.0, 3.0));
  ASSERT_TRUE(w.world.start().empty());
  const double start = w.gained();
  while (w.world.time() < 0.5)  // then 0.1 m of room are left
    w.world.step();
  const Audit audit = w.world.audit();
  EXPECT_GT(audit.work_J, 100.0);
  EXPECT_NEAR(w.gained(), start, 1e-9 * audit.work_J);
  EXPECT_EQ(audit.kinematic_late_s, 0.0);
}

// A gate holds what the press pushes, and opens: the press is late, and goes on.
TEST(KinematicPress, GoesOnWhenTheWayIsFree) {
  for (const double u : {0.05, 1.0, 10.0})
    for (const double e : {0.0, 0.5}) {
      SCOPED_TRACE(std::to_string(u) + " m/s, restitution " + std::to_string(e));
      World world(WorldSettings{1.0 / 240.0, Vec3::Zero()});
      const auto addBox = [&](const Vec3& p, bool is_kinematic) {
        BodyDescription d;
        d.solid = world.addSolid(Solid::box(Vec3(0.4, 0.4, 0.4)));
        d.X_WB.position = p;
        d.material = rubbing(0.0, e);
        d.is_kinematic = is_kinematic;
        return d;
      };
      BodyDescription press = addBox(Vec3(0.0, 0.0, -0.5), true);
      press.linear_velocity = Vec3(0.0, 0.0, u);
      const auto pressed_at = static_cast<std::size_t>(world.addBody(press));
      const auto box = static_cast<std::size_t>(world.addBody(addBox(Vec3::Zero(), false)));
      BodyDescription gate = addBox(Vec3(0.0, 0.0, 0.45), true);
      const double opens_s = 0.15 / u + 0.4, open_s = opens_s + 0.1;
      gate.keyframes = {
          {0.0, gate.X_WB}, {opens_s, gate.X_WB}, {open_s, {Quat::Identity(), Vec3(9.0, 0.0, 0.45)}}};
      world.addBody(gate);
      ASSERT_TRUE(world.start().empty());
      while (world.time() < opens_s) world.step();
      EXPECT_GE(world.audit().kinematic_late_s, 0.2);
      const double from_m = world.states()[pressed_at].X_WB.position.z();
      while (world.time() < open_s + 0.5) world.step();
      EXPECT_GE(world.states()[pressed_at].X_WB.position.z() - from_m, 0.45 * u);
      EXPECT_GE(world.states()[box].linear_velocity.z(), 0.99 * u);
      EXPECT_LE(world.states()[box].linear_velocity.z(), 1.01 * (1.0 + e) * u);
    }
}

// A plate that speeds up under a box is stopped within a step, by a column between it and a lid: the box has
// the speed that the plate had then, and only falls from there on.
TEST(KinematicPress, PressesNoLongerThanItMoves) {
  constexpr double kLeg_s = 0.4, kAcceleration_mps2 = 4.0 / (kLeg_s * kLeg_s);  // over a metre
  for (const double room : {0.05, 0.0744, 0.1, 0.1245})
    for (const double friction : {0.0, 0.5}) {
      SCOPED_TRACE(std::to_string(room) + " m of room, friction " + std::to_string(friction));
      World world(WorldSettings{1.0 / 60.0, Vec3(0.0, 0.0, -kGravity)});
      const auto add = [&](const Vec3& size, const Vec3& p, bool is_kinematic, bool is_static) {
        BodyDescription d;
        d.solid = world.addSolid(Solid::box(size));
        d.X_WB.position = p;
        d.material = rubbing(friction, 0.0);
        d.is_kinematic = is_kinematic;
        d.is_static = is_static;
        if (is_kinematic) {
          d.keyframes = {{0.0, d.X_WB}, {kLeg_s, {Quat::Identity(), p + Vec3(0.0, 0.0, 1.0)}}};
          d.interpolation = Interpolation::kSmooth;
        }
        return static_cast<std::size_t>(world.addBody(d));
      };
      add(Vec3(2.0, 1.0, 0.2), Vec3::Zero(), true, false);
      const std::size_t box = add(Vec3(0.4, 0.4, 0.4), Vec3(-0.5, 0.0, 0.3001), false, false);
      add(Vec3(0.3, 0.3, 1.0), Vec3(0.5, 0.0, 0.6001), false, false);
      add(Vec3(1.0, 1.0, 0.2), Vec3(0.5, 0.0, 1.2001 + room), false, true);
      ASSERT_TRUE(world.start().empty());
      while (world.audit().kinematic_late_s == 0.0 && world.time() < kLeg_s) world.step();
      const double late_s = world.audit().kinematic_late_s;
      ASSERT_GT(late_s, 0.0);
      const double speed_mps = kAcceleration_mps2 * (world.time() - late_s);
      // The column is caught within a tenth of a millimetre, for which time the box is pressed or not.
      EXPECT_NEAR(world.states()[box].linear_velocity.z(), speed_mps - kGravity * late_s,
                  (kAcceleration_mps2 + kGravity) * 1e-4 / speed_mps);
    }
}

}  // namespace
}  // namespace carom::physics
