#include "demos/language/scene_file.h"

#include <algorithm>
#include <numbers>
#include <set>

#include "demos/asset/asset_path.h"
#include "demos/format/json.h"
#include "demos/format/nearest_name.h"
#include "demos/language/scene_cameras.h"
#include "demos/language/scene_expansion.h"
#include "demos/language/scene_mistakes.h"
#include "demos/language/scene_motion.h"
#include "demos/language/scene_pattern.h"
#include "demos/language/scene_remedies.h"
#include "demos/language/scene_shape.h"
#include "demos/language/scene_values.h"
#include "engine/foundation/contract.h"

namespace carom::demos {
namespace {

using std::numbers::pi;

// Materials.

struct NamedMaterial {
  Material physical;
  SurfaceLook look;
};
using Materials = std::map<std::string, NamedMaterial>;

NamedMaterial readMaterial(const Json& json) {
  json.onlyKeys({"staticFriction", "dynamicFriction", "rollingResistance", "spinningResistance",
                 "restitution", "density", "dragCoefficient", "color", "checker", "ground", "surface",
                 "surfaceScale"});
  NamedMaterial material;
  Material& m = material.physical;
  if (const Json* value = json.find("staticFriction")) m.static_friction = readNumber(*value, {0.0, 100.0});
  m.dynamic_friction = m.static_friction;
  if (const Json* value = json.find("dynamicFriction")) {
    m.dynamic_friction = readNumber(*value, {0.0, 100.0});
    if (m.dynamic_friction > m.static_friction)
      value->fail(value->shown() + " is above the static friction of " + plainNumber(m.static_friction) +
                  "; accepted: at most that");
  }
  if (const Json* value = json.find("rollingResistance"))
    m.rolling_resistance_m = readNumber(*value, kResistance);
  if (const Json* value = json.find("spinningResistance"))
    m.spinning_resistance_m = readNumber(*value, kResistance);
  if (const Json* value = json.find("restitution")) m.restitution = readNumber(*value, {0.0, 1.0});
  if (const Json* value = json.find("density"))
    m.density_kgpm3 = readNumber(*value, {0.0, kLargestDensity_kgpm3});
  if (const Json* value = json.find("dragCoefficient")) m.drag_coefficient = readNumber(*value, kFactor);
  material.look = readLook(json);
  return material;
}

Materials readMaterials(const Json& json) {
  Materials materials;
  for (const auto& [name, value] : json.members()) {
    materials[name] = readMaterial(value);
    materials[name].look.material = name;
  }
  return materials;
}

NamedMaterial chooseMaterial(const Json& json, const Materials& materials) {
  if (json.kind() == Json::Kind::kObject) return readMaterial(json);
  const std::string& name = json.asString();
  const auto found = materials.find(name);
  if (found != materials.end()) return found->second;
  std::vector<std::string> names;
  for (const auto& [known, unused] : materials) names.push_back(known);
  json.fail("unknown material \"" + name + "\"" + acceptedNames(name, names));
}

// Bodies.

/// What it was given in its group's frame, in the world's.
void putIntoGroup(const ExpandedBody& written, Body& body) {
  body.in_group = true;
  body.X_WG = written.X_WG;
  body.linear_velocity = written.X_WG.rotation * body.linear_velocity;
  body.angular_velocity = written.X_WG.rotation * body.angular_velocity;
  for (Keyframe& keyframe : body.keyframes) keyframe.X_WB = written.X_WG * keyframe.X_WB;
}

Body readBody(const ExpandedBody& written, const Materials& materials, std::vector<std::string>& warnings) {
  const Json& json = written.json;
  const std::filesystem::path& file = written.file;
  json.onlyKeys({"name", "shape", "position", "rotation", "linearVelocity", "angularVelocity", "material",
                 "dragCoefficient", "color", "static", "repeat", "mass", "kinematic", "locked", "force",
                 "torque", "bodyForce", "bodyTorque", "visual"});
  Body body;
  body.place = placeOf(json, file);
  body.name = json.at("name").asString();
  if (body.name.empty()) json.at("name").fail("a body needs a name");
  body.shape = readShape(json.at("shape"), file);
  if (const Json* visual = json.find("visual")) body.visual = readVisual(*visual, file);
  body.X_WS = readPose(json);
  if (const Json* velocity = json.find("linearVelocity")) body.linear_velocity = readVec3(*velocity, kSpeed);
  if (const Json* velocity = json.find("angularVelocity"))
    body.angular_velocity = readVec3(*velocity, kSpeed);
  if (const Json* is_static = json.find("static")) body.is_static = is_static->asBoolean();
  readMotion(json, body);
  if (const Json* material = json.find("material")) {
    const NamedMaterial chosen = chooseMaterial(*material, materials);
    body.material = chosen.physical;
    body.look = chosen.look;
    if (!body.is_static && !body.is_kinematic && !body.mass_kg &&
        !(body.material.density_kgpm3 >= kDensity.low))
      material->fail("density " + plainNumber(body.material.density_kgpm3) +
                     " for a body that moves; accepted: " + shown(kDensity));
  }
  if (const Json* value = json.find("dragCoefficient"))
    body.material.drag_coefficient = readNumber(*value, kFactor);
  if (const Json* color = json.find("color")) body.colors = readColors(*color);
  if (const Json* repeat = json.find("repeat")) {
    body.repeat = readRepeat(*repeat, warnings);
    requireWithinReach(*repeat, body);
  }
  if (body.is_static && (!body.linear_velocity.isZero(0.0) || !body.angular_velocity.isZero(0.0)))
    json.fail("a static body has no velocity; accepted: leave out linearVelocity and angularVelocity");
  if (written.in_group) putIntoGroup(written, body);
  requireOneMotion(json, body);
  return body;
}

/// What a body is called: as it is written, and each of its copies.
std::vector<std::string> namesOf(const Body& body) {
  std::vector<std::string> names{body.name};
  if (body.repeat.total() > 1)
    for (int copy = 0; copy < body.repeat.total(); ++copy) names.push_back(nameOfCopy(body, copy));
  return names;
}

std::vector<Body> readBodies(const ExpandedScene& scene, const Materials& materials,
                             std::vector<std::string>& warnings) {
  std::vector<Body> bodies;
  std::set<std::string> names;
  int total = 0;
  for (const ExpandedBody& written : scene.expanded) {
    bodies.push_back(readBody(written, materials, warnings));
    const Json& item = written.json;
    total += bodies.back().repeat.total();
    if (total > kMostBodies) item.fail("more bodies than " + std::to_string(kMostBodies));
    for (const std::string& name : namesOf(bodies.back()))
      if (!names.insert(name).second) item.at("name").fail(Json(name).shown() + " names two bodies");
  }
  if (bodies.empty()) scene.bodies.fail("a scene needs at least one body");
  return bodies;
}

// Air and fluids.

Air readAir(const Json& json) {
  json.onlyKeys({"density", "wind", "skinFriction"});
  Air air;
  air.density_kgpm3 = 1.2;
  if (const Json* value = json.find("density")) air.density_kgpm3 = readNumber(*value, {0.0, 1e4});
  if (const Json* value = json.find("wind")) air.wind = readVec3(*value, kSpeed);
  if (const Json* value = json.find("skinFriction")) air.skin_friction = readNumber(*value, kFactor);
  return air;
}

Vec2 readDirection(const Json& json) {
  if (json.items().size() != 2)
    json.fail(json.shown() + " has " + std::to_string(json.items().size()) +
              " numbers; accepted: two, x and y");
  const Vec2 direction(readNumber(json.items()[0], kCoordinate), readNumber(json.items()[1], kCoordinate));
  if (!(direction.norm() > kSmallestLength_m))
    json.fail(json.shown() + " has no direction; accepted: two numbers, x and y, of some length");
  return direction.normalized();
}

Wave readWave(const Json& json) {
  json.onlyKeys({"amplitude", "wavelength", "direction", "period", "phaseDegrees"});
  Wave wave;
  wave.amplitude_m = readNumber(json.at("amplitude"), {0.0, kLargestLength_m});
  wave.wavelength_m = readNumber(json.at("wavelength"), {0.01, kLargestLength_m});
  if (const Json* value = json.find("direction")) wave.direction = readDirection(*value);
  if (const Json* value = json.find("period")) wave.period_s = readNumber(*value, {0.01, 1e5});
  if (const Json* value = json.find("phaseDegrees"))
    wave.phase = readNumber(*value, {-36000.0, 36000.0}) * pi / 180.0;
  return wave;
}

void readFluidSpace(const Json& json, Fluid& fluid) {
  const Json* box = json.find("box");
  const Json* level = json.find("level");
  if ((box == nullptr) == (level == nullptr)) json.fail("accepted: either \"box\" or \"level\"");
  if (level != nullptr) {
    fluid.max.z() = readNumber(*level, kCoordinate);
    return;
  }
  box->onlyKeys({"min", "max"});
  fluid.min = readVec3(box->at("min"), kCoordinate);
  fluid.max = readVec3(box->at("max"), kCoordinate);
  for (Eigen::Index axis = 0; axis < 3; ++axis)
    if (!(fluid.max[axis] - fluid.min[axis] >= kSmallestLength_m))
      box->at("max").fail(box->at("max").shown() + " is not above \"min\" along " + "xyz"[axis] +
                          "; accepted: larger along every axis");
}

NamedFluid readFluid(const Json& json, const std::filesystem::path& file) {
  json.onlyKeys(
      {"name", "box", "level", "density", "drag", "linearDrag", "flow", "addedMass", "waves", "color"});
  NamedFluid named;
  named.place = placeOf(json, file);
  named.name = json.at("name").asString();
  if (named.name.empty()) json.at("name").fail("a fluid needs a name");
  Fluid& fluid = named.fluid;
  readFluidSpace(json, fluid);
  if (const Json* value = json.find("density")) fluid.density_kgpm3 = readNumber(*value, kDensity);
  if (const Json* value = json.find("drag")) fluid.drag = readNumber(*value, kFactor);
  if (const Json* value = json.find("linearDrag")) fluid.linear_drag_mps = readNumber(*value, kFactor);
  if (const Json* value = json.find("flow")) fluid.flow = readVec3(*value, kSpeed);
  if (const Json* value = json.find("addedMass")) fluid.added_mass = readNumber(*value, kFactor);
  if (const Json* value = json.find("waves"))
    for (const Json& item : value->items()) fluid.waves.push_back(readWave(item));
  if (const Json* value = json.find("color")) named.color = readColor(*value);
  return named;
}

std::vector<NamedFluid> readFluids(const Json& json, const std::filesystem::path& file) {
  std::vector<NamedFluid> fluids;
  std::set<std::string> names;
  for (const Json& item : json.items()) {
    fluids.push_back(readFluid(item, file));
    if (!names.insert(fluids.back().name).second)
      item.at("name").fail(item.at("name").shown() + " names two fluids");
  }
  return fluids;
}

CaptionText readCaptionOf(const Json& json, const std::map<std::string, double>& variables,
                          const BodyNames& names) {
  const std::string& text = json.asString();
  CaptionText caption;
  try {
    caption = readCaption(text, variables);
  } catch (const InputError& error) {
    json.fail(error.what());
  }
  for (const CaptionPart& part : caption.parts)
    for (const BodyQuantity& quantity : part.bodies) names.require(quantity.body, json);
  return caption;
}

void readFormat(const Json& json) {
  if (json.at("format").asNumber() != 1.0)
    json.at("format").fail(json.at("format").shown() + " is unknown; accepted: 1");
}

/// Materials that no body has.
void warnOfUnused(const Json& materials, const std::vector<Body>& bodies, const std::filesystem::path& file,
                  std::vector<std::string>& warnings) {
  for (const auto& [name, value] : materials.members()) {
    bool is_used = false;
    for (const Body& body : bodies) is_used = is_used || body.look.material == name;
    if (!is_used) warnings.push_back(placeOf(value, file) + ": no body has this material");
  }
}

/// Adds to `grown` how many values the scene was made into, also where it is refused.
Scene readScene(const Json& written, const std::filesystem::path& path, std::size_t& grown) {
  written.onlyKeys({"$schema", "format", "description", "lookFor", "group", "caption", "set", "include",
                    "gravity", "rate", "seed", "materials", "air", "fluids", "bodies", "cameras", "duration",
                    "light"});
  readFormat(written);
  const ExpandedScene expanded = expandScene(written, path, grown);
  const Json& json = expanded.scene;
  Scene scene;
  scene.name = path.stem().string();
  scene.file = path;
  scene.included = expanded.included;
  scene.warnings = expanded.warnings;
  if (const Json* value = json.find("description")) scene.description = value->asString();
  if (const Json* value = json.find("lookFor")) scene.look_for = value->asString();
  if (const Json* value = json.find("group")) scene.group = value->asString();
  if (const Json* value = json.find("gravity")) scene.gravity = readVec3(*value, {-1000.0, 1000.0});
  if (const Json* value = json.find("rate")) scene.rate_hz = readNumber(*value, {10.0, 100000.0});
  if (const Json* value = json.find("seed"))
    scene.seed = static_cast<std::uint64_t>(readWhole(*value, 0, kMostSeed));
  if (const Json* value = json.find("duration")) scene.duration_s = readNumber(*value, {0.0, 3600.0, true});
  scene.written_duration_s = scene.duration_s;
  if (const Json* value = json.find("air")) scene.air = readAir(*value);
  if (const Json* value = json.find("light")) scene.light = readLight(*value);
  if (const Json* value = json.find("fluids")) scene.fluids = readFluids(*value, path);
  Materials materials;
  if (const Json* value = json.find("materials")) materials = readMaterials(*value);
  written.at("bodies");
  scene.bodies = readBodies(expanded, materials, scene.warnings);
  if (const Json* value = written.find("materials")) warnOfUnused(*value, scene.bodies, path, scene.warnings);
  const BodyNames names(scene.bodies);
  if (const Json* value = json.find("cameras"))
    for (const auto& [name, camera] : value->members())
      scene.cameras[name] = readCamera(camera, names, scene.duration_s);
  if (const Json* value = json.find("caption"))
    scene.caption = readCaptionOf(*value, expanded.numbers, names);
  if (scene.cameras.empty()) scene.cameras["main"] = SceneCamera();
  return scene;
}

Json parsedScene(std::string_view text, const std::filesystem::path& path) {
  try {
    return Json::parse(text, path.string());
  } catch (const InputError& error) {
    throw InputError(std::string(error.what()) + syntaxRemedy(error.what()));
  }
}

}  // namespace

Scene parseScene(std::string_view text, const std::filesystem::path& path,
                 const std::vector<std::string>& settings) {
  Json json = parsedScene(text, path);
  for (const std::string& setting : settings) json = withSetting(std::move(json), path, setting);
  std::size_t grown = 0;
  try {
    Scene scene = readScene(json, path, grown);
    scene.settings = settings;
    return scene;
  } catch (const JsonError& error) {
    constexpr std::size_t kWrittenByAProgram = 1 << 18;  // Bytes; a person writes less.
    const Mistakes mistakes = mistakesOf(std::move(json), path, error,
                                         text.size() < kWrittenByAProgram ? 100 : 1, [&](const Json& rest) {
                                           if (grown > static_cast<std::size_t>(kMostJsonValues))
                                             throw InputError("read often enough");
                                           readScene(rest, path, grown);
                                         });
    const std::size_t count = mistakes.all.size();
    const std::string others =
        count == 1 ? ""
                   : " (the first of " + std::to_string(count) + " mistakes; carom check lists them all)";
    throw SceneMistakes(mistakes.first + others, mistakes.all);
  }
}

Scene readSceneFile(const std::filesystem::path& path, const std::vector<std::string>& settings) {
  return parseScene(readTextFile(path), path, settings);
}

}  // namespace carom::demos
