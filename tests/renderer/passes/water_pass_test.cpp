// Water on the image: where it is, how it dims, where its line runs. Oracles are the pinhole equation, ray
// lengths and the sines themselves.
#include "renderer/passes/water_pass.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include <gtest/gtest.h>

#include "renderer/frame/frame_renderer.h"
#include "tests/support/pose_at.h"

namespace carom::renderer {
namespace {

constexpr int kWidth = 320, kHeight = 180;
constexpr double kInf = std::numeric_limits<double>::infinity();
const Camera kCamera{Vec3(1.0, -7.0, 3.0), Vec3(0.0, 0.0, 0.3), 40.0};
enum : int { kGround, kBall, kBox, kPost, kSlab };

const std::vector<Solid>& solids() {
  static const std::vector<Solid> all = {Solid::box(Vec3(40.0, 40.0, 1.0)), Solid::ball(0.5),
                                         Solid::box(Vec3(1.0, 1.0, 1.0)), Solid::box(Vec3(0.3, 0.3, 4.0)),
                                         Solid::box(Vec3(3.0, 3.0, 0.5))};
  return all;
}

Instance groundAt(double top) {
  return {kGround, poseAt(0.0, 0.0, top - 0.5), {}, true};
}
WaterVolume seaAt(double level) {
  WaterVolume sea;
  sea.max.z() = level;
  return sea;
}
WaterVolume boxOf(const Vec3& min, const Vec3& max) {
  WaterVolume box;
  box.min = min;
  box.max = max;
  return box;
}

int sumAt(const Image& image, int x, int y) {
  const std::uint8_t* p = image.pixel(x, y);
  return p[0] + p[1] + p[2];
}
int largestChange(const Image& a, const Image& b, int x, int y) {
  int change = 0;
  for (int c = 0; c < 3; ++c) change = std::max(change, std::abs(a.pixel(x, y)[c] - b.pixel(x, y)[c]));
  return change;
}
Vec2 pixelOf(const Vec3& p_W, const Camera& camera = kCamera) {
  return *projectToPixel(camera, kWidth, kHeight, p_W);
}
// The row of the brightest pixel of a column between two rows.
double brightestRow(const Image& image, int x, int from, int to) {
  int best = from;
  for (int y = from; y <= to; ++y)
    if (sumAt(image, x, y) > sumAt(image, x, best)) best = y;
  return best + 0.5;
}

class Water : public testing::Test {
 protected:
  explicit Water(Style style = Style::kDaylight) : renderer_(settings(style), solids()) {}
  static Settings settings(Style style) {
    Settings s{kWidth, kHeight};
    s.style = style;
    return s;
  }
  Image draw(const std::vector<Instance>& instances, const std::vector<WaterVolume>& water = {},
             const Camera& camera = kCamera) {
    return renderer_.draw(instances, camera, {}, water);
  }
  FrameRenderer renderer_;
};

TEST_F(Water, FramesWithoutItDoNotDependOnFramesWithIt) {
  const std::vector<Instance> scene = {groundAt(-1.0), {kBall, poseAt(0.0, 0.0, 0.0), {0.8f, 0.2f, 0.1f}}};
  const Image before = draw(scene), wet = draw(scene, {seaAt(0.0)}), after = draw(scene);
  EXPECT_EQ(before.rgb, after.rgb);
  EXPECT_NE(before.rgb, wet.rgb);
  EXPECT_EQ(wet.rgb, draw(scene, {seaAt(0.0)}).rgb);
}

TEST_F(Water, AboveTheWaterlineNothingChangesAndBelowItEverythingDoes) {
  const std::vector<Instance> scene = {groundAt(-1.0), {kBall, poseAt(0.0, 0.0, 0.0), {0.8f, 0.2f, 0.1f}}};
  const Image dry = draw(scene), wet = draw(scene, {seaAt(0.0)});
  // Down the ball's front: every point of it well above the level, and every one well below.
  const Vec3 front = (Vec3(kCamera.eye.x(), kCamera.eye.y(), 0.0)).normalized();
  int above = 0, below = 0;
  for (double elevation = -0.6; elevation <= 1.2; elevation += 0.05) {
    const Vec3 p = 0.5 * (std::cos(elevation) * front + std::sin(elevation) * Vec3::UnitZ());
    const Vec2 pixel = pixelOf(p), line = pixelOf(0.5 * front);
    const int x = static_cast<int>(pixel.x()), y = static_cast<int>(pixel.y());
    if (pixel.y() < line.y() - 5.0) {
      ++above;
      EXPECT_EQ(largestChange(dry, wet, x, y), 0) << elevation;
    } else if (pixel.y() > line.y() + 5.0) {
      ++below;
      EXPECT_GT(largestChange(dry, wet, x, y), 5) << elevation;
    }
  }
  EXPECT_GE(above, 5);
  EXPECT_GE(below, 5);
}

TEST_F(Water, ALineMarksWhereTheSurfaceCutsABall) {
  const Image image = draw({{kBall, poseAt(0.0, 0.0, 0.0), {0.05f, 0.08f, 0.3f}}}, {seaAt(0.1)});
  const double radius = std::sqrt(0.25 - 0.01);
  const double towards = std::atan2(kCamera.eye.y(), kCamera.eye.x());
  for (double turn = -0.9; turn <= 0.9; turn += 0.15) {
    const Vec3 p(radius * std::cos(towards + turn), radius * std::sin(towards + turn), 0.1);
    const Vec2 line = pixelOf(p);
    const int x = static_cast<int>(line.x()), y = static_cast<int>(line.y());
    EXPECT_NEAR(brightestRow(image, x, y - 6, y + 6), line.y(), 1.5) << turn;
    EXPECT_GT(sumAt(image, x, y), sumAt(image, x, y - 6) + 60) << turn;
    EXPECT_GT(sumAt(image, x, y), sumAt(image, x, y + 6) + 60) << turn;
  }
}

TEST_F(Water, ALineMarksWhereTheSurfaceCutsTheWallsOfAPool) {
  const Camera camera{Vec3(0.0, -5.0, 4.0), Vec3(0.0, 0.0, 0.0), 40.0};
  const std::vector<Instance> wall = {{kBox, poseAt(0.0, 1.5, 0.0), {0.3f, 0.2f, 0.2f}}};
  const Image image = draw(wall, {boxOf(Vec3(-2.0, -1.0, -1.0), Vec3(2.0, 1.0, 0.2))}, camera);
  for (const double x_m : {-0.4, -0.1, 0.3}) {
    const Vec2 line = pixelOf(Vec3(x_m, 1.0, 0.2), camera);
    const int y = static_cast<int>(line.y());
    EXPECT_NEAR(brightestRow(image, static_cast<int>(line.x()), y - 4, y + 8), line.y(), 1.5) << x_m;
  }
}

double light(const Image& image, const Vec2& pixel, int channel) {
  return linearLight(
      static_cast<float>(image.pixel(static_cast<int>(pixel.x()), static_cast<int>(pixel.y()))[channel]) /
      255.0f);
}

// White less black is what of a slab's own light comes through; Fresnel's share is that of the same angle at
// every depth.
TEST_F(Water, DimsByBeerAndLambertsLawAlongTheRay) {
  const Camera camera{Vec3(0.5, -4.0, 6.0), Vec3(0.0, 0.0, 0.0), 40.0};
  WaterVolume sea = seaAt(0.0);
  sea.color = {0.55f, 0.8f, 0.9f};
  const auto shareAt = [&](double top, double* length_m) {
    const Vec3 p(0.1, 0.2, top);
    const std::vector<Instance> white = {{kSlab, poseAt(0.0, 0.0, top - 0.25), {1.0f, 1.0f, 1.0f}}},
                                black = {{kSlab, poseAt(0.0, 0.0, top - 0.25), {0.0f, 0.0f, 0.0f}}};
    const Vec2 pixel = pixelOf(p, camera);
    *length_m = (p - camera.eye).norm() * (0.0 - top) / (camera.eye.z() - top);
    const Image wet_white = draw(white, {sea}, camera), wet_black = draw(black, {sea}, camera),
                dry_white = draw(white, {}, camera), dry_black = draw(black, {}, camera);
    Vec3 share;
    for (int c = 0; c < 3; ++c)
      share[c] = (light(wet_white, pixel, c) - light(wet_black, pixel, c)) /
                 (light(dry_white, pixel, c) - light(dry_black, pixel, c));
    return share;
  };
  double reference_m = 0.0, length_m = 0.0;
  const Vec3 reference = shareAt(-0.2, &reference_m);
  const Vec3 color(linearLight(0.55f), linearLight(0.8f), linearLight(0.9f));
  for (const double top : {-0.6, -1.2, -2.0}) {
    const Vec3 share = shareAt(top, &length_m);
    for (int c = 0; c < 3; ++c) {
      const double expected = std::pow(color[c], (length_m - reference_m) / kColorDepth_m);
      EXPECT_NEAR(share[c] / reference[c], expected, 0.02 + 0.03 * expected) << top << " " << c;
    }
  }
}

TEST_F(Water, WavesStandWhereTheirSinesDo) {
  const Camera camera{Vec3(0.0, -9.0, 2.0), Vec3(0.0, 0.0, 0.0), 40.0};
  WaterVolume sea = seaAt(0.1);
  for (const double phase : {0.0, 1.1, 2.9, 4.6}) {
    sea.waves = {{0.25, Vec2(2.0, 0.3), phase}, {0.1, Vec2(-1.0, 1.7), 2.0 * phase}};
    for (const double x_m : {-2.0, -0.7, 0.6, 1.9}) {
      const Image image = draw({{kPost, poseAt(x_m, 0.0, 0.0), {0.25f, 0.1f, 0.05f}}}, {sea}, camera);
      const Vec2 front(x_m, -0.15);
      double height_m = 0.1;
      for (const WaterWave& wave : sea.waves)
        height_m += wave.amplitude_m * std::sin(wave.wave_vector.dot(front) + wave.phase);
      const Vec2 line = pixelOf(Vec3(front.x(), front.y(), height_m), camera);
      const int y = static_cast<int>(line.y());
      EXPECT_NEAR(brightestRow(image, static_cast<int>(line.x()), y - 12, y + 5), line.y(), 1.5)
          << x_m << " " << phase;
    }
  }
}

// Whatever the shading, it repeats with the wave's length along x.
TEST_F(Water, ShadingRepeatsWithTheWavesLength) {
  const Camera camera{Vec3(0.0, -3.0, 9.0), Vec3(0.0, 0.0, 0.0), 40.0};
  WaterVolume sea = seaAt(0.0);
  sea.waves = {{0.06, Vec2(2.0 * std::numbers::pi, 0.0), 0.4}};
  const Image image = draw({}, {sea}, camera), flat = draw({}, {seaAt(0.0)}, camera);
  const auto rowOf = [&](const Image& of, double x_m) {
    const Vec2 pixel = pixelOf(Vec3(x_m, 0.0, 0.0), camera);
    return sumAt(of, static_cast<int>(pixel.x()), static_cast<int>(pixel.y()));
  };
  int least = 765, most = 0;
  for (double x_m = -1.5; x_m < 0.5; x_m += 0.1) {
    EXPECT_NEAR(rowOf(image, x_m), rowOf(image, x_m + 1.0), 12) << x_m;
    EXPECT_NEAR(rowOf(flat, x_m), rowOf(flat, x_m + 1.0), 12) << x_m;
    least = std::min(least, rowOf(image, x_m));
    most = std::max(most, rowOf(image, x_m));
  }
  EXPECT_GT(most - least, 6) << "waves must be seen";
}

TEST_F(Water, ABoxIsSeenWithinItsOutlineAndNowhereElse) {
  const WaterVolume box = boxOf(Vec3(-1.0, -0.8, -0.2), Vec3(1.2, 0.8, 0.9));
  const std::vector<Instance> scene = {groundAt(-0.2)};
  const Image dry = draw(scene), wet = draw(scene, {box});
  // A ray meets the box if it does so with its three pairs of planes at once.
  const CameraAxes axes = cameraAxes(kCamera);
  const double focal = focalLengthPixels(kCamera, kHeight);
  const auto lengthInside = [&](double x, double y) -> double {
    const Vec3 ray =
        (axes.forward + (x - 0.5 * kWidth) / focal * axes.right - (y - 0.5 * kHeight) / focal * axes.up)
            .normalized();
    double from = 0.0, to = kInf;
    for (int i = 0; i < 3; ++i) {
      const double a = (box.min[i] - kCamera.eye[i]) / ray[i], b = (box.max[i] - kCamera.eye[i]) / ray[i];
      from = std::max(from, std::min(a, b));
      to = std::min(to, std::max(a, b));
    }
    return to - from;
  };
  int inside = 0;
  for (int y = 4; y < kHeight - 4; ++y)
    for (int x = 4; x < kWidth - 4; ++x) {
      double least = kInf, most = -kInf;
      for (const double dy : {-3.5, 0.5, 4.5})
        for (const double dx : {-3.5, 0.5, 4.5}) {
          least = std::min(least, lengthInside(x + dx, y + dy));
          most = std::max(most, lengthInside(x + dx, y + dy));
        }
      if (most < 0.0) {
        ASSERT_LE(largestChange(dry, wet, x, y), 4)
            << x << " " << y;  // Edges are smoothed along their length.
      } else if (least > 0.6) {
        ++inside;
        ASSERT_GT(largestChange(dry, wet, x, y), 8) << x << " " << y;
      }
    }
  EXPECT_GT(inside, 1000);
}

TEST_F(Water, WhatStandsBeforeItHidesIt) {
  const std::vector<Instance> scene = {{kBox, poseAt(0.3, -2.5, 1.0), {0.8f, 0.2f, 0.1f}}};
  const WaterVolume behind = boxOf(Vec3(-3.0, 0.0, -1.0), Vec3(3.0, 2.0, 1.0));
  const Image dry = draw(scene), wet = draw(scene, {behind});
  const Vec2 middle = pixelOf(Vec3(0.3, -3.0, 1.0));
  for (int d = -8; d <= 8; ++d)
    EXPECT_EQ(largestChange(dry, wet, static_cast<int>(middle.x()) + d, static_cast<int>(middle.y()) + d / 2),
              0);
}

TEST_F(Water, VolumesAreDrawnByDistanceNotInTheOrderGiven) {
  WaterVolume near = boxOf(Vec3(-1.0, -2.0, -1.0), Vec3(1.0, -1.0, 1.0)),
              far = boxOf(Vec3(-1.0, 1.0, -1.0), Vec3(1.0, 2.0, 1.0));
  far.color = {0.9f, 0.5f, 0.3f};
  const std::vector<Instance> scene = {groundAt(-1.0)};
  EXPECT_EQ(draw(scene, {near, far}).rgb, draw(scene, {far, near}).rgb);
}

TEST_F(Water, AnEndlessSheetFadesIntoTheHorizon) {
  WaterVolume sea = seaAt(0.0);
  sea.waves = {{0.1, Vec2(1.3, 0.4), 0.0}};
  const Camera camera{Vec3(1.0, -7.0, 2.0), Vec3(0.0, 0.0, 1.2), 40.0};
  const Image image = draw({}, {sea}, camera);
  const int horizon = static_cast<int>(pixelOf(camera.eye + Vec3(-1.0, 7.0, 0.0), camera).y());
  for (int x = 10; x < kWidth; x += 50) {
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(image.pixel(x, horizon - 3)[c], image.pixel(x, horizon + 3)[c], 6) << x;
    EXPECT_GT(std::abs(sumAt(image, x, horizon - 3) - sumAt(image, x, kHeight - 5)), 60) << x;
  }
}

TEST_F(Water, SeenFromWithinItDimsWhatIsFarther) {
  const Camera camera{Vec3(0.0, -4.0, 0.0), Vec3(0.0, 0.0, 0.0), 40.0};
  const auto reddest = [&](double y) {
    WaterVolume sea = seaAt(3.0);
    sea.color = {0.7f, 0.9f, 0.9f};
    const Image image = draw({{kBox, poseAt(0.0, y, 0.0), {0.9f, 0.1f, 0.1f}}}, {sea}, camera);
    return static_cast<int>(image.pixel(kWidth / 2, kHeight / 2)[0]);
  };
  const int near = reddest(-2.0), middle = reddest(0.0), far = reddest(3.0);
  EXPECT_GT(near, middle + 20);
  EXPECT_GT(middle, far + 10);
}

TEST_F(Water, IsNotInTheSurfaceImages) {
  const std::vector<Instance> scene = {groundAt(-1.0), {kBall, poseAt(0.0, 0.0, 0.0), {}}};
  draw(scene);
  const SurfaceImage dry = renderer_.surfaces();
  draw(scene, {seaAt(0.2)});
  const SurfaceImage wet = renderer_.surfaces();
  EXPECT_EQ(dry.depth.depth_m, wet.depth.depth_m);
  EXPECT_EQ(dry.instance, wet.instance);
}

class WaterOnPaper : public Water {
 protected:
  WaterOnPaper() : Water(Style::kPrint) {}
};

TEST_F(WaterOnPaper, FadesToWhiteAndTintsNearBy) {
  const Image image = draw({groundAt(-1.0)}, {seaAt(0.0)});
  EXPECT_EQ(sumAt(image, 5, 2), 765);
  const std::uint8_t* near = image.pixel(kWidth / 2, kHeight - 5);
  EXPECT_GT(near[2], near[0] + 15) << "bluish";
}

}  // namespace
}  // namespace carom::renderer
