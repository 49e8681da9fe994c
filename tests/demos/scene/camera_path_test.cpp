#include "demos/scene/camera_path.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "demos/asset/asset_path.h"
#include "demos/language/scene_file.h"
#include "engine/foundation/contract.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/thrown_message.h"

namespace carom::demos {
namespace {

Scene sceneWith(const std::string& cameras) {
  return parseScene(R"({ "format": 1, "bodies": [
      { "name": "floor", "shape": { "box": [50, 50, 1] }, "position": [0, 0, -0.5], "static": true,
        "material": { "checker": true } },
      { "name": "die", "shape": { "box": [0.6, 0.5, 0.4] }, "position": [1, 2, 3] },
      { "name": "row", "shape": { "box": [0.3, 0.3, 0.3] }, "position": [-2, 0, 1],
        "repeat": { "count": [3, 1, 1], "step": [1, 0, 0] } } ],
      "cameras": { "main": )" +
                        cameras + " } }",
                    "cameras.json");
}

CameraPath pathOf(const std::string& camera, const SceneWorld& made) {
  return CameraPath(sceneWith(camera).cameras.at("main"), made, 16.0 / 9.0);
}

/// Where a point is drawn: right and up from the middle, in half heights of the picture.
Vec2 inPicture(const renderer::Camera& camera, const Vec3& p_W) {
  const Vec3 forward = (camera.target - camera.eye).normalized();
  const Vec3 right = forward.cross(Vec3::UnitZ()).normalized(), up = right.cross(forward);
  const Vec3 p = p_W - camera.eye;
  const double scale = 1.0 / (std::tan(camera.fov_degrees * std::numbers::pi / 360.0) * p.dot(forward));
  return {scale * p.dot(right), scale * p.dot(up)};
}

TEST(CameraPath, FitShowsAllPointsAndNoNearerEyeDoes) {
  const std::vector<Vec3> points = {{3, 1, 0}, {-2, 4, 1}, {0, 0, 5}, {1, -3, 2}, {0.5, 0.2, -1}};
  for (const double aspect : {0.5, 1.0, 16.0 / 9.0})
    for (const Vec3& direction : {Vec3(6, -9, 4), Vec3(-1, 0.2, 0.1), Vec3(0.3, 2, 3)}) {
      const renderer::Camera camera = fittedCamera(points, {direction, 40.0, aspect});
      EXPECT_LT((camera.eye - camera.target).normalized().cross(direction.normalized()).norm(), 1e-12);
      double widest = 0.0;
      for (const Vec3& p : points) {
        const Vec2 seen = inPicture(camera, p);
        widest = std::max({widest, std::abs(seen.x()) / aspect, std::abs(seen.y())});
      }
      EXPECT_NEAR(widest, 11.0 / 12.0, 1e-9);
      // Two opposite sides touch the margin, so that no shift lets the eye come nearer.
      double left = 1e9, right = -1e9, low = 1e9, high = -1e9;
      for (const Vec3& p : points) {
        const Vec2 seen = inPicture(camera, p);
        left = std::min(left, seen.x() / aspect), right = std::max(right, seen.x() / aspect);
        low = std::min(low, seen.y()), high = std::max(high, seen.y());
      }
      const bool across = std::abs(right - left - 22.0 / 12.0) < 1e-9;
      const bool upright = std::abs(high - low - 22.0 / 12.0) < 1e-9;
      EXPECT_TRUE(across || upright);
    }
}

TEST(CameraPath, FitHasEveryBodyOfEveryShippedSceneInThePictureAtTheStart) {
  for (const std::filesystem::path& file : shippedScenes()) {
    const Scene scene = readSceneFile(file);
    const SceneWorld made = makeSceneWorld(scene, std::nullopt);
    SceneCamera fit;
    fit.motion = FitView{};
    const renderer::Camera camera = CameraPath(fit, made, 16.0 / 9.0).at(0.0, made.world.states());
    for (std::size_t i = 0; i < made.names.size(); ++i) {
      if (made.looks[i].checker) continue;
      const BodyState& state = made.world.states()[i];
      const Solid& solid = made.world.solids()[static_cast<std::size_t>(made.world.bodies()[i].solid)];
      for (const ConvexPart& part : solid.parts())
        for (const Vec3& vertex : part.core.vertices()) {
          const Vec2 seen = inPicture(camera, state.X_WB * vertex);
          EXPECT_LT(std::abs(seen.x()), 16.0 / 9.0) << file << ' ' << made.names[i];
          EXPECT_LT(std::abs(seen.y()), 1.0) << file << ' ' << made.names[i];
        }
    }
  }
}

TEST(CameraPath, FollowKeepsTheBodyInTheMiddleAtItsOffset) {
  const SceneWorld made = makeSceneWorld(sceneWith("{ \"fit\": true }"), std::nullopt);
  std::vector<BodyState> states(made.world.states().begin(), made.world.states().end());
  const CameraPath path = pathOf(R"({ "follow": "row[1]", "offset": [1, -4, 2], "fovDegrees": 30 })", made);
  for (const Vec3& place : {Vec3(0, 0, 0), Vec3(5, -7, 2.5)}) {
    states[3].X_WB.position = place;
    const renderer::Camera camera = path.at(0.3, states);
    EXPECT_EQ(camera.target, place);
    EXPECT_EQ(camera.eye, place + Vec3(1, -4, 2));
    EXPECT_EQ(camera.fov_degrees, 30.0);
  }
  // Without an offset: six radii away.
  const renderer::Camera near = pathOf(R"({ "follow": "die" })", made).at(0.0, states);
  EXPECT_NEAR((near.eye - near.target).norm(), 6.0 * 0.5 * std::sqrt(0.36 + 0.25 + 0.16), 1e-12);
}

// A mesh of 4 m around (10, 0, 0) in place of a cube of 20 cm at the origin.
TEST(CameraPath, FramesWhatIsDrawnInPlaceOfABody) {
  const TemporaryFolder folder;
  folder.file("leaf.obj", "v 8 0 -1\nv 12 0 -1\nv 12 0 1\nf 1 2 3\n");
  const SceneWorld made = makeSceneWorld(parseScene(R"({ "format": 1, "bodies": [
      { "name": "cube", "shape": { "box": [0.2, 0.2, 0.2] }, "visual": { "file": "leaf.obj" } } ] })",
                                                    folder.path() / "scene.json"),
                                         std::nullopt);
  Vec3 low = Vec3::Constant(1e9), high = Vec3::Constant(-1e9);
  for (const Vec3& p : fittedPoints(made)) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  EXPECT_LT((low - Vec3(8, 0, -1)).norm(), 1e-6);
  EXPECT_LT((high - Vec3(12, 0, 1)).norm(), 1e-6);
  SceneCamera all;
  all.motion = FitView{};
  const renderer::Camera fit = CameraPath(all, made, 16.0 / 9.0).at(0.0, {});
  EXPECT_NEAR(fit.target.x(), 10.0, 2.0) << "on the leaf";
  SceneCamera follow;
  follow.motion = FollowBody{"cube", {}};
  const renderer::Camera near = CameraPath(follow, made, 16.0 / 9.0).at(0.0, made.world.states());
  EXPECT_NEAR((near.eye - near.target).norm(), 6.0 * std::sqrt(145.0), 1e-5);
}

