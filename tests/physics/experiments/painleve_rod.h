#pragma once
// Painlevé's rod: its tip slides along the floor ahead of its centre. At the angle `a` to the floor the tip's
// normal acceleration under a unit of normal force with friction is (1 + 3 cos^2 a - 3 mu sin a cos a) / m
// for a slender rod; where that is negative (mu > 4/3 at tan a = 2) no finite force holds it, and the motion
// goes on after an impulse ("impact without collision"), which is finite and never adds energy.

#include "tests/physics/experiments/experiment.h"

namespace carom::physics {

struct PainleveRod {
  double rate_hz = 60.0;
  double friction = 2.0;
  double slide_mps = 3.0;
  double angle = std::atan(2.0);  ///< To the floor.
  double heading = 0.0;
  double length_m = 1.0;

  /// Negative in Painlevé's region.
  double inverseMass() const {
    const double s = std::sin(angle), c = std::cos(angle);
    return 1.0 + 3.0 * c * c - 3.0 * friction * s * c;
  }
};

struct PainleveOutcome {
  double energy_gain = 0.0;  ///< The largest of E / E0 - 1.
  double fastest = 0.0;      ///< Speed of the centre, in those that the rod's whole energy could give it.
  double end_energy = 0.0;   ///< E / E0.
};

inline PainleveOutcome slidePainleveRod(const Simulator& simulator, const PainleveRod& rod,
                                        double seconds = 1.0) {
  constexpr double kThick = 0.02;
  const double s = std::sin(rod.angle), c = std::cos(rod.angle);
  Experiment e{.step_s = 1.0 / rod.rate_hz};
  e.addPlane(rod.friction);
  const Quat heading = rotatedBy(Vec3::UnitZ(), rod.heading);
  // Its own x axis leads down and ahead to the tip.
  const double height = 0.5 * rod.length_m * s + 0.5 * kThick * c + restGap(kThick);
  const int body = e.add({.shape = Shape::box({rod.length_m, kThick, kThick}),
                          .X_WB = {heading * rotatedBy(Vec3::UnitY(), rod.angle), Vec3(0, 0, height)},
                          .velocity = heading * Vec3(rod.slide_mps, 0, 0),
                          .friction = rod.friction});
  Trial trial(simulator, std::move(e));
  const double begin = trial.energy();
  const double fastest = std::sqrt(2.0 * begin / trial.experiment().bodies[1].mass_kg);
  PainleveOutcome outcome;
  for (long n = trial.stepsOf(seconds); n > 0; --n) {
    trial.step();
    outcome.end_energy = trial.energy() / begin;
    const double speed = trial.velocity(body).norm() / fastest;
    if (!(outcome.end_energy - 1.0 <= outcome.energy_gain)) outcome.energy_gain = outcome.end_energy - 1.0;
    if (!(speed <= outcome.fastest)) outcome.fastest = speed;
  }
  return outcome;
}

}  // namespace carom::physics
