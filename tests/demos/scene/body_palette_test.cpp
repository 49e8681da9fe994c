#include "demos/scene/body_palette.h"

#include <cmath>

#include <gtest/gtest.h>

#include "demos/language/scene_file.h"
#include "demos/scene/scene_world.h"

namespace carom::demos {
namespace {

// Linear sRGB to linear sRGB as seen with one kind of cone missing, at full severity: Machado, Oliveira and
// Fernandes, "A physiologically-based model for simulation of color vision deficiency", 2009, table 1.
struct Vision {
  const char* name;
  Mat3 seen;
};
std::vector<Vision> visions() {
  Mat3 protan, deutan, tritan;
  protan << 0.152286, 1.052583, -0.204868, 0.114503, 0.786281, 0.099216, -0.003882, -0.048116, 1.051998;
  deutan << 0.367322, 0.860646, -0.227968, 0.280085, 0.672501, 0.047413, -0.011820, 0.042940, 0.968881;
  tritan << 1.255528, -0.076749, -0.178779, -0.078411, 0.930809, 0.147602, 0.004733, 0.691367, 0.303900;
  return {
      {"usual", Mat3::Identity()}, {"protanopia", protan}, {"deuteranopia", deutan}, {"tritanopia", tritan}};
}

// CIE 1976 L*a*b* under D65.
Vec3 labOf(const Vec3& linear) {
  Mat3 xyz_from_rgb;
  xyz_from_rgb << 0.4124564, 0.3575761, 0.1804375, 0.2126729, 0.7151522, 0.0721750, 0.0193339, 0.1191920,
      0.9503041;
  const Vec3 xyz = (xyz_from_rgb * linear).cwiseQuotient(Vec3(0.95047, 1.0, 1.08883));
  const auto f = [](double t) {
    return t > 216.0 / 24389.0 ? std::cbrt(t) : (24389.0 / 27.0 * t + 16.0) / 116.0;
  };
  return {116.0 * f(xyz.y()) - 16.0, 500.0 * (f(xyz.x()) - f(xyz.y())), 200.0 * (f(xyz.y()) - f(xyz.z()))};
}

Vec3 seenAs(const renderer::Color& color, const Mat3& seen) {
  const Eigen::Vector3f linear(renderer::linearLight(color.r), renderer::linearLight(color.g),
                               renderer::linearLight(color.b));
  return labOf((seen * linear.cast<double>()).cwiseMax(0.0).cwiseMin(1.0));
}

// A difference of 2.3 is just noticeable (Mahy and others, 1994); on bodies that are lit and shaded, some
// multiple of it has to be left.
TEST(BodyPalette, AnyTwoColoursStayApartForEveryKindOfColourVision) {
  constexpr double kJustNoticeable = 2.3;
  for (const Vision& vision : visions())
    for (std::size_t i = 0; i < kPaletteColors; ++i)
      for (std::size_t k = 0; k < i; ++k) {
        const Vec3 a = seenAs(paletteColor(i), vision.seen), b = seenAs(paletteColor(k), vision.seen);
        EXPECT_GT((a - b).norm(), 4.0 * kJustNoticeable) << vision.name << ' ' << k << ' ' << i;
      }
}

// That the measure can say no: a red and a green, far apart for most eyes, which deuteranopes take for one.
TEST(BodyPalette, TheMeasureTellsColoursThatGreenBlindEyesConfuse) {
  const renderer::Color red{200.0f / 255.0f, 80.0f / 255.0f, 60.0f / 255.0f};
  const renderer::Color green{105.0f / 255.0f, 140.0f / 255.0f, 50.0f / 255.0f};
  const std::vector<Vision> all = visions();
  EXPECT_GT((seenAs(red, all[0].seen) - seenAs(green, all[0].seen)).norm(), 60.0);
  EXPECT_LT((seenAs(red, all[2].seen) - seenAs(green, all[2].seen)).norm(), 3.0);
}

TEST(BodyPalette, NeighboursInTheOrderDifferMost) {
  for (const Vision& vision : visions())
    for (std::size_t i = 0; i < kPaletteColors; ++i) {
      const Vec3 a = seenAs(paletteColor(i), vision.seen), b = seenAs(paletteColor(i + 1), vision.seen);
      EXPECT_GT((a - b).norm(), 20.0) << vision.name << ' ' << i;
    }
}

TEST(BodyPalette, ColoursBodiesThatMoveAndHaveNoneOfTheirOwn) {
  const Scene scene = parseScene(
      R"({ "format": 1, "materials": { "wood": {}, "brick": { "color": "#aa4433" } }, "bodies": [
      { "name": "shelf", "shape": { "box": [9, 1, 1] }, "position": [0, 0, -5], "static": true },
      { "name": "own", "shape": { "box": [1, 1, 1] }, "color": "#102030" },
      { "name": "brick", "shape": { "box": [1, 1, 1] }, "position": [3, 0, 0], "material": "brick" },
      { "name": "wood", "shape": { "box": [1, 1, 1] }, "position": [6, 0, 0], "material": "wood" },
      { "name": "row", "shape": { "box": [1, 1, 1] }, "position": [0, 6, 0],
        "repeat": { "count": [3, 1, 1], "step": [2, 0, 0] } } ] })",
      "colors.json");
  const SceneWorld made = makeSceneWorld(scene, std::nullopt);
  const auto same = [](const renderer::Color& a, const renderer::Color& b) {
    return a.r == b.r && a.g == b.g && a.b == b.b;
  };
  EXPECT_TRUE(same(made.looks[0].color, renderer::Color()));
  EXPECT_TRUE(same(made.looks[1].color, {16.0f / 255.0f, 32.0f / 255.0f, 48.0f / 255.0f}));
  EXPECT_TRUE(same(made.looks[2].color, {170.0f / 255.0f, 68.0f / 255.0f, 51.0f / 255.0f}));
  for (std::size_t body = 3; body < 7; ++body)
    EXPECT_TRUE(same(made.looks[body].color, paletteColor(body))) << body;
}

}  // namespace
}  // namespace carom::demos
