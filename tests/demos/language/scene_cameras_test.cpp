#include "demos/language/scene_cameras.h"

#include <gtest/gtest.h>

#include "demos/language/scene_file.h"
#include "engine/foundation/contract.h"
#include "tests/support/thrown_message.h"

namespace carom::demos {
namespace {

Scene sceneWith(const std::string& camera) {
  return parseScene(
      R"({ "format": 1, "duration": 4, "bodies": [ { "name": "crate", "shape": { "box": [1, 1, 1] } } ],
      "cameras": { "main": )" +
          camera + " } }",
      "cameras.json");
}
SceneCamera cameraOf(const std::string& camera) {
  return sceneWith(camera).cameras.at("main");
}

TEST(SceneCameras, ReadsKeyframes) {
  const SceneCamera camera =
      cameraOf(R"({ "keyframes": [ { "time": 0, "eye": [1, 2, 3], "target": [0, 0, 0] },
      { "time": 2.5, "eye": [4, 2, 3], "target": [0, 0, 1], "fovDegrees": 20 } ], "fovDegrees": 33 })");
  const auto& path = std::get<CameraKeyframes>(camera.motion);
  ASSERT_EQ(path.keys.size(), 2u);
  EXPECT_TRUE(path.smooth);
  EXPECT_EQ(path.keys[0].camera.fov_degrees, 33.0);
  EXPECT_EQ(path.keys[1].camera.fov_degrees, 20.0);
  EXPECT_EQ(path.keys[1].time_s, 2.5);
  EXPECT_TRUE(camera.moves());
}

TEST(SceneCameras, ADollyTakesTheSceneItsTimeAndLooksAtAPointOrABody) {
  const SceneCamera at_point =
      cameraOf(R"({ "dolly": { "points": [[9, 0, 1], [0, 9, 2]], "target": [0, 0, 1] } })");
  EXPECT_EQ(std::get<Dolly>(at_point.motion).seconds, 4.0);
  EXPECT_TRUE(std::get<Dolly>(at_point.motion).eased);
  const SceneCamera at_body =
      cameraOf(R"({ "dolly": { "points": [[9, 0, 1], [0, 9, 2]], "target": "crate", "start": 1,
      "seconds": 2, "ease": false } })");
  EXPECT_EQ(std::get<Dolly>(at_body.motion).body, "crate");
  EXPECT_FALSE(std::get<Dolly>(at_body.motion).eased);
}

TEST(SceneCameras, FramesWhatMoves) {
  const auto& frame = std::get<FrameMoving>(cameraOf(R"({ "frame": "moving", "fill": 0.5 })").motion);
  EXPECT_EQ(frame.fill, 0.5);
}

TEST(SceneCameras, RefusesWhatIsNoWayAndSaysWhatIsAccepted) {
  const auto refusal = [](const std::string& camera) {
    return thrownMessage<InputError>([&] { cameraOf(camera); });
  };
  const std::string key = R"({ "time": 1, "eye": [1, 2, 3], "target": [0, 0, 0] })";
  EXPECT_NE(refusal("{ \"keyframes\": [" + key + ", " + key + "] }").find("times that rise"),
            std::string::npos);
  EXPECT_NE(refusal("{ \"keyframes\": [] }").find("1 to 1000"), std::string::npos);
  EXPECT_NE(refusal("{ \"keyframes\": [" + key + "], \"interpolation\": \"cubic\" }").find("linear, smooth"),
            std::string::npos);
  EXPECT_NE(refusal(R"({ "dolly": { "points": [[1, 1, 1]], "target": [0, 0, 0] } })").find("2 to 1000"),
            std::string::npos);
  EXPECT_NE(refusal(R"({ "dolly": { "points": [[1, 1, 1], [1, 1, 1]], "target": [0, 0, 0] } })")
                .find("another place"),
            std::string::npos);
  EXPECT_NE(refusal(R"({ "dolly": { "points": [[1, 1, 1], [2, 1, 1]], "target": "crat" } })").find("crate"),
            std::string::npos);
  EXPECT_NE(refusal(R"({ "frame": "all" })").find("\"moving\""), std::string::npos);
}

}  // namespace
}  // namespace carom::demos
