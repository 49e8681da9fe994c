// What surfaces, lights, glass, alpha and lenses make of a frame.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "renderer/frame/frame_renderer.h"

namespace carom::renderer {
namespace {

using std::numbers::pi;

enum : int { kFloor, kBall, kBox };
const std::vector<Solid>& solids() {
  static const std::vector<Solid> all{Solid::box(Vec3(40.0, 40.0, 1.0)), Solid::ball(0.5),
                                      Solid::box(Vec3(1.0, 1.2, 0.9))};
  return all;
}

Settings sized(int width, int height) {
  Settings settings;
  settings.width = width;
  settings.height = height;
  return settings;
}

Image drawn(const Settings& settings, const std::vector<Instance>& instances, const Camera& camera) {
  FrameRenderer renderer(settings, solids());
  return renderer.draw(instances, camera);
}

Instance body(int solid, const Pose& X_WB, SurfaceKind kind) {
  Instance instance{solid, X_WB, naturalColor(kind)};
  instance.surface = {kind, 0.5, 77};
  return instance;
}

Instance ground(GroundPattern pattern) {
  Instance instance{kFloor, {Quat::Identity(), Vec3(0.0, 0.0, -0.5)}, naturalColor(pattern), true};
  instance.pattern = pattern;
  return instance;
}

Quat about(const Vec3& axis, double degrees) {
  return Quat(Eigen::AngleAxisd(degrees * pi / 180.0, axis.normalized()));
}

/// The mean and the largest difference of two images' bytes.
struct Difference {
  double mean = 0.0;
  int most = 0;
};
Difference difference(const Image& a, const Image& b) {
  Difference d;
  for (std::size_t i = 0; i < a.rgb.size(); ++i) {
    const int by = std::abs(int{a.rgb[i]} - int{b.rgb[i]});
    d.mean += by / static_cast<double>(a.rgb.size());
    d.most = std::max(d.most, by);
  }
  return d;
}

class Surfaces : public testing::TestWithParam<SurfaceKind> {};

// World, light and camera turned together about the vertical show the same picture; the body turned alone
// another one, where its surface has a pattern that its turn moves.
TEST_P(Surfaces, TurnWithTheBody) {
  const Quat turn = about(Vec3::UnitZ(), 40.0), own = about(Vec3(1.0, 2.0, 0.5), 70.0);
  const Camera camera{Vec3(0.4, -3.0, 1.1), Vec3(0.0, 0.0, 0.0), 30.0};
  const Camera turned{turn * camera.eye, turn * camera.target, 30.0};
  Settings settings = sized(200, 200);
  const Image plain = drawn(settings, {body(kBox, {own, Vec3::Zero()}, GetParam())}, camera);
  settings.light.to_light = turn * settings.light.to_light;
  const Image whole = drawn(settings, {body(kBox, {turn * own, Vec3::Zero()}, GetParam())}, turned);
  EXPECT_LT(difference(plain, whole).mean, 0.3);
}

// From so far that a pixel covers half a metre the pattern is gone, and what is left is its mean.
TEST_P(Surfaces, AreEvenFarAway) {
  if (GetParam() == SurfaceKind::kGlass || GetParam() == SurfaceKind::kSteel)
    GTEST_SKIP() << "mirrors what is around";
  const Pose wide{Quat::Identity(), Vec3(0.0, 0.0, -0.5)};
  const Camera camera{Vec3(0.0, 0.0, 100.0), Vec3(0.0, 0.0, 0.0), 20.0};
  const Image image = drawn(sized(64, 64), {body(kFloor, wide, GetParam())}, camera);
  for (int y = 0; y < 64; ++y)
    for (int x = 1; x < 64; ++x)
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(image.pixel(x, y)[c], image.pixel(32, 32)[c], 8) << x << ' ' << y;
}

INSTANTIATE_TEST_SUITE_P(All, Surfaces,
                         testing::Values(SurfaceKind::kWood, SurfaceKind::kBrick, SurfaceKind::kConcrete,
                                         SurfaceKind::kSteel, SurfaceKind::kRubber, SurfaceKind::kCardboard,
                                         SurfaceKind::kMarble, SurfaceKind::kGlass),
                         [](const auto& kind) { return nameOf(kind.param); });

// A camera that moves by a third of a pixel changes a filtered picture by a third of its slopes; one that
// aliased would change by its whole contrast. Away from the nearest rows, where the patterns are resolved.
TEST(Grounds, DoNotShimmerTowardsTheHorizon) {
  for (const GroundPattern pattern : {GroundPattern::kChecker, GroundPattern::kGrid, GroundPattern::kConcrete,
                                      GroundPattern::kPlanks, GroundPattern::kSand}) {
    const Camera camera{Vec3(0.3, -9.0, 2.0), Vec3(0.0, 0.0, 1.0), 40.0};
    Camera moved = camera;
    moved.eye.x() += 0.02, moved.target.x() += 0.02;
    FrameRenderer renderer(sized(320, 180), solids());
    const Image a = renderer.draw(std::vector{ground(pattern)}, camera);
    const Image b = renderer.draw(std::vector{ground(pattern)}, moved);
    int most = 0;
    for (int y = 64; y < 80; ++y)  // From 16 to 120 m away: up to half a metre a pixel, five along the view.
      for (int x = 0; x < 320; ++x)
        most = std::max(most, std::abs(int{a.pixel(x, y)[1]} - int{b.pixel(x, y)[1]}));
    EXPECT_LT(most, 14) << nameOf(pattern);
  }
}

TEST(Lights, TheDayIsTheDefaultToTheByte) {
  const std::vector<Instance> scene{ground(GroundPattern::kChecker),
                                    {kBox, {Quat::Identity(), Vec3(0.0, 0.0, 0.5)}, {}}};
  Settings settings = sized(160, 90);
  const Image usual = drawn(settings, scene, {});
  settings.light = lightOf("day");
  EXPECT_EQ(drawn(settings, scene, {}).rgb, usual.rgb);
  for (const char* other : {"sunset", "overcast", "studio-dark"}) {
    settings.light = lightOf(other);
    EXPECT_GT(difference(drawn(settings, scene, {}), usual).mean, 5.0) << other;
  }
}

TEST(Lights, MoreExposureMakesEveryPixelBrighter) {
  const std::vector<Instance> scene{ground(GroundPattern::kSand),
                                    body(kBall, {Quat::Identity(), Vec3(0.0, 0.0, 0.5)}, SurfaceKind::kWood)};
  Settings settings = sized(160, 90);
  const Image usual = drawn(settings, scene, {});
  settings.light.exposure = 1.4;
  const Image bright = drawn(settings, scene, {});
  int darker = 0;
  for (std::size_t i = 0; i < usual.rgb.size(); ++i) darker += bright.rgb[i] < usual.rgb[i] ? 1 : 0;
  EXPECT_EQ(darker, 0);
  EXPECT_GT(difference(bright, usual).mean, 10.0);
}

// A ball of radius r at distance d shows as a disc of radius f r / sqrt(d^2 - r^2): the sum of its alpha is
// its area, to what a smoothed polygon of its sides loses, and its colours know nothing of the black behind.
TEST(Cutouts, TheAlphaOfABallIsItsDisc) {
  Settings settings = sized(200, 200);
  settings.cutout = true;
  const Camera camera{Vec3(0.0, -5.0, 0.0), Vec3::Zero(), 20.0};
  for (const Preset preset : {Preset::kRealtime, Preset::kQuality}) {
    settings.preset = preset;
    const Image image =
        drawn(settings, {{kBall, {Quat::Identity(), Vec3::Zero()}, {0.8f, 0.8f, 0.8f}}}, camera);
    ASSERT_EQ(image.alpha.size(), 40000u);
    double area = 0.0;
    for (const std::uint8_t alpha : image.alpha) area += alpha / 255.0;
    const double radius = focalLengthPixels(camera, 200) * 0.5 / std::sqrt(25.0 - 0.25);
    EXPECT_NEAR(area, pi * radius * radius, 0.01 * pi * radius * radius);
    EXPECT_EQ(image.alpha.front(), 0);
  }
}

TEST(Cutouts, OfTheGroundOnlyTheShadowsAreLeft) {
  Settings settings = sized(200, 120);
  settings.cutout = true;
  const Camera camera{Vec3(0.0, -6.0, 3.0), Vec3(0.0, 0.0, 0.3), 30.0};
  const Image image =
      drawn(settings, {ground(GroundPattern::kChecker), {kBox, {Quat::Identity(), Vec3(0.0, 0.0, 0.6)}, {}}},
            camera);
  const auto alphaAt = [&](const Vec3& p_W) {
    const Vec2 pixel = *projectToPixel(camera, 200, 120, p_W);
    return int{image.alpha[static_cast<std::size_t>(pixel.y()) * 200 + static_cast<std::size_t>(pixel.x())]};
  };
  EXPECT_EQ(alphaAt(Vec3(0.0, -0.6, 0.6)), 255);
  EXPECT_EQ(alphaAt(Vec3(1.4, -0.4, 0.0)), 0);
  const Vec3 on_top(-0.35, 0.45, 1.0), to_light = settings.light.to_light;
  const Vec3 shadow = on_top - to_light * (on_top.z() / to_light.z());
  EXPECT_GT(alphaAt(shadow), 70);
  EXPECT_LT(alphaAt(shadow), 160);
}

/// The light on the ground behind a box of that surface, over what it is without the box.
double lightBehind(SurfaceKind kind, bool with_box) {
  const Camera camera{Vec3(0.0, -0.01, 12.0), Vec3(0.0, 0.0, 0.0), 30.0};
  std::vector<Instance> scene{ground(GroundPattern::kPlain)};
  Instance box = body(kBox, {Quat::Identity(), Vec3(0.0, 0.0, 2.0)}, kind);
  if (with_box) scene.push_back(box);
  const Image image = drawn(sized(240, 240), scene, camera);
  const Vec3 shadow = Vec3(0.0, 0.0, 2.0) - Settings{}.light.to_light * (2.0 / Settings{}.light.to_light.z());
  const Vec2 pixel = *projectToPixel(camera, 240, 240, shadow);
  return linearLight(image.pixel(static_cast<int>(pixel.x()), static_cast<int>(pixel.y()))[1] / 255.0f);
}

TEST(Glass, LetsMostOfTheSunsLightPass) {
  const double open = lightBehind(SurfaceKind::kGlass, false);
  EXPECT_LT(lightBehind(SurfaceKind::kWood, true), 0.5 * open);
  EXPECT_GT(lightBehind(SurfaceKind::kGlass, true), 0.75 * open);
  EXPECT_LT(lightBehind(SurfaceKind::kGlass, true), 0.97 * open);
}

// A slab looked at straight bends nothing: what is behind keeps its place and its colour.
TEST(Glass, ASlabShowsWhatIsBehindIt) {
  const Camera camera{Vec3(0.0, -5.0, 0.0), Vec3::Zero(), 20.0};
  const Instance red{kBall, {Quat::Identity(), Vec3(0.0, 3.0, 0.0)}, {0.8f, 0.05f, 0.05f}};
  Instance glass = body(kBox, {Quat::Identity(), Vec3::Zero()}, SurfaceKind::kGlass);
  glass.color = {1.0f, 1.0f, 1.0f};
  const Image through = drawn(sized(160, 160), {red, glass}, camera),
              without = drawn(sized(160, 160), {red}, camera);
  const std::uint8_t* seen = through.pixel(80, 80);
  EXPECT_GT(seen[0], seen[1] + 60);
  EXPECT_NEAR(seen[0], without.pixel(80, 80)[0], 25);
}

/// How far the bright pixels of a picture lie from their middle, pixels.
double spread(const Image& image) {
  double sum = 0.0, x_sum = 0.0, square = 0.0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const double light = image.alpha[static_cast<std::size_t>(y * image.width + x)];
      sum += light, x_sum += light * x, square += light * x * x;
    }
  return std::sqrt(square / sum - x_sum * x_sum / (sum * sum));
}

// The blur of a lens of width a, sharp at f, at distance d: a disc a |d - f| / d / f wide, times the focal
// length, whose variance along x (a sixteenth of its width squared) adds to the ball's own.
TEST(Lens, BlursByTheCircleOfConfusion) {
  Settings settings = sized(240, 240);
  settings.preset = Preset::kCinematic;
  settings.cutout = true;
  Camera camera{Vec3(0.0, -10.0, 0.0), Vec3::Zero(), 20.0};
  const std::vector<Instance> scene{{kBall, {Quat::Identity(), Vec3::Zero()}, {}}};
  const double sharp = spread(drawn(settings, scene, camera));
  camera.aperture_m = 0.4;
  EXPECT_NEAR(spread(drawn(settings, scene, camera)), sharp, 0.02 * sharp);
  camera.focus_m = 5.0;
  const double width = focalLengthPixels(camera, 240) * 0.4 * (10.0 - 5.0) / (10.0 * 5.0);
  EXPECT_NEAR(spread(drawn(settings, scene, camera)), std::sqrt(sharp * sharp + width * width / 16.0),
              0.03 * sharp);
}

// Two moments of a body that jumps: each shows for half of the exposures.
TEST(Shutter, ShowsEachMomentForItsShare) {
  Settings settings = sized(120, 80);
  settings.preset = Preset::kCinematic;
  settings.cutout = true;
  const Camera camera{Vec3(0.0, -10.0, 0.0), Vec3::Zero(), 20.0};
  const auto at = [](double x) {
    return std::vector<Instance>{{kBall, {Quat::Identity(), Vec3(x, 0.0, 0.0)}, {}}};
  };
  FrameRenderer renderer(settings, solids());
  const std::vector<std::vector<Instance>> moments{at(-1.0), at(1.0)};
  const Image image = renderer.draw(at(0.0), camera, {}, {}, moments);
  for (const double x : {-1.0, 1.0}) {
    const Vec2 pixel = *projectToPixel(camera, 120, 80, Vec3(x, 0.0, 0.0));
    EXPECT_NEAR(image.alpha[static_cast<std::size_t>(pixel.y()) * 120 + static_cast<std::size_t>(pixel.x())],
                128, 1);
  }
  EXPECT_EQ(renderer.surfaces().instance[40 * 120 + 60], 0);  // What is exactly at the frame's time.
}

}  // namespace
}  // namespace carom::renderer
