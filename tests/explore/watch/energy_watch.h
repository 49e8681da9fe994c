#pragma once
// Oracle: kinetic and potential energy may only fall. Each step is held against the lowest so far, raised by
// the rounding since then. What opening gaps may lift bodies by is granted once, not once a step: a gap that
// has closed again has given it back. Tested in tests/explore/watch/world_judge_test.cpp.

#include <algorithm>
#include <utility>

#include "tests/explore/finding.h"
#include "tests/explore/watch/own_mechanics.h"

namespace carom::explore {

// A step rounds each number some hundreds of times (the impulses of a few contacts, a few events); 4096 units
// in the last place are above what that adds up to.
constexpr Real kRounding = 0x1p-40L;
// The gap that lasting contact is held at, per metre of width and at most for a metre (DESIGN, the collision
// window): where a body starts nearer, opening the gap lifts it by so much, against its weight or what else
// presses it there. Of a tower the gaps below a body add up; a torque presses with an arm of half a width.
constexpr double kLift = 1.1e-3;

inline double smallestWidth(const Solid& solid) {
  double width = 1.0;
  for (const ConvexPart& part : solid.parts()) width = std::min(width, part.width());
  return width;
}

inline const Solid& solidOf(const World& world, int body) {
  const int solid = world.bodies()[static_cast<std::size_t>(body)].solid;
  return world.solids()[static_cast<std::size_t>(solid)];
}

class EnergyWatch {
 public:
  EnergyWatch(const World& world, std::span<const OwnBody> bodies, const Mechanics& start)
      : level_J_(start.total()), last_(start) {
    const Real g = world.settings().gravity.cast<Real>().norm();
    Real gaps = 0, push = 0, turn = 0, fall = 0;
    for (const OwnBody& body : bodies) {
      const AppliedLoad& load = world.bodies()[static_cast<std::size_t>(body.index)].load;
      const Real width = smallestWidth(solidOf(world, body.index));
      gaps += Real{kLift} * width;
      push += body.mass * g + load.force_W.cast<Real>().norm() + load.force_B.cast<Real>().norm();
      turn += 2 / width * (load.torque_W.cast<Real>().norm() + load.torque_B.cast<Real>().norm());
      fall += body.mass * g * body.reach_m;
    }
    lifted_J_ = world.bodies().size() > 1 ? (push + turn) * gaps : Real{0};  // one has nobody to lie on
    scale_J_ = start.kinetic_J + fall;
  }

  struct Gain {
    double of_scale = 0.0;      ///< Beyond the tolerance, of the largest kinetic energy so far and m g size.
    double of_tolerance = 0.0;  ///< The whole gain.
    std::string detail;
  };
  /// `turned_J`: what the spins of bodies in free flight have gained in the step, which FlightWatch judges,
  /// and the work of kinematic bodies and loads. `work_scale_J`: what that of loads is a difference of, since
  /// the start.
  Gain after(const Mechanics& now, Real turned_J, Real work_scale_J = 0) {
    const Real worked = work_scale_J - std::exchange(work_scale_J_, work_scale_J);
    const Real rounding = kRounding * (last_.kinetic_J + now.kinetic_J + last_.potential_scale_J +
                                       now.potential_scale_J + worked);
    scale_J_ = std::max(scale_J_, last_.kinetic_J);
    level_J_ += turned_J + rounding;
    const Real gain = now.total() - level_J_;
    Gain found;
    if (lifted_J_ + rounding > 0) found.of_tolerance = static_cast<double>(gain / (lifted_J_ + rounding));
    if (gain > lifted_J_ && scale_J_ > 0) {
      found.of_scale = static_cast<double>((gain - lifted_J_) / scale_J_);
      found.detail = shown(static_cast<double>(gain)) + " J gained where there were " +
                     shown(static_cast<double>(scale_J_)) + " J; tolerance " +
                     shown(static_cast<double>(lifted_J_)) + " J, kinetic in this step " +
                     shown(static_cast<double>(last_.kinetic_J)) + " -> " +
                     shown(static_cast<double>(now.kinetic_J));
    }
    level_J_ = std::min(level_J_, now.total());
    last_ = now;
    return found;
  }

 private:
  Real lifted_J_ = 0, level_J_ = 0, scale_J_ = 0, work_scale_J_ = 0;
  Mechanics last_;
};

}  // namespace carom::explore