TEST(CameraPath, OrbitCirclesAtItsSpeedAndComesRound) {
  const SceneWorld made = makeSceneWorld(sceneWith("{ \"fit\": true }"), std::nullopt);
  const CameraPath path = pathOf(
      R"({ "orbit": { "target": [1, 2, 0.5], "radius": 5, "height": 2, "degreesPerSecond": 90, "startDegrees": 0 } })",
      made);
  const Vec3 target(1, 2, 0.5);
  const Vec3 expected[] = {{5, 0, 2}, {0, 5, 2}, {-5, 0, 2}, {0, -5, 2}};
  for (int second = 0; second < 9; ++second) {
    const renderer::Camera camera = path.at(second, made.world.states());
    EXPECT_EQ(camera.target, target);
    EXPECT_LT((camera.eye - target - expected[second % 4]).norm(), 1e-12) << second;
  }
  EXPECT_EQ(path.at(4000.5, {}).eye, path.at(0.5, {}).eye);
}

TEST(CameraPath, TheOrbitThatFitsStartsWhereFitLooksFromUpToItsHeading) {
  const SceneWorld made = makeSceneWorld(sceneWith("{ \"fit\": true }"), std::nullopt);
  const renderer::Camera fit = pathOf("{ \"fit\": true }", made).at(0.0, {});
  SceneCamera orbiting;
  orbiting.motion = Orbit{.fits = true};
  const CameraPath orbit(orbiting, made, 16.0 / 9.0);
  for (const double time_s : {0.0, 1.7, 5.0}) {
    const renderer::Camera camera = orbit.at(time_s, {});
    EXPECT_EQ(camera.target, fit.target);
    EXPECT_NEAR((camera.eye - camera.target).norm(), (fit.eye - fit.target).norm(), 1e-12);
    EXPECT_NEAR(camera.eye.z(), fit.eye.z(), 1e-12);
  }
}

TEST(CameraPath, ABodyThatIsNotThereIsRefusedWithTheNearest) {
  const SceneWorld made = makeSceneWorld(sceneWith("{ \"fit\": true }"), std::nullopt);
  SceneCamera camera;
  camera.motion = FollowBody{"dye", {}};
  const std::string message = thrownMessage<InputError>([&] { CameraPath(camera, made, 1.0); });
  EXPECT_NE(message.find("no body \"dye\" to follow; did you mean \"die\"?"), std::string::npos) << message;
}

TEST(CameraPath, AStillCameraStaysWhereItIs) {
  const SceneWorld made = makeSceneWorld(sceneWith("{ \"fit\": true }"), std::nullopt);
  const CameraPath path = pathOf(R"({ "eye": [9, 8, 7], "target": [0, 1, 2], "fovDegrees": 25 })", made);
  EXPECT_EQ(path.at(3.0, made.world.states()).eye, Vec3(9, 8, 7));
  EXPECT_EQ(path.at(3.0, made.world.states()).target, Vec3(0, 1, 2));
}

}  // namespace
}  // namespace carom::demos
