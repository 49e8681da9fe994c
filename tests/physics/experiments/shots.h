#pragma once
// Fast bodies and thin obstacles: what came out on the other side is told by topology alone. The long runs of
// our own engine, to 10^4 m/s and 500 rad/s and with an overlap oracle, are `stress tunnelling`
// (tests/bench/stress/tunnelling_trials.h).

#include "tests/oracle/test_shapes.h"
#include "tests/physics/experiments/experiment.h"

namespace carom::physics {

struct ShotPlan {
  double speed = 10.0;  ///< m/s, or rad/s of a rod.
  bool continuous_collision = false;
  int shots = 50;
  double rate_hz = 60.0;
};

inline Experiment emptySpace(const ShotPlan& plan) {
  return {.step_s = 1.0 / plan.rate_hz, .gravity = 0.0, .continuous_collision = plan.continuous_collision};
}

/// Share of the plan's shots for which `passes` is true, each given the same random numbers in turn.
template <typename Passes>
double shareThat(const ShotPlan& plan, unsigned seed, const Passes& passes) {
  oracle::Random random(seed);
  int passed = 0;
  for (int i = 0; i < plan.shots; ++i) passed += passes(random);
  return static_cast<double>(passed) / plan.shots;
}

/// Share of 0.1 m boxes, turned anyhow, that pass a static wall of 2 cm.
inline double passedTheWall(const Simulator& simulator, const ShotPlan& plan) {
  return shareThat(plan, 11, [&](oracle::Random& random) {
    Experiment e = emptySpace(plan);
    ExperimentBody wall{Shape::box({0.02, 4.0, 4.0})};
    wall.is_static = true;
    e.add(std::move(wall));
    const double away = random.uniform(0.2, 1.0);
    const Vec3 place(-away, random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3));
    const int box = e.add({.shape = Shape::box(Vec3::Constant(0.1)),
                           .X_WB = {random.rotation(), place},
                           .velocity = Vec3(plan.speed, 0, 0)});
    Trial trial(simulator, std::move(e));
    bool beyond = false;
    for (long n = trial.stepsOf(1.0 / plan.speed) + 4; n > 0; --n) {
      trial.step();
      const Vec3 p = trial.position(box);
      beyond = beyond || (p.x() > 0.0 && p.tail<2>().cwiseAbs().maxCoeff() < 1.9);
    }
    return beyond;
  });
}

/// Share of pairs of 0.1 m boxes, face to face at `speed` each, that change sides.
inline double changedSides(const Simulator& simulator, const ShotPlan& plan) {
  return shareThat(plan, 12, [&](oracle::Random& random) {
    Experiment e = emptySpace(plan);
    const double apart = random.uniform(0.3, 2.0);
    for (double side : {-1.0, 1.0})
      e.add({.shape = Shape::box(Vec3::Constant(0.1)),
             .X_WB = {Quat::Identity(), Vec3(0.5 * side * apart, 0, 0)},
             .velocity = Vec3(-side * plan.speed, 0, 0)});
    Trial trial(simulator, std::move(e));
    bool beyond = false;
    for (long n = trial.stepsOf(0.5 * apart / plan.speed) + 4; n > 0; --n) {
      trial.step();
      beyond = beyond || !(trial.position(1).x() - trial.position(0).x() > 0.0);
    }
    return beyond;
  });
}

/// Share of rods of 2 m, spinning at `speed` < 90 rad/s between two static posts within their reach, that
/// turn past them. The posts stand opposite each other, so that their blows turn the rod but do not push it
/// away: past the line of both is through.
inline double passedThePosts(const Simulator& simulator, const ShotPlan& plan) {
  return shareThat(plan, 13, [&](oracle::Random& random) {
    Experiment e = emptySpace(plan);
    const double reach = random.uniform(0.3, 0.8);
    for (double side : {-1.0, 1.0}) {
      ExperimentBody post{Shape::box({0.1, 0.1, 1.0}), {Quat::Identity(), Vec3(side * reach, 0, 0)}};
      post.is_static = true;
      e.add(std::move(post));
    }
    const double behind = random.uniform(0.5, 1.5);
    const int rod = e.add({.shape = Shape::box({2.0, 0.04, 0.04}),
                           .X_WB = {rotatedBy(Vec3::UnitZ(), -behind), Vec3::Zero()},
                           .spin = Vec3(0, 0, plan.speed)});
    Trial trial(simulator, std::move(e));
    double angle = -behind;  // of the rod, followed through half turns
    bool through = false;
    for (long n = trial.stepsOf((behind + 0.5) / plan.speed) + 1; n > 0 && !through; --n) {
      trial.step();
      const Vec3 along = trial.motion(rod).X_WB.rotation * Vec3::UnitX();
      angle += std::remainder(std::atan2(along.y(), along.x()) - angle, std::numbers::pi);
      through = angle > 0.2;
    }
    return through;
  });
}

}  // namespace carom::physics
