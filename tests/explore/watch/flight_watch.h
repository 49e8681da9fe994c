#pragma once
// Oracle: a body flies through a step when its momentum has changed by gravity's alone and its angular
// momentum not at all. Then the kinetic energy of its turning must not grow either; what it grows by is the
// error of the rotation's integrator. Tested in tests/explore/watch/world_judge_test.cpp.

#include <utility>

#include "tests/explore/watch/energy_watch.h"

namespace carom::explore {

class FlightWatch {
 public:
  FlightWatch(const World& world, const std::vector<OwnBody>& bodies, std::span<const BodyState> states)
      : bodies_(bodies), gravity_(world.settings().gravity.cast<Real>()), dt_s_(world.settings().step_s) {
    for (const OwnBody& body : bodies_) before_.push_back(motionOf(body, states));
    least_J_.resize(bodies_.size(), -1);
  }

  /// J that turning in flight has gained in this step, of all bodies.
  Real after(std::span<const BodyState> states, int step, Findings& findings) {
    Real turned = 0;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const Motion now = motionOf(bodies_[i], states);
      const Motion before = std::exchange(before_[i], now);
      if (!flew(before, now)) {
        least_J_[i] = -1;
        continue;
      }
      turned += now.turning_J - before.turning_J;
      if (least_J_[i] < 0) least_J_[i] = before.turning_J;
      const Real grown = least_J_[i] > 0 ? now.turning_J / least_J_[i] - 1 : Real{0};
      if (grown > kRounding * step)
        findings.add("flight", static_cast<double>(grown), step,
                     "of the energy of its spin gained in free flight");
      least_J_[i] = std::min(least_J_[i], now.turning_J);
    }
    return turned;
  }

 private:
  struct Motion {
    Vec3R velocity, angular_momentum;
    Real turning_J = 0;
  };
  static Motion motionOf(const OwnBody& body, std::span<const BodyState> states) {
    const BodyState& s = states[static_cast<std::size_t>(body.index)];
    const Mat3R R = s.X_WB.rotation.cast<Real>().normalized().toRotationMatrix();
    const Vec3R w = R.transpose() * s.angular_velocity.cast<Real>();
    const Vec3R spin = body.inertia_B * w;
    return {s.linear_velocity.cast<Real>(), R * spin, w.dot(spin) / 2};
  }
  bool flew(const Motion& before, const Motion& now) const {
    const Vec3R fallen = now.velocity - before.velocity - dt_s_ * gravity_;
    const Real speed = before.velocity.norm() + now.velocity.norm();
    const Real spin = before.angular_momentum.norm();
    return fallen.norm() <= kRounding * speed && spin > 0 &&
           (now.angular_momentum - before.angular_momentum).norm() <= kRounding * spin;
  }

  const std::vector<OwnBody>& bodies_;
  Vec3R gravity_;
  Real dt_s_ = 0;
  std::vector<Motion> before_;
  std::vector<Real> least_J_;  ///< Of turning, in this flight; < 0: does not fly.
};

}  // namespace carom::explore
