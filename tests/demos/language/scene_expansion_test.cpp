#include "demos/language/scene_expansion.h"

#include <ctime>
#include <fstream>

#include <gtest/gtest.h>

#include "demos/formula/arithmetic.h"
#include "demos/language/scene_file.h"
#include "demos/scene/scene_world.h"
#include "demos/system/exit_code.h"
#include "engine/foundation/elementary.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/thrown_message.h"

namespace carom::demos {
namespace {

double valueOf(const std::string& text) {
  const NamedNumber numberOf = [](const std::string& name) -> std::optional<double> {
    if (name == "r") return 0.1;
    return std::nullopt;
  };
  return evaluate(text, numberOf, [] { return std::vector<std::string>{"r"}; });
}

TEST(Arithmetic, RoundsAsTheProcessorDoes) {
  EXPECT_EQ(valueOf("2*r + 0.01"), 2 * 0.1 + 0.01);
  EXPECT_EQ(valueOf("1 - 2 - 3"), -4.0);
  EXPECT_EQ(valueOf("-2^2"), -4.0);
  EXPECT_EQ(valueOf("2^3^2"), 512.0);
  EXPECT_EQ(valueOf("2^-1"), 0.5);
  EXPECT_EQ(valueOf("7 % 3 + mod(-1, 3)"), 3.0);
  EXPECT_EQ(valueOf("(1 + 2) * sqrt(16) / max(2, min(5, 3))"), 4.0);
  EXPECT_EQ(valueOf("cos(60)"), sineCosine(60.0 * 3.14159265358979323846 / 180.0).cosine);
  EXPECT_EQ(valueOf("1e-3"), 1e-3);
}

TEST(Arithmetic, WhatIsNoNumberIsRefusedWithItsPlace) {
  for (const char* text : {"", "2*", "(1", "1)", "1/0", "1 % 0", "r r", "2^0.5", "sqrt(-1)", "sin(1, 2)",
                           "sin 1", "1e400", "$", "cos(1e9)"})
    EXPECT_THROW(valueOf(text), InputError) << text;
  EXPECT_THROW(valueOf(std::string(1001, '1')), InputError);
  EXPECT_THROW(valueOf(std::string(200, '(') + "1" + std::string(200, ')')), InputError);
  EXPECT_THROW(valueOf(std::string(900, '-') + "1"), InputError);
  const std::string unknown = thrownMessage<InputError>([] { valueOf("2*R2"); });
  EXPECT_EQ(unknown.rfind("unknown name \"R2\"", 0), 0u) << unknown;
}

/// A scene of these bodies.
Scene sceneOf(const std::string& bodies, const std::string& more = "",
              const std::filesystem::path& path = "s.json") {
  return parseScene("{\"format\": 1, " + more + " \"bodies\": [" + bodies + "]}", path);
}
const std::string kBox = "\"shape\": {\"box\": [0.1, 0.1, 0.1]}";

TEST(SceneExpansion, VariablesStandForNumbersListsAndTexts) {
  const Scene scene = sceneOf(
      "{\"name\": \"a{n}\", \"shape\": {\"box\": \"=size\"}, \"position\": [\"=2*r\", 0, "
      "\"= r + n \"], \"color\": \"=paint\"}",
      "\"set\": {\"r\": 0.25, \"n\": \"=4*r\", \"size\": [1, \"=r\", 2], \"paint\": "
      "\"#ff0000\"},");
  ASSERT_EQ(scene.bodies.size(), 1u);
  EXPECT_EQ(scene.bodies[0].name, "a1");
  EXPECT_EQ(std::get<BoxShape>(scene.bodies[0].shape.form).size_m, Vec3(1, 0.25, 2));
  EXPECT_EQ(scene.bodies[0].X_WS.position, Vec3(0.5, 0, 1.25));
  EXPECT_TRUE(scene.warnings.empty());
}

TEST(SceneExpansion, LoopsNestAndCountFromZeroOrTakeAList) {
  const Scene scene =
      sceneOf("{\"for\": {\"i\": 2, \"x\": [0.5, 3]}, \"bodies\": [{\"name\": \"b{i},{x}\", " + kBox +
              ", \"position\": [\"=x\", \"=i\", 0]}]}");
  ASSERT_EQ(scene.bodies.size(), 4u);
  EXPECT_EQ(scene.bodies[1].name, "b0,3");
  EXPECT_EQ(scene.bodies[2].X_WS.position, Vec3(0.5, 1, 0));
}

TEST(SceneExpansion, AGroupCarriesPosesAndVelocitiesAndNames) {
  const Scene scene = sceneOf(
      "{\"name\": \"left\", \"position\": [1, 2, 3], \"rotation\": {\"axis\": [0, 0, 1], \"degrees\": 90}, "
      "\"bodies\": [{\"name\": \"a\", " +
      kBox +
      ", \"position\": [1, 0, 0], \"linearVelocity\": [1, 0, 0], \"repeat\": {\"count\": 2, \"step\": [1, 0, "
      "0]}}]}");
  const SceneWorld made = makeSceneWorld(scene, {});
  EXPECT_EQ(made.names, (std::vector<std::string>{"left.a[0]", "left.a[1]"}));
  EXPECT_LT((made.world.bodies()[0].X_WB.position - Vec3(1, 3, 3)).norm(), 1e-12);
  EXPECT_LT((made.world.bodies()[1].X_WB.position - Vec3(1, 4, 3)).norm(), 1e-12);
  EXPECT_LT((made.world.bodies()[1].linear_velocity - Vec3(0, 1, 0)).norm(), 1e-12);
}

TEST(SceneExpansion, AnIncludedFileBringsBodiesMaterialsAndVariablesThatCanBeSet) {
  const TemporaryFolder folder;
  folder.file(
      "tower.json",
      "{\"format\": 1, \"set\": {\"n\": 3, \"s\": 0.1}, \"materials\": {\"ice\": {\"density\": 900}}, "
      "\"bodies\": "
      "[{\"for\": {\"i\": \"=n\"}, \"bodies\": [{\"name\": \"brick{i}\", \"material\": \"ice\", \"shape\": "
      "{\"box\": [\"=s\", \"=s\", \"=s\"]}, \"position\": [0, 0, \"=i*s*1.1\"]}]}]}");
  const Scene scene = sceneOf(
      "{\"include\": \"tower.json\", \"name\": \"t\", \"position\": [5, 0, 0], \"set\": "
      "{\"n\": 2}}",
      "", folder.path() / "s.json");
  ASSERT_EQ(scene.bodies.size(), 2u);
  EXPECT_EQ(scene.bodies[1].name, "t.brick1");
  EXPECT_EQ(scene.bodies[1].material.density_kgpm3, 900.0);
  ASSERT_EQ(scene.included.size(), 1u);
  EXPECT_THROW(sceneOf("{\"include\": \"tower.json\", \"set\": {\"m\": 2}}", "", folder.path() / "s.json"),
               InputError);
  folder.file("loop.json", "{\"format\": 1, \"bodies\": [{\"include\": \"loop.json\"}]}");
  EXPECT_THROW(sceneOf("{\"include\": \"loop.json\"}", "", folder.path() / "s.json"), InputError);
}

TEST(SceneExpansion, AnIncludedFileHasWhatItIncludesItself) {
  const TemporaryFolder folder;
  folder.file("far.json", R"({"set": {"k": 2, "l": "=10*k"}, "materials": {"ice": {"density": 900}}})");
  folder.file("near.json", R"({"include": ["far.json"], "materials": {"snow": {"density": 100}}})");
  folder.file("tower.json", R"({"format": 1, "include": ["near.json"], "bodies": [)"
                            R"({"name": "a", "material": "ice", "shape": {"box": ["=k", "=l", 1]}},)"
                            R"({"name": "b", "material": "snow", "shape": {"box": [1, 1, 1]}}]})");
  const auto sizeOf = [&](const std::string& more) {
    const Scene scene =
        sceneOf(R"({"include": "tower.json", "name": "t")" + more + "}", "", folder.path() / "s.json");
    EXPECT_EQ(scene.bodies[0].material.density_kgpm3, 900.0);
    EXPECT_EQ(scene.bodies[1].material.density_kgpm3, 100.0);
    EXPECT_EQ(scene.included.size(), 3u);
    return std::get<BoxShape>(scene.bodies[0].shape.form).size_m;
  };
  EXPECT_EQ(sizeOf(""), Vec3(2, 20, 1));
  EXPECT_EQ(sizeOf(R"(, "set": {"k": 3})"), Vec3(3, 30, 1));
  const std::string refused = thrownMessage<InputError>([&] { sizeOf(R"(, "set": {"m": 3})"); });
  EXPECT_NE(refused.find("\"m\" is no variable of \"tower.json\""), std::string::npos) << refused;
  folder.file("self.json", R"({"format": 1, "include": ["self.json"], "bodies": []})");
  const std::string endless = thrownMessage<InputError>([&] { readSceneFile(folder.path() / "self.json"); });
  EXPECT_NE(endless.find("deeper than 8 levels"), std::string::npos) << endless;
}

TEST(SceneExpansion, OfTwoMaterialsOfOneNameTheLaterIncludedIsTaken) {
  const TemporaryFolder folder;
  folder.file("one.json", R"({"set": {"k": 1}, "materials": {"ice": {"density": 100}}})");
  folder.file("two.json", R"({"set": {"k": 2}, "materials": {"ice": {"density": 200}}})");
  const std::string body = R"({"name": "a", "material": "ice", "shape": {"box": ["=k", 1, 1]}})";
  for (const char* own : {"", R"("materials": {"wood": {}},)"}) {
    const Scene scene =
        sceneOf(body, R"("include": ["one.json", "two.json"],)" + std::string(own), folder.path() / "s.json");
    EXPECT_EQ(scene.bodies[0].material.density_kgpm3, 200.0) << own;
    EXPECT_EQ(std::get<BoxShape>(scene.bodies[0].shape.form).size_m.x(), 2.0) << own;
  }
}

// A few lines that would fill any memory, or never end: each ends in one line.
TEST(SceneExpansion, WhatGrowsWithoutBoundIsRefused) {
  std::string doubled = R"({"format": 1, "set": {"v0": ["a", "b"], "w0": "0123456789")";
  for (int i = 1; i < 60; ++i) {
    const std::string before = std::to_string(i - 1), now = std::to_string(i);
    doubled += ", \"v" + now + "\": [\"=v" + before + "\", \"=v" + before + "\"]";
  }
  std::string texts = R"({"format": 1, "set": {"w0": "0123456789")";
  for (int i = 1; i < 60; ++i) {
    const std::string before = std::to_string(i - 1), now = std::to_string(i);
    texts += ", \"w" + now + "\": \"{w" + before + "}{w" + before + "}\"";
  }
  const std::string turns =
      R"({"format": 1, "bodies": [{"for": {"i": 20000, "j": 20000, "k": 20000}, "bodies": []}]})";
  for (const std::string& scene : {doubled + "}, \"bodies\": []}", texts + "}, \"bodies\": []}", turns}) {
    const std::string told = thrownMessage<InputError>([&] { parseScene(scene, "grows.json"); });
    EXPECT_NE(told.find("grows to more than 3000000 values"), std::string::npos) << told;
    EXPECT_EQ(told.find('\n'), std::string::npos);
  }
}

TEST(SceneExpansion, FilesThatBringEachOtherManyTimesAreRefused) {
  TemporaryFolder folder;
  for (int i = 0; i < 7; ++i) {
    std::string bodies;
    for (int k = 0; k < 12; ++k)
      bodies += std::string(k > 0 ? ", " : "") + R"({"include": "f)" + std::to_string(i + 1) + R"(.json"})";
    std::ofstream(folder.path() / ("f" + std::to_string(i) + ".json"))
        << R"({"format": 1, "bodies": [)" << bodies << "]}";
  }
  std::ofstream(folder.path() / "f7.json") << R"({"format": 1, "bodies": []})";
  const std::string told = thrownMessage<InputError>([&] { readSceneFile(folder.path() / "f0.json"); });
  EXPECT_NE(told.find("grows to more than 3000000 values"), std::string::npos) << told;
}

TEST(SceneExpansion, WhatHasNoEffectIsWarnedOfWithItsPlace) {
  const Scene scene =
      sceneOf("{\"name\": \"a\", " + kBox + ", \"repeat\": {\"count\": [3, 1, 1], \"step\": [0.5, 0, 0.2]}}",
              "\"set\": {\"r\": 1}, \"materials\": {\"ice\": {}},");
  ASSERT_EQ(scene.warnings.size(), 3u) << testing::PrintToString(scene.warnings);
  EXPECT_NE(scene.warnings[0].find("\"r\" is set and not used"), std::string::npos);
  EXPECT_NE(scene.warnings[1].find("the step along z is ignored"), std::string::npos);
  EXPECT_NE(scene.warnings[1].find("\"count\": 3"), std::string::npos);
  EXPECT_NE(scene.warnings[2].find("no body has this material"), std::string::npos);
}

TEST(SceneSetting, GoesByNamesAndNumbers) {
  const std::string text = "{\"format\": 1, \"rate\": 240, \"bodies\": [{\"name\": \"a\", " + kBox + "}]}";
  const std::vector<std::string> settings{"bodies.a.position=[1,2,3]", "rate=480", "bodies[0].color=#ff0000",
                                          "bodies.a.shape.box[2]=3"};
  const Scene scene = parseScene(text, "s.json", settings);
  EXPECT_EQ(scene.bodies[0].X_WS.position, Vec3(1, 2, 3));
  EXPECT_EQ(scene.rate_hz, 480.0);
  EXPECT_EQ(std::get<BoxShape>(scene.bodies[0].shape.form).size_m.z(), 3.0);
  EXPECT_EQ(scene.settings, settings);
  EXPECT_THROW(parseScene(text, "s.json", {"bodies.b.position=[1,2,3]"}), UsageError);
  EXPECT_THROW(parseScene(text, "s.json", {"rate"}), UsageError);
  EXPECT_THROW(parseScene(text, "s.json", {"ratte=1"}), InputError);
}

TEST(SceneSetting, ChangesVariablesThatThereAreOfTheSceneOrOfWhatItIncludes) {
  const TemporaryFolder folder;
  folder.file("common.json", R"({"set": {"wide": 2}})");
  const auto widthOf = [&](const std::string& more, const std::string& setting) {
    const Scene scene = parseScene(
        R"({"format": 1, )" + more + R"("bodies": [{"name": "a", "shape": {"box": ["=wide", 1, 1]}}]})",
        folder.path() / "s.json", {setting});
    return std::get<BoxShape>(scene.bodies[0].shape.form).size_m.x();
  };
  const std::string own = R"("set": {"wide": 2},)", included = R"("include": ["common.json"],)";
  EXPECT_EQ(widthOf(own, "set.wide=3"), 3.0);
  EXPECT_EQ(widthOf(included, "set.wide=3"), 3.0);
  EXPECT_EQ(widthOf(included + R"("set": {"k": "=2*wide"},)", "set.wide=3"), 3.0);
  for (const std::string& scene : {own, included}) {
    EXPECT_EQ(
        thrownMessage<UsageError>([&] { widthOf(scene, "set.wdie=3"); }),
        "--set set.wdie=3: \"wdie\" is no variable of the scene; did you mean \"wide\"? accepted: wide");
  }
  const std::string none = thrownMessage<UsageError>(
      [] { parseScene(R"({"format": 1, "bodies": []})", "s.json", {"set.wide=3"}); });
  EXPECT_EQ(none, "--set set.wide=3: \"wide\" is no variable of the scene; accepted: none");
}

TEST(SceneSetting, OfAVariableActsOnWhatAnIncludedFileReckonsFromIt) {
  const TemporaryFolder folder;
  folder.file("common.json",
              R"({"set": {"wide": 2, "high": "=10*wide"}, "materials": {"ice": {"density": "=high"}}})");
  const auto sceneWith = [&](const std::string& set, const std::vector<std::string>& settings) {
    return parseScene(
        R"({"format": 1, "include": ["common.json"], "set": {)" + set +
            R"(}, "bodies": [{"name": "a", "material": "ice", "shape": {"box": ["=wide", "=high", 1]}}]})",
        folder.path() / "s.json", settings);
  };
  const auto sizeOf = [](const Scene& scene) {
    return std::get<BoxShape>(scene.bodies[0].shape.form).size_m;
  };
  EXPECT_EQ(sizeOf(sceneWith("", {})), Vec3(2, 20, 1));
  EXPECT_EQ(sizeOf(sceneWith("", {"set.wide=3"})), Vec3(3, 30, 1));
  EXPECT_EQ(sizeOf(sceneWith(R"("wide": "=wide+b", "b": 5)", {})), Vec3(7, 70, 1))
      << "its own name: the file's before";
  EXPECT_EQ(sceneWith(R"("wide": 4)", {}).bodies[0].material.density_kgpm3, 40.0);
}

TEST(SceneExpansion, VariablesStandInAnyOrderAndMayNotBeReckonedFromThemselves) {
  const Scene scene = sceneOf(R"({"name": "a", "shape": {"box": ["=p", "=q", "=r"]}})",
                              R"("set": {"p": "=q+r", "q": "=2*r", "r": 1},)");
  EXPECT_EQ(std::get<BoxShape>(scene.bodies[0].shape.form).size_m, Vec3(3, 2, 1));
  const auto refusal = [](const std::string& set) {
    return thrownMessage<InputError>(
        [&] { sceneOf(R"({"name": "a", )" + kBox + "}", R"("set": {)" + set + "},"); });
  };
  EXPECT_NE(refusal(R"("p": "=q", "q": "=p")").find("\"p\" is reckoned from itself"), std::string::npos);
  EXPECT_NE(refusal(R"("p": "=p")").find("unknown name \"p\""), std::string::npos);
  std::string chain = R"("v0": "=v1")";
  for (int i = 1; i < 300; ++i)
    chain += ", \"v" + std::to_string(i) + "\": \"=v" + std::to_string(i + 1) + "\"";
  EXPECT_NE(refusal(chain + ", \"v300\": 1").find("deeper than 100 levels"), std::string::npos);
}

// Whatever is done for each variable must not look at all of them: 20 000 took forty seconds.
TEST(SceneExpansion, ManyVariablesEachNamedByTheNextTakeNoTime) {
  constexpr int kMany = 20000;
  constexpr double kMost_s = 5.0;  // of CPU time; a hundred times what it takes
  std::string set = R"("v0": 1)";
  for (int i = 1; i < kMany; ++i)
    set += ", \"v" + std::to_string(i) + "\": \"=v" + std::to_string(i - 1) + "+1\"";
  const std::clock_t begin = std::clock();
  const Scene scene = sceneOf(R"({"name": "a{v19999}", )" + kBox + "}", R"("set": {)" + set + "},");
  EXPECT_LT(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC, kMost_s);
  EXPECT_EQ(scene.bodies[0].name, "a20000");
}

// Patterns.

std::vector<Pose> posesOf(const std::string& repeat) {
  const Scene scene =
      sceneOf("{\"name\": \"a\", " + kBox + ", \"position\": [0, 0, 5], \"repeat\": " + repeat + "}");
  std::vector<Pose> poses;
  const SceneWorld made = makeSceneWorld(scene, {});
  for (const BodyDescription& body : made.world.bodies()) poses.push_back(body.X_WB);
  return poses;
}

TEST(ScenePattern, ARowGoesAlongAnyVector) {
  const std::vector<Pose> poses = posesOf("{\"count\": 4, \"step\": [0.3, 0.2, 0.1]}");
  ASSERT_EQ(poses.size(), 4u);
  EXPECT_LT((poses[3].position - Vec3(0.9, 0.6, 5.3)).norm(), 1e-12);
}

TEST(ScenePattern, CirclesArcsAndSpiralsKeepTheirDistancesAndTurn) {
  const std::vector<Pose> circle = posesOf("{\"circle\": {\"count\": 8, \"radius\": 2}}");
  ASSERT_EQ(circle.size(), 8u);
  for (const Pose& pose : circle) EXPECT_NEAR((pose.position - Vec3(0, 0, 5)).norm(), 2.0, 1e-12);
  EXPECT_LT((circle[2].position - Vec3(0, 2, 5)).norm(), 1e-12);
  EXPECT_LT((circle[2].rotation * Vec3::UnitX() - Vec3::UnitY()).norm(), 1e-12);
  const std::vector<Pose> upright =
      posesOf("{\"circle\": {\"count\": 4, \"radius\": 2, \"axis\": [0, 1, 0]}}");
  for (const Pose& pose : upright) EXPECT_NEAR(pose.position.y(), 0.0, 1e-12);
  const std::vector<Pose> arc = posesOf(
      "{\"arc\": {\"count\": 5, \"radius\": 1, \"fromDegrees\": 0, \"toDegrees\": 180, \"turn\": false}}");
  EXPECT_LT((arc.back().position - Vec3(-1, 0, 5)).norm(), 1e-12);
  EXPECT_EQ(arc.back().rotation.w(), 1.0);
  const std::vector<Pose> spiral =
      posesOf("{\"spiral\": {\"count\": 9, \"radius\": 1, \"toRadius\": 3, \"degrees\": 45, \"rise\": 0.2}}");
  EXPECT_LT((spiral.back().position - Vec3(3, 0, 6.6)).norm(), 1e-12);
}

TEST(ScenePattern, AStackTurnsEachCopyAndSoDoesRotation) {
  for (const char* repeat :
       {"{\"stack\": {\"count\": 3, \"height\": 0.2, \"degrees\": 45}}",
        "{\"count\": 3, \"step\": [0, 0, 0.2], \"rotation\": {\"axis\": [0, 0, 1], \"degrees\": "
        "45}}"}) {
    const std::vector<Pose> poses = posesOf(repeat);
    EXPECT_LT((poses[2].rotation * Vec3::UnitX() - Vec3::UnitY()).norm(), 1e-12) << repeat;
    EXPECT_LT((poses[2].position - Vec3(0, 0, 5.4)).norm(), 1e-12) << repeat;
  }
}

TEST(ScenePattern, ChanceHasASeedAndKeepsCopiesApart) {
  const std::string random = "{\"random\": {\"count\": 40, \"size\": [2, 2, 1], \"apart\": 0.25, \"seed\": ";
  const std::vector<Pose> first = posesOf(random + "7}}"), again = posesOf(random + "7}}"),
                          other = posesOf(random + "8}}");
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(first[i].position, again[i].position);
    EXPECT_NE(first[i].position, other[i].position);
    EXPECT_LE(std::abs(first[i].position.x()), 1.0);
    for (std::size_t j = 0; j < i; ++j) EXPECT_GE((first[i].position - first[j].position).norm(), 0.25);
  }
  EXPECT_THROW(posesOf("{\"random\": {\"count\": 40, \"size\": [1, 1, 1], \"apart\": 0.9}}"), InputError);
}

// Shapes with a closed form for their volume.

TEST(CommonShapes, HaveTheirVolumes) {
  const auto volumeOf = [](const std::string& shape) {
    return makeSceneWorld(sceneOf("{\"name\": \"a\", \"shape\": " + shape + "}"), {})
        .world.solids()[0]
        .volume();
  };
  const double kPi = 3.14159265358979323846;
  const double polygon = 16.0 * sineCosine(2.0 * kPi / 32.0).sine;  // of 32 sides in the unit circle
  EXPECT_NEAR(volumeOf("{\"cylinder\": {\"radius\": 1, \"length\": 2}}"), 2.0 * polygon, 1e-9);
  EXPECT_NEAR(volumeOf("{\"cone\": {\"radius\": 1, \"height\": 3}}"), polygon, 1e-9);
  EXPECT_NEAR(volumeOf("{\"cone\": {\"radius\": 1, \"topRadius\": 0.5, \"height\": 3}}"), 1.75 * polygon,
              1e-9);
  EXPECT_NEAR(volumeOf("{\"prism\": {\"sides\": 4, \"radius\": 1, \"length\": 1}}"), 2.0, 1e-9);
  EXPECT_NEAR(volumeOf("{\"wedge\": [1, 2, 3]}"), 3.0, 1e-9);
  const double r = 0.1, a = 0.8, b = 0.6, c = 0.4;  // core and radius (Steiner's formula)
  EXPECT_NEAR(
      volumeOf("{\"roundedBox\": {\"size\": [1, 0.8, 0.6], \"radius\": 0.1}}"),
      a * b * c + 2 * r * (a * b + b * c + c * a) + kPi * r * r * (a + b + c) + 4.0 / 3.0 * kPi * r * r * r,
      1e-9);
  EXPECT_THROW(volumeOf("{\"roundedBox\": {\"size\": [1, 1, 0.2], \"radius\": 0.1}}"), InputError);
}

}  // namespace
}  // namespace carom::demos
