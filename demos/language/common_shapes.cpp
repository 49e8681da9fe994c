#include "demos/language/common_shapes.h"

#include <numbers>

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

}  // namespace

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

}  // namespace carom::demos
