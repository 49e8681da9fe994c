#include "demos/language/scene_shape.h"

#include <numbers>
#include <optional>

#include "demos/asset/asset_path.h"
#include "demos/language/scene_values.h"
#include "engine/foundation/elementary.h"

namespace carom::demos {
namespace {

using std::numbers::pi;
constexpr int kUsualSides = 32, kMostSides = 128;

/// The corners of a regular polygon in the plane at this height.
void addRing(std::vector<Vec3>& points, int sides, double radius_m, double z_m) {
  for (int k = 0; k < sides; ++k) {
    const SineCosine both = sineCosine(2.0 * pi * k / sides);
    points.emplace_back(radius_m * both.cosine, radius_m * both.sine, z_m);
  }
}

int readSides(const Json& json, int usual) {
  const Json* sides = json.find("sides");
  return sides == nullptr ? usual : readWhole(*sides, 3, kMostSides);
}

HullShape readCylinder(const Json& json) {
  json.onlyKeys({"radius", "length", "sides"});
  const double radius_m = readNumber(json.at("radius"), kLength);
  const double half_m = 0.5 * readNumber(json.at("length"), kLength);
  const int sides = readSides(json, kUsualSides);
  HullShape hull;
  addRing(hull.points, sides, radius_m, -half_m);
  addRing(hull.points, sides, radius_m, half_m);
  return hull;
}

HullShape readCone(const Json& json) {
  json.onlyKeys({"radius", "topRadius", "height", "sides"});
  const double half_m = 0.5 * readNumber(json.at("height"), kLength);
  const int sides = readSides(json, kUsualSides);
  HullShape hull;
  addRing(hull.points, sides, readNumber(json.at("radius"), kLength), -half_m);
  if (const Json* top = json.find("topRadius"))
    addRing(hull.points, sides, readNumber(*top, kLength), half_m);
  else
    hull.points.emplace_back(0.0, 0.0, half_m);
  return hull;
}

HullShape readPrism(const Json& json) {
  json.onlyKeys({"sides", "radius", "length"});
  const int sides = readWhole(json.at("sides"), 3, kMostSides);
  const double radius_m = readNumber(json.at("radius"), kLength);
  const double half_m = 0.5 * readNumber(json.at("length"), kLength);
  HullShape hull;
  addRing(hull.points, sides, radius_m, -half_m);
  addRing(hull.points, sides, radius_m, half_m);
  return hull;
}

/// Half of a box: level below, upright towards -x, sloping down along x.
HullShape readWedge(const Json& json) {
  const Vec3 half_m = 0.5 * readVec3(json, kLength);
  HullShape hull;
  for (const double y : {-half_m.y(), half_m.y()}) {
    hull.points.emplace_back(-half_m.x(), y, -half_m.z());
    hull.points.emplace_back(half_m.x(), y, -half_m.z());
    hull.points.emplace_back(-half_m.x(), y, half_m.z());
  }
  return hull;
}

RoundedBoxShape readRoundedBox(const Json& json) {
  json.onlyKeys({"size", "radius"});
  RoundedBoxShape box;
  box.size_m = readVec3(json.at("size"), kLength);
  const Json& radius = json.at("radius");
  box.radius_m = readNumber(radius, kLength);
  const double most_m = 0.5 * (box.size_m.minCoeff() - kSmallestLength_m);
  if (!(box.radius_m <= most_m))
    radius.fail(radius.shown() + " leaves nothing of the shortest side; accepted: less than half of it, " +
                plainNumber(0.5 * box.size_m.minCoeff()));
  return box;
}

bool isCommonShape(const std::string& kind) {
  return kind == "cylinder" || kind == "cone" || kind == "prism" || kind == "wedge" || kind == "roundedBox";
}

Shape readCommonShape(const std::string& kind, const Json& json) {
  Shape shape;
  if (kind == "cylinder")
    shape.form = readCylinder(json);
  else if (kind == "cone")
    shape.form = readCone(json);
  else if (kind == "prism")
    shape.form = readPrism(json);
  else if (kind == "wedge")
    shape.form = readWedge(json);
  else
    shape.form = readRoundedBox(json);
  return shape;
}

// Shapes: one of box, sphere, capsule, hull, mesh, compound.

// What all mesh files are read by.

std::filesystem::path foundFile(const Json& json, const std::filesystem::path& scene_file) {
  const std::optional<std::filesystem::path> found = findBeside(scene_file, json.asString());
  if (!found) json.fail("no file " + json.shown() + " beside the scene or in the assets folder");
  return *found;
}

void readSize(const Json& json, double& scale, std::optional<double>& fit_m) {
  if (const Json* value = json.find("scale")) scale = readNumber(*value, {1e-9, 1e9});
  if (const Json* fit = json.find("fit")) {
    if (json.find("scale") != nullptr) fit->fail("given together with \"scale\"; accepted: one of them");
    fit_m = readNumber(*fit, kLength);
  }
}

bool isYUp(const Json& up) {
  if (up.asString() != "y" && up.asString() != "z") up.fail(up.shown() + "; accepted: \"y\", \"z\"");
  return up.asString() == "y";
}

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
  if (file != nullptr) hull.file = foundFile(*file, scene_file);
  if (points != nullptr)
    for (const Json& point : points->items()) hull.points.push_back(readVec3(point, kCoordinate));
  readSize(json, hull.scale, hull.fit_m);
  if (const Json* up = json.find("up")) {
    if (file == nullptr) up->fail("only a \"file\" has an axis that is up");
    hull.y_up = isYUp(*up);
  }
  if (const Json* replaceable = json.find("replaceable")) {
    hull.replaceable = replaceable->asBoolean();
    if (hull.replaceable && file == nullptr) replaceable->fail("only a hull with a \"file\" can be replaced");
  }
  return hull;
}

Shape readAnyShape(const Json& json, const std::filesystem::path& file, bool inside_compound);

CompoundShape readCompound(const Json& json, const std::filesystem::path& file) {
  CompoundShape compound;
  if (json.items().size() > kMostParts)
    json.fail(std::to_string(json.items().size()) + " parts; accepted: at most " +
              std::to_string(kMostParts));
  for (const Json& item : json.items()) {
    item.onlyKeys({"shape", "position", "rotation"});
    compound.parts.push_back({readAnyShape(item.at("shape"), file, true), readPose(item)});
  }
  if (compound.parts.empty()) json.fail("a compound needs at least one part");
  return compound;
}

Shape readAnyShape(const Json& json, const std::filesystem::path& file, bool inside_compound) {
  json.onlyKeys({"box", "sphere", "capsule", "cylinder", "cone", "prism", "wedge", "roundedBox", "hull",
                 "mesh", "compound"});
  if (json.members().size() != 1)
    json.fail(
        "accepted: exactly one of box, sphere, capsule, cylinder, cone, prism, wedge, roundedBox, hull, "
        "mesh, "
        "compound");
  const auto& [kind, value] = json.members().front();
  Shape shape;
  if (isCommonShape(kind)) shape = readCommonShape(kind, value);
  shape.place = placeOf(value, file);
  if (isCommonShape(kind)) return shape;
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
    if (inside_compound) value.fail("a compound cannot hold a compound; accepted: any other shape");
    shape.form = readCompound(value, file);
  }
  return shape;
}

}  // namespace

Shape readShape(const Json& json, const std::filesystem::path& file) {
  return readAnyShape(json, file, false);
}

Visual readVisual(const Json& json, const std::filesystem::path& file) {
  json.onlyKeys({"file", "scale", "fit", "up", "position", "rotation"});
  Visual visual;
  visual.place = placeOf(json, file);
  visual.file = foundFile(json.at("file"), file);
  readSize(json, visual.scale, visual.fit_m);
  if (const Json* up = json.find("up")) visual.y_up = isYUp(*up);
  visual.X_SV = readPose(json);
  return visual;
}

}  // namespace carom::demos
