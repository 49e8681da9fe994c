#pragma once
// Housner's rocking block (1963): let go askew it turns about one lower edge, lands on its base and goes on
// about the other. The impulse acts on the new edge; angular momentum about that edge is kept, and of the
// energy (1 - 3/2 sin^2 a)^2 remains, tan a = width / height: 0.8313 for 1 x 4, whatever the size.

#include "tests/physics/experiments/experiment.h"

namespace carom::physics {

inline double closedFormRockingRatio(double width_over_height) {
  const double sine_squared = 1.0 / (1.0 + 1.0 / (width_over_height * width_over_height));
  return (1.0 - 1.5 * sine_squared) * (1.0 - 1.5 * sine_squared);
}

inline constexpr int kRocker = 1;  ///< The block of a rocking experiment; the floor is 0.

/// Askew by 0.8 of the angle at which it would fall over, its lower edge a rest gap above the floor.
inline Trial rockingBlock(const Simulator& simulator, double height_m, double rate_hz, double heading = 0.0,
                          double width_over_height = 0.25) {
  const double width = width_over_height * height_m, alpha = std::atan(width_over_height);
  const double tilt = 0.8 * alpha, diagonal = 0.5 * std::hypot(width, height_m);
  Experiment e{.step_s = 1.0 / rate_hz};
  e.addPlane(0.9);
  e.add({.shape = Shape::box({width, 1.6 * width, height_m}),
         .X_WB = {rotatedBy(Vec3::UnitZ(), heading) * rotatedBy(Vec3::UnitY(), tilt),
                  Vec3(0, 0, diagonal * std::cos(alpha - tilt) + restGap(width))},
         .friction = 0.9});
  return Trial(simulator, std::move(e));
}

/// Energies after the first landings, each over the one before it; fewer when it stops rocking.
inline std::vector<double> rockingRatios(const Simulator& simulator, double height_m, double rate_hz,
                                         std::size_t landings, double heading = 0.0,
                                         double width_over_height = 0.25) {
  const double alpha = std::atan(width_over_height), tilt = 0.8 * alpha;
  const double diagonal = 0.5 * std::hypot(width_over_height * height_m, height_m);
  const Quat turn = rotatedBy(Vec3::UnitZ(), heading);
  Trial trial = rockingBlock(simulator, height_m, rate_hz, heading, width_over_height);
  // Over one edge, per kg, from angle and rate: potential less that of standing, and 2/3 d^2 w^2.
  const auto energy = [&](double angle, double rate) {
    return kGravity * diagonal * (std::cos(alpha - angle) - std::cos(alpha)) +
           2.0 / 3.0 * diagonal * diagonal * rate * rate;
  };
  std::vector<double> swings{energy(tilt, 0.0)};  // the first one's energy is known
  double side = 1.0, farthest = 0.0, peak = 0.0;
  bool landed = false;
  for (long n = trial.stepsOf(6.0); n > 0 && swings.size() <= landings; --n) {
    trial.step();
    const Motion m = trial.motion(kRocker);
    const double lean =
        std::asin(std::clamp((turn.conjugate() * (m.X_WB.rotation * Vec3::UnitZ())).x(), -1.0, 1.0));
    if (lean * side < 0.0) {  // on the other edge now
      if (landed) swings.push_back(peak);
      landed = true;
      side = -side;
      farthest = 0.0;
    }
    if (std::abs(lean) > farthest) {
      farthest = std::abs(lean);
      peak = energy(farthest, m.spin.norm());
    }
  }
  std::vector<double> ratios;
  for (std::size_t i = 1; i < swings.size(); ++i) ratios.push_back(swings[i] / swings[i - 1]);
  return ratios;
}

}  // namespace carom::physics
