#include "demos/language/scene_motion.h"

#include <cmath>
#include <optional>
#include <string>

#include "demos/language/scene_values.h"

namespace carom::demos {
namespace {

constexpr double kSameTurn = 1e-3;  // rad: written numbers mean one orientation, but for rounding
constexpr double kLongestTime_s = 1e6;
// As long as the shortest step: the legs of a path that repeats are gone through in each step, however many.
constexpr double kShortestLeg_s = 1e-5;
constexpr double kLargestMass_kg = 1e21;
constexpr double kLargestLoad = 1e12;  // N and N m
// Masses come from densities and volumes of any size: what is accepted of them is said where both are known.
constexpr Range kMass{0.0, kLargestMass_kg, true};
constexpr Range kLoad{-kLargestLoad, kLargestLoad};
constexpr Range kAnyNumber{-1e9, 1e9};  // of what has been read already
constexpr double kHalfTurn_deg = 180.0 + 1e-9;

Keyframe readKeyframe(const Json& json) {
  json.onlyKeys({"time", "position", "rotation"});
  return {readNumber(json.at("time"), {0.0, kLongestTime_s}), readPose(json)};
}

struct WrittenTurn {
  std::optional<Vec3> axis;  // none: it is not turned
  double degrees = 0.0;
};

// Nothing where it is written in another way.
std::optional<WrittenTurn> writtenTurn(const Json& keyframe) {
  const Json* rotation = keyframe.find("rotation");
  if (rotation == nullptr) return WrittenTurn{};
  if (rotation->kind() != Json::Kind::kObject) return std::nullopt;
  const Json *axis = rotation->find("axis"), *degrees = rotation->find("degrees");
  if (axis == nullptr || degrees == nullptr) return std::nullopt;
  return WrittenTurn{readVec3(*axis, kAnyNumber), readNumber(*degrees, kAnyNumber)};
}

// About an axis that both name; nothing where they do not.
std::optional<double> degreesBetween(const Json& from, const Json& to) {
  const std::optional<WrittenTurn> before = writtenTurn(from), after = writtenTurn(to);
  if (!before || !after || (before->axis && after->axis && *before->axis != *after->axis))
    return std::nullopt;
  return after->degrees - before->degrees;
}

// A leg goes the shorter way round, which is not what more than half a turn about an axis asks for.
void requireShorterTurn(const Json& from, const Json& to) {
  const std::optional<double> degrees = degreesBetween(from, to);
  if (degrees && std::abs(*degrees) > kHalfTurn_deg)
    to.at("rotation")
        .fail("turns by " + plainNumber(*degrees) +
              " degrees from the keyframe before, and a path goes the shorter way round; "
              "accepted: at most 180 from each keyframe to the next");
}

void readKeyframes(const Json& json, Body& body) {
  if (json.items().empty()) json.fail("accepted: at least one keyframe");
  for (const Json& item : json.items()) {
    const Keyframe keyframe = readKeyframe(item);
    if (!body.keyframes.empty() && !(keyframe.time_s > body.keyframes.back().time_s))
      item.at("time").fail(item.at("time").shown() +
                           " is not after the keyframe before; accepted: times that rise");
    if (!body.keyframes.empty()) requireShorterTurn(json.items()[body.keyframes.size() - 1], item);
    body.keyframes.push_back(keyframe);
  }
}

/// A smooth leg speeds up evenly from rest for half of its time and brakes evenly: its mean speed is half of
/// its peak (engine/motion/prescribed_path.h).
double peakOverMean(Interpolation interpolation) {
  return interpolation == Interpolation::kSmooth ? 2.0 : 1.0;
}

/// A path is as fast as any other body may be, at its fastest.
void requireSpeeds(const Json& keyframes, const Body& body) {
  for (std::size_t k = 1; k < body.keyframes.size(); ++k) {
    const Keyframe &from = body.keyframes[k - 1], &to = body.keyframes[k];
    const double peak = peakOverMean(body.interpolation);
    const auto require = [&](double way, const char* unit) {
      const double speed = way * peak / (to.time_s - from.time_s);
      if (!(speed <= kSpeed.high))
        keyframes.items()[k].fail("takes " + plainNumber(speed) + unit + " from the keyframe before, " +
                                  plainNumber(to.time_s - from.time_s) + " s earlier; accepted: at most " +
                                  plainNumber(kSpeed.high));
    };
    require((to.X_WB.position - from.X_WB.position).norm(), " m/s");
    require(from.X_WB.rotation.angularDistance(to.X_WB.rotation), " rad/s");
  }
}

bool isSamePose(const Pose& a, const Pose& b) {
  return a.position == b.position && a.rotation.angularDistance(b.rotation) < kSameTurn;
}

void requireRound(const Json& repeats, const std::vector<Keyframe>& keyframes) {
  const Keyframe &first = keyframes.front(), &last = keyframes.back();
  if (!isSamePose(first.X_WB, last.X_WB))
    repeats.fail("the last keyframe is not where the first is; accepted: a path that ends as it begins");
  const double round_s = last.time_s - first.time_s;
  const double shortest_s = kShortestLeg_s * static_cast<double>(keyframes.size() - 1);
  if (round_s < shortest_s)
    repeats.fail("the path takes " + plainNumber(round_s) + " s; accepted: at least " +
                 plainNumber(shortest_s) + " s, " + plainNumber(kShortestLeg_s) +
                 " s from each keyframe to the next");
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
  requireSpeeds(json.at("keyframes"), body);
  if (const Json* repeats = json.find("repeats")) {
    body.path_repeats = repeats->asBoolean();
    if (body.path_repeats) requireRound(*repeats, body.keyframes);
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

}  // namespace

void readMotion(const Json& json, Body& body) {
  if (const Json* kinematic = json.find("kinematic")) readKinematic(*kinematic, body);
  if (const Json* mass = json.find("mass")) body.mass_kg = readNumber(*mass, kMass);
  if (const Json* locked = json.find("locked")) body.locks = readLocks(*locked);
  readLoad(json, body.load);
}

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

}  // namespace carom::demos
