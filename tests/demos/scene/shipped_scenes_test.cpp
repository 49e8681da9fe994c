// Every shipped scene is valid, starts without an overlap, and agrees with the schema; the schema refuses
// what the program refuses.
#include <cmath>
#include <map>
#include <regex>

#include <algorithm>

#include <gtest/gtest.h>

#include "demos/asset/asset_path.h"
#include "demos/format/json.h"
#include "demos/language/scene_file.h"
#include "demos/motion/frame_clock.h"
#include "demos/scene/scene_world.h"

namespace carom::demos {
namespace {

/// The part of JSON Schema (draft 2020-12) that scene.schema.json uses, written from the specification.
class Schema {
 public:
  explicit Schema(const Json& root) : root_(root) {}
  bool accepts(const Json& value) const { return accepts(root_, value); }

 private:
  using Kind = Json::Kind;

  static bool same(const Json& a, const Json& b) { return a.kind() == b.kind() && a.text() == b.text(); }
  static std::size_t size(const Json& bound) { return static_cast<std::size_t>(bound.asNumber()); }

  static bool isOfType(const std::string& type, const Json& value) {
    if (type == "integer")
      return value.kind() == Kind::kNumber && value.asNumber() == std::floor(value.asNumber());
    const std::map<std::string, Kind> kinds = {{"object", Kind::kObject},
                                               {"array", Kind::kArray},
                                               {"string", Kind::kString},
                                               {"number", Kind::kNumber},
                                               {"boolean", Kind::kBoolean}};
    return value.kind() == kinds.at(type);
  }

  bool accepts(const Json& schema, const Json& value) const {
    if (schema.kind() == Kind::kBoolean) return schema.asBoolean();
    bool ok = true;
    for (const auto& [keyword, rule] : schema.members()) ok = ok && obeys(keyword, rule, schema, value);
    return ok;
  }

  bool obeys(const std::string& keyword, const Json& rule, const Json& schema, const Json& value) const {
    if (keyword == "$ref")
      return accepts(root_.at("$defs").at(rule.asString().substr(std::string("#/$defs/").size())), value);
    if (keyword == "const") return same(rule, value);
    if (keyword == "enum")
      return std::any_of(rule.items().begin(), rule.items().end(),
                         [&](const Json& one) { return same(one, value); });
    if (keyword == "type") return isOfType(rule.asString(), value);
    if (keyword == "not") return !accepts(rule, value);
    if (keyword == "oneOf" || keyword == "anyOf") {
      int accepted = 0;
      for (const Json& option : rule.items()) accepted += accepts(option, value) ? 1 : 0;
      return keyword == "oneOf" ? accepted == 1 : accepted > 0;
    }
    switch (value.kind()) {
      case Kind::kObject:
        return objectObeys(keyword, rule, schema, value);
      case Kind::kArray:
        return arrayObeys(keyword, rule, value);
      case Kind::kNumber:
        return numberObeys(keyword, rule, value.asNumber());
      case Kind::kString:
        if (keyword == "pattern") return std::regex_search(value.asString(), std::regex(rule.asString()));
        if (keyword == "minLength") return value.asString().size() >= size(rule);
        return true;
      default:
        return true;
    }
  }

  bool objectObeys(const std::string& keyword, const Json& rule, const Json& schema,
                   const Json& value) const {
    bool ok = true;
    if (keyword == "minProperties") ok = value.members().size() >= size(rule);
    if (keyword == "maxProperties") ok = value.members().size() <= size(rule);
    if (keyword == "required")
      for (const Json& key : rule.items()) ok = ok && value.find(key.asString()) != nullptr;
    const Json* properties = schema.find("properties");
    for (const auto& [key, member] : value.members()) {
      const Json* property = properties != nullptr ? properties->find(key) : nullptr;
      if (keyword == "properties" && property != nullptr) ok = ok && accepts(*property, member);
      if (keyword == "additionalProperties" && property == nullptr) ok = ok && accepts(rule, member);
    }
    return ok;
  }

  bool arrayObeys(const std::string& keyword, const Json& rule, const Json& value) const {
    bool ok = true;
    if (keyword == "minItems") ok = value.items().size() >= size(rule);
    if (keyword == "maxItems") ok = value.items().size() <= size(rule);
    if (keyword == "items")
      for (const Json& item : value.items()) ok = ok && accepts(rule, item);
    return ok;
  }

  static bool numberObeys(const std::string& keyword, const Json& rule, double value) {
    if (keyword == "minimum") return value >= rule.asNumber();
    if (keyword == "maximum") return value <= rule.asNumber();
    if (keyword == "exclusiveMinimum") return value > rule.asNumber();
    return true;
  }

