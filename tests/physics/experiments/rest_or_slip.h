#pragma once
// Flat solids on slopes of 1 to 60 degrees with friction of 0 to 1.5: each stays where it was laid exactly
// when tan <= mu (their bases are too wide to topple over). Nothing that calls itself at rest may stand on a
// slope that theory says it slides down.

#include "tests/physics/experiments/sliding_block.h"

namespace carom::physics {

struct Verdicts {
  int asked = 0;
  int held_wrongly = 0;  ///< Stays, and should slide.
  int slid_wrongly = 0;  ///< Slides, and should stay.
};

/// A frustum with regular sides, its faces z-down, wide enough for 60 degrees.
inline Shape flatSolid(int sides, double upper_share) {
  std::vector<Vec3> points;
  for (int k = 0; k < sides; ++k) {
    const double angle = 2.0 * std::numbers::pi * (k + 0.3) / sides;
    const Vec3 out(std::cos(angle), std::sin(angle), 0.0);
    points.push_back(0.5 * out);
    points.push_back(0.5 * upper_share * out + 0.12 * Vec3::UnitZ());
  }
  return Shape::hull(points);
}

inline std::vector<Shape> sixFlatSolids() {
  return {Shape::box({0.6, 0.5, 0.2}), Shape::box({0.5, 0.5, 0.05}),
          flatSolid(3, 1.0),           flatSolid(5, 0.6),
          flatSolid(6, 1.0),           flatSolid(12, 0.4)};
}

/// Whether it gains speed along the slope in the second half of `seconds`.
inline bool slidesDown(const Simulator& simulator, const Shape& shape, const Slope& slope, double seconds) {
  constexpr double kGains = 1e-4;  // m/s^2; a slope 0.11 % too steep for mu = 0.1 gives a thousandth
  Experiment e{.step_s = 1.0 / slope.rate_hz, .resting = slope.resting};
  const Quat tilt = slope.tilt();
  e.addPlane(slope.friction, 0.0, tilt);
  const ConvexPolyhedron& core = shape.solid.parts()[0].core;
  double lowest = 0.0;
  for (const Vec3& v : core.vertices()) lowest = std::min(lowest, v.z());
  e.add({.shape = shape,
         .X_WB = {tilt * rotatedBy(Vec3::UnitZ(), slope.turn),
                  tilt * Vec3(0, 0, restGap(core.width()) - lowest)},
         .friction = slope.friction});
  Trial trial(simulator, std::move(e));
  return !(accelerationOf(trial, tilt, seconds) < kGains);
}

/// Every solid on slopes of 1, 6, 11 ... 56 and 60 degrees and 0.11 % to either side of the threshold, with
/// mu = 0, 0.1 ... 1.5.
inline Verdicts restOrSlip(const Simulator& simulator, double rate_hz, double seconds = 1.5) {
  Verdicts verdicts;
  const auto ask = [&](const Shape& shape, double friction, double tangent) {
    if (std::abs(tangent - friction) < 1e-3 * friction || tangent > std::tan(radians(60.5))) return;
    const Slope slope{.rate_hz = rate_hz,
                      .angle = std::atan(tangent),
                      .friction = friction,
                      .heading = 0.1 * verdicts.asked,
                      .turn = 0.07 * verdicts.asked};
    const bool slides = slidesDown(simulator, shape, slope, seconds);
    ++verdicts.asked;
    verdicts.held_wrongly += !slides && tangent > friction;
    verdicts.slid_wrongly += slides && tangent < friction;
  };
  for (const Shape& shape : sixFlatSolids())
    for (int tenths = 0; tenths <= 15; ++tenths) {
      const double friction = 0.1 * tenths;
      for (int degrees = 1; degrees <= 61; degrees += 5)
        ask(shape, friction, std::tan(radians(std::min(degrees, 60))));
      if (tenths == 0) continue;
      for (double side : {-1.1e-3, 1.1e-3}) ask(shape, friction, friction * (1.0 + side));
    }
  return verdicts;
}

}  // namespace carom::physics
