#pragma once
// Bodies that glide over a floor of flush tiles of random sizes, as they would over one floor: the speed that
// they lose and how far they are lifted without friction, and how far they go with it (v^2 / 2 mu g). The
// whole floor is turned about the vertical, so that no edge lies along an axis. For the tests of this folder
// and for `stress tiles`.

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "engine/contact/collision_window.h"
#include "engine/foundation/contract.h"
#include "engine/simulation/world.h"
#include "tests/oracle/test_shapes.h"

namespace carom::physics {

/// What glides.
enum class Glider { kBox, kHull, kBall, kLyingCapsule, kRollingCapsule, kPlateOfTiles, kStool };
inline constexpr int kGliders = 7;

inline const char* gliderName(Glider glider) {
  constexpr const char* names[] = {
      "box", "hull", "ball", "capsule along", "capsule across", "plate of tiles", "stool"};
  return names[static_cast<int>(glider)];
}

/// It stands on the plane z = -height.
struct StandingSolid {
  Solid solid;
  double height_m = 0.0;
  Quat R_WB = Quat::Identity();
};

inline StandingSolid makeGlider(Glider glider, double size_m, oracle::Random& random) {
  const Quat yaw = oracle::turned(Vec3::UnitZ(), random.uniform(-3.0, 3.0));
  switch (glider) {
    case Glider::kBox: {
      Vec3 size;
      for (int i = 2; i >= 0; --i) size[i] = size_m * random.uniform(0.4, 1.0);
      return {Solid::box(size), 0.5 * size.z(), yaw};
    }
    case Glider::kHull: {  // a flat base below a dome of random points
      std::vector<Vec3> points;
      for (int i = 0; i < 7; ++i) {
        const double angle = 2.0 * std::numbers::pi * (i + random.uniform(0.0, 0.5)) / 7.0;
        points.emplace_back(0.5 * size_m * std::cos(angle), 0.5 * size_m * std::sin(angle), 0.0);
      }
      for (int i = 0; i < 8; ++i) {
        const Vec3 up = random.direction();
        points.emplace_back(0.3 * size_m * up.x(), 0.3 * size_m * up.y(),
                            size_m * (0.2 + 0.2 * std::abs(up.z())));
      }
      Solid solid = Solid::polyhedron(convexHull(points).polyhedron);
      const double height = -solid.origin_B().z();
      return {std::move(solid), height, yaw};
    }
    case Glider::kBall:
      return {Solid::ball(0.5 * size_m), 0.5 * size_m, yaw};
    case Glider::kLyingCapsule:
      return {Solid::capsule(0.2 * size_m, 0.6 * size_m), 0.2 * size_m,
              oracle::turned(Vec3::UnitY(), 0.5 * std::numbers::pi)};
    case Glider::kRollingCapsule:
      return {Solid::capsule(0.2 * size_m, 0.6 * size_m), 0.2 * size_m,
              oracle::turned(Vec3::UnitX(), 0.5 * std::numbers::pi)};
    case Glider::kPlateOfTiles: {  // of eight parts side by side
      std::vector<ConvexPart> parts;
      for (int i = 0; i < 8; ++i) {
        const double width = 0.25 * size_m;
        parts.push_back({boxPolyhedron({width, 2.0 * width, 0.2 * size_m})
                             .translated({width * (i % 4 - 1.5), 2.0 * width * (i / 4 - 0.5), 0.0}),
                         0.0});
      }
      return {Solid(std::move(parts)), 0.1 * size_m, yaw};
    }
    case Glider::kStool: {  // three legs below a seat
      std::vector<ConvexPart> parts{
          {boxPolyhedron({size_m, size_m, 0.1 * size_m}).translated({0.0, 0.0, 0.25 * size_m}), 0.0}};
      for (const Vec3& at : {Vec3(-0.4, -0.4, 0.0), Vec3(0.4, -0.4, 0.0), Vec3(0.0, 0.4, 0.0)})
        parts.push_back(
            {boxPolyhedron({0.1 * size_m, 0.1 * size_m, 0.4 * size_m}).translated(size_m * at), 0.0});
      Solid solid{std::move(parts)};
      const double height = 0.2 * size_m - solid.origin_B().z();
      return {std::move(solid), height, yaw};
    }
  }
  return {Solid::ball(size_m), size_m, yaw};
}

struct Glide {
  Glider glider = Glider::kBox;
  double size_m = 1.0;
  double speed_mps = 5.0;
  double rate_hz = 240.0;
  double friction = 0.0;
  double seconds = 3.0;  ///< At most: it ends at the floor's end, too.
  double length_m = 100.0;
  double half_width_m = 3.0;
  double least_tile_m = 0.1;
  double largest_tile_m = 0.4;
  bool resting_mode = true;
  std::uint64_t seed = 1;
};

struct GlideResult {
  double speed_lost = 0.0;  ///< Of the speed along the floor, relative; positive or negative.
  double strayed = 0.0;     ///< Speed across, relative.
  double lift_m = 0.0;      ///< The most that it was higher, or lower, than at the start.
  double turned = 0.0;      ///< rad/s at the end.
  double travelled_m = 0.0;
  double coulomb_m = 0.0;  ///< v^2 / 2 mu g.
  int tiles = 0;
  int events = 0;
};

inline GlideResult glideOverTiles(const Glide& glide) {
  constexpr double kG = 9.81;
  oracle::Random random(glide.seed);
  const Quat yaw = oracle::turned(Vec3::UnitZ(), random.uniform(-3.0, 3.0));
  World world(WorldSettings{1.0 / glide.rate_hz, Vec3(0.0, 0.0, -kG), glide.resting_mode});
  const Material material{glide.friction, glide.friction, 0.0, 1000.0};
  GlideResult result;
  for (double x = -2.0 * glide.size_m; x < glide.length_m;) {
    const double along = random.uniform(glide.least_tile_m, glide.largest_tile_m);
    for (double y = -glide.half_width_m; y < glide.half_width_m;) {
      const double across = random.uniform(glide.least_tile_m, glide.largest_tile_m);
      const int tile = world.addSolid(Solid::box({along, across, 0.2}));
      const Vec3 middle(x + 0.5 * along, y + 0.5 * across, -0.1);
      world.addBody({tile, {yaw, yaw * middle}, Vec3::Zero(), Vec3::Zero(), material, true});
      y += across;
      ++result.tiles;
    }
    x += along;
  }
  const StandingSolid standing = makeGlider(glide.glider, glide.size_m, random);
  const double gap = collisionWindow(standing.solid.width()).rest;
  const Vec3 heading = yaw * Vec3::UnitX();
  const int solid = world.addSolid(standing.solid);
  const Vec3 start(0.0, 0.0, standing.height_m + gap);
  const int body = world.addBody(
      {solid, {yaw * standing.R_WB, start}, glide.speed_mps * heading, Vec3::Zero(), material, false});
  REQUIRE(world.start().empty());
  const double end_m = glide.length_m - 2.0 * glide.size_m;
  const auto state = [&] { return world.states()[static_cast<std::size_t>(body)]; };
  const auto steps = static_cast<int>(std::lround(glide.seconds * glide.rate_hz));
  for (int i = 0; i < steps && state().X_WB.position.dot(heading) < end_m; ++i) {
    world.step();
    result.events += world.audit().last_step.events;
    result.lift_m = std::max(result.lift_m, std::abs(state().X_WB.position.z() - start.z()));
    if (glide.friction > 0.0 && state().linear_velocity.norm() < 1e-9) break;
  }
  const BodyState end = state();
  result.speed_lost = 1.0 - end.linear_velocity.dot(heading) / glide.speed_mps;
  result.strayed = std::abs(end.linear_velocity.dot(yaw * Vec3::UnitY())) / glide.speed_mps;
  result.turned = end.angular_velocity.norm();
  result.travelled_m = (end.X_WB.position - start).norm();
  if (glide.friction > 0.0)
    result.coulomb_m = glide.speed_mps * glide.speed_mps / (2.0 * glide.friction * kG);
  return result;
}

}  // namespace carom::physics
