// Depths, normals and ids of every shipped scene, drawn as `render --aov` draws them with all its water,
// against rays cast through the engine's solids.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <span>

#include <gtest/gtest.h>

#include "demos/asset/asset_path.h"
#include "demos/frames/frame_outputs.h"
#include "demos/language/scene_file.h"
#include "demos/motion/frame_source.h"
#include "demos/scene/camera_path.h"
#include "demos/scene/drawn_water.h"
#include "demos/scene/scene_world.h"
#include "tests/oracle/pixel_casting.h"

namespace carom::demos {
namespace {

constexpr int kWidth = 160, kHeight = 90;
constexpr double kFps = 10.0;

// The height of the level face on top of a solid; none without one.
double levelTop(const Solid& solid, const Pose& X_WB) {
  double top = -oracle::kNoHit;
  bool level = false;
  for (const ConvexPart& part : solid.parts())
    for (int f = 0; f < part.core.faceCount(); ++f) {
      const double z = (X_WB * part.core.vertex(part.core.faceVertices(f)[0])).z() + part.radius_m;
      const bool up = (X_WB.rotation * part.core.plane(f).normal).z() > 1.0 - 1e-9;
      if (up && z > top) top = z, level = true;
    }
  return level ? top : oracle::kNoHit;
}

// The lowest checkered body with a level top is an endless ground, which is seen from above alone.
std::vector<oracle::CastBody> castBodies(const std::vector<renderer::Instance>& instances,
                                         std::span<const Solid> solids, const Vec3& eye) {
  std::vector<oracle::CastBody> bodies;
  std::size_t ground = instances.size();
  double lowest = oracle::kNoHit;
  for (std::size_t i = 0; i < instances.size(); ++i) {
    bodies.push_back({&solids[static_cast<std::size_t>(instances[i].solid)], instances[i].X_WB});
    const double top = levelTop(*bodies[i].solid, bodies[i].X_WB);
    if (instances[i].checker && top < lowest) lowest = top, ground = i;
  }
  if (ground < instances.size()) {
    EXPECT_LT(lowest, eye.z()) << "a scene whose camera is below its ground wants a test of its own";
    bodies[ground].endless_top = lowest;
  }
  return bodies;
}

struct Count {
  int compared = 0;
  int wrong_depths = 0;
  int wrong_normals = 0;
  int wrong_ids = 0;
  std::set<int> ids;
};

Count comparedWith(const std::vector<oracle::CastPixel>& truth, const renderer::SurfaceImage& surfaces,
                   const OutputScale& scale) {
  const renderer::Raster depths = outputRaster(FrameOutput::kDepth, surfaces, scale);
  const renderer::Raster normals = outputRaster(FrameOutput::kNormal, surfaces, scale);
  const renderer::Raster ids = outputRaster(FrameOutput::kId, surfaces, scale);
  Count count;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      if (!oracle::awayFromOutlines(truth, kWidth, kHeight, x, y)) continue;
      const oracle::CastPixel& pixel = truth[static_cast<std::size_t>(y * kWidth + x)];
      ++count.compared;
      count.ids.insert(pixel.body + 1);
      count.wrong_ids += ids.pixel(x, y)[0] != pixel.body + 1;
      const double units = std::min<double>(pixel.hit.t / scale.metresPerUnit(), kMostDepth);
      const double depth = pixel.body < 0 ? kSkyDepth : units;
      count.wrong_depths += std::abs(depths.pixel(x, y)[0] - depth) > 1.0;
      const std::uint16_t* n = normals.pixel(x, y);
      const Vec3 normal = (Vec3(n[0], n[1], n[2]) - Vec3::Constant(32768.0)) / 32767.0;
      count.wrong_normals +=
          pixel.body < 0 ? (n[0] | n[1] | n[2]) != 0 : (normal - pixel.hit.normal).norm() > 1e-3;
    }
  return count;
}

// A second after the start, by when what falls into water is wet.
void expectOutputsOf(const std::filesystem::path& path) {
  const Scene scene = readSceneFile(path);
  SceneWorld made = makeSceneWorld(scene, std::nullopt);
  const std::span<const Solid> solids = made.world.solids();
  const CameraPath path_of_eye(scene.cameras.at("main"), made, static_cast<double>(kWidth) / kHeight);
  const OutputScale scale = outputScale(drawnInstances(made, made.world.states()), solids,
                                        path_of_eye.at(0.0, made.world.states()));
  renderer::FrameRenderer pictures({.width = kWidth, .height = kHeight}, solids);
  RunFacts facts;
  const FrameClock clock({kFps, scene.rate_hz});
  FrameSource source(made, clock, facts);
  const int frame = static_cast<int>(kFps);
  const FrameState state = source.at(frame);
  const renderer::Camera camera = path_of_eye.at(clock.time(frame), state.bodies);
  const std::vector<renderer::Instance> instances = drawnInstances(made, state.bodies);
  pictures.draw(instances, camera, {}, drawnWater(scene, clock.time(frame)));
  const oracle::CastView view{camera.eye, camera.target, camera.fov_degrees, kWidth, kHeight};
  const auto truth = oracle::castPixels(view, castBodies(instances, solids, camera.eye));
  const Count count = comparedWith(truth, pictures.surfaces(), scale);
  const std::string what = scene.name;
  EXPECT_GT(count.compared, 5000) << what;
  EXPECT_GT(count.ids.size(), 1u) << what;
  EXPECT_EQ(count.wrong_ids, 0) << what;
  // Where two faces of a body meet, the middle of a pixel may lie on either to rounding.
  EXPECT_LE(count.wrong_depths, count.compared / 2000) << what;
  EXPECT_LE(count.wrong_normals, count.compared / 2000) << what;
}

TEST(SceneOutputs, OfEveryShippedSceneAreWhatRaysThroughItsSolidsMeetWhateverWaterStandsBefore) {
  ASSERT_FALSE(shippedScenes().empty());
  for (const std::filesystem::path& path : shippedScenes()) expectOutputsOf(path);
}

}  // namespace
}  // namespace carom::demos
