#include "demos/scene/scene_caption.h"

#include <gtest/gtest.h>

#include "demos/language/scene_file.h"
#include "engine/foundation/contract.h"
#include "tests/support/thrown_message.h"

namespace carom::demos {
namespace {

Scene sceneWith(const std::string& caption) {
  return parseScene(R"({ "format": 1, "set": { "m": 2 }, "gravity": [0, 0, -10], "caption": ")" + caption +
                        R"(", "bodies": [
      { "name": "crate", "shape": { "box": [1, 2, 1] }, "position": [1, 2, 3], "mass": 2, "linearVelocity": [3, 0, 4],
        "angularVelocity": [0, 0, 2], "rotation": { "axis": [1, 0, 0], "degrees": 30 } },
      { "name": "wall", "shape": { "box": [1, 1, 1] }, "position": [9, 9, 9], "static": true } ] })",
                    "caption.json");
}

std::string lineAt(const std::string& caption, double time_s, const Vec3& shift) {
  const Scene scene = sceneWith(caption);
  const SceneWorld made = makeSceneWorld(scene, std::nullopt);
  const SceneCaption line(scene, made);
  std::vector<BodyState> states(made.world.states().begin(), made.world.states().end());
  states[0].X_WB.position += shift;
  return line.at(time_s, states);
}

TEST(SceneCaption, KnowsPlaceSpeedAndEnergies) {
  EXPECT_EQ(lineAt("{body:crate.x:0} {body:crate.y:0} {body:crate.z:0}", 0, Vec3::Zero()), "1 2 3");
  EXPECT_EQ(
      lineAt("{body:crate.vx:0} {body:crate.vz:0} {body:crate.speed:0} {body:crate.spin:0}", 0, Vec3::Zero()),
      "3 4 5 2");
  // m v^2 / 2 = 25 J; about z, tilted by 30 degrees about x: I = c^2 Iz + s^2 Iy = m/12 (c^2 5 + s^2 2).
  EXPECT_EQ(lineAt("{body:crate.energy:4}", 0, Vec3::Zero()), "26.4167");
  EXPECT_EQ(lineAt("{=kinetic:4} {=energy:4}", 0, Vec3::Zero()), "26.4167 86.4167");
  EXPECT_EQ(lineAt("{=time*m:2}", 1.25, Vec3::Zero()), "2.50");
}

TEST(SceneCaption, MeasuresTiltAndWhatWasMovedSinceTheStart) {
  EXPECT_EQ(lineAt("{body:crate.tilt:3} {body:crate.turned:3}", 0, Vec3::Zero()), "30.000 0.000");
  EXPECT_EQ(lineAt("{body:crate.moved:2}", 0, {3, 4, 0}), "5.00");
}

TEST(SceneCaption, RefusesABodyThatIsNotThereWithTheNearest) {
  const std::string message = thrownMessage<InputError>([] { sceneWith("{body:crat.x}"); });
  EXPECT_NE(message.find("unknown body \"crat\""), std::string::npos) << message;
  EXPECT_NE(message.find("crate"), std::string::npos) << message;
}

TEST(SceneCaption, UsesTheVariablesThatItNames) {
  EXPECT_TRUE(sceneWith("{=m}").warnings.empty());
  EXPECT_EQ(sceneWith("mm").warnings.size(), 1u) << "\"m\" is set and not used";
}

}  // namespace
}  // namespace carom::demos
