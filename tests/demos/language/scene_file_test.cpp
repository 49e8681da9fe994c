#include "demos/language/scene_file.h"

#include <algorithm>
#include <regex>

#include <gtest/gtest.h>

#include "demos/scene/scene_world.h"
#include "engine/foundation/contract.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/thrown_message.h"

namespace carom::demos {
namespace {

/// A scene of one body with this inside, in a file of that many lines above.
std::string bodyScene(const std::string& body) {
  return "{ \"format\": 1,\n  \"bodies\": [\n    { \"name\": \"crate\", " + body + " } ] }";
}

struct Refusal {
  const char* name;
  std::string text;
  std::string message;  ///< Without the file's name.
};
void PrintTo(const Refusal& refusal, std::ostream* out) {
  *out << refusal.name;
}

/// A scene with this fluid on its second line.
std::string fluidScene(const std::string& fluid) {
  return "{ \"format\": 1, \"bodies\": [ { \"name\": \"a\", \"shape\": { \"box\": [1, 1, 1] } } ],\n"
         "  \"fluids\": [ { \"name\": \"pool\"" +
         fluid + " } ] }";
}

const std::string kBox = "\"shape\": { \"box\": [1, 1, 1] }";
/// A scene with one camera, in the file's second line.
std::string cameraScene(const std::string& camera) {
  return "{ \"format\": 1, \"bodies\": [ { \"name\": \"a\", " + kBox +
         " } ],\n \"cameras\": { \"main\": " + camera + " } }";
}
const char kOneOfShapes[] =
    "accepted: exactly one of box, sphere, capsule, cylinder, cone, prism, wedge, roundedBox, hull, mesh, "
    "compound";

const Refusal kRefusals[] = {
    {"MisspeltTopKey", "{ \"format\": 1, \"boddies\": [] }",
     ":1: boddies: unknown key \"boddies\"; did you mean \"bodies\"? accepted: $schema, format, "
     "description, lookFor, group, caption, set, include, gravity, rate, seed, materials, air, fluids, "
     "bodies, cameras, duration, light"},
    {"MisspeltShape", bodyScene("\"shape\": { \"bx\": [1, 1, 1] }"),
     ":3: bodies[0].shape.bx: unknown key \"bx\"; did you mean \"box\"? accepted: box, sphere, capsule, "
     "cylinder, cone, prism, wedge, roundedBox, hull, mesh, compound"},
    {"MisspeltMaterial",
     "{ \"format\": 1, \"materials\": { \"wood\": {} },\n \"bodies\": [ { \"name\": \"a\", \"material\": "
     "\"wod\", " +
         kBox + " } ] }",
     ":2: bodies[0].material: unknown material \"wod\"; did you mean \"wood\"? accepted: wood"},
    {"KeyOfALaterFormat",
     "{ \"format\": 1, \"bodies\": [ { \"name\": \"a\", " + kBox + " } ],\n \"sound\": [] }",
     ":2: sound: unknown key \"sound\"; accepted: $schema, format, description, lookFor, group, "
     "caption, set, include, gravity, rate, seed, materials, air, fluids, bodies, cameras, duration, light"},
    {"UnknownFormat", "{ \"format\": 2, \"bodies\": [] }", ":1: format: 2 is unknown; accepted: 1"},
    {"MissingFormat", "{ \"bodies\": [] }", ":1: key \"format\" is missing"},
    {"NoBodies", "{ \"format\": 1, \"bodies\": [] }", ":1: bodies: a scene needs at least one body"},
    {"DensityThatMakesNoMass", bodyScene(kBox + ", \"material\": { \"density\": 5e-324 }"),
     ":3: bodies[0].material: density 4.94066e-324 for a body that moves; accepted: 1e-06 to 1e+06"},
    {"CopiesOutOfReach", bodyScene(kBox + ", \"repeat\": { \"count\": [1, 3, 1], \"step\": [0, -60000, 0] }"),
     ":3: bodies[0].repeat: the copies reach to 120000 m along y; accepted: -100000 to 100000"},
    {"NanSize", bodyScene("\"shape\": { \"box\": [1, NaN, 1] }"), ":3: syntax error"},
    {"InfiniteSize", bodyScene("\"shape\": { \"box\": [1, 1e999, 1] }"),
     ":3: number overflow parsing '1e999'"},
    {"ZeroSize", bodyScene("\"shape\": { \"box\": [1, 0, 1] }"),
     ":3: bodies[0].shape.box[1]: 0 is out of range; accepted: 0.0001 to 100000"},
    {"NegativeRadius", bodyScene("\"shape\": { \"sphere\": { \"radius\": -0.5 } }"),
     ":3: bodies[0].shape.sphere.radius: -0.5 is out of range; accepted: 0.0001 to 100000"},
    {"TwoSizes", bodyScene("\"shape\": { \"box\": [1, 2] }"),
     ":3: bodies[0].shape.box: [1,2] has 2 numbers; accepted: three"},
    {"SizeInWords", bodyScene("\"shape\": { \"box\": [1, \"two\", 3] }"),
     ":3: bodies[0].shape.box[1]: \"two\" is a string; accepted: a finite number"},
    {"NoShape", bodyScene("\"shape\": {}"), std::string(":3: bodies[0].shape: ") + kOneOfShapes},
    {"TwoShapes", bodyScene("\"shape\": { \"box\": [1, 1, 1], \"sphere\": { \"radius\": 1 } }"),
     std::string(":3: bodies[0].shape: ") + kOneOfShapes},
    {"MissingShape", bodyScene("\"static\": true"), ":3: bodies[0]: key \"shape\" is missing"},
    {"MissingMesh", bodyScene("\"shape\": { \"hull\": { \"file\": \"meshes/gemm.obj\" } }"),
     ":3: bodies[0].shape.hull.file: no file \"meshes/gemm.obj\" beside the scene or in the assets folder"},
    {"NeitherFileNorPoints", bodyScene("\"shape\": { \"hull\": {} }"),
     ":3: bodies[0].shape.hull: accepted: either \"file\" or \"points\""},
    {"ScaleAndFit",
     bodyScene("\"shape\": { \"hull\": { \"file\": \"meshes/gem.obj\", \"scale\": 2, \"fit\": 1 } }"),
     ":3: bodies[0].shape.hull.fit: given together with \"scale\"; accepted: one of them"},
    {"NestedCompound", bodyScene("\"shape\": { \"compound\": [ { \"shape\": { \"compound\": [] } } ] }"),
     ":3: bodies[0].shape.compound[0].shape.compound: a compound cannot hold a compound; accepted: any "
     "other shape"},
    {"ZeroMass", bodyScene(kBox + ", \"material\": { \"density\": 0 }"),
     ":3: bodies[0].material: density 0 for a body that moves; accepted: 1e-06 to 1e+06"},
    {"NegativeDensity", bodyScene(kBox + ", \"material\": { \"density\": -1 }"),
     ":3: bodies[0].material.density: -1 is out of range; accepted: 0 to 1e+06"},
    {"NegativeRollingResistance", bodyScene(kBox + ", \"material\": { \"rollingResistance\": -1 }"),
     ":3: bodies[0].material.rollingResistance: -1 is out of range; accepted: 0 to 100"},
    {"ResistanceMisspelt", bodyScene(kBox + ", \"material\": { \"spiningResistance\": 0.1 }"),
     ":3: bodies[0].material.spiningResistance: unknown key \"spiningResistance\"; did you mean "
     "\"spinningResistance\"? accepted: staticFriction, dynamicFriction, rollingResistance, "
     "spinningResistance, restitution, density, dragCoefficient, color, checker, ground, surface, "
     "surfaceScale"},
    {"TooBouncy", bodyScene(kBox + ", \"material\": { \"restitution\": 1.1 }"),
     ":3: bodies[0].material.restitution: 1.1 is out of range; accepted: 0 to 1"},
    {"DynamicAboveStaticFriction",
     bodyScene(kBox + ", \"material\": { \"staticFriction\": 0.3, \"dynamicFriction\": 0.4 }"),
     ":3: bodies[0].material.dynamicFriction: 0.4 is above the static friction of 0.3; accepted: at most "
     "that"},
    {"BadQuaternion", bodyScene(kBox + ", \"rotation\": [1, 1, 0, 0]"),
     ":3: bodies[0].rotation: [1,1,0,0] has length 1.41421; accepted: a unit quaternion [w, x, y, z]"},
    {"ZeroQuaternion", bodyScene(kBox + ", \"rotation\": [0, 0, 0, 0]"),
     ":3: bodies[0].rotation: [0,0,0,0] has length 0; accepted: a unit quaternion [w, x, y, z]"},
    {"ZeroAxis", bodyScene(kBox + ", \"rotation\": { \"axis\": [0, 0, 0], \"degrees\": 30 }"),
     ":3: bodies[0].rotation.axis: [0,0,0] has no direction; accepted: an axis of some length"},
    {"RotationInWords", bodyScene(kBox + ", \"rotation\": \"up\""),
     ":3: bodies[0].rotation: \"up\" is no rotation; accepted: {\"axis\": [x, y, z], \"degrees\": d} or a "
     "unit quaternion [w, x, y, z]"},
    {"BadColor", bodyScene(kBox + ", \"color\": \"red\""),
     ":3: bodies[0].color: \"red\" is no colour; accepted: \"#rrggbb\""},
    {"MovingStatic", bodyScene(kBox + ", \"static\": true, \"linearVelocity\": [1, 0, 0]"),
     ":3: bodies[0]: a static body has no velocity; accepted: leave out linearVelocity and angularVelocity"},
    {"HugeCount", bodyScene(kBox + ", \"repeat\": { \"count\": [1000, 1000, 1000], \"step\": [2, 2, 2] }"),
     ":3: bodies[0].repeat.count: [1000,1000,1000] makes too many bodies; accepted: at most 20000"},
    {"FractionOfACount", bodyScene(kBox + ", \"repeat\": { \"count\": [1.5, 1, 1], \"step\": [2, 2, 2] }"),
     ":3: bodies[0].repeat.count[0]: 1.5 is out of range; accepted: a whole number from 1 to 20000"},
    {"EndlessDuration", "{ \"format\": 1, \"duration\": 0, \"bodies\": [] }",
     ":1: duration: 0 is out of range; accepted: above 0 to 3600"},
    {"TwoBodiesOfOneName",
     "{ \"format\": 1, \"bodies\": [ { \"name\": \"a\", " + kBox + " },\n { \"name\": \"a\", " + kBox +
         " } ] }",
     ":2: bodies[1].name: \"a\" names two bodies"},
    {"NameOfACopy",
     "{ \"format\": 1, \"bodies\": [ { \"name\": \"a\", \"repeat\": { \"count\": 2, \"step\": [2, 0, 0] }, " +
         kBox + " },\n { \"name\": \"a[1]\", " + kBox + " } ] }",
     ":2: bodies[1].name: \"a[1]\" names two bodies"},
    {"CopyOfAName",
     "{ \"format\": 1, \"bodies\": [ { \"name\": \"a[1]\", " + kBox +
         " },\n { \"name\": \"a\", \"repeat\": { \"count\": 2, \"step\": [2, 0, 0] }, " + kBox + " } ] }",
     ":2: bodies[1].name: \"a[1]\" names two bodies"},
    {"BlindCamera",
     "{ \"format\": 1, \"bodies\": [ { \"name\": \"a\", " + kBox +
         " } ],\n \"cameras\": { \"main\": { \"eye\": [1, 2, 3], \"target\": [1, 2, 3] } } }",
     ":2: cameras.main: eye and target coincide"},
    {"MisspeltCamera", cameraScene("{ \"folow\": \"a\" }"),
     ":2: cameras.main.folow: unknown key \"folow\"; did you mean \"follow\"? accepted: eye, target, "
     "fovDegrees, fit, direction, frame, fill, follow, offset, orbit, keyframes, interpolation, dolly, "
     "aperture, focus"},
    {"TwoKindsOfCamera", cameraScene("{ \"fit\": true, \"eye\": [1, 2, 3] }"),
     ":2: cameras.main.eye: unknown key \"eye\"; accepted: fit, direction, fovDegrees, aperture, focus"},
    {"FitThatDoesNot", cameraScene("{ \"fit\": false }"),
     ":2: cameras.main.fit: accepted: true, or another kind of camera"},
    {"FollowNobody", cameraScene("{ \"follow\": \"b\" }"),
     ":2: cameras.main.follow: unknown body \"b\"; did you mean \"a\"? accepted: a"},
    {"FollowFromWithin", cameraScene("{ \"follow\": \"a\", \"offset\": [0, 0, 0] }"),
     ":2: cameras.main.offset: [0,0,0] has no direction; accepted: a vector of some length"},
    {"OrbitWithoutRadius", cameraScene("{ \"orbit\": { \"target\": [0, 0, 0] } }"),
     ":2: cameras.main.orbit: key \"radius\" is missing"},
    {"OrbitMisspelt", cameraScene("{ \"orbit\": { \"target\": [0, 0, 0], \"radius\": 1, \"hight\": 2 } }"),
     ":2: cameras.main.orbit.hight: unknown key \"hight\"; did you mean \"height\"? accepted: target, "
     "radius, height, degreesPerSecond, startDegrees"},
    {"StaticAndKinematic", bodyScene(kBox + ", \"static\": true, \"kinematic\": true"),
     ":3: bodies[0].kinematic: the body is static, too; accepted: one of static and kinematic"},
    {"MassOfAStaticBody", bodyScene(kBox + ", \"static\": true, \"mass\": 2"),
     ":3: bodies[0].mass: of a body that is static; accepted: only of one that moves freely"},
    {"MassAndDensity", bodyScene(kBox + ", \"mass\": 2, \"material\": { \"density\": 100 }"),
     ":3: bodies[0].mass: given together with the material's \"density\"; accepted: one of them"},
    {"NoMass", bodyScene(kBox + ", \"mass\": 0"),
     ":3: bodies[0].mass: 0 is out of range; accepted: above 0 to 1e+21"},
    {"OneAxisOfTurningLocked", bodyScene(kBox + ", \"locked\": [\"x\", \"turnZ\"]"),
     ":3: bodies[0].locked: locks one axis of turning; accepted: none, two or all three of turnX, turnY, "
     "turnZ"},
    {"NoSuchAxis", bodyScene(kBox + ", \"locked\": [\"w\"]"),
     ":3: bodies[0].locked[0]: \"w\" is no axis; accepted: x, y, z, turnX, turnY, turnZ"},
    {"VelocityAlongALockedAxis", bodyScene(kBox + ", \"locked\": [\"x\"], \"linearVelocity\": [1, 0, 0]"),
     ":3: bodies[0].linearVelocity: has a part along a locked axis; accepted: 0 there"},
    {"KeyframesBackInTime",
     bodyScene(kBox + ", \"kinematic\": { \"keyframes\": [ { \"time\": 1 }, { \"time\": 1 } ] }"),
     ":3: bodies[0].kinematic.keyframes[1].time: 1 is not after the keyframe before; accepted: times that "
     "rise"},
    {"KeyframesThreeQuartersOfATurnApart",
     bodyScene(kBox + ", \"kinematic\": { \"keyframes\": [ { \"time\": 0 }, { \"time\": 1, \"rotation\": { "
                      "\"axis\": [0, 0, 1], \"degrees\": 270 } } ] }"),
     ":3: bodies[0].kinematic.keyframes[1].rotation: turns by 270 degrees from the keyframe before, and a "
     "path goes the shorter way round; accepted: at most 180 from each keyframe to the next"},
    // 10 m and a right angle, each in 1e-6 s; a smooth leg is twice as fast in its middle.
    {"KeyframesFasterThanAnyBody",
     bodyScene(kBox + ", \"kinematic\": { \"keyframes\": [ { \"time\": 0 }, { \"time\": 0.000001, "
                      "\"position\": [6, 8, 0] } ] }"),
     ":3: bodies[0].kinematic.keyframes[1]: takes 1e+07 m/s from the keyframe before, 1e-06 s earlier; "
     "accepted: at most 100000"},
    {"KeyframesTurningFasterThanAnyBody",
     bodyScene(kBox + ", \"kinematic\": { \"interpolation\": \"smooth\", \"keyframes\": [ { \"time\": 0 }, { "
                      "\"time\": 0.000001, \"rotation\": { \"axis\": [0, 0, 1], \"degrees\": 90 } } ] }"),
     ":3: bodies[0].kinematic.keyframes[1]: takes 3.14159e+06 rad/s from the keyframe before, 1e-06 s "
     "earlier; accepted: at most 100000"},
    {"KeyframesAndPosition",
     bodyScene(kBox + ", \"kinematic\": { \"keyframes\": [ { \"time\": 1 } ] }, \"position\": [0, 0, 1]"),
     ":3: bodies[0].position: given together with keyframes, which say where the body is; accepted: one of "
     "them"},
    {"RepeatsWithASeam",
     bodyScene(kBox + ", \"kinematic\": { \"keyframes\": [ { \"time\": 0 }, { \"time\": 1, "
                      "\"position\": [1, 0, 0] } ], \"repeats\": true }"),
     ":3: bodies[0].kinematic.repeats: the last keyframe is not where the first is; accepted: a path that "
     "ends as it begins"},
    {"RepeatsWithoutEnd",
     bodyScene(kBox + ", \"kinematic\": { \"keyframes\": [ { \"time\": 0 }, { \"time\": 1e-9 }, { "
                      "\"time\": 2e-9 } ], \"repeats\": true }"),
     ":3: bodies[0].kinematic.repeats: the path takes 2e-09 s; accepted: at least 2e-05 s, 1e-05 s from "
     "each keyframe to the next"},
    {"NegativeDragCoefficient", bodyScene(kBox + ", \"dragCoefficient\": -1"),
     ":3: bodies[0].dragCoefficient: -1 is out of range; accepted: 0 to 1000"},
    {"MisspeltFluidKey", fluidScene(", \"level\": 0, \"densty\": 1000"),
     ":2: fluids[0].densty: unknown key \"densty\"; did you mean \"density\"? accepted: name, box, level, "
     "density, drag, linearDrag, flow, addedMass, waves, color"},
    {"MisspeltFluidColor", fluidScene(", \"level\": 0, \"colr\": \"#ffffff\""),
     ":2: fluids[0].colr: unknown key \"colr\"; did you mean \"color\"? accepted: name, box, level, "
     "density, drag, linearDrag, flow, addedMass, waves, color"},
    {"FluidWithoutSpace", fluidScene(""), ":2: fluids[0]: accepted: either \"box\" or \"level\""},
    {"FluidWithTwoSpaces", fluidScene(", \"level\": 0, \"box\": { \"min\": [0, 0, 0], \"max\": [1, 1, 1] }"),
     ":2: fluids[0]: accepted: either \"box\" or \"level\""},
    {"FluidUpsideDown", fluidScene(", \"box\": { \"min\": [0, 0, 2], \"max\": [1, 1, 1] }"),
     ":2: fluids[0].box.max: [1,1,1] is not above \"min\" along z; accepted: larger along every axis"},
    {"FluidOfNoDensity", fluidScene(", \"level\": 0, \"density\": 0"),
     ":2: fluids[0].density: 0 is out of range; accepted: 1e-06 to 1e+06"},
    {"WaveWithoutLength", fluidScene(", \"level\": 0, \"waves\": [ { \"amplitude\": 0.1 } ]"),
     ":2: fluids[0].waves[0]: key \"wavelength\" is missing"},
    {"WaveUpwards",
     fluidScene(", \"level\": 0, \"waves\": [ { \"amplitude\": 0.1, \"wavelength\": 2, \"direction\": [0, 0, "
                "1] } ]"),
     ":2: fluids[0].waves[0].direction: [0,0,1] has 3 numbers; accepted: two, x and y"},
    {"MisspeltAirKey",
     "{ \"format\": 1, \"bodies\": [ { \"name\": \"a\", " + kBox +
         " } ],\n \"air\": { \"wnd\": [1, 0, 0] } }",
     ":2: air.wnd: unknown key \"wnd\"; did you mean \"wind\"? accepted: density, wind, skinFriction"},
};

class SceneFileRefuses : public testing::TestWithParam<Refusal> {};

TEST_P(SceneFileRefuses, InOneLineThatNamesPlaceValueAndWhatIsAccepted) {
  // The column and the remedy are scene_mistakes_test.cpp's matter.
  const std::string message =
      std::regex_replace(thrownMessage<InputError>([] { parseScene(GetParam().text, "scenes/try.json"); }),
                         std::regex("(:[0-9]+):[0-9]+: "), "$1: ");
  const std::string expected = "scenes/try.json" + GetParam().message;
  EXPECT_EQ(message.substr(0, expected.size()), expected);
  EXPECT_EQ(message.find('\n'), std::string::npos);
  const bool in_the_parsers_words = message.find("syntax error") != std::string::npos;
  const std::string rest = message.substr(std::min(expected.size(), message.size()));
  EXPECT_TRUE(rest.empty() || rest.rfind("; write ", 0) == 0 || rest.rfind(" (the first of ", 0) == 0 ||
              in_the_parsers_words)
      << message;
}

INSTANTIATE_TEST_SUITE_P(All, SceneFileRefuses, testing::ValuesIn(kRefusals),
                         [](const testing::TestParamInfo<Refusal>& refusal) { return refusal.param.name; });

TEST(SceneFile, ReadsWhatIsWritten) {
  const Scene scene = parseScene(
      R"({ "format": 1, "description": "d", "lookFor": "=l", "group": "=g", "gravity": [0, 0, -1.62], "rate": 500, "seed": 9, "duration": 2.5,
      // a comment
      "materials": { "wood": { "staticFriction": 0.6, "dynamicFriction": 0.5, "restitution": 0.3, "density": 600, "color": "#ff8000", "checker": true,
        "rollingResistance": 0.01, "spinningResistance": 0.002 } },
      "bodies": [ { "name": "crate", "shape": { "capsule": { "radius": 0.2, "length": 0.6 } }, "position": [1, 2, 3],
                    "rotation": { "axis": [0, 0, 2], "degrees": 90 }, "linearVelocity": [4, 5, 6], "angularVelocity": [7, 8, 9],
                    "material": "wood", "color": ["#000000", "#ffffff"], "repeat": { "count": [2, 3, 4], "step": [1, 1, 2], "jitter": 0.1, "jitterDegrees": 5 } } ],
      "cameras": { "far": { "eye": [9, 9, 9], "target": [0, 0, 1], "fovDegrees": 25 } } })",
      "scenes/moon.json");
  EXPECT_EQ(scene.name, "moon");
  EXPECT_EQ(scene.look_for, "=l") << "a text, no arithmetic";
  EXPECT_EQ(scene.group, "=g");
  EXPECT_EQ(scene.gravity, Vec3(0.0, 0.0, -1.62));
  EXPECT_EQ(scene.rate_hz, 500.0);
  EXPECT_EQ(scene.seed, 9u);
  EXPECT_EQ(scene.duration_s, 2.5);
  EXPECT_EQ(scene.cameras.at("far").fov_degrees, 25.0);
  const Body& body = scene.bodies.at(0);
  EXPECT_EQ(std::get<CapsuleShape>(body.shape.form).length_m, 0.6);
  EXPECT_EQ(body.X_WS.position, Vec3(1.0, 2.0, 3.0));
  EXPECT_LT((body.X_WS.rotation * Vec3::UnitX() - Vec3::UnitY()).norm(), 1e-15);
  EXPECT_EQ(body.linear_velocity, Vec3(4.0, 5.0, 6.0));
  EXPECT_EQ(body.angular_velocity, Vec3(7.0, 8.0, 9.0));
  EXPECT_EQ(body.material.static_friction, 0.6);
  EXPECT_EQ(body.material.dynamic_friction, 0.5);
  EXPECT_EQ(body.material.rolling_resistance_m, 0.01);
  EXPECT_EQ(body.material.spinning_resistance_m, 0.002);
  EXPECT_EQ(body.material.restitution, 0.3);
  EXPECT_EQ(body.material.density_kgpm3, 600.0);
  EXPECT_TRUE(body.look.checker);
  EXPECT_FLOAT_EQ(body.look.color.g, 128.0f / 255.0f);
  EXPECT_EQ(body.colors.size(), 2u);
  EXPECT_EQ(body.repeat.total(), 24);
}

