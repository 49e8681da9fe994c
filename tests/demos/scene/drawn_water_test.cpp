// The water that is drawn is the water that bodies feel.
#include "demos/scene/drawn_water.h"

#include <cmath>

#include <gtest/gtest.h>

#include "demos/language/scene_file.h"

namespace carom::demos {
namespace {

constexpr char kScene[] = R"({ "format": 1, "gravity": [0, 0, -3.7],
  "fluids": [
    { "name": "sea", "level": -0.5, "color": "#336699", "waves": [
      { "amplitude": 0.2, "wavelength": 6, "direction": [3, 4], "phaseDegrees": 50 },
      { "amplitude": 0.07, "wavelength": 2.3, "direction": [-1, 4], "period": 1.9 } ] },
    { "name": "pool", "box": { "min": [10, -5, -2], "max": [20, 5, 0] } } ],
  "bodies": [ { "name": "a", "shape": { "box": [1, 1, 1] } } ] })";

TEST(DrawnWater, StandsAsHighAsTheSurfaceThatBodiesFeelAtAnyTime) {
  const Scene scene = parseScene(kScene, "s.json");
  for (const double t_s : {0.0, 0.37, 12.9})
    for (const Vec2& p : {Vec2(0.0, 0.0), Vec2(1.7, -2.2), Vec2(-13.1, 40.3)}) {
      const renderer::WaterVolume sea = drawnWater(scene, t_s)[0];
      double height = sea.max.z();
      for (const renderer::WaterWave& wave : sea.waves)
        height += wave.amplitude_m * std::sin(wave.wave_vector.dot(p) + wave.phase);
      EXPECT_NEAR(height, surfaceAt(scene.fluids[0].fluid, 3.7, p, t_s).height_m, 1e-12) << t_s;
    }
}

TEST(DrawnWater, HasTheFluidsBoundsAndColor) {
  const std::vector<renderer::WaterVolume> water = drawnWater(parseScene(kScene, "s.json"), 0.0);
  ASSERT_EQ(water.size(), 2u);
  EXPECT_TRUE(std::isinf(water[0].min.z()) && std::isinf(water[0].max.x()));
  EXPECT_NEAR(water[0].color.r, 0x33 / 255.0, 1e-6);
  EXPECT_NEAR(water[0].color.g, 0x66 / 255.0, 1e-6);
  EXPECT_NEAR(water[0].color.b, 0x99 / 255.0, 1e-6);
  EXPECT_EQ(water[1].min, Vec3(10.0, -5.0, -2.0));
  EXPECT_EQ(water[1].max, Vec3(20.0, 5.0, 0.0));
  EXPECT_EQ(water[1].color.g, renderer::WaterVolume{}.color.g);
}

}  // namespace
}  // namespace carom::demos
