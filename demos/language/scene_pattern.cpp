#include "demos/language/scene_pattern.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "demos/formula/random_stream.h"
#include "demos/language/scene_values.h"
#include "engine/foundation/elementary.h"

namespace carom::demos {
namespace {

using std::numbers::pi;
constexpr Range kDegrees{-36000.0, 36000.0};

double radians(double degrees) {
  return degrees * pi / 180.0;
}

int readCount(const Json& json) {
  return readWhole(json.at("count"), 1, kMostBodies);
}

std::string where(const Json& json) {
  try {
    json.fail("");
  } catch (const InputError& place) {
    return place.what();
  }
}

/// The shortest turn of z into the axis.
Quat uprightTo(const Json* json) {
  if (json == nullptr) return Quat::Identity();
  const Vec3 along = readVec3(*json, kCoordinate);
  if (!(along.norm() > kSmallestLength_m))
    json->fail(json->shown() + " has no direction; accepted: an axis of some length");
  const Vec3 axis = along.normalized();
  const Vec3 cross = Vec3::UnitZ().cross(axis);
  const Quat turn(1.0 + axis.z(), cross.x(), cross.y(), cross.z());
  if (!(turn.norm() > 1e-6)) return Quat(0.0, 1.0, 0.0, 0.0);
  return turn.normalized();
}

bool readFlag(const Json& json, const char* key, bool usual) {
  const Json* value = json.find(key);
  return value == nullptr ? usual : value->asBoolean();
}

double readOr(const Json& json, const char* key, const Range& range, double usual) {
  const Json* value = json.find(key);
  return value == nullptr ? usual : readNumber(*value, range);
}

/// A place on a circle about the pattern's axis, and the turn that goes with it.
struct Round {
  Quat upright = Quat::Identity();
  bool turns = true;
  Pose at(double degrees, double radius_m, double height_m) const {
    const Quat turn = upright * rotationBy(Vec3(0.0, 0.0, radians(degrees)));
    const Vec3 place = turn * Vec3(radius_m, 0.0, height_m);
    return {turns ? (turn * upright.conjugate()).normalized() : Quat::Identity(), place};
  }
};

Round readRound(const Json& json) {
  return {uprightTo(json.find("axis")), readFlag(json, "turn", true)};
}

std::vector<Pose> readRow(const Json& json) {
  json.onlyKeys({"count", "step"});
  const int count = readCount(json);
  const Vec3 step_m = readVec3(json.at("step"), kCoordinate);
  std::vector<Pose> copies;
  for (int k = 0; k < count; ++k) copies.push_back({Quat::Identity(), k * step_m});
  return copies;
}

std::vector<Pose> readCircle(const Json& json) {
  json.onlyKeys({"count", "radius", "axis", "startDegrees", "turn"});
  const int count = readCount(json);
  const double radius_m = readNumber(json.at("radius"), kLength);
  const double start = readOr(json, "startDegrees", kDegrees, 0.0);
  const Round round = readRound(json);
  std::vector<Pose> copies;
  for (int k = 0; k < count; ++k) copies.push_back(round.at(start + 360.0 * k / count, radius_m, 0.0));
  return copies;
}

/// Both ends have a copy.
std::vector<Pose> readArc(const Json& json) {
  json.onlyKeys({"count", "radius", "axis", "fromDegrees", "toDegrees", "turn"});
  const int count = readCount(json);
  const double radius_m = readNumber(json.at("radius"), kLength);
  const double from = readNumber(json.at("fromDegrees"), kDegrees),
               to = readNumber(json.at("toDegrees"), kDegrees);
  const Round round = readRound(json);
  std::vector<Pose> copies;
  for (int k = 0; k < count; ++k)
    copies.push_back(round.at(from + (to - from) * k / std::max(1, count - 1), radius_m, 0.0));
  return copies;
}

std::vector<Pose> readSpiral(const Json& json) {
  json.onlyKeys({"count", "radius", "toRadius", "rise", "degrees", "axis", "startDegrees", "turn"});
  const int count = readCount(json);
  const double from_m = readNumber(json.at("radius"), kLength);
  const double to_m = readOr(json, "toRadius", kLength, from_m);
  const double rise_m = readOr(json, "rise", kCoordinate, 0.0);
  const double degrees = readNumber(json.at("degrees"), kDegrees);
  const double start = readOr(json, "startDegrees", kDegrees, 0.0);
  const Round round = readRound(json);
  std::vector<Pose> copies;
  for (int k = 0; k < count; ++k)
    copies.push_back(
        round.at(start + degrees * k, from_m + (to_m - from_m) * k / std::max(1, count - 1), rise_m * k));
  return copies;
}

std::vector<Pose> readStack(const Json& json) {
  json.onlyKeys({"count", "height", "degrees"});
  const int count = readCount(json);
  const double height_m = readNumber(json.at("height"), kLength);
  const double degrees = readOr(json, "degrees", kDegrees, 0.0);
  std::vector<Pose> copies;
  for (int k = 0; k < count; ++k)
    copies.push_back({rotationBy(Vec3(0.0, 0.0, radians(degrees * k))), Vec3(0.0, 0.0, height_m * k)});
  return copies;
}

/// In a box about the body's position, none nearer to another than `apart`; a place that is taken is drawn
/// again, a bounded number of times.
std::vector<Pose> readRandom(const Json& json) {
  constexpr int kMostTries = 2000;
  json.onlyKeys({"count", "size", "apart", "seed", "turn"});
  const int count = readCount(json);
  const Vec3 size_m = readVec3(json.at("size"), {0.0, kLargestLength_m});
  const double apart_m = readOr(json, "apart", {0.0, kLargestLength_m}, 0.0);
  const Json* seed = json.find("seed");
  RandomStream random(seed == nullptr ? 1 : static_cast<std::uint64_t>(readWhole(*seed, 0, kMostSeed)));
  const bool turns = readFlag(json, "turn", false);
  std::vector<Pose> copies;
  const auto isFree = [&](const Vec3& place) {
    return std::all_of(copies.begin(), copies.end(),
                       [&](const Pose& other) { return (other.position - place).norm() >= apart_m; });
  };
  for (int k = 0; k < count; ++k) {
    std::optional<Vec3> place;
    for (int tries = 0; tries < kMostTries && !place; ++tries) {
      const Vec3 drawn = 0.5 * size_m.cwiseProduct(random.vector());
      if (isFree(drawn)) place = drawn;
    }
    if (!place)
      json.fail("only " + std::to_string(k) + " of " + std::to_string(count) + " copies find room " +
                plainNumber(apart_m) +
                " m apart; accepted: fewer, a larger \"size\", or a smaller \"apart\"");
    Pose copy{Quat::Identity(), *place};
    if (turns) {
      const Vec3 axis = random.direction();
      copy.rotation = rotationBy(axis * (pi * random.signedUnit()));
    }
    copies.push_back(copy);
  }
  return copies;
}

/// One number counts along the step, which may point anywhere; three count along x, y and z.
void readLattice(const Json& json, Repeat& repeat, std::vector<std::string>& warnings) {
  const Json& count = json.at("count");
  const Json& step = json.at("step");
  if (count.kind() == Json::Kind::kNumber) {
    const int copies = readWhole(count, 1, kMostBodies);
    const Vec3 step_m = readVec3(step, kCoordinate);
    for (int k = 0; k < copies; ++k) repeat.copies.push_back({Quat::Identity(), k * step_m});
    return;
  }
  if (count.items().size() != 3)
    count.fail(count.shown() + " has " + std::to_string(count.items().size()) + " numbers; accepted: three");
  double total = 1.0;
  for (std::size_t i = 0; i < 3; ++i) {
    repeat.count[i] = readWhole(count.items()[i], 1, kMostBodies);
    total *= repeat.count[i];
  }
  if (total > kMostBodies)
    count.fail(count.shown() + " makes too many bodies; accepted: at most " + std::to_string(kMostBodies));
  repeat.step_m = readVec3(step, kCoordinate);
  for (Eigen::Index axis = 0; axis < 3; ++axis)
    if (repeat.count[axis] == 1 && repeat.step_m[axis] != 0.0 && total > 1.0) {
      const bool other_moves = (repeat.step_m.array() != 0.0).count() > 1;
      if (other_moves)
        warnings.push_back(where(step.items()[static_cast<std::size_t>(axis)]) + "the step along " +
                           "xyz"[axis] +
                           " is ignored, for there is one copy along it; for a row along any direction write "
                           "\"count\": " +
                           plainNumber(total));
    }
}

void turnEach(const Json& json, Repeat& repeat) {
  json.onlyKeys({"axis", "degrees"});
  const Vec3 axis = readVec3(json.at("axis"), kCoordinate);
  if (!(axis.norm() > kSmallestLength_m))
    json.at("axis").fail(json.at("axis").shown() + " has no direction; accepted: an axis of some length");
  repeat.turn_axis = axis.normalized();
  repeat.turn_degrees = readNumber(json.at("degrees"), kDegrees);
}

struct Pattern {
  const char* name;
  std::vector<Pose> (*read)(const Json&);
};
constexpr Pattern kPatterns[] = {{"row", readRow},       {"circle", readCircle}, {"arc", readArc},
                                 {"spiral", readSpiral}, {"stack", readStack},   {"random", readRandom}};

}  // namespace

Repeat readRepeat(const Json& json, std::vector<std::string>& warnings) {
  json.onlyKeys({"count", "step", "row", "circle", "arc", "spiral", "stack", "random", "rotation", "jitter",
                 "jitterDegrees"});
  Repeat repeat;
  int patterns = json.find("count") != nullptr || json.find("step") != nullptr ? 1 : 0;
  for (const Pattern& pattern : kPatterns)
    if (json.find(pattern.name) != nullptr) ++patterns;
  if (patterns != 1)
    json.fail(
        "accepted: \"count\" and \"step\", or one of \"row\", \"circle\", \"arc\", \"spiral\", \"stack\", "
        "\"random\"");
  for (const Pattern& pattern : kPatterns)
    if (const Json* value = json.find(pattern.name)) repeat.copies = pattern.read(*value);
  if (repeat.copies.empty()) readLattice(json, repeat, warnings);
  if (const Json* value = json.find("rotation")) turnEach(*value, repeat);
  if (const Json* jitter = json.find("jitter"))
    repeat.jitter_m = readNumber(*jitter, {0.0, kLargestLength_m});
  if (const Json* jitter = json.find("jitterDegrees"))
    repeat.jitter_degrees = readNumber(*jitter, {0.0, 180.0});
  return repeat;
}

void requireWithinReach(const Json& json, const Body& body) {
  const Repeat& repeat = body.repeat;
  const auto require = [&](double farthest_m, Eigen::Index axis) {
    if (farthest_m > kLargestLength_m)
      json.fail("the copies reach to " + plainNumber(farthest_m) + " m along " + "xyz"[axis] +
                "; accepted: " + shown(kCoordinate));
  };
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const double last_m = body.X_WS.position[axis] + (repeat.count[axis] - 1) * repeat.step_m[axis];
    require(std::max(std::abs(last_m), std::abs(body.X_WS.position[axis])) + repeat.jitter_m, axis);
    for (const Pose& copy : repeat.copies)
      require(std::abs(body.X_WS.position[axis] + copy.position[axis]) + repeat.jitter_m, axis);
  }
}

}  // namespace carom::demos
