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

Vec3 viewOf(const renderer::Camera& camera) {
  return renderer::cameraAxes(camera).forward;
}

// On a straight line through the target at half of the time: what it sees there is what it saw just before,
// in this frame as in any beside it. The way there is reckoned out at 1e-4 m from the target, with
// coordinates of 5 m: their rounding is 1e-11 of it.
TEST(CameraKeyframes, LookOnWhereTheEyeMeetsTheTarget) {
  for (const char* how : {"linear", "smooth"}) {
    const Made made(R"({ "keyframes": [ { "time": 0, "eye": [5, 1, 2], "target": [0, 2, 1] },
        { "time": 4, "eye": [-5, 3, 0], "target": [0, 2, 1] } ], "interpolation": ")" +
                    std::string(how) + "\" }");
    EXPECT_LT((made.at(2.0).eye - Vec3(0, 2, 1)).norm(), 1e-12);
    EXPECT_LT((viewOf(made.at(2.0)) - Vec3(-5, 1, -1).normalized()).norm(), 1e-9) << how;
    EXPECT_LT((viewOf(made.at(1.9)) - Vec3(-5, 1, -1).normalized()).norm(), 1e-9) << how;
    EXPECT_LT((viewOf(made.at(2.1)) + Vec3(-5, 1, -1).normalized()).norm(), 1e-9) << how;
  }
}

TEST(CameraDolly, LooksOnWhereItEndsAndBackWhereItBeginsAtItsTarget) {
  const std::string way =
      R"({ "dolly": { "points": [[9, 0, 1], [5, 5, 2], [0, 9, 2]], "start": 1, "seconds": 2, )";
  for (const char* ease : {"false", "true"}) {
    const Made there(way + R"("target": [0, 9, 2], "ease": )" + ease + " } }");
    const Vec3 arriving = viewOf(there.at(3.0));
    // The curve's direction changes by less than a radian a metre, and this is a millimetre before its end.
    EXPECT_LT((arriving - (there.at(3.0).eye - there.at(2.999).eye).normalized()).norm(), 0.01) << ease;
    for (const double later : {3.5, 30.0}) EXPECT_EQ(viewOf(there.at(later)), arriving) << ease;
    const Made back(way + R"("target": [9, 0, 1], "ease": )" + ease + " } }");
    const Vec3 leaving = viewOf(back.at(1.0));
    EXPECT_LT((leaving + (back.at(1.001).eye - back.at(1.0).eye).normalized()).norm(), 0.01) << ease;
    EXPECT_EQ(viewOf(back.at(0.0)), leaving) << ease;
  }
}

TEST(CameraDolly, LooksAtABodyThatGoesThroughItAsItCame) {
  const Made made(R"({ "dolly": { "points": [[9, 0, 1], [5, 5, 2], [0, 9, 2]], "target": "crate", "start": 1,
      "seconds": 2 } })");
  BodyState crate = made.made.world.states()[0];
  crate.X_WB.position = made.at(0.5).eye;
  crate.linear_velocity = Vec3(1, -2, 2);
  const renderer::Camera camera = made.path.at(0.5, std::span<const BodyState>(&crate, 1));
  EXPECT_LT((viewOf(camera) + Vec3(1, -2, 2) / 3.0).norm(), 1e-9);
}

}  // namespace
}  // namespace carom::demos
