// What a scene's file says of looks and light.
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "demos/language/scene_file.h"
#include "demos/scene/scene_world.h"
#include "tests/support/thrown_message.h"

namespace carom::demos {
namespace {

std::string scene(const std::string& material, const std::string& more = "") {
  return R"({ "format": 1, )" + more + R"("bodies": [)" +
         R"({ "name": "a", "shape": { "box": [0.4, 0.6, 0.2] }, "material": )" + material + "} ] }";
}

std::string refusal(const std::string& text) {
  return thrownMessage<InputError>([&text] { parseScene(text, "look.json"); });
}

TEST(SceneLook, ASurfaceHasItsOwnColourUnlessTheSceneChoosesOne) {
  const Scene natural = parseScene(scene(R"({ "surface": "wood" })"), "look.json");
  const SceneWorld made = makeSceneWorld(natural, {});
  const renderer::Instance drawn = drawnInstances(made, made.world.states())[0];
  EXPECT_EQ(drawn.surface.kind, renderer::SurfaceKind::kWood);
  EXPECT_EQ(drawn.surface.scale_m, 0.5);  // The middle side is 0.4 m.
  EXPECT_EQ(drawn.color.r, renderer::naturalColor(renderer::SurfaceKind::kWood).r);

  const Scene chosen =
      parseScene(scene(R"({ "surface": "wood", "color": "#336699", "surfaceScale": 3 })"), "look.json");
  const SceneWorld other = makeSceneWorld(chosen, {});
  const renderer::Instance tinted = drawnInstances(other, other.world.states())[0];
  EXPECT_EQ(tinted.surface.scale_m, 3.0);
  EXPECT_FLOAT_EQ(tinted.color.g, 0x66 / 255.0f);
  EXPECT_EQ(tinted.surface.seed, drawn.surface.seed);  // Of the name.
}

TEST(SceneLook, AGroundIsACheckerWithAnotherPattern) {
  const Scene read = parseScene(scene(R"({ "ground": "planks" })"), "look.json");
  EXPECT_TRUE(read.bodies[0].look.checker);
  EXPECT_EQ(read.bodies[0].look.pattern, renderer::GroundPattern::kPlanks);
}

TEST(SceneLook, ALightByNameOrWithChanges) {
  const Scene named = parseScene(scene("{}", R"("light": "sunset", )"), "look.json");
  EXPECT_EQ(named.light.light, renderer::lightOf("sunset"));
  EXPECT_EQ(lightText(named.light), "sunset");
  EXPECT_EQ(lightText(parseScene(scene("{}"), "look.json").light), "");

  const Scene changed = parseScene(
      scene(
          "{}",
          R"("light": { "like": "overcast", "direction": [0, 0, 2], "strength": 2, "horizon": "#ffffff", "exposure": 1.5 }, )"),
      "look.json");
  const renderer::Light &light = changed.light.light, base = renderer::lightOf("overcast");
  EXPECT_EQ(light.to_light, Vec3(0.0, 0.0, 2.0));
  EXPECT_EQ(light.sun, Vec3(2.0 * base.sun));
  EXPECT_EQ(light.horizon, Vec3(1.0, 1.0, 1.0));
  EXPECT_GT(light.sky_light.x(), base.sky_light.x());  // A brighter sky gives more light.
  EXPECT_EQ(light.zenith, base.zenith);
  EXPECT_EQ(light.exposure, 1.5);
  EXPECT_EQ(chosenLight(changed.light, "", 2.0).light.exposure, 2.0);
  EXPECT_EQ(chosenLight(changed.light, "sunset", {}).light, renderer::lightOf("sunset"));
}

TEST(SceneLook, ACameraHasALens) {
  const Scene read = parseScene(
      scene("{}", R"("cameras": { "main": { "fit": true, "aperture": 0.1, "focus": 4 } }, )"), "look.json");
  EXPECT_EQ(read.cameras.at("main").aperture_m, 0.1);
  EXPECT_EQ(read.cameras.at("main").focus_m, 4.0);
}

TEST(SceneLook, WhatIsUnknownIsAnsweredWithWhatIsAccepted) {
  EXPECT_NE(refusal(scene(R"({ "surface": "wod" })")).find("\"wod\" is unknown; did you mean \"wood\"?"),
            std::string::npos);
  EXPECT_NE(refusal(scene(R"({ "ground": "lava" })")).find("planks"), std::string::npos);
  EXPECT_NE(refusal(scene(R"({ "surface": "wood", "checker": true })")).find("accepted: one of them"),
            std::string::npos);
  EXPECT_NE(refusal(scene(R"({ "surfaceScale": 2 })")).find("no \"surface\" to scale"), std::string::npos);
  EXPECT_NE(refusal(scene("{}", R"("light": "noon", )")).find("studio-dark"), std::string::npos);
  EXPECT_NE(refusal(scene("{}", R"("light": { "direction": [0, 0, 0] }, )")).find("towards the sun"),
            std::string::npos);
  EXPECT_NE(refusal(scene("{}", R"("sun": [0, 0, 1], )")).find("write \"light\""), std::string::npos);
  EXPECT_NE(refusal(scene(R"({ "texture": "wood" })")).find("\"surface\": \"wood\""), std::string::npos);
}

}  // namespace
}  // namespace carom::demos
