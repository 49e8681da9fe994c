#include "engine/simulation/world_contract.h"

#include <algorithm>
#include <cmath>

#include "engine/foundation/contract.h"
#include "engine/foundation/index.h"

namespace carom {
namespace {

void requireMotion(const BodyDescription& d) {
  REQUIRE(!d.is_static || !d.is_kinematic);
  REQUIRE(d.keyframes.empty() || d.is_kinematic);
  REQUIRE(!d.mass_kg || (*d.mass_kg > 0.0 && std::isfinite(*d.mass_kg)), d.mass_kg.value_or(0.0));
  const AxisLocks& locks = d.locks;
  REQUIRE((locks.free_axes.array() == 0.0 || locks.free_axes.array() == 1.0).all());
  REQUIRE(std::abs(locks.axis_W.norm() - 1.0) < 1e-9, locks.axis_W.norm());
  REQUIRE(locks.movingPart(d.linear_velocity) == d.linear_velocity);
  REQUIRE((locks.turningPart(d.angular_velocity) - d.angular_velocity).norm() <=
          1e-9 * d.angular_velocity.norm());
  REQUIRE(d.load.force_W.allFinite() && d.load.torque_W.allFinite() && d.load.force_B.allFinite() &&
          d.load.torque_B.allFinite());
  const bool free = !d.is_static && !d.is_kinematic;
  REQUIRE(free || (!locks.any() && d.load.isZero()));
  for (const Keyframe& keyframe : d.keyframes)
    REQUIRE(std::isfinite(keyframe.time_s) && keyframe.X_WB.position.allFinite() &&
            std::abs(keyframe.X_WB.rotation.norm() - 1.0) < 1e-9);
}

}  // namespace

void requireDescription(const BodyDescription& d, std::size_t solids) {
  REQUIRE(d.solid >= 0 && at(d.solid) < solids, d.solid);
  REQUIRE(d.X_WB.position.allFinite() && std::abs(d.X_WB.rotation.norm() - 1.0) < 1e-9,
          d.X_WB.rotation.norm());
  REQUIRE(d.linear_velocity.allFinite() && d.angular_velocity.allFinite());
  REQUIRE(d.is_static || d.is_kinematic ||
              (d.material.density_kgpm3 > 0.0 && std::isfinite(d.material.density_kgpm3)),
          d.material.density_kgpm3);
  requireMotion(d);
  REQUIRE(d.material.drag_coefficient.value_or(0.0) >= 0.0);
  REQUIRE(d.material.restitution >= 0.0 && d.material.restitution <= 1.0, d.material.restitution);
  REQUIRE(d.material.static_friction >= 0.0 && std::isfinite(d.material.static_friction),
          d.material.static_friction);
  REQUIRE(d.material.dynamic_friction >= 0.0 && std::isfinite(d.material.dynamic_friction),
          d.material.dynamic_friction);
  REQUIRE(d.material.rolling_resistance_m >= 0.0 && std::isfinite(d.material.rolling_resistance_m),
          d.material.rolling_resistance_m);
  REQUIRE(d.material.spinning_resistance_m >= 0.0 && std::isfinite(d.material.spinning_resistance_m),
          d.material.spinning_resistance_m);
}

void requireSettings(const WorldSettings& settings) {
  REQUIRE(settings.step_s > 0.0 && std::isfinite(settings.step_s), settings.step_s);
  REQUIRE(settings.gravity.allFinite());
  REQUIRE(settings.threads >= 1, settings.threads);
  REQUIRE(settings.air.density_kgpm3 >= 0.0 && settings.air.skin_friction >= 0.0 &&
          settings.air.wind.allFinite());
  for (const Fluid& fluid : settings.fluids) {
    REQUIRE(fluid.density_kgpm3 > 0.0 && std::isfinite(fluid.density_kgpm3), fluid.density_kgpm3);
    REQUIRE(fluid.drag >= 0.0 && fluid.linear_drag_mps >= 0.0 && fluid.added_mass >= 0.0);
    REQUIRE((fluid.min.array() < fluid.max.array()).all() && std::isfinite(fluid.max.z()));
    REQUIRE(fluid.flow.allFinite());
    for (const Wave& wave : fluid.waves)
      REQUIRE(wave.wavelength_m > 0.0 && wave.period_s >= 0.0 &&
              std::abs(wave.direction.norm() - 1.0) < 1e-9);
  }
}

}  // namespace carom
