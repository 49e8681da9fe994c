// Wind and currents: bodies take the stream's velocity, by the closed form where there is one.

#include "tests/physics/small_world.h"

namespace carom::physics {
namespace {

TEST(Stream, WindCarriesALightBallToItsVelocityByTheClosedForm) {
  WorldSettings settings{1.0 / 60.0, Vec3::Zero()};
  settings.air = {1.2, Vec3(3.0, -4.0, 0.0), 0.0};
  SmallWorld world(settings);
  Placement p{Solid::ball(0.2)};
  p.material.density_kgpm3 = 3.0;
  const int ball = world.add(p);
  world.start();
  const double mass = 3.0 * p.solid.volume();
  const double c = 0.5 * 1.2 * 0.47 * std::numbers::pi * 0.04 / mass;
  for (double t : {0.5, 2.0, 10.0}) {
    world.run(t - world.time());
    const Vec3 behind = settings.air.wind - world.velocity(ball);
    EXPECT_NEAR(behind.norm(), 5.0 / (1.0 + c * 5.0 * t), 1e-9) << t << " s";
  }
}

TEST(Stream, ACurrentCarriesFloatingBodiesToItsVelocity) {
  WorldSettings settings{1.0 / 120.0};
  Fluid stream;
  stream.flow = Vec3(0.8, 0.3, 0.0);
  settings.fluids.push_back(stream);
  SmallWorld world(settings);
  std::vector<int> bodies;
  const std::vector<Solid> solids{Solid::box(Vec3(0.6, 0.5, 0.3)), Solid::ball(0.2),
                                  Solid::capsule(0.1, 0.5)};
  for (std::size_t i = 0; i < solids.size(); ++i) {
    Placement p{solids[i]};
    p.X_WB.position = Vec3(0.0, 3.0 * static_cast<double>(i), 0.0);
    p.X_WB.rotation = oracle::turned(Vec3::UnitX(), i == 2 ? radians(90.0) : 0.0);
    p.material.density_kgpm3 = 500.0;
    bodies.push_back(world.add(p));
  }
  world.start();
  world.run(60.0);
  for (int body : bodies) {
    EXPECT_LT((world.velocity(body) - stream.flow).norm(), 1e-4) << body;
    EXPECT_FALSE(world.rests(body)) << body;
  }
}

TEST(Stream, AFallingPlateDroppedOnEdgeTurnsOver) {
  WorldSettings settings{1.0 / 240.0};
  settings.air = {1.2, Vec3::Zero(), 0.0};
  SmallWorld world(settings);
  Placement p{Solid::box(Vec3(0.4, 0.3, 0.004))};
  p.material.density_kgpm3 = 300.0;
  p.X_WB = {oracle::turned(Vec3::UnitY(), radians(80.0)), Vec3(0.0, 0.0, 200.0)};
  const int plate = world.add(p);
  world.start();
  double fastest = 0.0, flattest = 1.0;
  while (world.time() < 6.0) {
    world.step();
    fastest = std::max(fastest, world.velocity(plate).norm());
    const Vec3 normal = world.state(plate).X_WB.rotation * Vec3::UnitZ();
    flattest = std::min(flattest, std::hypot(normal.x(), normal.y()));
  }
  EXPECT_LT(flattest, 0.2) << "it has been broadside to its fall";
  EXPECT_LT(fastest, 40.0);
}

TEST(Stream, WindPushesACrateOverTheFloorOnlyWhenItBeatsFriction) {
  // 1/2 rho C_d A u^2 against mu m g: 22 m/s move a crate of 1 m and 60 kg at mu = 0.5, 20 m/s do not.
  for (double speed : {20.0, 24.0}) {
    WorldSettings settings{1.0 / 240.0};
    settings.air = {1.2, Vec3(speed, 0.0, 0.0), 0.0};
    SmallWorld world(settings);
    world.addPlane(rubbing(0.5));
    Placement p{Solid::box(Vec3(1.0, 1.0, 1.0))};
    p.X_WB = lyingBox(Vec3(1.0, 1.0, 1.0), Quat::Identity(), 0.0);
    p.material = rubbing(0.5);
    p.material.density_kgpm3 = 60.0;
    const int crate = world.add(p);
    world.start();
    world.run(3.0);
    if (speed < 21.6) {
      EXPECT_TRUE(world.rests(crate));
      EXPECT_LT(std::abs(world.position(crate).x()), 1e-3);
    } else {
      // The first second by a = (F(u) - mu m g) / m, with u hardly less than the wind.
      EXPECT_GT(world.position(crate).x(), 0.5);
      EXPECT_FALSE(world.rests(crate));
    }
  }
}

// What bore it in the last step bears nothing in flight: a ball that has rolled off a table, in next to no
// air, goes in each step by the mean of its velocities before and after.
TEST(Stream, WhatHasLeftItsSupportFallsEvenly) {
  WorldSettings settings{1.0 / 60.0};
  settings.air.density_kgpm3 = 1e-9;
  SmallWorld world(settings);
  Placement table{Solid::box(Vec3(1.0, 1.0, 1.0))};
  table.X_WB.position = Vec3(0.0, 0.0, -0.5);
  table.material = rubbing(0.0);
  table.is_static = true;
  world.add(table);
  Placement p{Solid::ball(0.2)};
  p.X_WB.position = Vec3(-0.3, 0.0, 0.2 + restGap(0.4));
  p.velocity = Vec3(2.0, 0.0, 0.0);
  p.material = rubbing(0.0);
  const int ball = world.add(p);
  world.start();
  world.run(0.55);
  ASSERT_GT(world.position(ball).x(), 0.75) << "beyond the edge";
  for (int i = 0; i < 20; ++i) {
    const Vec3 from = world.position(ball), before = world.velocity(ball);
    world.step();
    const Vec3 way = 0.5 / 60.0 * (before + world.velocity(ball));
    EXPECT_LT((world.position(ball) - from - way).norm(), 1e-9) << i;
    EXPECT_NEAR((world.velocity(ball) - before).z(), settings.gravity.z() / 60.0, 1e-9) << i;
  }
}

}  // namespace
}  // namespace carom::physics
