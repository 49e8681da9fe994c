#include "demos/scene/drawn_water.h"

#include <numbers>

namespace carom::demos {

std::vector<renderer::WaterVolume> drawnWater(const Scene& scene, double t_s) {
  std::vector<renderer::WaterVolume> volumes;
  for (const NamedFluid& named : scene.fluids) {
    renderer::WaterVolume volume{named.fluid.min, named.fluid.max, named.color, {}};
    for (const Wave& wave : named.fluid.waves)
      volume.waves.push_back({wave.amplitude_m, (2.0 * std::numbers::pi / wave.wavelength_m) * wave.direction,
                              wavePhase(wave, scene.gravity.norm(), Vec2::Zero(), t_s)});
    volumes.push_back(std::move(volume));
  }
  return volumes;
}

}  // namespace carom::demos
