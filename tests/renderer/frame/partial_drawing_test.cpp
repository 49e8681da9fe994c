// Frames of which only the damage is drawn, against the same frames drawn in full: they must be equal in all
// bytes. A renderer is made to draw in full by a frame from elsewhere in between.
#include <random>

#include <gtest/gtest.h>

#include "renderer/frame/frame_renderer.h"

namespace carom::renderer {
namespace {

constexpr int kWidth = 480, kHeight = 270;
enum : int { kFloor, kBox, kBall, kPlank, kCapsule, kDumbbell };

std::vector<Solid> solids() {
  std::vector<ConvexPart> parts = Solid::ball(0.25).parts();
  const std::vector<ConvexPart> bar = Solid::capsule(0.08, 0.5).parts();
  parts.insert(parts.end(), bar.begin(), bar.end());
  return {Solid::box(Vec3(40.0, 40.0, 1.0)), Solid::box(Vec3(0.6, 0.6, 0.6)), Solid::ball(0.35),
          Solid::box(Vec3(1.6, 0.5, 0.08)),  Solid::capsule(0.15, 0.5),       Solid(parts)};
}

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double within(double low, double high) { return std::uniform_real_distribution(low, high)(engine_); }
  bool happens(double share) { return within(0.0, 1.0) < share; }
  int below(int count) { return static_cast<int>(engine_() % static_cast<unsigned>(count)); }

  Pose pose() {
    const Vec3 axis(within(-1.0, 1.0), within(-1.0, 1.0), within(-1.0, 1.0));
    Quat turned =
        happens(0.5) ? Quat::Identity() : Quat(Eigen::AngleAxisd(within(-3.0, 3.0), axis.normalized()));
    // Many level boxes on the floor and in each other, so that faces lie in one plane.
    const double height = happens(0.5) ? 0.3 : within(0.1, 2.5);
    return {turned, Vec3(0.3 * below(25) - 3.6, 0.3 * below(25) - 3.6, height)};
  }
  Instance body() { return {1 + below(5), pose(), color(), happens(0.05)}; }
  Color color() {
    const auto share = [&] { return static_cast<float>(within(0.1, 0.9)); };
    return {share(), share(), share()};
  }

