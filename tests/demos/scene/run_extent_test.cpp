#include "demos/scene/run_extent.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "demos/language/scene_file.h"
#include "demos/scene/camera_path.h"
#include "demos/scene/scene_world.h"
#include "renderer/view/projection.h"
#include "tests/support/temporary_folder.h"

namespace carom::demos {
namespace {

Scene flying(const std::string& duration) {
  return parseScene(R"({ "format": 1, "gravity": [0, 0, 0], "duration": )" + duration + R"(, "bodies": [
      { "name": "wall", "shape": { "box": [9, 9, 9] }, "position": [50, 0, 0], "static": true },
      { "name": "die", "shape": { "box": [0.2, 0.2, 0.2] }, "position": [1, 2, 3], "linearVelocity": [2, 0, 0] } ] })",
                    "flying.json");
}

TEST(RunExtent, HasTheBoxesOfWhatMovesFromTheFirstMomentToTheLast) {
  const std::vector<Vec3> points = pointsOfTheRun(flying("3"), std::nullopt, 1);
  double low = 1e9, high = -1e9;
  for (const Vec3& p : points) {
    low = std::min(low, p.x()), high = std::max(high, p.x());
    EXPECT_NEAR(std::abs(p.y() - 2.0), 0.1, 1e-12);
  }
  EXPECT_NEAR(low, 0.9, 1e-12);
  EXPECT_NEAR(high, 7.1, 1e-9);
  EXPECT_EQ(points.size() % 8, 0u);
}

TEST(RunExtent, HasTheBoxesOfWhatIsDrawnInPlaceOfABody) {
  const TemporaryFolder folder;
  folder.file("leaf.obj", "v 0 0 -2\nv 0 0 2\nv 5 0 2\nf 1 2 3\n");
  const Scene scene = parseScene(R"({ "format": 1, "gravity": [0, 0, 0], "duration": 1, "bodies": [
      { "name": "die", "shape": { "box": [0.2, 0.2, 0.2] }, "position": [1, 2, 3], "linearVelocity": [2, 0, 0],
        "visual": { "file": "leaf.obj" } } ] })",
                                 folder.path() / "scene.json");
  Vec3 low = Vec3::Constant(1e9), high = Vec3::Constant(-1e9);
  for (const Vec3& p : pointsOfTheRun(scene, std::nullopt, 1)) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  EXPECT_LT((low - Vec3(1, 2, 1)).norm(), 1e-6);
  EXPECT_LT((high - Vec3(8, 2, 5)).norm(), 1e-6);
}

TEST(RunExtent, IsThatOfTheFilesDurationWhateverWasAskedFor) {
  Scene asked = flying("3");
  asked.duration_s = 0.5;
  EXPECT_EQ(pointsOfTheRun(asked, std::nullopt, 1), pointsOfTheRun(flying("3"), std::nullopt, 1));
  EXPECT_EQ(pointsOfTheRun(asked, std::nullopt, 2), pointsOfTheRun(asked, std::nullopt, 1));
}

TEST(CameraThatFramesWhatMoves, FillsTwoThirdsOfThePicture) {
  const Scene scene = flying("3");
  const SceneWorld made = makeSceneWorld(scene, std::nullopt);
  for (const double fill : {2.0 / 3.0, 0.4}) {
    SceneCamera camera;
    camera.motion = FrameMoving{.direction = Vec3(0.3, -1, 0.4), .fill = fill};
    const renderer::Camera stands = CameraPath(camera, made, 16.0 / 9.0).at(0.0, made.world.states());
    double left = 1e9, right = -1e9;
    for (const Vec3& p : pointsOfTheRun(scene, std::nullopt, 1)) {
      const auto pixel = renderer::projectToPixel(stands, 1600, 900, p);
      ASSERT_TRUE(pixel.has_value());
      left = std::min(left, pixel->x()), right = std::max(right, pixel->x());
    }
    // One point in a hundred may be beyond each side: here those of the first and the last of 97 moments, the
    // nearer of which is seen larger.
    EXPECT_NEAR((right - left) / 1600.0, fill, 2.5 * 2.0 / 97.0);
    EXPECT_GT((right - left) / 1600.0, fill);
    EXPECT_NEAR(0.5 * (right + left), 800.0, 20.0);
  }
}

TEST(CameraThatFramesWhatMoves, FramesWhatStandsWhereNothingMoves) {
  const Scene scene = parseScene(R"({ "format": 1, "bodies": [
      { "name": "post", "shape": { "box": [1, 1, 3] }, "position": [40, 2, 3], "static": true } ] })",
                                 "standing.json");
  const SceneWorld made = makeSceneWorld(scene, std::nullopt);
  SceneCamera camera;
  camera.motion = FrameMoving{};
  const renderer::Camera stands = CameraPath(camera, made, 16.0 / 9.0).at(0.0, made.world.states());
  const auto pixel = renderer::projectToPixel(stands, 1600, 900, Vec3(40, 2, 3));
  ASSERT_TRUE(pixel.has_value());
  EXPECT_LT((*pixel - Vec2(800, 450)).norm(), 60.0);
}

}  // namespace
}  // namespace carom::demos
