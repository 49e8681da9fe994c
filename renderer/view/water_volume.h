#pragma once
// A body of water as the renderer is given it: plain values for one moment. Tested in
// tests/renderer/passes/water_pass_test.cpp.

#include <limits>
#include <vector>

#include "engine/foundation/frames.h"
#include "renderer/image/color.h"

namespace carom::renderer {

/// Raises the surface over (x, y) by amplitude sin(wave_vector . (x, y) + phase).
struct WaterWave {
  double amplitude_m = 0.0;
  Vec2 wave_vector = Vec2::UnitX();  ///< rad/m, along the direction of travel.
  double phase = 0.0;                ///< Radians, at the moment of the frame.
};

/// World axes; sides without end are infinite. `max.z` is the level of the undisturbed surface.
struct WaterVolume {
  Vec3 min = Vec3::Constant(-std::numeric_limits<double>::infinity());
  Vec3 max = Vec3(std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(), 0.0);
  Color color{0.36f, 0.72f, 0.76f};  ///< What white looks like through kColorDepth_m of it.
  std::vector<WaterWave> waves;      ///< Of more than kMostWaves the highest are drawn.
};
inline constexpr double kColorDepth_m = 2.0;
inline constexpr int kMostWaves = 64;

}  // namespace carom::renderer
