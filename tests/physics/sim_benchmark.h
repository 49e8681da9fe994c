#pragma once
// Two scenes of SimBenchmark (Kang and Hwangbo, 2018) in which an elastic world must keep its energy: 49
// balls that bounce apart from each other, and a cube of 216 that fall on the ground and through one another.
// Their error is the mean over time of the squared difference from the energy of the start, J^2.

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "engine/foundation/contract.h"
#include "engine/simulation/world.h"
#include "tests/oracle/test_shapes.h"
#include "tests/support/world_energy.h"

namespace carom::physics {

class ElasticBalls {
 public:
  /// 7 x 7 balls 2 m apart, their centres 5 m above the ground.
  static ElasticBalls bouncing(double step_s) {
    ElasticBalls scene(step_s);
    for (int i = 0; i < 49; ++i) scene.add(Vec3(2.0 * (i % 7), 2.0 * (i / 7), 5.0));
    scene.start();
    return scene;
  }

  /// 6 x 6 x 6 balls 0.21 m apart, each moved by up to a millimetre along every axis, the lowest at 1.101 m.
  static ElasticBalls cube(double step_s, std::uint64_t seed) {
    ElasticBalls scene(step_s);
    oracle::Random random(seed);
    for (int i = 0; i < 216; ++i) {
      const Vec3 place(0.21 * (i % 6), 0.21 * (i / 6 % 6), 1.101 + 0.21 * (i / 36));
      Vec3 jitter;
      for (double& j : jitter) j = random.uniform(0.0, 1e-3);
      scene.add(place + jitter);
    }
    scene.start();
    return scene;
  }

  void run(double seconds) {
    const int steps = static_cast<int>(std::lround(seconds / world_.settings().step_s));
    for (int i = 0; i < steps; ++i) {
      world_.step();
      const double error = energy() - begin_J_;
      squares_ += error * error;
      worst_J_ = std::max(worst_J_, std::abs(error));
      held_ += world_.audit().last_step.stopped_bodies;
      smallest_gap_m_ = std::min(smallest_gap_m_, world_.audit().smallest_gap_m);
    }
    steps_ += steps;
  }

  double meanSquare() const { return squares_ / steps_; }
  double worst_J() const { return worst_J_; }
  double begin_J() const { return begin_J_; }
  double smallest_gap_m() const { return smallest_gap_m_; }
  long held() const { return held_; }  ///< Bodies that a budget stopped, over all steps.
  const World& world() const { return world_; }

 private:
  static constexpr double kRadius = 0.1;
  static constexpr double kMass = 10.0;

  explicit ElasticBalls(double step_s) : world_({step_s, Vec3(0, 0, -9.81), true}) {
    material_ = {0.0, 0.0, 1.0, kMass / (4.0 / 3.0 * std::numbers::pi * kRadius * kRadius * kRadius)};
    const int ground = world_.addSolid(Solid::box({100.0, 100.0, 2.0}));
    world_.addBody(
        {ground, {Quat::Identity(), Vec3(0, 0, -1.0)}, Vec3::Zero(), Vec3::Zero(), material_, true});
    ball_ = world_.addSolid(Solid::ball(kRadius));
  }

  void add(const Vec3& position) {
    world_.addBody({ball_, {Quat::Identity(), position}, Vec3::Zero(), Vec3::Zero(), material_, false});
  }

  void start() {
    REQUIRE(world_.start().empty());
    begin_J_ = energy();
  }

  double energy() const { return energyOf(world_); }

  World world_;
  Material material_;
  int ball_ = -1;
  double begin_J_ = 0.0, squares_ = 0.0, worst_J_ = 0.0;
  double smallest_gap_m_ = std::numeric_limits<double>::infinity();
  long held_ = 0;
  int steps_ = 0;
};

}  // namespace carom::physics
