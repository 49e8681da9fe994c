#include "renderer/frame/frame_renderer.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <thread>

#include <gtest/gtest.h>

#include "engine/foundation/contract.h"
#include "tests/support/pose_at.h"

namespace carom::renderer {
namespace {

constexpr int kWidth = 320, kHeight = 180;
const Camera kCamera{Vec3(1.0, -7.0, 3.0), Vec3(0.0, 0.0, 0.5), 40.0};
const Color kRed{0.85f, 0.12f, 0.1f}, kBlue{0.1f, 0.2f, 0.85f};
enum : int { kGround, kBall, kBox, kCapsule };

const std::vector<Solid>& solids() {
  static const std::vector<Solid> all = {Solid::box(Vec3(40.0, 40.0, 1.0)), Solid::ball(0.5),
                                         Solid::box(Vec3(1.0, 1.0, 1.0)), Solid::capsule(0.2, 0.6)};
  return all;
}

Instance ground() {
  return {kGround, poseAt(0.0, 0.0, -0.5), {}, true};
}

// The oracle for where a point is drawn: heading and pitch as angles, then the pinhole equation.
Vec2 pinhole(const Camera& camera, const Vec3& p_W) {
  const Vec3 view = camera.target - camera.eye, to_p = p_W - camera.eye;
  const double heading = std::atan2(view.y(), view.x());
  const double pitch = std::atan2(view.z(), std::hypot(view.x(), view.y()));
  const double level = std::cos(heading) * to_p.x() + std::sin(heading) * to_p.y();
  const double right = std::sin(heading) * to_p.x() - std::cos(heading) * to_p.y();
  const double ahead = std::cos(pitch) * level + std::sin(pitch) * to_p.z();
  const double up = -std::sin(pitch) * level + std::cos(pitch) * to_p.z();
  const double focal = 0.5 * kHeight / std::tan(0.5 * camera.fov_degrees * std::numbers::pi / 180.0);
  return {0.5 * kWidth + focal * right / ahead, 0.5 * kHeight - focal * up / ahead};
}

struct Rgb {
  int r = 0, g = 0, b = 0;
  int sum() const { return r + g + b; }
};
Rgb at(const Image& image, const Vec2& pixel) {
  const int x = static_cast<int>(std::floor(pixel.x())), y = static_cast<int>(std::floor(pixel.y()));
  REQUIRE(x >= 0 && x < image.width && y >= 0 && y < image.height, x, y);
  const std::uint8_t* p = image.pixel(x, y);
  return {p[0], p[1], p[2]};
}
Rgb seenAt(const Image& image, const Vec3& p_W) {
  return at(image, pinhole(kCamera, p_W));
}
bool isRed(const Rgb& c) {
  return c.r > 2 * c.g && c.r > 2 * c.b;
}

class Frame : public testing::Test {
 protected:
  Frame() : renderer_(Settings{kWidth, kHeight}, solids()) {}
  Image draw(const std::vector<Instance>& instances) { return renderer_.draw(instances, kCamera); }
  FrameRenderer renderer_;
};

TEST_F(Frame, ABallFillsTheDiscThatThePinholeProjectionGivesIt) {
  const Vec3 center(0.6, 0.3, 1.4);
  const Image image = draw({ground(), {kBall, poseAt(center.x(), center.y(), center.z()), kRed}});
  // Near the middle of the image the outline, a cone of sine r/d about the centre, is a circle of this
  // radius.
  const double sine = 0.5 / (center - kCamera.eye).norm();
  const double focal = 0.5 * kHeight / std::tan(20.0 * std::numbers::pi / 180.0);
  const double radius_px = focal * sine / std::sqrt(1.0 - sine * sine);
  EXPECT_TRUE(isRed(seenAt(image, center)));
  const Vec2 middle = pinhole(kCamera, center);
  for (const double side : {-1.0, 1.0}) {
    EXPECT_TRUE(isRed(at(image, middle + Vec2(side * (radius_px - 3.0), 0.0))));
    EXPECT_FALSE(isRed(at(image, middle + Vec2(side * (radius_px + 3.0), 0.0))));
    EXPECT_TRUE(isRed(at(image, middle + Vec2(0.0, side * (radius_px - 3.0)))));
    EXPECT_FALSE(isRed(at(image, middle + Vec2(0.0, side * (radius_px + 3.0)))));
  }
}

TEST_F(Frame, TheNearerBodyHidesTheFartherOne) {
  const Vec3 near = kCamera.eye + 0.5 * (kCamera.target - kCamera.eye);
  const Image image = draw({{kBox, poseAt(kCamera.target.x(), kCamera.target.y(), kCamera.target.z()), kBlue},
                            {kBall, poseAt(near.x(), near.y(), near.z()), kRed}});
  EXPECT_TRUE(isRed(seenAt(image, kCamera.target)));
}

TEST_F(Frame, TheShadowLiesOnTheSideAwayFromTheLight) {
  const Image image = draw({ground(), {kBall, poseAt(0.0, 0.0, 0.9), kRed}});
  const Vec3 light = Settings{}.light.to_light;
  // The middle of the shadow is where the line through the centre along the light meets the ground.
  const Vec3 shadow = Vec3(0.0, 0.0, 0.9) - light * (0.9 / light.z());
  const Vec3 mirrored(-shadow.x(), -shadow.y(), 0.0);
  const Image empty = draw({ground()});
  EXPECT_LT(seenAt(image, shadow).sum(), 0.7 * seenAt(empty, shadow).sum());
  EXPECT_NEAR(seenAt(image, mirrored).sum(), seenAt(empty, mirrored).sum(), 12);
}

TEST_F(Frame, WhereNothingStandsInTheLightTheGroundIsLit) {
  const std::vector<Instance> bodies = {{kBall, poseAt(0.0, 0.0, 0.9), kRed},
                                        {kBall, poseAt(1.5, 0.5, 0.5), kBlue}};
  const Image image = draw({ground(), bodies[0], bodies[1]}), empty = draw({ground()});
  const Vec3 to_light = Settings{}.light.to_light.normalized();
  for (double x = -6.0; x <= 6.0; x += 0.21)
    for (double y = -3.0; y <= 12.0; y += 0.23) {
      const Vec3 p(x, y, 0.0);
      const Vec2 pixel = pinhole(kCamera, p);
      if (pixel.x() < 2 || pixel.x() > kWidth - 2 || pixel.y() < 2 || pixel.y() > kHeight - 2) continue;
      bool open =
          true;  // Neither the line to the light nor the line of sight passes a ball, nor is one close.
      for (const Instance& ball : bodies) {
        const Vec3 c = ball.X_WB.position, to_eye = (kCamera.eye - p).normalized();
        for (const Vec3& ray : {to_light, to_eye}) open = open && (c - p).cross(ray).norm() > 0.65;
        open = open && (c - p).norm() > 1.3;
      }
      if (!open) continue;
      // A shadow takes some 300; a far pixel is larger than the margins above and may take a little of its
      // neighbour.
      EXPECT_NEAR(seenAt(image, p).sum(), seenAt(empty, p).sum(), 30) << x << "," << y;
    }
}

TEST_F(Frame, ALightFromTheOtherSideThrowsTheShadowToTheOtherSide) {
  Settings settings{kWidth, kHeight};
  settings.light.to_light = Vec3(-0.8, -0.2, 1.0);
  FrameRenderer other(settings, solids());
  const std::vector<Instance> scene = {ground(), {kBall, poseAt(0.0, 0.0, 0.9), kRed}};
  const Image left = draw(scene), right = other.draw(scene, kCamera);
  const Vec3 shadow = Vec3(0.0, 0.0, 0.9) - settings.light.to_light * 0.9;
  EXPECT_LT(seenAt(right, shadow).sum(), 0.7 * seenAt(left, shadow).sum());
}

TEST_F(Frame, ALitFaceHasNoShadowOfItsOwn) {
  // The top of the box: all of its inner pixels within a few steps of each other.
  const Image image = draw({ground(), {kBox, poseAt(0.0, 0.0, 0.5), {0.7f, 0.7f, 0.7f}}});
  int darkest = 3 * 255, brightest = 0;
  for (double x = -0.4; x <= 0.4; x += 0.02)
    for (double y = -0.4; y <= 0.4; y += 0.02) {
      const int sum = seenAt(image, Vec3(x, y, 1.0)).sum();
      darkest = std::min(darkest, sum), brightest = std::max(brightest, sum);
    }
  EXPECT_LT(brightest - darkest, 20);
}

TEST_F(Frame, TheGroundIsDarkerNextToWhatStandsOnIt) {
  const Image image = draw({ground(), {kBox, poseAt(0.0, 0.0, 0.5), kRed}});
  const Image empty = draw({ground()});
  // In front of the box, where the light reaches.
  const Vec3 close(0.15, -0.56, 0.0), away(0.15, -1.6, 0.0);
  EXPECT_LT(seenAt(image, close).sum(), 0.95 * seenAt(empty, close).sum());
  EXPECT_EQ(seenAt(image, away).sum(), seenAt(empty, away).sum());
}

TEST_F(Frame, CheckerSquaresAreAMetre) {
  const Camera above{Vec3(0.0, 0.0, 12.0), Vec3(0.0, 0.0, 0.0), 40.0};
  const Image image = renderer_.draw(std::vector<Instance>{ground()}, above);
  const auto brightness = [&](double x, double y) {
    return at(image, *projectToPixel(above, kWidth, kHeight, Vec3(x, y, 0.0))).sum();
  };
  for (int i = -3; i < 3; ++i)
    for (int k = -2; k < 2; ++k) {
      const int here = brightness(i + 0.5, k + 0.5), same = brightness(i + 1.5, k + 1.5),
                next = brightness(i + 1.5, k + 0.5);
      EXPECT_NEAR(here, same, 6) << i << "," << k;
      EXPECT_GT(std::abs(here - next), 60) << i << "," << k;
    }
}

TEST_F(Frame, TheGroundFadesIntoTheHorizonBeyondItsOwnBox) {
  const Image image = draw({ground()});
  // Right before the camera there is a checker; far beyond the box of 40 m there is no step to the sky.
  const Vec2 horizon = pinhole(kCamera, kCamera.eye + 1e6 * Vec3(-0.14, 0.99, 0.0));
  const Rgb sky = at(image, horizon - Vec2(0.0, 2.0)), far_ground = at(image, horizon + Vec2(0.0, 2.0));
  EXPECT_NEAR(sky.sum(), far_ground.sum(), 24);
  int darkest = 3 * 255, brightest = 0;
  for (int x = 0; x < kWidth; ++x) {
    const int sum = at(image, Vec2(x + 0.5, kHeight - 5.0)).sum();
    darkest = std::min(darkest, sum), brightest = std::max(brightest, sum);
  }
  EXPECT_GT(brightest - darkest, 80);
}

TEST_F(Frame, TheSameFrameTwiceIsTheSameBytesWhateverWasDrawnBetween) {
  const std::vector<Instance> scene = {
      ground(), {kBall, poseAt(0.2, 0.0, 0.5), kRed}, {kCapsule, poseAt(-0.8, 0.2, 0.7), kBlue}};
  const Image first = draw(scene);
  draw({{kBox, poseAt(0.0, 0.0, 3.0), kBlue}});
  EXPECT_EQ(draw(scene).rgb, first.rgb);
  FrameRenderer fresh(Settings{kWidth, kHeight}, solids());
  EXPECT_EQ(fresh.draw(scene, kCamera).rgb, first.rgb);
}

// Sky and ground are kept while the camera stands still.
TEST_F(Frame, AKeptBackgroundIsTheOneThatANewRendererDraws) {
  const std::vector<Instance> before = {ground(), {kBall, poseAt(0.6, 0.3, 1.4), kRed}};
  const std::vector<Instance> after = {
      ground(), {kBall, poseAt(-0.6, 0.4, 1.0), kRed}, {kBox, poseAt(1.0, 1.0, 0.5), kBlue}};
  const std::vector<Instance> lower = {{kGround, poseAt(0.0, 0.0, -0.6), {}, true}};
  const std::vector<Instance> none = {{kBall, poseAt(0.6, 0.3, 1.4), kRed}};
  for (const std::vector<Instance>& next : {after, lower, none}) {
    draw(before);
    FrameRenderer fresh(Settings{kWidth, kHeight}, solids());
    EXPECT_EQ(draw(next).rgb, fresh.draw(next, kCamera).rgb);
  }
}

TEST_F(Frame, AShadowFallsOnABodyUnderAnother) {
  const Vec3 top(0.0, 0.0, 1.0);
  const auto light = Vec3(0.50, -0.50, 0.85).normalized();
  const Vec3 above = top + 1.5 * light;
  const Image shaded =
      draw({ground(), {kBox, poseAt(0, 0, 0.5), kRed}, {kBall, {Quat::Identity(), above}, kBlue}});
  const Image open =
      draw({ground(), {kBox, poseAt(0, 0, 0.5), kRed}, {kBall, poseAt(-3.0, 4.0, 0.5), kBlue}});
  EXPECT_LT(seenAt(shaded, top).sum(), 0.85 * seenAt(open, top).sum());
}

TEST_F(Frame, AnotherThreadDrawsTheSameBytes) {
  const std::vector<Instance> scene = {ground(), {kBox, poseAt(0.2, 0.0, 0.5), kRed}};
  const Image here = draw(scene);
  Image there;
  std::thread([&] {
    FrameRenderer own(Settings{kWidth, kHeight}, solids());
    there = own.draw(scene, kCamera);
  }).join();
  EXPECT_EQ(there.rgb, here.rgb);
}

TEST_F(Frame, ATwentiethOfAPixelOfMotionChangesTheFrame) {
  const double pixel_m = (kCamera.target - kCamera.eye).norm() / focalLengthPixels(kCamera, kHeight);
  const Image before = draw({ground(), {kBall, poseAt(0.2, 0.0, 0.5), kRed}});
  const Image after = draw({ground(), {kBall, poseAt(0.2 + 0.05 * pixel_m, 0.0, 0.5), kRed}});
  EXPECT_NE(before.rgb, after.rgb);
}

TEST_F(Frame, NoPartOfAnEmptyFrameIsBlack) {
  const Image image = draw({});
  for (const std::uint8_t value : image.rgb) EXPECT_GT(value, 90);
}

TEST_F(Frame, SlantedSilhouettesAreSmooth) {
  // A black box before the sky, so far away that it has no bevels: what lies between the two is due to
  // smoothing.
  const Quat turned(Eigen::AngleAxisd(0.35, Vec3::UnitY()));
  const Vec3 far = kCamera.eye + 10.0 * cameraAxes(kCamera).forward;
  const Image image = draw({{kBox, {turned, far}, {0.02f, 0.02f, 0.02f}}});
  int between = 0;
  for (int y = 20; y < kHeight - 20; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const int g = image.pixel(x, y)[1];
      if (g > 100 && g < 170) ++between;
    }
  EXPECT_GT(between, 20);
}

TEST_F(Frame, FarFromTheOriginTheFrameIsTheSame) {
  // Whole squares of the checker away; 1e5 m in single precision would be 8 mm.
  const Vec3 away(100000.0, -60000.0, 0.0);
  const std::vector<Instance> here = {ground(), {kBox, poseAt(0.25, 0.0, 0.5), kRed}};
  std::vector<Instance> there = here;
  for (Instance& instance : there) instance.X_WB.position += away;
  const Image near = renderer_.draw(here, kCamera);
  const Image far = FrameRenderer(Settings{kWidth, kHeight}, solids())
                        .draw(there, {kCamera.eye + away, kCamera.target + away, kCamera.fov_degrees});
  int different = 0;
  for (std::size_t i = 0; i < near.rgb.size(); ++i)
    different += std::abs(near.rgb[i] - far.rgb[i]) > 8 ? 1 : 0;
  EXPECT_LT(different, static_cast<int>(near.rgb.size() / 500));
}

TEST_F(Frame, SmallScenesLookLikeLargeOnes) {
  // A hundredth of the size throughout; the checker's square changes by a power of ten, so bodies alone are
  // compared.
  const double s = 0.01;
  const std::vector<Solid> small = {Solid::box(Vec3(s, s, s)), Solid::ball(0.5 * s)};
  const std::vector<Instance> large_scene = {{kBox, poseAt(0.1, 0.0, 0.5), kRed},
                                             {kBall, poseAt(0.2, 0.1, 1.5), kBlue}};
  const std::vector<Instance> small_scene = {{0, poseAt(0.1 * s, 0.0, 0.5 * s), kRed},
                                             {1, poseAt(0.2 * s, 0.1 * s, 1.5 * s), kBlue}};
  const Image large = draw(large_scene);
  const Image tiny = FrameRenderer(Settings{kWidth, kHeight}, small)
                         .draw(small_scene, {s * kCamera.eye, s * kCamera.target, kCamera.fov_degrees});
  int different = 0;
  for (std::size_t i = 0; i < large.rgb.size(); ++i)
    different += std::abs(large.rgb[i] - tiny.rgb[i]) > 8 ? 1 : 0;
  EXPECT_LT(different, static_cast<int>(large.rgb.size() / 500));
}

TEST_F(Frame, ImpossibleCamerasAndSolidsAreRefused) {
  EXPECT_THROW(renderer_.draw({}, Camera{Vec3(1, 1, 1), Vec3(1, 1, 1), 40.0}), InputError);
  EXPECT_THROW(draw({{4, {}, kRed}}), ContractViolation);
  EXPECT_THROW(draw({{-1, {}, kRed}}), ContractViolation);
}

// Boxes that darken each other's sides but not their tops: the faces come from several draws. The oracle is
// the image of surfaces, one pixel inside of each body.
TEST(FrameRenderer, FacesOfDifferentLightMeetWithoutAGap) {
  const Camera camera{Vec3(5.0, -12.0, 7.0), Vec3(0.0, 0.0, 0.3), 30.0};
  FrameRenderer renderer(Settings{kWidth, kHeight}, solids());
  std::vector<Instance> bodies = {ground()};
  for (int i = 0; i < 9; ++i)
    bodies.push_back({kBox, poseAt(1.2 * (i % 3 - 1), 1.2 * (i / 3 - 1), 0.5001), kRed});
  const Image image = renderer.draw(bodies, camera);
  const std::vector<std::int32_t>& shown = renderer.surfaces().instance;
  int inside = 0;
  for (int y = 1; y + 1 < kHeight; ++y)
    for (int x = 1; x + 1 < kWidth; ++x) {
      const std::ptrdiff_t i = static_cast<std::ptrdiff_t>(y) * kWidth + x;
      const auto body = [&](std::ptrdiff_t k) { return shown[static_cast<std::size_t>(k)]; };
      if (body(i) < 1 || body(i - 1) != body(i) || body(i + 1) != body(i) || body(i - kWidth) != body(i) ||
          body(i + kWidth) != body(i))
        continue;
      ++inside;
      const std::uint8_t* rgb = image.pixel(x, y);
      EXPECT_GT(rgb[0], 2 * rgb[1]) << x << "," << y;
    }
  EXPECT_GT(inside, 2000);
}

// A plank over one of two boxes far apart: what it shades on the way is darker than the same face in the sun.
TEST(FrameRenderer, AShadedTopIsDarkerThanASunlitOne) {
  FrameRenderer renderer(Settings{kWidth, kHeight}, solids());
  const Vec3 to_light = Settings{}.light.to_light / Settings{}.light.to_light.z();
  const Camera camera{Vec3(0.0, -16.0, 9.0), Vec3(0.0, 0.0, 0.5), 30.0};
  const Vec3 top(-2.0, 0.0, 1.0), other(2.0, 0.0, 1.0);
  const Image& image =
      renderer.draw(std::vector<Instance>{ground(),
                                          {kBox, poseAt(-2.0, 0.0, 0.5), kRed},
                                          {kBox, poseAt(2.0, 0.0, 0.5), kRed},
                                          {kBox, {Quat::Identity(), top + 2.5 * to_light}, kBlue}},
                    camera);
  EXPECT_GT(at(image, pinhole(camera, other)).r, at(image, pinhole(camera, top)).r + 60);
}

TEST(FrameRenderer, ImpossibleSizesAreRefused) {
  for (const auto& [width, height] :
       {std::pair{0, 720}, {1280, 0}, {-1, 720}, {1280, -5}, {16385, 16}, {16, 16385}})
    EXPECT_THROW(FrameRenderer(Settings{width, height}, solids()), InputError) << width << "x" << height;
  Settings dark;
  dark.light.to_light = Vec3::Zero();
  EXPECT_THROW(FrameRenderer(dark, solids()), InputError);
}

TEST(FrameRenderer, OddAndTinySizesAreDrawn) {
  for (const auto& [width, height] : {std::pair{1, 1}, {3, 2}, {17, 211}, {333, 1}}) {
    FrameRenderer renderer(Settings{width, height}, solids());
    const Image& image =
        renderer.draw(std::vector<Instance>{ground(), {kBall, poseAt(0, 0, 0.5), kRed}}, kCamera);
    EXPECT_EQ(image.width, width);
    EXPECT_EQ(image.height, height);
    EXPECT_EQ(image.rgb.size(), static_cast<std::size_t>(3 * width * height));
  }
}

TEST(FrameRenderer, NoSolidsAndNoInstancesIsASky) {
  FrameRenderer renderer(Settings{64, 36}, {});
  EXPECT_EQ(renderer.draw({}, kCamera).rgb.size(), 64u * 36u * 3u);
}

}  // namespace
}  // namespace carom::renderer
