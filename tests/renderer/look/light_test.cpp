#include "renderer/look/light.h"

#include <cmath>

#include <gtest/gtest.h>

namespace carom::renderer {
namespace {

TEST(Light, DayIsWhatThereIsWithoutAName) {
  EXPECT_EQ(lightOf("day"), Light{});
}

TEST(Light, EveryNameIsAnotherLight) {
  for (const std::string& a : lightNames())
    for (const std::string& b : lightNames()) EXPECT_EQ(lightOf(a) == lightOf(b), a == b) << a << ' ' << b;
}

// The film is l / sqrt(1 + l^2); its inverse, twice the light, and the film again.
TEST(Light, ExposureActsOnTheLightNotOnTheImage) {
  const Vec3 image(0.1, 0.5, 0.9);
  EXPECT_EQ(exposed(image, 1.0), image);
  const Vec3 twice = exposed(image, 2.0);
  for (int i = 0; i < 3; ++i) {
    const double light = image[i] / std::sqrt(1.0 - image[i] * image[i]);
    EXPECT_NEAR(twice[i], 2.0 * light / std::sqrt(1.0 + 4.0 * light * light), 1e-12);
  }
  EXPECT_LT((exposed(twice, 0.5) - image).norm(), 1e-12);
}

}  // namespace
}  // namespace carom::renderer
