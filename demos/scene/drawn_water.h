#pragma once
// A scene's fluids as the renderer takes them. Tested in tests/demos/scene/drawn_water_test.cpp.

#include <vector>

#include "demos/scene/scene.h"
#include "renderer/view/water_volume.h"

namespace carom::demos {

/// The fluids at time `t_s`, one each in the scene's order, with the surface that bodies feel (surfaceAt).
std::vector<renderer::WaterVolume> drawnWater(const Scene& scene, double t_s);

}  // namespace carom::demos
