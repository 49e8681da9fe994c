// Cameras that go along keyframes and curves, through the scene's file.
#include <gtest/gtest.h>

#include "demos/language/scene_file.h"
#include "demos/scene/camera_path.h"

namespace carom::demos {
namespace {

struct Made {
  explicit Made(const std::string& camera)
      : scene(parseScene(R"({ "format": 1, "duration": 4, "bodies": [
          { "name": "crate", "shape": { "box": [1, 1, 1] }, "position": [1, 2, 3] } ], "cameras": { "main": )" +
                             camera + " } }",
                         "moving.json")),
        made(makeSceneWorld(scene, std::nullopt)),
        path(scene.cameras.at("main"), made, 16.0 / 9.0) {}
  renderer::Camera at(double time_s) const { return path.at(time_s, made.world.states()); }

  Scene scene;
  SceneWorld made;
  CameraPath path;
};

TEST(CameraKeyframes, AreMetExactlyAndHeldOutside) {
  const Made made(R"({ "keyframes": [ { "time": 1, "eye": [1, 2, 3], "target": [0, 0, 0], "fovDegrees": 20 },
      { "time": 2, "eye": [5, 2, 3], "target": [0, 1, 0], "fovDegrees": 40 },
      { "time": 3, "eye": [5, 2, 7], "target": [0, 1, 0], "fovDegrees": 40 } ] })");
  for (const double before : {0.0, 1.0}) {
    EXPECT_EQ(made.at(before).eye, Vec3(1, 2, 3));
    EXPECT_EQ(made.at(before).fov_degrees, 20.0);
  }
  EXPECT_EQ(made.at(2.0).eye, Vec3(5, 2, 3));
  EXPECT_EQ(made.at(2.0).target, Vec3(0, 1, 0));
  EXPECT_EQ(made.at(2.5).target, Vec3(0, 1, 0)) << "stands between equal ones";
  EXPECT_EQ(made.at(2.5).eye, Vec3(5, 2, 5)) << "from rest to rest";
  for (const double after : {3.0, 9.0}) EXPECT_EQ(made.at(after).eye, Vec3(5, 2, 7));
}

TEST(CameraKeyframes, GoStraightAtOneSpeedWhereTheyAreLinear) {
  const Made made(R"({ "keyframes": [ { "time": 0, "eye": [0, 0, 3], "target": [0, 9, 0] },
      { "time": 4, "eye": [8, 4, 3], "target": [0, 9, 0] } ], "interpolation": "linear" })");
  EXPECT_EQ(made.at(1.0).eye, Vec3(2, 1, 3));
}

TEST(CameraDolly, LooksAtItsBodyAndArrivesInItsTime) {
  const Made made(R"({ "dolly": { "points": [[9, 0, 1], [5, 5, 2], [0, 9, 2]], "target": "crate", "start": 1,
      "seconds": 2, "ease": false } })");
  EXPECT_LT((made.at(0.5).eye - Vec3(9, 0, 1)).norm(), 1e-12);
  EXPECT_LT((made.at(3.0).eye - Vec3(0, 9, 2)).norm(), 1e-9);
  EXPECT_EQ(made.at(2.0).target, made.made.world.states()[0].X_WB.position);
  const double first = (made.at(1.2).eye - made.at(1.1).eye).norm();
  EXPECT_NEAR((made.at(2.7).eye - made.at(2.6).eye).norm(), first, 0.02 * first) << "one speed";
}

}  // namespace
}  // namespace carom::demos
