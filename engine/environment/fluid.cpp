#include "engine/environment/fluid.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/foundation/elementary.h"

namespace carom {
namespace {

constexpr double kDeepest = 30.0;  // wavelengths / 2 pi: below, waves are not felt

struct Pace {
  double wavenumber = 0.0;  ///< rad/m.
  double frequency = 0.0;   ///< rad/s.
};

Pace paceOf(const Wave& wave, double gravity_mps2) {
  const double k = 2.0 * std::numbers::pi / wave.wavelength_m;
  return {k, wave.period_s > 0.0 ? 2.0 * std::numbers::pi / wave.period_s : std::sqrt(gravity_mps2 * k)};
}

double phaseAt(const Wave& wave, const Pace& pace, const Vec2& p, double t_s) {
  return pace.wavenumber * dot(wave.direction, p) - pace.frequency * t_s + wave.phase;
}

}  // namespace

double Fluid::waveHeight() const {
  double height = 0.0;
  for (const Wave& wave : waves) height += std::abs(wave.amplitude_m);
  return height;
}

double wavePhase(const Wave& wave, double gravity_mps2, const Vec2& p, double t_s) {
  return phaseAt(wave, paceOf(wave, gravity_mps2), p, t_s);
}

SurfacePoint surfaceAt(const Fluid& fluid, double gravity_mps2, const Vec2& p, double t_s) {
  SurfacePoint surface{fluid.max.z(), Vec2::Zero()};
  for (const Wave& wave : fluid.waves) {
    const Pace pace = paceOf(wave, gravity_mps2);
    const SineCosine at = sineCosine(phaseAt(wave, pace, p, t_s));
    surface.height_m += wave.amplitude_m * at.sine;
    surface.slope += (wave.amplitude_m * pace.wavenumber * at.cosine) * wave.direction;
  }
  return surface;
}

// Where the surface is a sin(psi), the water below moves by a omega e^(kz) (sin psi forwards, -cos psi up).
WaterMotion waterMotionAt(const Fluid& fluid, double gravity_mps2, const Vec3& p_W, double t_s) {
  WaterMotion motion{fluid.flow, Vec3::Zero()};
  for (const Wave& wave : fluid.waves) {
    const Pace pace = paceOf(wave, gravity_mps2);
    const double depth = std::max(0.0, pace.wavenumber * (fluid.max.z() - p_W.z()));
    if (depth > kDeepest) continue;
    const SineCosine at = sineCosine(phaseAt(wave, pace, p_W.head<2>(), t_s));
    const double speed = wave.amplitude_m * pace.frequency * exponential(-depth);
    const Vec3 forwards(wave.direction.x(), wave.direction.y(), 0.0);
    motion.velocity += speed * (at.sine * forwards - at.cosine * Vec3::UnitZ());
    motion.acceleration -= speed * pace.frequency * (at.cosine * forwards + at.sine * Vec3::UnitZ());
  }
  return motion;
}

}  // namespace carom
