// Air, fluids and drag coefficients on their way from a scene's file into its world.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "demos/language/scene_file.h"
#include "demos/scene/scene_world.h"

namespace carom::demos {
namespace {

constexpr char kScene[] = R"({ "format": 1, "rate": 120,
  "air": { "density": 1.3, "wind": [2, 0, -1], "skinFriction": 0.01 },
  "fluids": [
    { "name": "sea", "level": -0.5, "density": 1025, "drag": 0.8, "linearDrag": 0.1, "flow": [0.2, 0, 0],
      "addedMass": 0.5, "waves": [ { "amplitude": 0.2, "wavelength": 6, "direction": [3, 4], "period": 2.5,
      "phaseDegrees": 90 } ] },
    { "name": "pool", "box": { "min": [10, -5, -2], "max": [20, 5, 0] } } ],
  "materials": { "cork": { "density": 240, "dragCoefficient": 0.9 } },
  "bodies": [
    { "name": "ball", "shape": { "sphere": { "radius": 0.3 } }, "position": [0, 0, 1], "material": "cork" },
    { "name": "crate", "shape": { "box": [1, 1, 0.4] }, "position": [15, 0, 0.3], "material": "cork",
      "dragCoefficient": 1.3 },
    { "name": "stone", "shape": { "box": [1, 1, 1] }, "position": [15, 3, 3] } ] })";

TEST(SceneEnvironment, EveryKeyIsRead) {
  const Scene scene = parseScene(kScene, "s.json");
  EXPECT_EQ(scene.air.density_kgpm3, 1.3);
  EXPECT_EQ(scene.air.wind, Vec3(2.0, 0.0, -1.0));
  EXPECT_EQ(scene.air.skin_friction, 0.01);
  ASSERT_EQ(scene.fluids.size(), 2u);
  const Fluid& sea = scene.fluids[0].fluid;
  EXPECT_EQ(scene.fluids[0].name, "sea");
  EXPECT_EQ(sea.max.z(), -0.5);
  EXPECT_TRUE(std::isinf(sea.max.x()) && std::isinf(sea.min.z()));
  EXPECT_EQ(sea.density_kgpm3, 1025.0);
  EXPECT_EQ(sea.drag, 0.8);
  EXPECT_EQ(sea.linear_drag_mps, 0.1);
  EXPECT_EQ(sea.flow, Vec3(0.2, 0.0, 0.0));
  EXPECT_EQ(sea.added_mass, 0.5);
  ASSERT_EQ(sea.waves.size(), 1u);
  EXPECT_EQ(sea.waves[0].amplitude_m, 0.2);
  EXPECT_EQ(sea.waves[0].wavelength_m, 6.0);
  EXPECT_LT((sea.waves[0].direction - Vec2(0.6, 0.8)).norm(), 1e-15);
  EXPECT_EQ(sea.waves[0].period_s, 2.5);
  EXPECT_NEAR(sea.waves[0].phase, 0.5 * std::numbers::pi, 1e-15);
  EXPECT_EQ(scene.fluids[1].fluid.min, Vec3(10.0, -5.0, -2.0));
  EXPECT_EQ(scene.fluids[1].fluid.max, Vec3(20.0, 5.0, 0.0));
  EXPECT_EQ(scene.bodies[0].material.drag_coefficient, 0.9);
  EXPECT_EQ(scene.bodies[1].material.drag_coefficient, 1.3);
  EXPECT_FALSE(scene.bodies[2].material.drag_coefficient.has_value());
}

TEST(SceneEnvironment, AirWithoutKeysIsThatOfASummersDayAndNoAirIsVacuum) {
  const std::string bodies = "\"bodies\": [ { \"name\": \"a\", \"shape\": { \"box\": [1, 1, 1] } } ] }";
  EXPECT_EQ(parseScene("{ \"format\": 1, \"air\": {}, " + bodies, "s.json").air.density_kgpm3, 1.2);
  EXPECT_EQ(parseScene("{ \"format\": 1, " + bodies, "s.json").air.density_kgpm3, 0.0);
}

TEST(SceneEnvironment, TheWorldFloatsWhatFloatsAndSinksWhatSinks) {
  SceneWorld made = makeSceneWorld(parseScene(kScene, "s.json"), std::nullopt);
  EXPECT_EQ(made.world.settings().fluids.size(), 2u);
  for (int i = 0; i < 40; ++i) made.world.step();
  EXPECT_GT(made.world.states()[0].linear_velocity.x(), 0.005) << "the wind carries the ball";
  for (int i = 0; i < 80; ++i) made.world.step();
  EXPECT_GT(made.world.states()[1].X_WB.position.z(), -0.4) << "cork floats in the pool";
  EXPECT_LT(made.world.states()[2].linear_velocity.z(), -1.0) << "stone's density is that of water";
}

}  // namespace
}  // namespace carom::demos
