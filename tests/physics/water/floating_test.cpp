// Floating against closed forms: draft, heave period, energy, and the orientation of a square bar.

#include "tests/physics/small_world.h"

namespace carom::physics {
namespace {

constexpr double kWater = 1000.0;

struct Pool {
  double rate_hz = 240.0;
  double drag = 1.0;
  double linear_drag = 0.05;
  bool resting = false;
};

SmallWorld poolWorld(const Pool& pool) {
  WorldSettings settings{1.0 / pool.rate_hz, Vec3(0.0, 0.0, -kGravity), pool.resting};
  Fluid water;
  water.density_kgpm3 = kWater;
  water.drag = pool.drag;
  water.linear_drag_mps = pool.linear_drag;
  settings.fluids.push_back(water);
  return SmallWorld(settings);
}

Placement floater(const Solid& solid, double density, const Vec3& position) {
  Placement p{solid};
  p.X_WB.position = position;
  p.material.density_kgpm3 = density;
  return p;
}

// A flat box, stable as it lies, of height h: it sinks to h rho_b / rho_f.
TEST(Floating, DraftIsTheRatioOfTheDensities) {
  const double height = 0.4;
  for (double density : {150.0, 400.0, 650.0, 900.0}) {
    for (double rate : {60.0, 240.0}) {
      SmallWorld world = poolWorld({.rate_hz = rate, .linear_drag = 0.6});
      const int body = world.add(floater(Solid::box(Vec3(1.6, 1.3, height)), density, Vec3(0.3, 0.2, 0.1)));
      world.start();
      world.run(40.0);
      const double draft = 0.5 * height - world.position(body).z();
      EXPECT_NEAR(draft, height * density / kWater, 1e-6) << density << " kg/m^3 at " << rate << " Hz";
    }
  }
}

// The mean time between upward crossings of the equilibrium.
double heavePeriod(double rate_hz, double height, double density) {
  SmallWorld world = poolWorld({.rate_hz = rate_hz, .drag = 0.0, .linear_drag = 0.0});
  const double draft = height * density / kWater;
  const double level = 0.5 * height - draft;
  const int body =
      world.add(floater(Solid::box(Vec3(1.6, 1.6, height)), density, Vec3(0.0, 0.0, level + 0.05 * height)));
  world.start();
  double before = 0.05 * height, first = -1.0, last = -1.0;
  int crossings = 0;
  while (world.time() < 20.0) {
    world.step();
    const double now = world.position(body).z() - level;
    if (before < 0.0 && now >= 0.0) {
      last = world.time() - now / (now - before) / rate_hz;
      if (crossings++ == 0) first = last;
    }
    before = now;
  }
  return (last - first) / (crossings - 1);
}

TEST(Floating, HeavePeriodIsTwoPiRootDraftOverG) {
  for (double rate : {30.0, 60.0, 120.0, 240.0})
    for (double density : {300.0, 500.0, 800.0}) {
      const double height = 0.5;
      const double expected = 2.0 * std::numbers::pi * std::sqrt(height * density / kWater / kGravity);
      EXPECT_NEAR(heavePeriod(rate, height, density) / expected, 1.0, 1e-3)
          << density << " kg/m^3 at " << rate << " Hz";
    }
}

TEST(Floating, WithoutDragTheEnergyOfARollingBobStaysForAMinute) {
  for (double rate : {60.0, 240.0}) {
    SmallWorld world = poolWorld({.rate_hz = rate, .drag = 0.0, .linear_drag = 0.0});
    Placement p = floater(Solid::box(Vec3(1.2, 0.8, 0.5)), 500.0, Vec3(0.0, 0.0, 0.12));
    p.X_WB.rotation = oracle::turned(Vec3(1.0, 0.6, 0.1), 0.35);
    world.add(p);
    world.start();
    const Audit begin = world.world().audit();
    const double energy = begin.kinetic_energy_J + begin.potential_energy_J;
    double moved = 0.0, worst = 0.0, worst_late = 0.0;
    while (world.time() < 60.0) {
      world.step();
      const Audit now = world.world().audit();
      moved = std::max(moved, now.kinetic_energy_J);
      const double error = std::abs(now.kinetic_energy_J + now.potential_energy_J - energy);
      (world.time() < 30.0 ? worst : worst_late) = std::max(world.time() < 30.0 ? worst : worst_late, error);
    }
    ASSERT_GT(moved, 20.0) << "it bobs";
    EXPECT_LT(worst, 0.01 * moved) << rate << " Hz";
    EXPECT_LT(worst_late, 0.01 * moved) << rate << " Hz";
  }
}

// How far a long bar of square section turns about its axis from upright, degrees (0 .. 45).
double settledRoll(double share) {
  SmallWorld world = poolWorld({.rate_hz = 120.0, .drag = 1.0, .linear_drag = 0.15});
  Placement p = floater(Solid::box(Vec3(6.0, 1.0, 1.0)), share * kWater, Vec3(0.0, 0.0, 0.5 - share));
  p.X_WB.rotation = oracle::turned(Vec3::UnitX(), radians(1.5));
  const int body = world.add(p);
  world.start();
  world.run(150.0);
  const Vec3 side = world.state(body).X_WB.rotation * Vec3::UnitY();
  const double turn = std::atan2(side.z(), side.y()) * 180.0 / std::numbers::pi;
  return std::abs(turn - 90.0 * std::round(turn / 90.0));
}

// The roots of 6 s^2 - 6 s + 1: where the metacentre of the upright bar passes its centre of mass.
TEST(Floating, ASquareBarFloatsUprightOnlyBelow0Point2113AndAbove0Point7887) {
  EXPECT_LT(settledRoll(0.2113 - 0.005), 0.2);
  EXPECT_GT(settledRoll(0.2113 + 0.005), 4.0);
  EXPECT_GT(settledRoll(0.7887 - 0.005), 4.0);
  EXPECT_LT(settledRoll(0.7887 + 0.005), 0.2);
}

TEST(Floating, ASquareBarFloatsOnEdgeBetweenNineAndTwentyThree32nds) {
  EXPECT_LT(settledRoll(9.0 / 32.0 - 0.005), 44.0);
  EXPECT_NEAR(settledRoll(9.0 / 32.0 + 0.005), 45.0, 0.2);
  EXPECT_NEAR(settledRoll(0.5), 45.0, 0.1);
  EXPECT_NEAR(settledRoll(23.0 / 32.0 - 0.005), 45.0, 0.2);
  EXPECT_LT(settledRoll(23.0 / 32.0 + 0.005), 44.0);
}

TEST(Floating, ANeutralBodyStaysWhereItIsPut) {
  const Solid compound({{boxPolyhedron(Vec3(0.4, 0.3, 0.2)), 0.0},
                        {boxPolyhedron(Vec3(0.2, 0.2, 0.5)).translated(Vec3(0.3, 0.0, 0.0)), 0.0}});
  const std::vector<Solid> solids{Solid::box(Vec3(0.5, 0.4, 0.3)), Solid::ball(0.2), Solid::capsule(0.1, 0.4),
                                  compound, Solid::roundedBox(Vec3(0.5, 0.4, 0.3), 0.05)};
  SmallWorld world = poolWorld({.rate_hz = 60.0});
  std::vector<int> bodies;
  for (std::size_t i = 0; i < solids.size(); ++i) {
    Placement p = floater(solids[i], kWater, Vec3(2.0 * static_cast<double>(i), 0.0, -1.7));
    p.X_WB.rotation = oracle::turned(Vec3(1.0, 2.0, 0.5), 0.4);
    bodies.push_back(world.add(p));
  }
  world.start();
  std::vector<Pose> begin;
  for (int body : bodies) begin.push_back(world.state(body).X_WB);
  world.run(60.0);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    EXPECT_LT((world.position(bodies[i]) - begin[i].position).norm(), 1e-6) << i;
    EXPECT_LT(world.state(bodies[i]).X_WB.rotation.angularDistance(begin[i].rotation), 1e-6) << i;
  }
}

TEST(Floating, AFloatingBodyComesToRestAndLiesAtItsDraft) {
  SmallWorld world = poolWorld({.rate_hz = 120.0, .linear_drag = 0.3, .resting = true});
  const int box = world.add(floater(Solid::box(Vec3(1.0, 1.0, 0.4)), 500.0, Vec3(0.0, 0.0, 0.25)));
  const int ball = world.add(floater(Solid::ball(0.3), 500.0, Vec3(3.0, 0.0, 0.3)));
  world.start();
  world.run(60.0);
  EXPECT_TRUE(world.rests(box));
  EXPECT_TRUE(world.rests(ball));
  EXPECT_NEAR(world.position(box).z(), 0.0, 1e-4);
  EXPECT_NEAR(world.position(ball).z(), 0.0, 1e-4);
}

TEST(Floating, WhatIsPressedUnderDoesNotRestThere) {
  SmallWorld world = poolWorld({.rate_hz = 120.0, .resting = true});
  const int box = world.add(floater(Solid::box(Vec3(1.0, 1.0, 0.4)), 990.0, Vec3(0.0, 0.0, -5.0)));
  world.start();
  world.run(2.0);
  EXPECT_FALSE(world.rests(box));
  EXPECT_GT(world.velocity(box).z(), 0.01);
}

}  // namespace
}  // namespace carom::physics
