#pragma once
// Bodies of water: a box, or everything below a level, with a surface that may carry waves. The undisturbed
// surface is level, z = max.z; waves are a sum of sines, each with the motion of the water below it (linear
// theory of deep water: Lamb, Hydrodynamics, art. 229). Tested in tests/engine/environment/fluid_test.cpp.

#include <limits>
#include <vector>

#include "engine/foundation/frames.h"

namespace carom {

/// height = amplitude sin(k . p - omega t + phase), k = 2 pi / wavelength along the direction of travel.
struct Wave {
  double amplitude_m = 0.0;
  double wavelength_m = 1.0;
  Vec2 direction = Vec2::UnitX();  ///< Unit.
  double period_s = 0.0;           ///< 0: that of deep water, omega^2 = g k.
  double phase = 0.0;              ///< Radians.
};

struct Fluid {
  /// World axes; sides without end are infinite. `max.z` is the level of the undisturbed surface.
  Vec3 min = Vec3::Constant(-std::numeric_limits<double>::infinity());
  Vec3 max = Vec3(std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(), 0.0);
  double density_kgpm3 = 1000.0;
  double drag = 1.0;              ///< Factor of the bodies' coefficients of quadratic drag.
  double linear_drag_mps = 0.05;  ///< Times density and wetted area: linear drag, N per m/s.
  Vec3 flow = Vec3::Zero();       ///< m/s.
  double added_mass = 0.0;        ///< Of the displaced mass: what moves with a body.
  std::vector<Wave> waves;

  /// The highest that waves raise or lower the surface, metres.
  double waveHeight() const;
};

/// k . p - omega t + phase, radians: its sine times the amplitude is what the wave adds to the height over p.
double wavePhase(const Wave& wave, double gravity_mps2, const Vec2& p, double t_s);

/// The surface over one point: the height and the way it leans.
struct SurfacePoint {
  double height_m = 0.0;      ///< z in the world.
  Vec2 slope = Vec2::Zero();  ///< d height / dx, dy.
};
/// At (x, y) and time t; `gravity_mps2` is gravity's magnitude, which sets the pace of waves without a
/// period. Also beyond the sides of a box.
SurfacePoint surfaceAt(const Fluid& fluid, double gravity_mps2, const Vec2& p, double t_s);

/// How the water moves at a point: the flow and, under waves, circling with a radius that falls off with
/// depth.
struct WaterMotion {
  Vec3 velocity = Vec3::Zero();      ///< m/s.
  Vec3 acceleration = Vec3::Zero();  ///< m/s^2.
};
WaterMotion waterMotionAt(const Fluid& fluid, double gravity_mps2, const Vec3& p_W, double t_s);

}  // namespace carom
