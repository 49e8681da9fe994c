// Entering and leaving water: the water's work is continuous, so that without drag the energy of what falls
// in and shoots out again stays; and with drag nothing is thrown back.

#include "tests/physics/small_world.h"

namespace carom::physics {
namespace {

SmallWorld stillWater(double rate_hz, double drag, double linear_drag) {
  WorldSettings settings{1.0 / rate_hz, Vec3(0.0, 0.0, -kGravity), false};
  Fluid water;
  water.drag = drag;
  water.linear_drag_mps = linear_drag;
  settings.fluids.push_back(water);
  return SmallWorld(settings);
}

struct Diver {
  const char* name;
  Solid solid;
  double tilt;
};

std::vector<Diver> divers() {
  return {{"flat box", Solid::box(Vec3(0.8, 0.8, 0.4)), 0.0},
          {"box on its corner", Solid::box(Vec3(0.6, 0.5, 0.4)), 0.6},
          {"ball", Solid::ball(0.3), 0.0},
          {"capsule", Solid::capsule(0.15, 0.4), 0.8}};
}

int throwIn(SmallWorld& world, const Diver& diver, double height, double density = 600.0) {
  Placement p{diver.solid};
  p.X_WB = {oracle::turned(Vec3(1.0, 0.5, 0.0), diver.tilt), Vec3(0.0, 0.0, height)};
  p.material.density_kgpm3 = density;
  return world.add(p);
}

TEST(WaterEntry, WithoutDragTheEnergyIsTheSameBeforeUnderAndAfter) {
  for (const Diver& diver : divers()) {
    for (double rate : {60.0, 240.0}) {
      SmallWorld world = stillWater(rate, 0.0, 0.0);
      throwIn(world, diver, 1.5);
      world.start();
      const auto energy = [&] {
        const Audit now = world.world().audit();
        return now.kinetic_energy_J + now.potential_energy_J;
      };
      const double begin = energy();
      double worst = 0.0;
      while (world.time() < 6.0) {
        world.step();
        worst = std::max(worst, std::abs(energy() - begin));
      }
      const double fall = 600.0 * diver.solid.volume() * kGravity * 1.5;
      EXPECT_LT(worst, (rate < 100.0 ? 0.02 : 0.004) * fall) << diver.name << " at " << rate << " Hz";
    }
  }
}

TEST(WaterEntry, WithDragEnergyOnlyFallsAndNothingIsThrownBack) {
  for (const Diver& diver : divers()) {
    for (double rate : {30.0, 60.0, 240.0}) {
      SmallWorld world = stillWater(rate, 1.0, 0.05);
      const int body = throwIn(world, diver, 6.0);
      world.start();
      double before = world.world().audit().kinetic_energy_J + world.world().audit().potential_energy_J;
      const double begin = before;
      bool wet = false;
      while (world.time() < 5.0) {
        world.step();
        const Audit now = world.world().audit();
        const double energy = now.kinetic_energy_J + now.potential_energy_J;
        ASSERT_LT(energy, before + 0.004 * begin) << diver.name << " at " << rate << " Hz";
        before = energy;
        wet = wet || world.position(body).z() < 0.0;
        ASSERT_FALSE(wet && world.velocity(body).z() > 3.0) << diver.name << " at " << rate << " Hz";
      }
      EXPECT_LT(std::abs(world.position(body).z()), 0.5) << diver.name << " floats";
    }
  }
}

TEST(WaterEntry, TheSameDiveAtEveryRate) {
  for (const Diver& diver : divers()) {
    std::vector<double> depths;
    for (double rate : {60.0, 120.0, 480.0}) {
      SmallWorld world = stillWater(rate, 1.0, 0.05);
      const int body = throwIn(world, diver, 4.0);
      world.start();
      double depth = 0.0;
      while (world.time() < 3.0) {
        world.step();
        depth = std::max(depth, -world.position(body).z());
      }
      depths.push_back(depth);
    }
    EXPECT_NEAR(depths[0] / depths[2], 1.0, 0.03) << diver.name;
    EXPECT_NEAR(depths[1] / depths[2], 1.0, 0.015) << diver.name;
  }
}

TEST(WaterEntry, AddedMassSlowsWhatIsLetGoUnderWater) {
  // a = g (rho_f - rho_b) / (rho_b + c rho_f) at first, with c = 1/2 for a ball.
  WorldSettings settings{1.0 / 240.0, Vec3(0.0, 0.0, -kGravity), false};
  Fluid water;
  water.drag = water.linear_drag_mps = 0.0;
  water.added_mass = 0.5;
  settings.fluids.push_back(water);
  SmallWorld world(settings);
  const int body = throwIn(world, divers()[2], -20.0, 200.0);
  world.start();
  world.run(1.0);
  EXPECT_NEAR(world.velocity(body).z(), kGravity * 800.0 / (200.0 + 500.0), 1e-9);
}

}  // namespace
}  // namespace carom::physics
