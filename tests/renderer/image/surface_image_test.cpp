// Depths, normals and instances against rays cast through the solids' definitions, and against what the
// colour frame shows in the same place.
#include "renderer/image/surface_image.h"

#include <cmath>

#include <gtest/gtest.h>

#include "renderer/frame/frame_renderer.h"
#include "tests/oracle/pixel_casting.h"
#include "tests/oracle/test_shapes.h"

namespace carom::renderer {
namespace {

constexpr int kWidth = 320, kHeight = 180;

// A floor and solids of every kind, turned every way, some in front of others and one through the floor.
struct Stage {
  Stage() {
    solids.push_back(Solid::box(Vec3(40.0, 40.0, 1.0)));
    instances.push_back({0, {Quat::Identity(), Vec3(0.0, 0.0, -0.5)}, {}, true});
    oracle::Random random(11);
    solids.push_back(Solid::ball(0.6));
    solids.push_back(Solid::box(Vec3(0.7, 0.9, 1.1)));
    solids.push_back(Solid::capsule(0.3, 1.0));
    solids.push_back(Solid::roundedBox(Vec3(1.0, 0.8, 0.9), 0.2));
    std::vector<ConvexPart> hammer;
    hammer.push_back({boxPolyhedron(Vec3(1.4, 0.2, 0.2)), 0.0});
    hammer.push_back({ConvexPolyhedron::point(Vec3(0.8, 0.0, 0.0)), 0.35});
    solids.emplace_back(hammer);
    for (int i = 0; i < 15; ++i) {
      const int solid = 1 + i % 5;
      const Vec3 place(-3.2 + 1.6 * (i % 5), 1.5 * (i / 5) - 1.0, random.uniform(0.2, 2.6));
      instances.push_back({solid, {random.rotation(), place}, {}, false});
    }
  }
  std::vector<oracle::CastBody> bodies() const {
    std::vector<oracle::CastBody> all;
    for (const Instance& instance : instances)
      all.push_back({&solids[static_cast<std::size_t>(instance.solid)], instance.X_WB});
    all[0].endless_top = 0.0;
    return all;
  }
  std::vector<Solid> solids;
  std::vector<Instance> instances;
};

oracle::CastView viewOf(const Camera& camera) {
  return {camera.eye, camera.target, camera.fov_degrees, kWidth, kHeight};
}

void expectSurfacesOf(const Stage& stage, const Camera& camera, Preset preset,
                      std::span<const WaterVolume> water = {}) {
  FrameRenderer renderer({.width = kWidth, .height = kHeight, .preset = preset}, stage.solids);
  renderer.draw(stage.instances, camera, {}, water);
  const SurfaceImage& surfaces = renderer.surfaces();
  ASSERT_EQ(surfaces.instance.size(), static_cast<std::size_t>(kWidth * kHeight));
  const std::vector<oracle::CastPixel> expected = oracle::castPixels(viewOf(camera), stage.bodies());
  int compared = 0, round = 0, wrong_ids = 0, wrong_depths = 0, wrong_normals = 0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      if (!oracle::awayFromOutlines(expected, kWidth, kHeight, x, y)) continue;
      const std::size_t pixel = static_cast<std::size_t>(y * kWidth + x);
      const oracle::CastPixel& truth = expected[pixel];
      ++compared;
      wrong_ids += surfaces.instance[pixel] != truth.body;
      const double depth_m = static_cast<double>(surfaces.depth.depth_m[pixel]);
      const Eigen::Vector3f normal(surfaces.normal_W[pixel].data());
      if (truth.body < 0) {
        wrong_depths += !std::isinf(depth_m);
        wrong_normals += !normal.isZero(0.0f);
        continue;
      }
      round += truth.body > 0 && stage.instances[static_cast<std::size_t>(truth.body)].solid != 2;
      // Single precision over a view of ten metres, magnified where a face is seen almost edge on.
      wrong_depths += !(std::abs(depth_m - truth.hit.t) < 5e-5 * truth.hit.t);
      wrong_normals += !((normal.cast<double>() - truth.hit.normal).norm() < 1e-3);
    }
  EXPECT_GT(compared, 40000);
  EXPECT_GT(round, 2000);
  EXPECT_EQ(wrong_ids, 0);
  EXPECT_EQ(wrong_depths, 0);
  // Where a face meets the next, the middle of a pixel may lie on either side to rounding.
  EXPECT_LE(wrong_normals, compared / 10000);
}

TEST(SurfaceImage, EveryPixelAwayFromOutlinesIsWhatARayThroughTheSolidsMeets) {
  expectSurfacesOf(Stage(), {Vec3(1.0, -8.0, 3.5), Vec3(0.0, 0.0, 0.9), 42.0}, Preset::kRealtime);
}

TEST(SurfaceImage, NeitherPresetNorExposuresMoveIt) {
  const Stage stage;
  const Camera camera{Vec3(-4.0, -6.0, 2.0), Vec3(0.0, 0.5, 0.9), 50.0};
  expectSurfacesOf(stage, camera, Preset::kQuality);
  FrameRenderer realtime({.width = kWidth, .height = kHeight}, stage.solids);
  FrameRenderer quality({.width = kWidth, .height = kHeight, .preset = Preset::kQuality}, stage.solids);
  realtime.draw(stage.instances, camera);
  quality.draw(stage.instances, camera);
  EXPECT_EQ(realtime.depth().depth_m, quality.depth().depth_m);
  EXPECT_EQ(realtime.surfaces().instance, quality.surfaces().instance);
}

TEST(SurfaceImage, FromAmongTheBodiesAndFromBelowTheGroundAsWell) {
  const Stage stage;
  expectSurfacesOf(stage, {Vec3(0.1, -2.4, 1.3), Vec3(0.3, 0.0, 1.2), 75.0}, Preset::kFast);
  // From below, the endless ground is not drawn: bodies and sky alone.
  const Camera below{Vec3(2.0, -7.0, -1.0), Vec3(0.0, 0.0, 1.0), 45.0};
  FrameRenderer renderer({.width = kWidth, .height = kHeight}, stage.solids);
  renderer.draw(stage.instances, below);
  std::vector<oracle::CastBody> bodies = stage.bodies();
  bodies[0].endless_top = 1e9;
  const auto expected = oracle::castPixels(viewOf(below), std::span(bodies).subspan(1));
  int wrong = 0, shown = 0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const std::size_t pixel = static_cast<std::size_t>(y * kWidth + x);
      if (!oracle::awayFromOutlines(expected, kWidth, kHeight, x, y)) continue;
      const int body = expected[pixel].body < 0 ? kSky : expected[pixel].body + 1;
      shown += body > 0;
      wrong += renderer.surfaces().instance[pixel] != body;
    }
  EXPECT_GT(shown, 3000);
  EXPECT_EQ(wrong, 0);
}

