// A failure that hangs on two of many bodies, one of them fast, is shrunk to these two and round numbers.

#include "tests/explore/shrink.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "demos/language/scene_file.h"
#include "tests/explore/scene_text.h"

namespace carom::explore {
namespace {

demos::Scene manyBodies() {
  demos::Scene scene;
  scene.rate_hz = 100.0;
  scene.duration_s = 1.0;
  for (int i = 0; i < 20; ++i) {
    demos::Body body;
    body.name = "b";
    body.name += std::to_string(i);
    body.shape.form = demos::BoxShape{Vec3(0.123456789, 0.5, 0.25)};
    body.X_WS.position = Vec3(1.23456789 * i, 0, 0);
    body.X_WS.rotation = Quat(0.5, 0.5, 0.5, 0.5);
    body.linear_velocity = Vec3(3.14159, 0, 0);
    body.angular_velocity = Vec3(0, 1, 0);
    scene.bodies.push_back(body);
  }
  return scene;
}

TEST(Shrink, KeepsWhatTheFailureNeeds) {
  const Trial trial = [](const demos::Scene& scene) -> std::optional<Finding> {
    const auto find = [&scene](const char* name) {
      return std::find_if(scene.bodies.begin(), scene.bodies.end(),
                          [name](const demos::Body& body) { return body.name == name; });
    };
    const auto a = find("b3"), b = find("b17");
    if (a == scene.bodies.end() || b == scene.bodies.end() || stepsOf(scene) < 12) return std::nullopt;
    if (b->linear_velocity.x() < 3.0) return std::nullopt;
    return Finding{"energy", 0.5, 12, ""};
  };
  const Shrunk shrunk = shrunkScene(manyBodies(), {"energy", 0.5, 12, ""}, trial, 300);
  ASSERT_EQ(shrunk.scene.bodies.size(), 2u);
  EXPECT_EQ(stepsOf(shrunk.scene), 12);
  EXPECT_EQ(shrunk.scene.bodies[1].linear_velocity, Vec3(3, 0, 0));
  EXPECT_EQ(shrunk.scene.bodies[0].linear_velocity, Vec3::Zero());
  EXPECT_EQ(shrunk.scene.bodies[0].X_WS.rotation.w(), 1.0);
  EXPECT_EQ(std::get<demos::BoxShape>(shrunk.scene.bodies[0].shape.form).size_m, Vec3(0.1, 0.5, 0.3));
  EXPECT_LE(shrunk.trials, 300);
}

TEST(Shrink, AFigureATenthAsLargeIsAnotherFailure) {
  const Trial trial = [](const demos::Scene& scene) -> std::optional<Finding> {
    return Finding{"energy", scene.bodies.size() < 20 ? 0.001 : 1.0, 100, ""};
  };
  EXPECT_EQ(shrunkScene(manyBodies(), {"energy", 1.0, 100, ""}, trial, 300).scene.bodies.size(), 20u);
}

}  // namespace
}  // namespace carom::explore
