// Falling through air against the closed form: v(t) = v_t tanh(g t / v_t) with v_t = sqrt(2 m g / (rho C_d
// A)), for a ball, a cube and a plate falling flat and a capsule across and along its fall, at steps from
// 1/30 to 1/240 s.

#include "tests/physics/small_world.h"

namespace carom::physics {
namespace {

constexpr double kAir = 1.2;

struct Faller {
  const char* name;
  Solid solid;
  Quat turn;
  double density;
  double drag_area_m2;  ///< C_d A.
};

std::vector<Faller> fallers() {
  const Quat straight = Quat::Identity();
  const Quat level = oracle::turned(Vec3::UnitX(), radians(90.0));
  const double ball = std::numbers::pi * 0.11 * 0.11, end = std::numbers::pi * 0.05 * 0.05;
  return {{"ball", Solid::ball(0.11), straight, 77.0, 0.47 * ball},
          {"cube", Solid::box(Vec3(0.3, 0.3, 0.3)), straight, 40.0, 1.05 * 0.09},
          {"plate", Solid::box(Vec3(0.6, 0.5, 0.01)), straight, 300.0, 1.05 * 0.3},
          {"capsule along", Solid::capsule(0.05, 0.4), straight, 100.0, 0.47 * end},
          {"capsule across", Solid::capsule(0.05, 0.4), level, 100.0, 1.1 * 0.1 * 0.4 + 0.47 * end}};
}

SmallWorld airWorld(double rate_hz, const Vec3& wind = Vec3::Zero()) {
  WorldSettings settings{1.0 / rate_hz};
  settings.air = {kAir, wind, 0.0};
  return SmallWorld(settings);
}

int drop(SmallWorld& world, const Faller& f) {
  Placement p{f.solid};
  p.X_WB = {f.turn, Vec3(0.0, 0.0, 1000.0)};
  p.material.density_kgpm3 = f.density;
  return world.add(p);
}

double terminalSpeed(const Faller& f) {
  return std::sqrt(2.0 * f.density * f.solid.volume() * kGravity / (kAir * f.drag_area_m2));
}

TEST(TerminalVelocity, SpeedFollowsTanhToATenthOfAPercentAtEveryStep) {
  for (const Faller& f : fallers()) {
    const double v_t = terminalSpeed(f);
    for (double rate : {30.0, 60.0, 120.0, 240.0}) {
      SmallWorld world = airWorld(rate);
      const int body = drop(world, f);
      world.start();
      double worst = 0.0;
      while (world.time() < 4.0 * v_t / kGravity) {
        world.step();
        const double expected = v_t * std::tanh(kGravity * world.time() / v_t);
        worst = std::max(worst, std::abs(-world.velocity(body).z() / expected - 1.0));
      }
      EXPECT_LT(worst, 1e-3) << f.name << " at " << rate << " Hz";
      RecordProperty(std::string(f.name) + " at " + std::to_string(static_cast<int>(rate)),
                     std::to_string(worst));
    }
  }
}

TEST(TerminalVelocity, TerminalSpeedIsThatOfTheClosedFormAndStaysThere) {
  for (const Faller& f : fallers()) {
    const double v_t = terminalSpeed(f);
    for (double rate : {30.0, 60.0, 120.0, 240.0}) {
      SmallWorld world = airWorld(rate);
      const int body = drop(world, f);
      world.start();
      world.run(20.0 * v_t / kGravity);
      EXPECT_NEAR(-world.velocity(body).z() / v_t, 1.0, 1e-9) << f.name << " at " << rate << " Hz";
    }
  }
}

TEST(TerminalVelocity, DistanceIsTheIntegralOfTheSpeed) {
  for (const Faller& f : fallers()) {
    const double v_t = terminalSpeed(f);
    SmallWorld world = airWorld(60.0);
    const int body = drop(world, f);
    world.start();
    world.run(2.0);
    const double expected = v_t * v_t / kGravity * std::log(std::cosh(kGravity * 2.0 / v_t));
    EXPECT_NEAR((1000.0 - world.position(body).z()) / expected, 1.0, 1e-3) << f.name;
  }
}

TEST(TerminalVelocity, AnySpeedAtAnyStepIsOnlyBraked) {
  for (const Faller& f : fallers()) {
    for (double speed : {50.0, 1000.0, 1e5}) {
      WorldSettings settings{1.0 / 30.0, Vec3::Zero()};
      settings.air = {kAir, Vec3::Zero(), 0.0};
      SmallWorld world(settings);
      Placement p{f.solid};
      p.X_WB.rotation = oracle::turned(Vec3(1.0, 2.0, 3.0), 0.7);
      p.material.density_kgpm3 = f.density;
      p.velocity = Vec3(speed, 0.3 * speed, -0.2 * speed);
      p.spin = Vec3(1.0, 20.0, -3.0);
      const int body = world.add(p);
      world.start();
      double energy = world.world().audit().kinetic_energy_J;
      for (int i = 0; i < 60; ++i) {
        world.step();
        const double now = world.world().audit().kinetic_energy_J;
        ASSERT_LE(now, energy * (1.0 + 1e-9)) << f.name << " at " << speed << " m/s, step " << i;
        energy = now;
      }
      EXPECT_LT(world.velocity(body).norm(), speed) << f.name;
    }
  }
}

TEST(TerminalVelocity, SpeedInAConstantStreamDecaysAsOneOverOnePlusCVT) {
  const Faller f = fallers()[0];
  WorldSettings settings{1.0 / 30.0, Vec3::Zero()};
  settings.air = {kAir, Vec3::Zero(), 0.0};
  SmallWorld world(settings);
  Placement p{f.solid};
  p.material.density_kgpm3 = f.density;
  p.velocity = Vec3(300.0, 0.0, 0.0);
  const int body = world.add(p);
  world.start();
  world.run(1.0);
  const double c = 0.5 * kAir * f.drag_area_m2 / (f.density * f.solid.volume());
  EXPECT_NEAR(world.velocity(body).x(), 300.0 / (1.0 + c * 300.0), 1e-6);
}

}  // namespace
}  // namespace carom::physics
