#include "demos/frames/picture_settings.h"

#include <gtest/gtest.h>

namespace carom::demos {
namespace {

TEST(PictureSettings, HaveTheLightAndWhatIsChosen) {
  SceneLight light = chosenLight({}, "sunset", 0.5);
  light.light.pool = 3.0;
  const renderer::Settings settings = pictureSettings(light, {320, 180, "osmesa", renderer::Preset::kFast});
  EXPECT_EQ(renderer::shaderLines(settings.light), renderer::shaderLines(light.light));
  EXPECT_EQ(settings.light.to_light, light.light.to_light);
  EXPECT_EQ(settings.light.pool, 3.0);
  EXPECT_EQ(settings.width, 320);
  EXPECT_EQ(settings.height, 180);
  EXPECT_EQ(settings.backend, renderer::GlBackend::kOsmesa);
  EXPECT_EQ(settings.preset, renderer::Preset::kFast);
}

}  // namespace
}  // namespace carom::demos
