// What people write wrongly in a scene, and the remedy that the message has to hold: typical mistakes, one a
// line of the table. A mistake that is answered without its remedy fails.
#include <algorithm>
#include <iterator>

#include <gtest/gtest.h>

#include "demos/language/scene_file.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/thrown_message.h"

namespace carom::demos {
namespace {

struct Mistake {
  const char* written;
  const char* remedy;
};

/// Members of a body that has a name and a box, unless it has a shape of its own.
const Mistake kOfABody[] = {
    {R"("shape": {"sphere": 0.5})", R"(write {"radius": 0.5})"},
    {R"("shape": {"sphere": [0.5]})", R"(write {"radius": 0.5})"},
    {R"("shape": {"sphere": {"diameter": 1}})", R"(write "radius": half of it)"},
    {R"("shape": {"sphere": {}})", R"(write "radius": 0.5)"},
    {R"("shape": {"ball": {"radius": 1}})", R"(write "sphere": {"radius": 0.5})"},
    {R"("shape": {"box": 2})", "write [2, 2, 2]"},
    {R"("shape": {"box": {"size": [1,2,3]}})", "write [1,2,3]"},
    {R"("shape": {"box": {"x": 1, "y": 2, "z": 3}})", "write [1, 2, 3]"},
    {R"("shape": {"box": [1, 2]})", "accepted: three"},
    {R"("shape": {"cube": 1})", R"(write "box": [x, y, z])"},
    {R"("shape": {"capsule": 0.5})", R"(write {"radius": 0.2, "length": 0.6})"},
    {R"("shape": {"capsule": {"radius": 0.2}})", R"(write "length": 0.6)"},
    {R"("shape": {"capsule": {"radius": 0.2, "height": 1}})", R"(write "length")"},
    {R"("shape": {"pill": {}})", R"(write "capsule")"},
    {R"("shape": {"cylinder": 1})", R"(write {"radius": 0.2, "length": 0.6})"},
    {R"("shape": {"cone": 1})", R"(write {"radius": 0.2, "height": 0.6})"},
    {R"("shape": {"roundedBox": [1, 1, 1]})", R"(write {"size": [1, 1, 1], "radius": 0.1})"},
    {R"("shape": {"plane": {}})", R"("static": true, half a metre below)"},
    {R"("shape": {"mesh": "gem.obj"})", R"(write {"file": "gem.obj"})"},
    {R"("shape": {"convex": []})", R"(write "hull": {"points")"},
    {R"("shape": "box")", R"(write {"box": [1, 1, 1]})"},
    {R"("shape": "sphere")", R"(write {"sphere": {"radius": 0.5}})"},
    {R"("type": "box")", R"(write "shape")"},
    {R"("size": [1, 1, 1])", R"(write "shape")"},
    {R"("radius": 1)", R"(write "shape")"},
    {R"("friction": 0.3)", R"("staticFriction": 0.5 and "dynamicFriction")"},
    {R"("bounciness": 0.3)", R"("restitution": 0.5 in a material)"},
    {R"("restitution": 0.3)", R"(in the body's "material")"},
    {R"("density": 300)", R"(in the body's "material")"},
    {R"("material": {"friction": 0.3})", R"("staticFriction")"},
    {R"("material": {"bounce": 0.3})", R"("restitution")"},
    {R"("material": {"mu": 0.3})", R"("staticFriction")"},
    {R"("material": {"restitution": 1.5})", "accepted: 0 to 1"},
    {R"("material": "steel")", "unknown material"},
    {R"("color": "red")", R"(write "#ff0000")"},
    {R"("color": "#f80")", R"(write "#ff8800")"},
    {R"("color": [255, 0, 0])", R"(write "#ff0000")"},
    {R"("color": [1, 0.5, 0])", R"(write "#ff8000")"},
    {R"("color": "ff0000")", R"(write "#ff0000")"},
    {R"("colour": "#ff0000")", R"("color")"},
    {R"("position": {"x": 1, "y": 2, "z": 3})", "write [1, 2, 3]"},
    {R"("position": [1, 2])", "accepted: three"},
    {R"("position": 3)", "write [x, y, z]"},
    {R"("position": ["1", 2, 3])", "write 1, without quotes"},
    {R"("position": ["2*r", 2, 3])", R"(write a number; arithmetic begins with =: "=2*r")"},
    {R"("pos": [1, 2, 3])", R"("position")"},
    {R"("location": [1, 2, 3])", R"(write "position": [x, y, z])"},
    {R"("rotation": 45)", R"(write {"axis": [0, 0, 1], "degrees": 45})"},
    {R"("rotation": [0, 0, 45])", R"({"axis": [x, y, z], "degrees": d})"},
    {R"("rotation": {"axis": [0, 0, 1], "angle": 45})", R"(write "degrees": 45)"},
    {R"("euler": [0, 0, 45])", R"(write "rotation")"},
    {R"("velocity": [1, 0, 0])", R"(write "linearVelocity")"},
    {R"("linear_velocity": [1, 0, 0])", R"("linearVelocity")"},
    {R"("omega": [1, 0, 0])", R"(write "angularVelocity")"},
    {R"("static": "true")", "write true, without quotes"},
    {R"("static": 1)", "accepted: true or false"},
    {R"("fixed": true)", R"(write "static": true)"},
    {R"("dynamic": true)", R"(write "static": true)"},
    {R"("repeat": 5)", R"(write {"count": 5, "step": [1, 0, 0]})"},
    {R"("repeat": {"count": [3, 1, 1]})", R"(write "repeat": {"count": 5, "step": [0.3, 0, 0]})"},
    {R"("repeat": {"count": [3, 1, 1], "spacing": [1, 0, 0]})", R"(write "step": [x, y, z])"},
    {R"("repeat": {"count": 2.5, "step": [1, 0, 0]})", "a whole number"},
    {R"("position": null)", "write a value, or leave the key out"},
    {R"("position": ["=2*", 0, 0])", "it ends where a number should be"},
    {R"("position": ["=rad", 0, 0])", R"(unknown name "rad")"},
};

/// Members of a scene that has a body.
const Mistake kOfAScene[] = {
    {R"("gravity": -9.81)", "write [0, 0, -9.81]"},
    {R"("gravity": 9.81)", "write [0, 0, -9.81]"},
    {R"("duration": "5s")", "write 5, without quotes or unit"},
    {R"("duration": 0)", "accepted: above 0"},
    {R"("timestep": 0.01)", R"(write "rate": 240)"},
    {R"("dt": 0.01)", R"(write "rate": 240)"},
    {R"("camera": {})", R"(write "cameras": {"main")"},
    {R"("cameras": [])", R"(write an object by name: {"main")"},
    {R"("cameras": {"main": {"eye": [1, 2, 3]}})", R"(write "eye": [x, y, z] and "target")"},
    {R"("cameras": {"main": {"eye": [1, 2, 3], "lookAt": [0, 0, 0]}})", R"("target")"},
    {R"("cameras": {"main": {"eye": [1, 2, 3], "target": [0, 0, 0], "fov": 40}})", R"("fovDegrees")"},
    {R"("materials": [])", R"(write an object by name: {"wood")"},
    {R"("objects": [])", R"(write "bodies")"},
    {R"("variables": {"r": 1})", R"(write "set": {"r": 0.5})"},
    {R"("water": {})", R"(write "fluids")"},
    {R"("ground": true)", R"(write a body {"name": "floor")"},
    {R"("fluids": {})", R"(write a list: [{"name": "pool")"},
    {R"("set": {"pi": 3})", "no name for a variable"},
};

/// Whole texts.
const Mistake kOfAText[] = {
    {R"({"bodies": []})", R"(write "format": 1 first)"},
    {R"({"format": 1})", R"(write "bodies": [{...}, {...}])"},
    {R"({"format": 1, "bodies": {}})", "write a list"},
    {R"({"format": 1, "bodies": [{"shape": {"box": [1, 1, 1]}}]})", R"(write "name": "crate")"},
    {R"({"format": 1, "bodies": [{"name": "a"}]})", R"(write "shape": {"box": [1, 1, 1]})"},
    {R"({"format": 1, "bodies": [],})", "a comma too many"},
    {R"({"format": 1 "bodies": []})", "is a comma or a colon missing"},
    {R"({"format": 1, "bodies": [)", "is a bracket not closed?"},
    {R"({'format': 1})", R"("double quotes")"},
    {R"({"format": 1, "static": True})", "true, not True"},
};

std::string withBody(const std::string& member) {
  const bool has_shape = member.rfind("\"shape\"", 0) == 0;
  return R"({"format": 1, "bodies": [{"name": "a", )" +
         std::string(has_shape ? "" : R"("shape": {"box": [1, 1, 1]}, )") + member + "}]}";
}
std::string withScene(const std::string& member) {
  return R"({"format": 1, "bodies": [{"name": "a", "shape": {"box": [1, 1, 1]}}], )" + member + "}";
}

void expectRemedy(const std::string& text, const std::string& remedy) {
  const std::string message = thrownMessage<InputError>([&] { parseScene(text, "scene.json"); });
  EXPECT_NE(message.find(remedy), std::string::npos) << text << "\n" << message;
  EXPECT_EQ(message.rfind("scene.json:1:", 0), 0u) << message;
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
}

TEST(SceneMistakes, SixtyTypicalOnesAreEachAnsweredWithTheRemedy) {
  static_assert(std::size(kOfABody) + std::size(kOfAScene) + std::size(kOfAText) >= 60);
  for (const Mistake& mistake : kOfABody) expectRemedy(withBody(mistake.written), mistake.remedy);
  for (const Mistake& mistake : kOfAScene) expectRemedy(withScene(mistake.written), mistake.remedy);
  for (const Mistake& mistake : kOfAText) expectRemedy(mistake.written, mistake.remedy);
}

TEST(SceneMistakes, AllOfAFileAreToldAtOnceInItsOrderWithLineAndColumn) {
  const std::string text =
      "{ \"format\": 1, \"duration\": \"5s\",\n"
      "  \"materials\": { \"wood\": { \"friction\": 0.3 } },\n"
      "  \"bodies\": [\n"
      "    { \"name\": \"a\", \"shape\": { \"sphere\": 0.5 }, \"color\": \"red\" },\n"
      "    { \"name\": \"b\", \"shape\": \"box\", \"position\": [1, \"x\", 2] },\n"
      "    { \"shape\": { \"box\": [1, 1, 1] }, \"material\": \"wood\" } ],\n"
      "  \"camera\": {} }\n";
  std::vector<std::string> all;
  try {
    parseScene(text, "s.json");
  } catch (const SceneMistakes& mistakes) {
    all = mistakes.all;
    EXPECT_NE(std::string(mistakes.what()).find("(the first of 8 mistakes; carom check lists them all)"),
              std::string::npos)
        << mistakes.what();
  }
  const std::vector<std::string> places{"s.json:1:28: duration: ",
                                        "s.json:2:40: materials.wood.friction: ",
                                        "s.json:4:41: bodies[0].shape.sphere: ",
                                        "s.json:4:57: bodies[0].color: ",
                                        "s.json:5:29: bodies[1].shape: ",
                                        "s.json:5:52: bodies[1].position[1]: ",
                                        "s.json:6:5: bodies[2]: ",
                                        "s.json:7:13: camera: "};
  ASSERT_EQ(all.size(), places.size()) << testing::PrintToString(all);
  for (std::size_t i = 0; i < all.size(); ++i)
    EXPECT_EQ(all[i].rfind(places[i], 0), 0u) << all[i] << "\n" << places[i];
}

TEST(SceneMistakes, OneMistakeIsToldOnceWhateverFollowsFromIt) {
  for (
      const char* text :
      {R"({"format": 1, "bodies": [{"name": "a"}], "cameras": {"main": {"follow": "a"}}})",
       R"({"format": 1, "materials": {"wood": {"density": -1}},
               "bodies": [{"name": "a", "shape": {"box": [1, 1, 1]}, "material": "wood"}]})",
       R"({"format": 1, "set": {"r": "=1/0"}, "bodies": [{"name": "a", "shape": {"sphere": {"radius": "=r"}}}]})"}) {
    try {
      parseScene(text, "s.json");
      ADD_FAILURE() << text;
    } catch (const SceneMistakes& mistakes) {
      EXPECT_EQ(mistakes.all.size(), 1u) << testing::PrintToString(mistakes.all);
    }
  }
}

std::vector<std::string> allOf(const std::string& text, const std::filesystem::path& path = "s.json") {
  try {
    parseScene(text, path);
  } catch (const SceneMistakes& mistakes) {
    // What is told first is one of them, whatever is added about the others.
    const std::string first = mistakes.what();
    EXPECT_TRUE(std::any_of(mistakes.all.begin(), mistakes.all.end(), [&](const std::string& mistake) {
      return first.rfind(mistake, 0) == 0;
    })) << first;
    return mistakes.all;
  }
  return {};
}

TEST(SceneMistakes, WhatStandsForANameIsNotToldOf) {
  const std::vector<std::string> all =
      allOf(R"({"format":1,"bodies":[{"for":{"i":2},"bodies":[{"name":"a","shape":{"box":[1,1,1]}}]}]})");
  ASSERT_EQ(all.size(), 1u) << testing::PrintToString(all);
  EXPECT_EQ(all[0].rfind("s.json:1:56: bodies[0].bodies[0].name: \"a\" names two bodies", 0), 0u) << all[0];
}

TEST(SceneMistakes, BodiesOfAFileThatIsNotThereLackNothingElse) {
  const std::vector<std::string> all = allOf(
      R"({"format":1,"bodies":[{"include":"nosuch.json","name":"b"}],"cameras":{"main":{"follow":"b.a"}}})");
  ASSERT_EQ(all.size(), 1u) << testing::PrintToString(all);
  EXPECT_EQ(all[0].rfind("s.json:1:34: bodies[0].include: no file \"nosuch.json\"", 0), 0u) << all[0];
  const std::vector<std::string> common = allOf(
      R"({"format":1,"include":["nosuch.json"],"bodies":[{"name":"a","material":"m","shape":{"box":["=k",1,1]}}]})");
  ASSERT_EQ(common.size(), 1u) << testing::PrintToString(common);
  EXPECT_EQ(common[0].rfind("s.json:1:24: include[0]: no file \"nosuch.json\"", 0), 0u) << common[0];
}

TEST(SceneMistakes, FilesThatIncludeEachOtherAreToldOfAlone) {
  const TemporaryFolder folder;
  folder.file("a.json", R"({"format":1,"bodies":[{"include":"b.json","name":"b"}]})");
  folder.file("b.json", R"({"format":1,"bodies":[{"include":"a.json","name":"a"}]})");
  const std::vector<std::string> all =
      allOf(R"({"format":1,"bodies":[{"include":"b.json","name":"b"}]})", folder.path() / "a.json");
  ASSERT_EQ(all.size(), 1u) << testing::PrintToString(all);
  EXPECT_NE(all[0].find("include each other deeper than 8 levels"), std::string::npos) << all[0];
}

TEST(SceneMistakes, ALoopAndAGroupThatAreWrongLackNoShape) {
  for (const char* item : {R"({"for":{"i":-1},"bodies":[]})", R"({"name":"g","bodies":5})"}) {
    const std::vector<std::string> all = allOf(R"({"format":1,"bodies":[)" + std::string(item) + "]}");
    ASSERT_EQ(all.size(), 1u) << testing::PrintToString(all);
    EXPECT_EQ(all[0].find("shape"), std::string::npos) << all[0];
  }
}

TEST(SceneMistakes, APathIsToldOfOnceAndTheRestOfItsBodyIsRead) {
  const std::vector<std::string> all =
      allOf(R"({"format":1,"bodies":[{"name":"a","shape":{"box":[1,1,1]},"color":7,"material":{"density":0},)"
            R"("kinematic":{"keyframes":[{"time":0},{"time":1,"position":[1,0,0]}],"repeats":true}}]})");
  ASSERT_EQ(all.size(), 2u) << testing::PrintToString(all);
  EXPECT_NE(all[0].find("bodies[0].color: "), std::string::npos) << all[0];
  EXPECT_NE(all[1].find("bodies[0].kinematic.repeats: "), std::string::npos) << all[1];
}

// What is wrong with a body as a whole, or with one number of a list, is not what a list of bodies or a box
// would be wrong with.
TEST(SceneMistakes, NoRemedyIsThatOfTheListAround) {
  std::string many = R"({"format":1,"bodies":[)";
  for (const char* name : {"a", "b"})
    many += std::string(name[0] == 'b' ? "," : "") + R"({"name":")" + name +
            R"(","shape":{"box":[1,1,1]},"repeat":{"count":15000,"step":[2,0,0]}})";
  for (const std::string& text :
       {withBody(R"("shape": {"box": [0, 1, 1]})"), withBody(R"("shape": {"box": 0})"),
        withBody(R"("static": true, "linearVelocity": [1, 0, 0])"), many + "]}"}) {
    const std::string message = thrownMessage<InputError>([&] { parseScene(text, "s.json"); });
    EXPECT_EQ(message.find("write [0, 0, 0]"), std::string::npos) << message;
    EXPECT_EQ(message.find("write a list"), std::string::npos) << message;
  }
}

TEST(SceneMistakes, AValueThatWasSetIsCalledByItsKey) {
  const std::string text = R"({"format":1,"bodies":[{"name":"a","shape":{"box":[1,1,1]}}]})";
  const auto refusal = [&](const std::string& setting) {
    return thrownMessage<InputError>([&] { parseScene(text, "s.json", {setting}); });
  };
  EXPECT_EQ(refusal("gravity=").rfind("s.json:1:1: gravity: \"\" is a string; accepted: an array", 0), 0u)
      << refusal("gravity=");
  const std::string color = refusal("bodies.a.color=red");
  EXPECT_NE(color.find("bodies[0].color: \"red\" is no colour"), std::string::npos) << color;
  EXPECT_NE(color.find("write \"#ff0000\""), std::string::npos) << color;
}

// A mistake that hides others of its body until it is out: keys that only begin like a body's own.
TEST(SceneMistakes, AKeyThatBeginsLikeAnotherHidesNothing) {
  const std::vector<std::string> all = allOf(
      R"({"format":1,"bodies":[{"name":"a","shape":{"box":[1,1,1]},"names":1,"repeats":2,"color":7}]})");
  ASSERT_EQ(all.size(), 3u) << testing::PrintToString(all);
}

}  // namespace
}  // namespace carom::demos