TEST(SceneFile, QuaternionsAreGivenAsWXYZ) {
  const Scene scene = parseScene(bodyScene(kBox + ", \"rotation\": [0, 1, 0, 0]"), "s.json");
  EXPECT_LT((scene.bodies[0].X_WS.rotation * Vec3::UnitY() + Vec3::UnitY()).norm(), 1e-15);
  EXPECT_LT((scene.bodies[0].X_WS.rotation * Vec3::UnitX() - Vec3::UnitX()).norm(), 1e-15);
}

TEST(SceneFile, FindsMeshesBesideTheSceneBeforeTheAssets) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.path() / "meshes");
  folder.file("meshes/gem.obj", "own");
  const std::string text = bodyScene("\"shape\": { \"hull\": { \"file\": \"meshes/gem.obj\" } }");
  const auto file = [&text](const std::filesystem::path& scene) {
    return std::get<HullShape>(parseScene(text, scene).bodies[0].shape.form).file;
  };
  EXPECT_EQ(file(folder.path() / "s.json"), folder.path() / "meshes/gem.obj");
  EXPECT_EQ(file("nowhere/s.json"), std::filesystem::path(CAROM_SOURCE_DIR) / "assets/meshes/gem.obj");
}

// 30 m in 0.0005 s are 60000 m/s on the mean: so fast goes a linear leg, a smooth one 120000 in its middle.
TEST(SceneFile, APathIsHeldToTheLimitOfSpeedsWhereItIsFastest) {
  const auto scene = [](const std::string& how) {
    return bodyScene(
        kBox + ", \"kinematic\": { \"interpolation\": \"" + how +
        "\", \"keyframes\": [ { \"time\": 0 }, { \"time\": 0.0005, \"position\": [30, 0, 0] } ] }");
  };
  EXPECT_NO_THROW(parseScene(scene("linear"), "s.json"));
  EXPECT_NE(
      thrownMessage<InputError>([&] { parseScene(scene("smooth"), "s.json"); }).find("takes 120000 m/s"),
      std::string::npos);
}

}  // namespace
}  // namespace carom::demos
