// Ghost collisions (engine/simulation/contacts/internal_edges.h): over a floor of flush tiles bodies glide,
// and stop, as over one floor. Without friction nothing changes their speed, and nothing lifts them; with it
// they go v^2 / 2 mu g. `stress tiles` does the same for hundreds of floors of ten thousand tiles.

#include "tests/physics/tiled_floor.h"

#include "engine/solid/convex_hull.h"
#include "tests/physics/small_world.h"

namespace carom::physics {
namespace {

// What the solver leaves over tilts a body that many tiles hold, and lifts it; but it goes on along the tiles
// (Ground, engine/contact/contact_polygon.h).
constexpr double kLost = 1e-12;

class FlushTiles : public testing::TestWithParam<int> {};

TEST_P(FlushTiles, NeitherBrakeNorLiftWhatGlides) {
  const auto glider = static_cast<Glider>(GetParam());
  for (const double speed : {0.2, 1.0, 5.0, 25.0})
    for (const double rate : {60.0, 240.0, 1000.0}) {
      SCOPED_TRACE(testing::Message() << gliderName(glider) << " at " << speed << " m/s, " << rate << " Hz");
      const GlideResult result = glideOverTiles({.glider = glider,
                                                 .size_m = 0.7,
                                                 .speed_mps = speed,
                                                 .rate_hz = rate,
                                                 .seconds = std::min(5.0, 10.0 / speed),
                                                 .length_m = 12.0,
                                                 .half_width_m = 1.0,
                                                 .seed = 7});
      EXPECT_LT(std::abs(result.speed_lost), kLost);
      EXPECT_LT(result.strayed, kLost);
      EXPECT_LT(result.lift_m, 1e-7);
    }
}

INSTANTIATE_TEST_SUITE_P(Gliders, FlushTiles, testing::Range(0, kGliders),
                         [](const testing::TestParamInfo<int>& glider) {
                           std::string name = gliderName(static_cast<Glider>(glider.param));
                           std::erase(name, ' ');
                           return name;
                         });

TEST(FlushTiles, LetAThingSlideAsFarAsOneFloor) {
  for (const Glider glider : {Glider::kBox, Glider::kHull, Glider::kStool, Glider::kLyingCapsule}) {
    SCOPED_TRACE(gliderName(glider));
    const GlideResult result = glideOverTiles({.glider = glider,
                                               .size_m = 0.7,
                                               .speed_mps = 5.0,
                                               .friction = 0.5,
                                               .seconds = 2.0,
                                               .length_m = 6.0,
                                               .half_width_m = 1.0,
                                               .seed = 3});
    EXPECT_NEAR(result.travelled_m / result.coulomb_m, 1.0, 1e-4);
  }
}

// Of a box that slides towards a tile that is higher by `height_m`, and past its edge.
double speedPastAStep(double height_m, double speed_mps) {
  SmallWorld world(240.0);
  world.add({Solid::box({10, 4, 1}),
             {Quat::Identity(), {-5, 0, -0.5}},
             Vec3::Zero(),
             Vec3::Zero(),
             rubbing(0.0),
             true});
  world.add({Solid::box({10, 4, 1}),
             {Quat::Identity(), {5, 0, -0.5 + height_m}},
             Vec3::Zero(),
             Vec3::Zero(),
             rubbing(0.0),
             true});
  const Vec3 start(-0.4, 0, 0.25 + collisionWindow(0.5).rest);
  const int box = world.add({Solid::box({0.5, 0.5, 0.5}),
                             {Quat::Identity(), start},
                             {speed_mps, 0, 0},
                             Vec3::Zero(),
                             rubbing(0.0)});
  world.start();
  world.run(0.8 / speed_mps);
  return world.state(box).linear_velocity.x();
}

// What a box that tips over a low edge loses more than its lifting takes, of that: it comes down again on its
// other side, without restitution.
constexpr double kTipping = 0.25;

TEST(StepInTheFloor, IsPassedBelowTheWindowAndHitAbove) {
  const CollisionWindow window = collisionWindow(0.5);
  const double low = 0.5 * (window.rest - window.floor);
  const double high = 1.5 * (window.rest - window.floor);
  for (const double speed : {0.2, 5.0}) {
    const double past = speedPastAStep(low, speed);
    EXPECT_LE(past, speed);
    EXPECT_GE(past * past, speed * speed - (1.0 + kTipping) * 2.0 * kGravity * low) << speed;
    EXPECT_LT(speedPastAStep(high, speed), 0.5 * speed) << speed;
  }
}

TEST(PlateOfTiles, GoesOnSpinningOnAnother) {
  SmallWorld world(240.0);
  std::vector<ConvexPart> parts;
  for (int i = 0; i < 8; ++i)
    parts.push_back(
        {boxPolyhedron({0.25, 0.5, 0.1}).translated({0.25 * (i % 4 - 1.5), 0.5 * (i / 4 - 0.5), 0}), 0.0});
  const Solid plate{parts};
  const double gap = collisionWindow(plate.width()).rest;
  world.add({plate, {Quat::Identity(), {0, 0, -0.05}}, Vec3::Zero(), Vec3::Zero(), rubbing(0.0), true});
  const int spinning =
      world.add({plate, {Quat::Identity(), {0, 0, 0.05 + gap}}, Vec3::Zero(), {0, 0, 3.0}, rubbing(0.0)});
  world.start();
  world.run(3.0);
  EXPECT_NEAR(world.state(spinning).angular_velocity.z() / 3.0, 1.0, 1e-4);
}

// A skid: the prism of 8 sides along y, one edge down.
ConvexPart skid(double radius_m, double length_m, const Vec3& middle) {
  std::vector<Vec3> points;
  for (int k = 0; k < 8; ++k) {
    const double angle = 0.25 * std::numbers::pi * k;
    for (const double y : {-0.5, 0.5})
      points.push_back(radius_m * Vec3(std::sin(angle), 0.0, -std::cos(angle)) +
                       y * length_m * Vec3::UnitY() + middle);
  }
  return {convexHull(points).polyhedron, 0.0};
}

// Beside the edge that bears it a skid has faces that come down obliquely over the edge of the next tile.
TEST(FlushTiles, LetEdgesAlongTheSeamPass) {
  for (const double speed : {0.03, 0.1, 0.3})
    for (const double rate : {60.0, 240.0, 960.0}) {
      SCOPED_TRACE(testing::Message() << speed << " m/s, " << rate << " Hz");
      SmallWorld world(rate);
      for (const double x : {-0.5, 0.5}) {
        Placement tile{Solid::box({1.0, 2.0, 0.5})};
        tile.X_WB.position = Vec3(x, 0.0, -0.25);
        tile.material = rubbing(0.0);
        tile.is_static = true;
        world.add(tile);
      }
      const Solid sledge({skid(0.1, 0.3, {-0.2, 0.0, 0.0}), skid(0.1, 0.3, {0.2, 0.0, 0.0})});
      Placement p{sledge};
      const double rest_gap = collisionWindow(sledge.width()).rest;
      p.X_WB.position = Vec3(-0.21 - 0.1 * speed, 0.0, 0.1 + rest_gap);
      p.velocity = Vec3(speed, 0.0, 0.0);
      p.material = rubbing(0.0);
      const int sliding = world.add(p);
      world.start();
      const double height = world.position(sliding).z();
      for (int i = 0; i < static_cast<int>(0.6 / speed * rate); ++i) {
        world.step();
        ASSERT_NEAR(world.velocity(sliding).x() / speed, 1.0, 1e-6) << i;
        ASSERT_NEAR(world.position(sliding).z(), height, 0.5 * rest_gap) << i;
      }
    }
}

// Rails of capsules whose cores meet end to end: their tops are one line. Whichever end of the one before is
// at the joint, a box glides over it.
TEST(FlushRails, NeitherBrakeNorLiftABox) {
  const double radius = 0.1;
  for (const double speed : {1.0, -1.0}) {
    SCOPED_TRACE(speed);
    SmallWorld world(240.0);
    for (const double y : {-0.3, 0.3})
      for (const double x : {-1.0, 1.0}) {
        Placement rail{Solid::capsule(radius, 2.0)};
        rail.X_WB = {oracle::turned(Vec3::UnitY(), 0.5 * std::numbers::pi), Vec3(x, y, -radius)};
        rail.material = rubbing(0.0);
        rail.is_static = true;
        world.add(rail);
      }
    Placement p{Solid::box(Vec3(0.6, 1.0, 0.2))};
    p.X_WB.position = Vec3(-0.9 * speed, 0.0, 0.1 + restGap(0.2));
    p.velocity = Vec3(speed, 0.0, 0.0);
    p.material = rubbing(0.0);
    const int box = world.add(p);
    world.start();
    const double height = world.position(box).z();
    for (int i = 0; i < 400; ++i) {
      world.step();
      ASSERT_NEAR(world.velocity(box).x(), speed, 1e-9) << i;
      ASSERT_NEAR(world.position(box).z(), height, 1e-5) << i;
    }
  }
}

}  // namespace
}  // namespace carom::physics