// Water is see-through: behind it are flat and round bodies and the ground, whole, cut or drowned.
TEST(SurfaceImage, ShowsTheSolidsBehindWater) {
  const Stage stage;
  WaterVolume sea, pool;
  sea.max.z() = 1.3;
  sea.waves = {{0.1, Vec2(1.5, 0.8), 0.4}};
  pool.min = Vec3(-4.0, -2.0, 0.0);
  pool.max = Vec3(4.0, 3.0, 4.0);
  const Camera above{Vec3(1.0, -8.0, 3.5), Vec3(0.0, 0.0, 0.9), 42.0};
  const Camera within{Vec3(0.1, -2.4, 1.1), Vec3(0.3, 0.0, 1.0), 75.0};
  for (const Preset preset : {Preset::kRealtime, Preset::kQuality}) {
    expectSurfacesOf(stage, above, preset, std::vector{sea});
    expectSurfacesOf(stage, above, preset, std::vector{pool, sea});
    expectSurfacesOf(stage, within, preset, std::vector{sea});
  }
}

// The colour frame's bodies lie where the instances do: another colour of a body shows where it is and, off
// its edges, nowhere else.
void expectOutlineInColour(std::int32_t body) {
  Stage red, green;
  red.instances[static_cast<std::size_t>(body)].color = {0.9f, 0.05f, 0.05f};
  green.instances[static_cast<std::size_t>(body)].color = {0.05f, 0.9f, 0.05f};
  const Camera camera{Vec3(-1.0, -8.0, 3.0), Vec3(-0.5, 0.0, 1.0), 40.0};
  for (const Preset preset : {Preset::kFast, Preset::kRealtime, Preset::kQuality, Preset::kCinematic}) {
    FrameRenderer renderer({.width = kWidth, .height = kHeight, .preset = preset}, red.solids);
    const Image reddish = renderer.draw(red.instances, camera);
    const Image greenish = renderer.draw(green.instances, camera);
    const SurfaceImage& surfaces = renderer.surfaces();
    int inside = 0, outside = 0, differing = 0;
    for (int y = 1; y + 1 < kHeight; ++y)
      for (int x = 1; x + 1 < kWidth; ++x) {
        int around = 0;
        for (int v = -1; v <= 1; ++v)
          for (int u = -1; u <= 1; ++u)
            around += surfaces.instance[static_cast<std::size_t>((y + v) * kWidth + x + u)] == body;
        if (around != 0 && around != 9) continue;
        (around == 9 ? inside : outside) += 1;
        if (preset == Preset::kCinematic && around == 0) continue;  // the ground mirrors it
        const bool recoloured = reddish.pixel(x, y)[0] - greenish.pixel(x, y)[0] > 20;
        differing += recoloured != (around == 9);
      }
    EXPECT_GT(inside, 200);
    EXPECT_GT(outside, 40000);
    EXPECT_EQ(differing, 0) << nameOf(preset);
  }
}

TEST(SurfaceImage, LiesPixelOnPixelWithTheColourFrame) {
  expectOutlineInColour(2);  // a box, whose bevels are narrower than a pixel here
  expectOutlineInColour(4);  // a rounded box
}

TEST(SurfaceImage, IsEmptyBeforeAnyDrawAndFollowsTheLast) {
  const Stage stage;
  FrameRenderer renderer({.width = kWidth, .height = kHeight}, stage.solids);
  EXPECT_TRUE(renderer.depth().depth_m.empty());
  const Camera camera{Vec3(1.0, -8.0, 3.5), Vec3(0.0, 0.0, 0.9), 42.0};
  renderer.draw(std::span(stage.instances).first(1), camera);
  const std::vector<std::int32_t> ground = renderer.surfaces().instance;
  const Image first = renderer.draw(stage.instances, camera);
  EXPECT_NE(renderer.surfaces().instance, ground);
  // Asking leaves no trace in the next frame.
  EXPECT_EQ(renderer.draw(stage.instances, camera).rgb, first.rgb);
}

}  // namespace
}  // namespace carom::renderer
