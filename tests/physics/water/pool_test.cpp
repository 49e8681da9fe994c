// Many bodies in a pool, bodies on its floor, waves: contacts and rest in water.

#include "tests/oracle/overlap_oracle.h"
#include "tests/physics/small_world.h"

namespace carom::physics {
namespace {

WorldSettings poolSettings(double rate_hz) {
  WorldSettings settings{1.0 / rate_hz};
  Fluid water;
  water.min = Vec3(-2.5, -2.5, -3.0);
  water.max = Vec3(2.5, 2.5, 0.0);
  settings.fluids.push_back(water);
  return settings;
}

/// Water in which floating bodies soon lie still.
WorldSettings viscousSettings() {
  WorldSettings settings{1.0 / 120.0};
  settings.fluids.emplace_back();
  settings.fluids[0].linear_drag_mps = 0.3;
  return settings;
}

void addWall(SmallWorld& world, const Vec3& size, const Vec3& position) {
  Placement wall{Solid::box(size)};
  wall.X_WB.position = position;
  wall.is_static = true;
  world.add(wall);
}

void addBasin(SmallWorld& world) {
  addWall(world, Vec3(7.0, 7.0, 1.0), Vec3(0.0, 0.0, -3.5));
  for (double side : {-1.0, 1.0}) {
    addWall(world, Vec3(1.0, 7.0, 5.0), Vec3(3.0 * side, 0.0, -0.49));
    addWall(world, Vec3(4.99, 1.0, 5.0), Vec3(0.0, 3.0 * side, -0.49));
  }
}

TEST(Pool, ACrowdThrownInNeverOverlapsAndFloatsOrSinksByItsDensity) {
  SmallWorld world(poolSettings(60.0));
  addBasin(world);
  oracle::Random random(31);
  const std::vector<Solid> solids{Solid::box(Vec3(0.5, 0.4, 0.3)), Solid::ball(0.2),
                                  Solid::capsule(0.12, 0.3),
                                  Solid::polyhedron(oracle::randomHull(random, 14, Vec3(0.3, 0.25, 0.2)))};
  std::vector<int> light, heavy;
  for (int i = 0; i < 48; ++i) {
    Placement p{solids[static_cast<std::size_t>(i % 4)]};
    p.X_WB.position =
        Vec3(1.1 * (i % 4) - 1.7, 1.1 * (i / 4 % 4) - 1.7, 0.8 + 0.9 * (i / 16) + (i < 16 ? 0.0 : 4.0));
    p.X_WB.rotation = oracle::turned(random.direction(), random.uniform(0.0, 3.0));
    p.material.density_kgpm3 = i < 16 ? 1600.0 : 450.0;
    p.material.restitution = 0.2;
    (i < 16 ? heavy : light).push_back(world.add(p));
  }
  world.start();
  double smallest = 1.0;
  for (int second = 0; second < 10; ++second) {
    for (int i = 0; i < 15; ++i) {
      world.run(4.0 / 60.0);
      smallest = std::min(smallest, static_cast<double>(oracle::smallestGap(world.world()).gap_m));
    }
  }
  EXPECT_GT(smallest, 0.0);
  for (int body : light) EXPECT_GT(world.position(body).z(), -1.0) << body;
  for (int body : heavy) EXPECT_LT(world.position(body).z(), -1.5) << body;
}

// On the pool's floor friction bears the buoyant weight only: v^2 / (2 mu g (1 - rho_f / rho_b)).
TEST(Pool, ABodySlidesOnTheFloorUnderItsBuoyantWeightAndComesToRest) {
  WorldSettings settings{1.0 / 240.0};
  Fluid water;
  water.max.z() = 5.0;
  water.drag = water.linear_drag_mps = 0.0;
  settings.fluids.push_back(water);
  SmallWorld world(settings);
  world.addPlane(rubbing(0.4));
  const Vec3 size(1.0, 0.8, 0.3);
  Placement p{Solid::box(size)};
  p.X_WB = lyingBox(size, Quat::Identity(), 0.3);
  p.material = rubbing(0.4);
  p.material.density_kgpm3 = 2500.0;
  p.velocity = Vec3(1.5, 0.0, 0.0);
  const int box = world.add(p);
  world.start();
  world.run(4.0);
  EXPECT_NEAR(world.position(box).x(), 1.5 * 1.5 / (2.0 * 0.4 * kGravity * 0.6), 0.003);
  EXPECT_TRUE(world.rests(box));
}

TEST(Pool, AStackOnTheFloorRestsAndALightOneRises) {
  WorldSettings settings{1.0 / 120.0};
  Fluid water;
  water.max.z() = 4.0;
  settings.fluids.push_back(water);
  SmallWorld world(settings);
  world.addPlane(rubbing(0.5));
  const Vec3 size(0.6, 0.6, 0.3);
  std::vector<int> boxes;
  for (int i = 0; i < 3; ++i) {
    Placement p{Solid::box(size)};
    p.X_WB.position = Vec3(0.0, 0.0, 0.151 + 0.301 * i);
    p.material.density_kgpm3 = i == 2 ? 400.0 : 1800.0;
    boxes.push_back(world.add(p));
  }
  world.start();
  world.run(30.0);
  EXPECT_TRUE(world.rests(boxes[0]));
  EXPECT_TRUE(world.rests(boxes[1]));
  EXPECT_NEAR(world.position(boxes[2]).z(), 4.0 + 0.15 - 0.12, 0.005);
}

TEST(Pool, AWeightDroppedOnAFloatAtRestWakesIt) {
  SmallWorld world(viscousSettings());
  Placement p{Solid::box(Vec3(2.0, 2.0, 0.4))};
  p.material.density_kgpm3 = 500.0;
  const int raft = world.add(p);
  Placement weight{Solid::box(Vec3(0.4, 0.4, 0.4))};
  weight.X_WB.position = Vec3(0.3, 0.0, 800.0);
  weight.material.density_kgpm3 = 1500.0;
  world.add(weight);
  world.start();
  world.run(5.0);
  ASSERT_TRUE(world.rests(raft));
  world.run(8.5);
  EXPECT_FALSE(world.rests(raft));
}

TEST(Pool, ARaftCarriesItsLoadByTheDisplacedWater) {
  SmallWorld world(viscousSettings());
  Placement p{Solid::box(Vec3(2.0, 2.0, 0.4))};
  p.material.density_kgpm3 = 300.0;
  p.X_WB.position.z() = 0.05;
  const int raft = world.add(p);
  Placement load{Solid::box(Vec3(0.5, 0.5, 0.5))};
  load.X_WB.position = Vec3(0.0, 0.0, 0.52);
  load.material.density_kgpm3 = 1600.0;
  const int cargo = world.add(load);
  world.start();
  world.run(60.0);
  const double draft = (300.0 * 1.6 + 1600.0 * 0.125) / (1000.0 * 4.0);
  EXPECT_NEAR(world.position(raft).z(), 0.2 - draft, 1e-3);
  EXPECT_TRUE(world.rests(raft));
  EXPECT_TRUE(world.rests(cargo));
}

TEST(Pool, InWavesABodyFollowsTheSurfaceAndNeverFreezes) {
  WorldSettings settings{1.0 / 120.0};
  Fluid sea;
  sea.waves = {{0.15, 12.0, Vec2::UnitX(), 0.0, 0.0}};
  settings.fluids.push_back(sea);
  SmallWorld world(settings);
  Placement p{Solid::box(Vec3(0.5, 0.5, 0.2))};
  p.material.density_kgpm3 = 500.0;
  const int body = world.add(p);
  world.start();
  world.run(10.0);
  double worst = 0.0, moved = 0.0;
  for (int i = 0; i < 1200; ++i) {
    world.step();
    ASSERT_FALSE(world.rests(body));
    const Vec3 at = world.position(body);
    const double surface = surfaceAt(sea, kGravity, at.head<2>(), world.time()).height_m;
    worst = std::max(worst, std::abs(at.z() - surface));
    moved = std::max(moved, std::abs(at.z()));
  }
  EXPECT_GT(moved, 0.1);
  EXPECT_LT(worst, 0.05);
}

// A swell so slow that nothing on it is ever faster than what counts as lying still.
TEST(Pool, OnASlowSwellABodyRisesAndSinksAndNeverFreezes) {
  WorldSettings settings{1.0 / 60.0};
  Fluid sea;
  sea.linear_drag_mps = 0.3;
  sea.waves = {{0.05, 4000.0, Vec2::UnitX(), 60.0, 0.0}};
  settings.fluids.push_back(sea);
  SmallWorld world(settings);
  Placement p{Solid::box(Vec3(0.5, 0.5, 0.2))};
  p.material.density_kgpm3 = 500.0;
  const int body = world.add(p);
  world.start();
  world.run(5.0);
  for (int i = 0; i < 3600; ++i) {
    world.step();
    ASSERT_FALSE(world.rests(body));
    const double surface = surfaceAt(sea, kGravity, world.position(body).head<2>(), world.time()).height_m;
    ASSERT_NEAR(world.position(body).z(), surface, 0.002) << world.time() << " s";
  }
}

// Nothing but the water's own acceleration acts on it, less than what rest may leave over.
TEST(Pool, UnderASlowSwellANeutralBodyGoesRoundWithTheWaterAndNeverFreezes) {
  WorldSettings settings{1.0 / 60.0};
  Fluid sea;
  sea.linear_drag_mps = 0.0;
  sea.waves = {{0.05, 4000.0, Vec2::UnitX(), 60.0, 0.0}};
  settings.fluids.push_back(sea);
  SmallWorld world(settings);
  Placement p{Solid::ball(0.2)};
  p.X_WB.position.z() = -0.5;
  p.velocity = waterMotionAt(sea, kGravity, p.X_WB.position, 0.0).velocity;
  const int body = world.add(p);
  world.start();
  Vec3 low = world.position(body), high = low;
  for (int i = 0; i < 3600; ++i) {
    world.step();
    ASSERT_FALSE(world.rests(body));
    low = low.cwiseMin(world.position(body));
    high = high.cwiseMax(world.position(body));
  }
  EXPECT_NEAR(high.x() - low.x(), 0.1, 0.003);
  EXPECT_NEAR(high.z() - low.z(), 0.1, 0.003);
}

TEST(Pool, TwiceTheSameBits) {
  std::uint64_t hash[2];
  for (std::uint64_t& h : hash) {
    SmallWorld world(poolSettings(60.0));
    addBasin(world);
    for (int i = 0; i < 8; ++i) {
      Placement p{i % 2 ? Solid::capsule(0.1, 0.4) : Solid::box(Vec3(0.5, 0.4, 0.3))};
      p.X_WB.position = Vec3(0.2 * i - 0.8, 0.1 * i, 0.5 + 0.6 * i);
      p.X_WB.rotation = oracle::turned(Vec3(1.0, 1.0 + i, 0.3), 0.4 * i);
      p.material.density_kgpm3 = 600.0;
      world.add(p);
    }
    world.start();
    world.run(4.0);
    h = world.world().stateHash();
  }
  EXPECT_EQ(hash[0], hash[1]);
}

}  // namespace
}  // namespace carom::physics