  const Json& root_;
};

Json sceneSchema() {
  const std::filesystem::path path = assetsFolder() / "scene.schema.json";
  return Json::parse(readTextFile(path), path.string());
}

TEST(ShippedScenes, AgreeWithTheSchemaAndStartWithoutOverlap) {
  const Json root = sceneSchema();
  const Schema schema(root);
  ASSERT_FALSE(shippedScenes().empty());
  for (const std::filesystem::path& path : shippedScenes()) {
    EXPECT_TRUE(schema.accepts(Json::parse(readTextFile(path), path.string()))) << path;
    const Scene scene = readSceneFile(path);
    EXPECT_NO_THROW(makeSceneWorld(scene, std::nullopt)) << path;
    EXPECT_FALSE(scene.description.empty()) << path;
    EXPECT_TRUE(scene.cameras.contains("main")) << path;
  }
}

TEST(ShippedScenes, HoldWhatTheMainJobPromises) {
  const FrameClock clock({30.0, 240.0});
  int frames = 0;
  std::string names;
  for (const std::filesystem::path& path : shippedScenes()) {
    const Scene scene = readSceneFile(path);
    frames += clock.frameCount(scene.duration_s);
    names += scene.name + " ";
  }
  EXPECT_GE(frames, 600);
  for (const char* name : {"sliding", "resting", "multi-contact", "contact-vertex-vertex",
                           "contact-vertex-edge", "contact-edge-edge", "contact-vertex-face", "bouncing-ball",
                           "imported-meshes", "drop-mesh", "fifty-bodies", "crates-in-a-pool", "boat",
                           "ball-released-under-water", "falling-plates", "wind-tunnel", "stream"})
    EXPECT_NE(names.find(name), std::string::npos) << name;
}

TEST(SceneSchema, RefusesWhatTheProgramRefuses) {
  const Json root = sceneSchema();
  const Schema schema(root);
  const auto body = [](const std::string& inside) {
    return "{ \"format\": 1, \"bodies\": [ { \"name\": \"a\", " + inside + " } ] }";
  };
  const std::string box = "\"shape\": { \"box\": [1, 1, 1] }";
  EXPECT_TRUE(schema.accepts(Json::parse(body(box), "good")));
  const auto fluid = [&](const std::string& inside) {
    return "{ \"format\": 1, \"bodies\": [ { \"name\": \"a\", " + box +
           " } ], \"fluids\": [ { \"name\": \"f\", " + inside + " } ] }";
  };
  const std::string good_fluid = fluid(
      "\"box\": { \"min\": [0, 0, 0], \"max\": [1, 1, 1] }, \"waves\": [ { \"amplitude\": 0.1, "
      "\"wavelength\": 2 } ]");
  EXPECT_TRUE(schema.accepts(Json::parse(good_fluid, "good")));
  EXPECT_NO_THROW(parseScene(good_fluid, "good.json"));
  const std::vector<std::string> refused = {
      fluid("\"density\": 1000"),
      fluid("\"level\": 0, \"density\": 0"),
      fluid("\"level\": 0, \"drag\": -1"),
      fluid("\"level\": 0, \"box\": { \"min\": [0, 0, 0], \"max\": [1, 1, 1] }"),
      fluid("\"level\": 0, \"waves\": [ { \"amplitude\": 0.1 } ]"),
      fluid("\"level\": 0, \"deep\": true"),
      fluid("\"level\": 0, \"color\": \"blue\""),
      body(box + ", \"dragCoefficient\": -1"),
      "{ \"format\": 2, \"bodies\": [] }",
      "{ \"format\": 1, \"bodies\": [] }",
      "{ \"format\": 1, \"boddies\": [] }",
      body(box + ", \"colour\": \"#ffffff\""),
      body("\"shape\": { \"bx\": [1, 1, 1] }"),
      body("\"shape\": {}"),
      body("\"shape\": { \"box\": [1, 1] }"),
      body("\"shape\": { \"box\": [1, 0, 1] }"),
      body("\"shape\": { \"sphere\": { \"radius\": -1 } }"),
      body("\"shape\": { \"sphere\": { \"radius\": 1, \"length\": 2 } }"),
      body("\"shape\": { \"hull\": {} }"),
      body("\"shape\": { \"hull\": { \"file\": \"meshes/gem.obj\", \"points\": [] } }"),
      body("\"shape\": { \"hull\": { \"file\": \"meshes/gem.obj\", \"scale\": 1, \"fit\": 1 } }"),
      body("\"shape\": { \"compound\": [] }"),
      body("\"shape\": { \"compound\": [ { \"shape\": { \"compound\": [] } } ] }"),
      body(box + ", \"rotation\": [1, 2, 0, 0]"),
      body(box + ", \"rotation\": { \"axis\": [0, 0, 1] }"),
      body(box + ", \"color\": \"red\""),
      body(box + ", \"color\": []"),
      body(box + ", \"material\": { \"restitution\": 2 }"),
      body(box + ", \"repeat\": { \"count\": [1.5, 1, 1], \"step\": [1, 1, 1] }"),
      body(box + ", \"repeat\": { \"count\": [0, 1, 1], \"step\": [1, 1, 1] }"),
  };
  for (const std::string& text : refused) {
    EXPECT_FALSE(schema.accepts(Json::parse(text, "bad"))) << text;
    EXPECT_ANY_THROW(parseScene(text, "bad.json")) << text;
  }
}

}  // namespace
}  // namespace carom::demos
