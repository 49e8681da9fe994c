#include "renderer/view/preset.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "renderer/frame/frame_renderer.h"
#include "tests/support/pose_at.h"

namespace carom::renderer {
namespace {

constexpr Preset kAll[] = {Preset::kFast, Preset::kRealtime, Preset::kQuality, Preset::kCinematic};
constexpr int kWidth = 320, kHeight = 180;
const Camera kCamera{Vec3(1.0, -7.0, 3.0), Vec3(0.0, 0.0, 0.5), 40.0};
const Color kRed{0.85f, 0.12f, 0.1f};
enum : int { kGround, kBall, kBox };

const std::vector<Solid>& solids() {
  static const std::vector<Solid> all = {Solid::box(Vec3(40.0, 40.0, 1.0)), Solid::ball(0.5),
                                         Solid::box(Vec3(1.0, 1.0, 1.0))};
  return all;
}
Instance ground() {
  return {kGround, poseAt(0.0, 0.0, -0.5), {}, true};
}

Image drawn(Preset preset, const std::vector<Instance>& instances, Style style = Style::kDaylight) {
  Settings settings{.width = kWidth, .height = kHeight};
  settings.preset = preset;
  settings.style = style;
  return FrameRenderer(settings, solids()).draw(instances, kCamera);
}

const std::uint8_t* seenAt(const Image& image, const Vec3& p_W) {
  const Vec2 p = projectToPixel(kCamera, kWidth, kHeight, p_W).value();
  return image.pixel(static_cast<int>(p.x()), static_cast<int>(p.y()));
}
int redness(const std::uint8_t* p) {
  return p[0] - (p[1] + p[2]) / 2;
}

TEST(Preset, ExposuresLieInTheirPixelAndDiscAndHaveNoMeanShift) {
  const Vec3 to_light = Vec3(0.5, -0.5, 0.85).normalized();
  for (const Preset preset : kAll) {
    const Quality quality = qualityOf(preset, Style::kDaylight);
    const std::vector<Sample> samples = samplesOf(quality, to_light);
    ASSERT_EQ(samples.size(), static_cast<std::size_t>(quality.samples));
    Vec2 shift = Vec2::Zero();
    Vec3 light = Vec3::Zero();
    std::set<double> columns, rows;
    for (const Sample& sample : samples) {
      EXPECT_LT(sample.shift_px.cwiseAbs().maxCoeff(), 0.5);
      EXPECT_LE(sample.to_light.cross(to_light).norm(), quality.sun_half_angle + 1e-12);
      shift += sample.shift_px / quality.samples;
      light += sample.to_light / quality.samples;
      columns.insert(sample.shift_px.x()), rows.insert(sample.shift_px.y());
    }
    EXPECT_LT(shift.norm(), 1e-12);
    EXPECT_LT(light.normalized().cross(to_light).norm(), 0.2 * quality.sun_half_angle + 1e-12);
    // As many columns and rows as samples: an upright edge and a level one are as smooth as any.
    EXPECT_EQ(columns.size(), samples.size());
    EXPECT_EQ(rows.size(), samples.size());
  }
  EXPECT_EQ(samplesOf(qualityOf(Preset::kRealtime, Style::kDaylight), to_light)[0].to_light, to_light);
}

TEST(Preset, RepeatedFramesAreTheSamePixelsInEveryPresetAndStyle) {
  const std::vector<Instance> scene = {
      ground(), {kBall, poseAt(0.3, 0.2, 0.9), kRed}, {kBox, poseAt(-1.0, 0.5, 0.5), {}}};
  for (const Preset preset : kAll)
    for (const Style style : {Style::kDaylight, Style::kPrint})
      EXPECT_EQ(drawn(preset, scene, style).rgb, drawn(preset, scene, style).rgb) << nameOf(preset);
}

// The middle of the ball's red pixels, against the same of the plain preset: more exposures shift nothing.
TEST(Preset, NoPresetShiftsThePicture) {
  const std::vector<Instance> scene = {{kBall, poseAt(0.3, 0.2, 0.9), kRed}};
  const auto middle = [&](Preset preset) {
    const Image image = drawn(preset, scene);
    Vec2 sum = Vec2::Zero();
    double weight = 0.0;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const double red = std::max(0, redness(image.pixel(x, y)));
        sum += red * Vec2(x, y);
        weight += red;
      }
    return Vec2(sum / weight);
  };
  const Vec2 plain = middle(Preset::kRealtime);
  for (const Preset preset : kAll) EXPECT_LT((middle(preset) - plain).norm(), 0.1) << nameOf(preset);
}

// Along a slanted edge before the sky an image without anti-aliasing holds two colours a row.
TEST(Preset, EveryPresetSmoothsEdges) {
  const Pose turned{Quat(Eigen::AngleAxisd(0.3, Vec3(0.2, 1.0, 0.1).normalized())), Vec3(0.0, 0.0, 2.0)};
  for (const Preset preset : kAll)
    for (const Style style : {Style::kDaylight, Style::kPrint}) {
      const Image image = drawn(preset, {{kBox, turned, {0.05f, 0.05f, 0.05f}}}, style);
      int rows = 0, smoothed = 0;
      for (int y = 0; y < kHeight; ++y) {
        // The left outline of the dark box in this row.
        int x = 0;
        while (x < kWidth && image.pixel(x, y)[2] > 150) ++x;
        if (x < 2 || x > kWidth - 4) continue;
        ++rows;
        const int before = image.pixel(x - 2, y)[2], at_edge = image.pixel(x - 1, y)[2];
        const int on_edge = image.pixel(x, y)[2], behind = image.pixel(x + 2, y)[2];
        smoothed += at_edge < before - 12 || on_edge > behind + 25;
      }
      ASSERT_GT(rows, 20);
      EXPECT_GT(smoothed, rows * 3 / 4) << nameOf(preset) << ' ' << nameOf(style);
    }
}

// The shadow of a ball a metre and a half up, along a line across its edge on the ground: how many pixels lie
// between lit and dark.
TEST(Preset, TheCinematicSunCastsWiderPenumbrasThanThePlainOne) {
  const auto penumbra = [](Preset preset) {
    const Image image = drawn(preset, {ground(), {kBall, poseAt(0.0, 0.0, 2.3), kRed}});
    // The shadow's centre by the sun's direction (0.5, -0.5, 0.85).
    const Vec3 center(-0.5 / 0.85 * 2.3, 0.5 / 0.85 * 2.3, 0.0);
    int partly = 0;
    const int dark = seenAt(image, center)[0];
    const Image open = drawn(preset, {ground()});
    for (int i = 0; i < 400; ++i) {
      const Vec3 p = center + Vec3(-0.004 * i, 0.0, 0.0);
      const double lit = seenAt(open, p)[0];
      const double share = (seenAt(image, p)[0] - dark) / std::max(1.0, lit - dark);
      partly += share > 0.1 && share < 0.9;
    }
    return 0.004 * partly;
  };
  const double plain_m = penumbra(Preset::kRealtime), cinematic_m = penumbra(Preset::kCinematic);
  // A disc whose half angle has the tangent 0.05, 2.7 m away: 0.27 m across the ray, of which the middle 80 %
  // of the light passes over about two thirds.
  EXPECT_GT(cinematic_m, plain_m + 0.06);
  EXPECT_LT(cinematic_m, 0.45);
}

TEST(Preset, TheCinematicGroundMirrorsABodyWhereItsImageIs) {
  const std::vector<Instance> scene = {ground(), {kBall, poseAt(0.0, -0.5, 0.9), kRed}};
  // A sunlit point of the ball that the eye's image below the ground sees.
  const Vec3 point = Vec3(0.0, -0.5, 0.9) + 0.45 * Vec3(0.0, -1.0, 0.2).normalized();
  const Vec3 image_of_point(point.x(), point.y(), -point.z());
  const Image cinematic = drawn(Preset::kCinematic, scene), plain = drawn(Preset::kRealtime, scene);
  EXPECT_GT(redness(seenAt(cinematic, image_of_point)), redness(seenAt(plain, image_of_point)) + 12);
  // Beside the image of the ball, by twice its radius, there is none of it.
  const Vec3 beside = image_of_point + Vec3(1.0, 0.0, 0.0);
  EXPECT_LT(std::abs(redness(seenAt(cinematic, beside)) - redness(seenAt(plain, beside))), 8);
}

TEST(Preset, PrintIsWhiteAroundTheBodiesAndDarkensOnlyInShadow) {
  const std::vector<Instance> scene = {ground(), {kBall, poseAt(0.0, 0.0, 0.6), kRed}};
  for (const Preset preset : kAll) {
    const Image image = drawn(preset, scene, Style::kPrint);
    const auto least = [](const std::uint8_t* p) { return std::min({p[0], p[1], p[2]}); };
    EXPECT_EQ(least(image.pixel(0, 0)), 255);  // far ground or sky, no horizon
    EXPECT_EQ(least(image.pixel(kWidth - 1, 0)), 255);
    EXPECT_GE(least(seenAt(image, Vec3(1.9, -1.0, 0.0))), 235);  // ground nearby
    EXPECT_GT(redness(seenAt(image, Vec3(0.0, 0.0, 0.6))), 60);
    const Vec3 shadow(-0.5 / 0.85 * 0.6, 0.5 / 0.85 * 0.6, 0.0);
    EXPECT_LT(least(seenAt(image, shadow + Vec3(-0.2, 0.2, 0.0))), 225) << nameOf(preset);
  }
}

TEST(Preset, PrintHasNoAirBetweenHereAndThere) {
  const auto far_red = [](Style style) {
    const Image image =
        drawn(Preset::kRealtime, {{kBox, {Quat::Identity(), Vec3(-2.0, 30.0, 0.0)}, kRed}}, style);
    return redness(seenAt(image, Vec3(-2.0, 29.5, 0.0)));
  };
  EXPECT_GT(far_red(Style::kPrint), far_red(Style::kDaylight) + 15);
}

}  // namespace
}  // namespace carom::renderer
