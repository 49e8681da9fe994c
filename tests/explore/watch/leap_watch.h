#pragma once
// Oracle: no body goes farther in a step than all energy of motion could carry it. What is led clear of
// others may go where its momentum does not, but only as far as gaps open. Tested in
// tests/explore/watch/world_judge_test.cpp.

#include "tests/explore/finding.h"
#include "tests/explore/watch/own_mechanics.h"

namespace carom::explore {

// m/s: gaps reopen no faster.
constexpr Real kOpening = 0.1L;

class LeapWatch {
 public:
  LeapWatch(const World& world, std::span<const OwnBody> bodies)
      : bodies_(bodies),
        gravity_(world.settings().gravity.cast<Real>().norm()),
        dt_s_(world.settings().step_s),
        before_(world.states().begin(), world.states().end()) {
    for (const OwnBody& body : bodies_) mass_ += body.mass;
  }

  /// `kinetic_J`: of all bodies, before and after the step, added up.
  void after(std::span<const BodyState> states, Real kinetic_J, int step, Findings& findings) {
    // Speeds weighted by the roots of masses are a vector whose length energy gives, and to which gravity
    // adds.
    const Real fallen = std::sqrt(mass_) * gravity_ * dt_s_;
    const Real length = std::sqrt(2 * (kinetic_J + mass_ * kOpening * kOpening)) + fallen;
    for (const OwnBody& body : bodies_) {
      const auto i = static_cast<std::size_t>(body.index);
      const Vec3R gone = (states[i].X_WB.position - before_[i].X_WB.position).cast<Real>();
      const Real most = dt_s_ * length / std::sqrt(body.mass);
      if (gone.norm() > most)
        findings.add("leap", static_cast<double>(gone.norm() / most), step,
                     shown(static_cast<double>(gone.norm())) + " m in a step, at most " +
                         shown(static_cast<double>(most)) + " m by all energy of motion");
    }
    before_.assign(states.begin(), states.end());
  }

 private:
  std::span<const OwnBody> bodies_;
  Real gravity_ = 0, dt_s_ = 0, mass_ = 0;
  std::vector<BodyState> before_;
};

}  // namespace carom::explore
