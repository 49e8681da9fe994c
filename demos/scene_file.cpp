#include "demos/scene_file.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <set>
#include <sstream>

#include "demos/asset_path.h"
#include "demos/json.h"
#include "demos/nearest_name.h"
#include "engine/foundation/contract.h"
#include "engine/foundation/elementary.h"

namespace carom::demos {
namespace {

constexpr double kLargestSpeed = 1e5;  // m/s and rad/s
constexpr double kLongestTime_s = 1e6;
constexpr double kLargestMass_kg = 1e21;
constexpr double kLargestLoad = 1e12;  // N and N m
constexpr double kUnitTolerance =
    1e-3;  // a quaternion farther from length one than this is a mistake, not rounding
constexpr double kPi = 3.14159265358979323846;

/// The values that are accepted; a limit that is `open` is itself left out.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false;
};
constexpr Range kLength{kSmallestLength_m, kLargestLength_m};
constexpr Range kCoordinate{-kLargestLength_m, kLargestLength_m};
constexpr Range kDensity{kSmallestDensity_kgpm3, kLargestDensity_kgpm3};
constexpr Range kFactor{0.0, 1000.0};
constexpr Range kResistance{0.0, 100.0};  // metres
// Masses come from densities and volumes of any size: what is accepted of them is said where both are known.
constexpr Range kMass{0.0, kLargestMass_kg, true};
constexpr Range kLoad{-kLargestLoad, kLargestLoad};
constexpr Range kSpeed{-kLargestSpeed, kLargestSpeed};

std::string plainNumber(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

std::string shown(const Range& range) {
  if (std::isinf(range.high)) return (range.low_open ? "above " : "at least ") + plainNumber(range.low);
  return (range.low_open ? "above " : "") + plainNumber(range.low) + " to " + plainNumber(range.high);
}

double readNumber(const Json& json, const Range& range) {
  const double value = json.asNumber();
  const bool inside = value >= range.low && value <= range.high && !(range.low_open && value == range.low);
  if (!inside) json.fail(json.shown() + " is out of range; accepted: " + shown(range));
  return value;
}

int readWhole(const Json& json, int least, int most) {
  const double value = json.asNumber();
  if (!(value >= least && value <= most) || value != std::floor(value))
    json.fail(json.shown() + " is out of range; accepted: a whole number from " + std::to_string(least) +
              " to " + std::to_string(most));
  return static_cast<int>(value);
}

Vec3 readVec3(const Json& json, const Range& range) {
  if (json.items().size() != 3)
    json.fail(json.shown() + " has " + std::to_string(json.items().size()) + " numbers; accepted: three");
  return {readNumber(json.items()[0], range), readNumber(json.items()[1], range),
          readNumber(json.items()[2], range)};
}

Place placeOf(const Json& json, const std::filesystem::path& file) {
  return file.string() + ":" + std::to_string(json.line()) + ": " + json.path();
}

// Rotations: {"axis": [x, y, z], "degrees": d} or a quaternion [w, x, y, z].

Quat readAxisRotation(const Json& json) {
  json.onlyKeys({"axis", "degrees"});
  const Vec3 axis = readVec3(json.at("axis"), kCoordinate);
  if (!(axis.norm() > kSmallestLength_m))
    json.at("axis").fail(json.at("axis").shown() + " has no direction; accepted: an axis of some length");
  const double radians = readNumber(json.at("degrees"), {-36000.0, 36000.0}) * kPi / 180.0;
  return rotationBy(axis.normalized() * radians);
}

Quat readRotation(const Json& json) {
  if (json.kind() == Json::Kind::kObject) return readAxisRotation(json);
  if (json.kind() != Json::Kind::kArray || json.items().size() != 4)
    json.fail(
        json.shown() +
        " is no rotation; accepted: {\"axis\": [x, y, z], \"degrees\": d} or a unit quaternion [w, x, y, z]");
  double q[4];
  for (std::size_t i = 0; i < 4; ++i) q[i] = json.items()[i].asNumber();
  const Quat rotation(q[0], q[1], q[2], q[3]);
  if (!(std::abs(rotation.norm() - 1.0) <= kUnitTolerance))
    json.fail(json.shown() + " has length " + plainNumber(rotation.norm()) +
              "; accepted: a unit quaternion [w, x, y, z]");
  return rotation.normalized();
}

Pose readPose(const Json& json) {
  Pose pose;
  if (const Json* position = json.find("position")) pose.position = readVec3(*position, kCoordinate);
  if (const Json* rotation = json.find("rotation")) pose.rotation = readRotation(*rotation);
  return pose;
}

// Colours: "#rrggbb".

int hexDigit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

renderer::Color readColor(const Json& json) {
  const std::string& text = json.asString();
  bool valid = text.size() == 7 && text[0] == '#';
  for (std::size_t i = 1; valid && i < 7; ++i) valid = hexDigit(text[i]) >= 0;
  if (!valid) json.fail(json.shown() + " is no colour; accepted: \"#rrggbb\"");
  float channel[3];
  for (std::size_t i = 0; i < 3; ++i)
    channel[i] = static_cast<float>(16 * hexDigit(text[1 + 2 * i]) + hexDigit(text[2 + 2 * i])) / 255.0f;
  return {channel[0], channel[1], channel[2]};
}

std::vector<renderer::Color> readColors(const Json& json) {
  if (json.kind() != Json::Kind::kArray) return {readColor(json)};
  std::vector<renderer::Color> colors;
  for (const Json& item : json.items()) colors.push_back(readColor(item));
  if (colors.empty()) json.fail("the list of colours is empty");
  return colors;
}

// Materials.

struct NamedMaterial {
  Material physical;
  SurfaceLook look;
};
using Materials = std::map<std::string, NamedMaterial>;

NamedMaterial readMaterial(const Json& json) {
  json.onlyKeys({"staticFriction", "dynamicFriction", "rollingResistance", "spinningResistance",
                 "restitution", "density", "dragCoefficient", "color", "checker"});
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
  if (const Json* value = json.find("color")) {
    material.look.color = readColor(*value);
    material.look.has_color = true;
  }
  if (const Json* value = json.find("checker")) material.look.checker = value->asBoolean();
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

// Shapes: one of box, sphere, capsule, hull, mesh, compound.

/// A "hull", of points or a file; a "mesh" is a file as it is, or with "hull": true its hull.
HullShape readHull(const Json& json, const std::filesystem::path& scene_file, bool is_mesh) {
  HullShape hull;
  if (is_mesh) {
    json.onlyKeys({"file", "scale", "fit", "up", "hull", "replaceable"});
    json.at("file");
    const Json* as_hull = json.find("hull");
    hull.as_hull = as_hull != nullptr && as_hull->asBoolean();
  } else {
    json.onlyKeys({"file", "points", "scale", "fit", "up", "replaceable"});
  }
  const Json* file = json.find("file");
  const Json* points = json.find("points");
  if ((file == nullptr) == (points == nullptr)) json.fail("accepted: either \"file\" or \"points\"");
  if (file != nullptr) {
    const std::optional<std::filesystem::path> found = findBeside(scene_file, file->asString());
    if (!found) file->fail("no file " + file->shown() + " beside the scene or in the assets folder");
    hull.file = *found;
  }
  if (points != nullptr)
    for (const Json& point : points->items()) hull.points.push_back(readVec3(point, kCoordinate));
  if (const Json* scale = json.find("scale")) hull.scale = readNumber(*scale, {1e-9, 1e9});
  if (const Json* fit = json.find("fit")) {
    if (json.find("scale") != nullptr) fit->fail("given together with \"scale\"; accepted: one of them");
    hull.fit_m = readNumber(*fit, kLength);
  }
  if (const Json* up = json.find("up")) {
    if (file == nullptr) up->fail("only a \"file\" has an axis that is up");
    if (up->asString() != "y" && up->asString() != "z") up->fail(up->shown() + "; accepted: \"y\", \"z\"");
    hull.y_up = up->asString() == "y";
  }
  if (const Json* replaceable = json.find("replaceable")) {
    hull.replaceable = replaceable->asBoolean();
    if (hull.replaceable && file == nullptr) replaceable->fail("only a hull with a \"file\" can be replaced");
  }
  return hull;
}

Shape readShape(const Json& json, const std::filesystem::path& file, bool inside_compound = false);

CompoundShape readCompound(const Json& json, const std::filesystem::path& file) {
  CompoundShape compound;
  if (json.items().size() > kMostParts)
    json.fail(std::to_string(json.items().size()) + " parts; accepted: at most " +
              std::to_string(kMostParts));
  for (const Json& item : json.items()) {
    item.onlyKeys({"shape", "position", "rotation"});
    compound.parts.push_back({readShape(item.at("shape"), file, true), readPose(item)});
  }
  if (compound.parts.empty()) json.fail("a compound needs at least one part");
  return compound;
}

Shape readShape(const Json& json, const std::filesystem::path& file, bool inside_compound) {
  json.onlyKeys({"box", "sphere", "capsule", "hull", "mesh", "compound"});
  if (json.members().size() != 1)
    json.fail("accepted: exactly one of box, sphere, capsule, hull, mesh, compound");
  const auto& [kind, value] = json.members().front();
  Shape shape;
  shape.place = placeOf(value, file);
  if (kind == "box") {
    shape.form = BoxShape{readVec3(value, kLength)};
  } else if (kind == "sphere") {
    value.onlyKeys({"radius"});
    shape.form = SphereShape{readNumber(value.at("radius"), kLength)};
  } else if (kind == "capsule") {
    value.onlyKeys({"radius", "length"});
    shape.form =
        CapsuleShape{readNumber(value.at("radius"), kLength), readNumber(value.at("length"), kLength)};
  } else if (kind == "hull") {
    shape.form = readHull(value, file, false);
  } else if (kind == "mesh") {
    shape.form = readHull(value, file, true);
  } else {
    if (inside_compound)
      value.fail("a compound cannot hold a compound; accepted: box, sphere, capsule, hull, mesh");
    shape.form = readCompound(value, file);
  }
  return shape;
}

// Bodies.

Repeat readRepeat(const Json& json) {
  json.onlyKeys({"count", "step", "jitter", "jitterDegrees"});
  Repeat repeat;
  const Json& count = json.at("count");
  if (count.items().size() != 3)
    count.fail(count.shown() + " has " + std::to_string(count.items().size()) + " numbers; accepted: three");
  double total = 1.0;
  for (std::size_t i = 0; i < 3; ++i) {
    repeat.count[i] = readWhole(count.items()[i], 1, kMostBodies);
    total *= repeat.count[i];
  }
  if (total > kMostBodies)
    count.fail(count.shown() + " makes too many bodies; accepted: at most " + std::to_string(kMostBodies));
  repeat.step_m = readVec3(json.at("step"), kCoordinate);
  if (const Json* jitter = json.find("jitter"))
    repeat.jitter_m = readNumber(*jitter, {0.0, kLargestLength_m});
  if (const Json* jitter = json.find("jitterDegrees"))
    repeat.jitter_degrees = readNumber(*jitter, {0.0, 180.0});
  return repeat;
}

/// The farthest copy must be as near as any other body.
void requireWithinReach(const Json& json, const Body& body) {
  const Repeat& repeat = body.repeat;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const double last_m = body.X_WS.position[axis] + (repeat.count[axis] - 1) * repeat.step_m[axis];
    const double farthest_m =
        std::max(std::abs(last_m), std::abs(body.X_WS.position[axis])) + repeat.jitter_m;
    if (farthest_m > kLargestLength_m)
      json.fail("the copies reach to " + plainNumber(farthest_m) + " m along " + "xyz"[axis] +
                "; accepted: " + shown(kCoordinate));
  }
}

// Bodies that are moved: kinematic ones, locked axes, loads.

Keyframe readKeyframe(const Json& json) {
  json.onlyKeys({"time", "position", "rotation"});
  return {readNumber(json.at("time"), {0.0, kLongestTime_s}), readPose(json)};
}

void readKeyframes(const Json& json, Body& body) {
  if (json.items().empty()) json.fail("accepted: at least one keyframe");
  for (const Json& item : json.items()) {
    const Keyframe keyframe = readKeyframe(item);
    if (!body.keyframes.empty() && !(keyframe.time_s > body.keyframes.back().time_s))
      item.at("time").fail(item.at("time").shown() +
                           " is not after the keyframe before; accepted: times that rise");
    body.keyframes.push_back(keyframe);
  }
}

bool isSamePose(const Pose& a, const Pose& b) {
  return a.position == b.position && a.rotation.angularDistance(b.rotation) < kUnitTolerance;
}

void readKinematic(const Json& json, Body& body) {
  if (json.kind() != Json::Kind::kObject) {
    body.is_kinematic = json.asBoolean();
    return;
  }
  json.onlyKeys({"keyframes", "interpolation", "repeats"});
  body.is_kinematic = true;
  readKeyframes(json.at("keyframes"), body);
  if (const Json* how = json.find("interpolation")) {
    const std::string& name = how->asString();
    if (name != "linear" && name != "smooth")
      how->fail(how->shown() + " is unknown; accepted: linear, smooth");
    if (name == "smooth") body.interpolation = Interpolation::kSmooth;
  }
  if (const Json* repeats = json.find("repeats")) {
    body.path_repeats = repeats->asBoolean();
    if (body.path_repeats && !isSamePose(body.keyframes.front().X_WB, body.keyframes.back().X_WB))
      repeats->fail("the last keyframe is not where the first is; accepted: a path that ends as it begins");
  }
}

// "x", "y", "z": along the world's axes; "turnX", "turnY", "turnZ": about them.
AxisLocks readLocks(const Json& json) {
  AxisLocks locks;
  Vec3 turning = Vec3::Ones();
  for (const Json& item : json.items()) {
    const std::string& name = item.asString();
    const std::size_t axis = name.empty() ? 3 : std::string("xyzXYZ").find(name.back());
    if (name == "x" || name == "y" || name == "z")
      locks.free_axes[static_cast<Eigen::Index>(axis)] = 0.0;
    else if (name == "turnX" || name == "turnY" || name == "turnZ")
      turning[static_cast<Eigen::Index>(axis - 3)] = 0.0;
    else
      item.fail(item.shown() + " is no axis; accepted: x, y, z, turnX, turnY, turnZ");
  }
  if (turning.sum() == 2.0)
    json.fail("locks one axis of turning; accepted: none, two or all three of turnX, turnY, turnZ");
  if (turning.sum() == 0.0) locks.turning = AxisLocks::Turning::kLocked;
  if (turning.sum() == 1.0) {
    locks.turning = AxisLocks::Turning::kOneAxis;
    locks.axis_W = turning;
  }
  return locks;
}

void readLoad(const Json& json, AppliedLoad& load) {
  if (const Json* value = json.find("force")) load.force_W = readVec3(*value, kLoad);
  if (const Json* value = json.find("torque")) load.torque_W = readVec3(*value, kLoad);
  if (const Json* value = json.find("bodyForce")) load.force_B = readVec3(*value, kLoad);
  if (const Json* value = json.find("bodyTorque")) load.torque_B = readVec3(*value, kLoad);
}

// What cannot be said together.
void requireOneMotion(const Json& json, const Body& body) {
  const auto refuse = [&](const char* key, const std::string& why) {
    if (const Json* found = json.find(key)) found->fail(why);
  };
  if (body.is_static && body.is_kinematic)
    refuse("kinematic", "the body is static, too; accepted: one of static and kinematic");
  if (!body.keyframes.empty())
    for (const char* key : {"position", "rotation", "linearVelocity", "angularVelocity", "repeat"})
      refuse(key, "given together with keyframes, which say where the body is; accepted: one of them");
  if (body.is_static || body.is_kinematic)
    for (const char* key : {"mass", "locked", "force", "torque", "bodyForce", "bodyTorque"})
      refuse(key, std::string("of a body that is ") + (body.is_static ? "static" : "kinematic") +
                      "; accepted: only of one that moves freely");
  if (body.locks.movingPart(body.linear_velocity) != body.linear_velocity)
    refuse("linearVelocity", "has a part along a locked axis; accepted: 0 there");
  if (body.locks.turningPart(body.angular_velocity) != body.angular_velocity)
    refuse("angularVelocity", "has a part about a locked axis; accepted: 0 there");
  const Json* material = json.find("material");
  if (material != nullptr && material->kind() == Json::Kind::kObject && material->find("density") != nullptr)
    refuse("mass", "given together with the material's \"density\"; accepted: one of them");
}

Body readBody(const Json& json, const Materials& materials, const std::filesystem::path& file) {
  json.onlyKeys({"name", "shape", "position", "rotation", "linearVelocity", "angularVelocity", "material",
                 "dragCoefficient", "color", "static", "repeat", "mass", "kinematic", "locked", "force",
                 "torque", "bodyForce", "bodyTorque"});
  Body body;
  body.place = placeOf(json, file);
  body.name = json.at("name").asString();
  if (body.name.empty()) json.at("name").fail("a body needs a name");
  body.shape = readShape(json.at("shape"), file);
  body.X_WS = readPose(json);
  if (const Json* velocity = json.find("linearVelocity")) body.linear_velocity = readVec3(*velocity, kSpeed);
  if (const Json* velocity = json.find("angularVelocity"))
    body.angular_velocity = readVec3(*velocity, kSpeed);
  if (const Json* is_static = json.find("static")) body.is_static = is_static->asBoolean();
  if (const Json* kinematic = json.find("kinematic")) readKinematic(*kinematic, body);
  if (const Json* mass = json.find("mass")) body.mass_kg = readNumber(*mass, kMass);
  if (const Json* locked = json.find("locked")) body.locks = readLocks(*locked);
  readLoad(json, body.load);
  requireOneMotion(json, body);
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
    body.repeat = readRepeat(*repeat);
    requireWithinReach(*repeat, body);
  }
  if (body.is_static && (!body.linear_velocity.isZero(0.0) || !body.angular_velocity.isZero(0.0)))
    json.fail("a static body has no velocity; accepted: leave out linearVelocity and angularVelocity");
  return body;
}

std::vector<Body> readBodies(const Json& json, const Materials& materials,
                             const std::filesystem::path& file) {
  std::vector<Body> bodies;
  std::set<std::string> names;
  int total = 0;
  for (const Json& item : json.items()) {
    bodies.push_back(readBody(item, materials, file));
    if (!names.insert(bodies.back().name).second)
      item.at("name").fail(item.at("name").shown() + " names two bodies");
    total += bodies.back().repeat.total();
    if (total > kMostBodies) item.fail("more bodies than " + std::to_string(kMostBodies));
  }
  if (bodies.empty()) json.fail("a scene needs at least one body");
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
    wave.phase = readNumber(*value, {-36000.0, 36000.0}) * kPi / 180.0;
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

// Cameras: one of "eye" and "target", "fit", "follow", "orbit".

void readStillCamera(const Json& json, SceneCamera& camera) {
  json.onlyKeys({"eye", "target", "fovDegrees"});
  camera.eye = readVec3(json.at("eye"), kCoordinate);
  camera.target = readVec3(json.at("target"), kCoordinate);
  if (!((camera.eye - camera.target).norm() > kSmallestLength_m)) json.fail("eye and target coincide");
}

Vec3 readOffset(const Json& json) {
  const Vec3 offset = readVec3(json, kCoordinate);
  if (!(offset.norm() > kSmallestLength_m))
    json.fail(json.shown() + " has no direction; accepted: a vector of some length");
  return offset;
}

void readFitCamera(const Json& json, SceneCamera& camera) {
  json.onlyKeys({"fit", "direction", "fovDegrees"});
  if (!json.at("fit").asBoolean()) json.at("fit").fail("accepted: true, or another kind of camera");
  FitView fit;
  if (const Json* direction = json.find("direction")) fit.direction = readOffset(*direction);
  camera.motion = fit;
}

/// The names of all copies, in the order of the scene and sorted.
struct BodyNames {
  explicit BodyNames(const std::vector<Body>& bodies) {
    for (const Body& body : bodies)
      for (int copy = 0; copy < body.repeat.total(); ++copy) in_order.push_back(nameOfCopy(body, copy));
    sorted = in_order;
    std::sort(sorted.begin(), sorted.end());
  }
  std::vector<std::string> in_order, sorted;
};

void readFollowCamera(const Json& json, const BodyNames& names, SceneCamera& camera) {
  json.onlyKeys({"follow", "offset", "fovDegrees"});
  FollowBody follow{json.at("follow").asString(), {}};
  if (!std::binary_search(names.sorted.begin(), names.sorted.end(), follow.body))
    json.at("follow").fail("unknown body " + json.at("follow").shown() +
                           acceptedNames(follow.body, names.in_order));
  if (const Json* offset = json.find("offset")) follow.offset_m = readOffset(*offset);
  camera.motion = follow;
}

void readOrbitCamera(const Json& json, SceneCamera& camera) {
  json.onlyKeys({"orbit", "fovDegrees"});
  const Json& path = json.at("orbit");
  path.onlyKeys({"target", "radius", "height", "degreesPerSecond", "startDegrees"});
  Orbit orbit;
  camera.target = readVec3(path.at("target"), kCoordinate);
  orbit.radius_m = readNumber(path.at("radius"), kLength);
  if (const Json* value = path.find("height")) orbit.height_m = readNumber(*value, kCoordinate);
  if (const Json* value = path.find("degreesPerSecond"))
    orbit.degrees_per_second = readNumber(*value, {-36000.0, 36000.0});
  if (const Json* value = path.find("startDegrees"))
    orbit.start_degrees = readNumber(*value, {-36000.0, 36000.0});
  camera.motion = orbit;
}

SceneCamera readCamera(const Json& json, const BodyNames& names) {
  json.onlyKeys({"eye", "target", "fovDegrees", "fit", "direction", "follow", "offset", "orbit"});
  SceneCamera camera;
  if (json.find("fit") != nullptr)
    readFitCamera(json, camera);
  else if (json.find("follow") != nullptr)
    readFollowCamera(json, names, camera);
  else if (json.find("orbit") != nullptr)
    readOrbitCamera(json, camera);
  else
    readStillCamera(json, camera);
  if (const Json* fov = json.find("fovDegrees")) camera.fov_degrees = readNumber(*fov, {1.0, 150.0});
  return camera;
}

void readFormat(const Json& json) {
  if (json.at("format").asNumber() != 1.0)
    json.at("format").fail(json.at("format").shown() + " is unknown; accepted: 1");
}

}  // namespace

Scene parseScene(std::string_view text, const std::filesystem::path& path) {
  const Json json = Json::parse(text, path.string());
  json.onlyKeys({"format", "description", "gravity", "rate", "seed", "materials", "air", "fluids", "bodies",
                 "cameras", "duration"});
  readFormat(json);
  Scene scene;
  scene.name = path.stem().string();
  scene.file = path;
  if (const Json* value = json.find("description")) scene.description = value->asString();
  if (const Json* value = json.find("gravity")) scene.gravity = readVec3(*value, {-1000.0, 1000.0});
  if (const Json* value = json.find("rate")) scene.rate_hz = readNumber(*value, {10.0, 100000.0});
  if (const Json* value = json.find("seed"))
    scene.seed = static_cast<std::uint64_t>(readWhole(*value, 0, 1000000000));
  if (const Json* value = json.find("duration")) scene.duration_s = readNumber(*value, {0.0, 3600.0, true});
  if (const Json* value = json.find("air")) scene.air = readAir(*value);
  if (const Json* value = json.find("fluids")) scene.fluids = readFluids(*value, path);
  Materials materials;
  if (const Json* value = json.find("materials")) materials = readMaterials(*value);
  scene.bodies = readBodies(json.at("bodies"), materials, path);
  if (const Json* value = json.find("cameras")) {
    const BodyNames names(scene.bodies);
    for (const auto& [name, camera] : value->members()) scene.cameras[name] = readCamera(camera, names);
  }
  if (scene.cameras.empty()) scene.cameras["main"] = SceneCamera();
  return scene;
}

Scene readSceneFile(const std::filesystem::path& path) {
  return parseScene(readTextFile(path), path);
}

}  // namespace carom::demos