 private:
  std::mt19937 engine_;
};

Camera cameraOf(Random& random) {
  return {Vec3(random.within(-6.0, 6.0), random.within(-11.0, -6.0), random.within(1.0, 7.0)),
          Vec3(random.within(-1.0, 1.0), random.within(-1.0, 1.0), 0.5), random.within(30.0, 60.0)};
}

// Some bodies move, far or a little, some change colour, come, go, or change places in the list.
void change(std::vector<Instance>& bodies, Random& random) {
  const int count = random.below(4);
  for (int i = 0; i < count; ++i) {
    const int which = 1 + random.below(static_cast<int>(bodies.size()) - 1);
    Instance& body = bodies[static_cast<std::size_t>(which)];
    switch (random.below(7)) {
      case 0:
        body.X_WB = random.pose();
        break;
      case 1:
        body.color = random.color();
        break;
      case 2:
        bodies.push_back(random.body());
        break;
      case 3:
        if (bodies.size() > 5) bodies.erase(bodies.begin() + which);
        break;
      case 4:
        std::swap(body, bodies.back());
        break;
      default:
        body.X_WB.position += Vec3(random.within(-0.1, 0.1), random.within(-0.1, 0.1), 0.0);
        break;
    }
  }
}

struct Case {
  Preset preset = Preset::kRealtime;
  Style style = Style::kDaylight;
  bool with_floor = true;
};

// How many of the frames differ.
int differingFrames(const Case& drawn, unsigned seed, int frames) {
  Settings settings{kWidth, kHeight};
  settings.preset = drawn.preset;
  settings.style = drawn.style;
  FrameRenderer lasting(settings, solids()), full(settings, solids());
  Random random(seed);
  std::vector<Instance> bodies = {
      {drawn.with_floor ? kFloor : kBox, {Quat::Identity(), Vec3(0, 0, -0.5)}, {}, true}};
  for (int i = 0; i < 40; ++i) bodies.push_back(random.body());
  Camera camera = cameraOf(random);
  int differing = 0;
  for (int frame = 0; frame < frames; ++frame) {
    if (random.happens(0.05)) camera = cameraOf(random);
    change(bodies, random);
    full.draw({}, {camera.target, camera.eye, 20.0});
    const Image& expected = full.draw(bodies, camera);
    const bool same = lasting.draw(bodies, camera).rgb == expected.rgb;
    EXPECT_TRUE(same) << "seed " << seed << ", frame " << frame;
    differing += same ? 0 : 1;
    if (random.happens(0.1)) lasting.surfaces();
  }
  return differing;
}

TEST(PartialDrawing, RandomScenesAreDrawnAsInFull) {
  for (const unsigned seed : {1u, 2u, 3u, 4u}) EXPECT_EQ(differingFrames({}, seed, 60), 0) << seed;
}

TEST(PartialDrawing, SoAreThoseOfTheFastPresetOnPaper) {
  EXPECT_EQ(differingFrames({.preset = Preset::kFast, .style = Style::kPrint}, 5, 60), 0);
}

TEST(PartialDrawing, SoAreThoseWithoutAGroundAndOfSeveralExposures) {
  EXPECT_EQ(differingFrames({.with_floor = false}, 6, 60), 0);
  EXPECT_EQ(differingFrames({.preset = Preset::kQuality}, 7, 6), 0);
}

TEST(PartialDrawing, AFrameOfTheSameValuesIsTheSameAndStillSaysThatItIsDrawn) {
  const std::vector<Instance> bodies = {{kBall, {Quat::Identity(), Vec3(0.0, 0.0, 1.0)}, {0.8f, 0.2f, 0.1f}}};
  const Camera camera;
  FrameRenderer renderer(Settings{kWidth, kHeight}, solids());
  const Image first = renderer.draw(bodies, camera);
  const DepthImage depth = renderer.depth();
  int calls = 0;
  EXPECT_EQ(renderer.draw(bodies, camera, [&] { ++calls; }).rgb, first.rgb);
  EXPECT_EQ(calls, 1);
  EXPECT_EQ(renderer.depth().depth_m, depth.depth_m);
  const std::vector<WaterVolume> water(1);
  EXPECT_NE(renderer.draw(bodies, camera, {}, water).rgb, first.rgb);
  EXPECT_EQ(renderer.draw(bodies, camera).rgb, first.rgb);
}

TEST(PartialDrawing, AFrameThatWasGivenUpBeforeItWasReadIsNoFrameToBuildUpon) {
  const std::vector<Instance> start = {
      {kFloor, {Quat::Identity(), Vec3(0.0, 0.0, -0.5)}, {}, true},
      {kBall, {Quat::Identity(), Vec3(-1.0, 0.0, 0.35)}, {0.8f, 0.2f, 0.1f}}};
  std::vector<Instance> moved = start;
  moved[1].X_WB.position.x() = 1.0;
  const Camera camera;
  FrameRenderer lasting(Settings{kWidth, kHeight}, solids()), fresh(Settings{kWidth, kHeight}, solids());
  lasting.draw(start, camera);
  EXPECT_THROW(lasting.draw(moved, camera, [] { throw 1; }), int);
  EXPECT_EQ(lasting.draw(moved, camera).rgb, fresh.draw(moved, camera).rgb);
  EXPECT_THROW(lasting.draw(start, camera, [] { throw 1; }), int);
  moved.push_back({kBox, {Quat::Identity(), Vec3(0.0, -1.0, 0.3)}, {0.1f, 0.2f, 0.8f}});
  EXPECT_EQ(lasting.draw(moved, camera).rgb,
            FrameRenderer(Settings{kWidth, kHeight}, solids()).draw(moved, camera).rgb);
}

}  // namespace
}  // namespace carom::renderer
