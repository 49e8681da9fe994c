#pragma once
// A world in a few lines for the tests of this folder: bodies given by solid, pose and velocity, a floor or
// an incline whose top is a plane through the origin, and what the tests ask of a body.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/foundation/tolerances.h"
#include "engine/simulation/world.h"
#include "tests/oracle/test_shapes.h"
#include "tests/physics/experiments/experiment.h"

namespace carom::physics {

struct Placement {
  Solid solid = Solid::box(Vec3::Ones());
  Pose X_WB{};
  Vec3 velocity = Vec3::Zero();
  Vec3 spin = Vec3::Zero();
  Material material{};
  bool is_static = false;
};

/// Equal static and dynamic friction.
inline Material rubbing(double friction, double restitution = 0.0) {
  return {friction, friction, restitution, 1000.0};
}

class SmallWorld {
 public:
  explicit SmallWorld(double rate_hz = 240.0, const Vec3& gravity = Vec3(0.0, 0.0, -kGravity),
                      bool resting_mode = true)
      : world_(WorldSettings{1.0 / rate_hz, gravity, resting_mode}) {}

  explicit SmallWorld(const WorldSettings& settings) : world_(settings) {}

  int add(const Placement& p) {
    const int solid = world_.addSolid(p.solid);
    return world_.addBody({solid, p.X_WB, p.velocity, p.spin, p.material, p.is_static});
  }

  /// A large static box whose top face is the plane through the origin with normal turned by `tilt` from z.
  int addPlane(const Material& material, const Quat& tilt = Quat::Identity(), double half_width_m = 50.0) {
    const Vec3 size(2.0 * half_width_m, 2.0 * half_width_m, 2.0);
    Placement plane{
        Solid::box(size), {tilt, tilt * Vec3(0.0, 0.0, -1.0)}, Vec3::Zero(), Vec3::Zero(), material, true};
    return add(plane);
  }

  void start() { ASSERT_TRUE(world_.start().empty()) << "bodies overlap at the start"; }
  void step() { world_.step(); }
  void run(double seconds) {
    const double steps = std::round(seconds / world_.settings().step_s);
    for (int i = 0; i < static_cast<int>(steps); ++i) step();
  }

  const World& world() const { return world_; }
  double time() const { return world_.time(); }
  const BodyState& state(int body) const { return world_.states()[static_cast<std::size_t>(body)]; }
  Vec3 position(int body) const { return state(body).X_WB.position; }
  Vec3 velocity(int body) const { return state(body).linear_velocity; }
  Vec3 spin(int body) const { return state(body).angular_velocity; }
  bool rests(int body) const {
    return state(body).mode == Mode::kResting && velocity(body) == Vec3::Zero() && spin(body) == Vec3::Zero();
  }

 private:
  World world_;
};

/// The widest gap at which such a part can be struck.
inline double windowCeiling(double width_m) {
  return tolerance::kWindowCeiling * std::min(width_m, tolerance::kWindowLargestScale);
}

/// The pose of a box lying on the plane of `addPlane` at its rest gap, turned about the plane's normal by
/// `heading`, its centre over the point `p` of the plane (plane coordinates).
inline Pose lyingBox(const Vec3& size_m, const Quat& tilt, double heading, const Vec2& p = Vec2::Zero()) {
  const double height = 0.5 * size_m.z() + restGap(size_m.minCoeff());
  return {tilt * oracle::turned(Vec3::UnitZ(), heading), tilt * Vec3(p.x(), p.y(), height)};
}

}  // namespace carom::physics
