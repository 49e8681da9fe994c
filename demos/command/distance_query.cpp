#include "demos/command/distance_query.h"

#include <charconv>
#include <cmath>
#include <limits>
#include <vector>

#include "demos/scene/shape_solid.h"
#include "demos/system/exit_code.h"
#include "engine/foundation/contract.h"

namespace carom::demos {
namespace {

// A quaternion farther from length one than this is a mistake, not rounding.
constexpr double kUnitTolerance = 1e-3;
// Farther out, the coordinates of a double are coarser than a tenth of a millimetre.
constexpr double kFarthest_m = 1e12;

constexpr const char* kAcceptedRotation = "accepted: a unit quaternion w, x, y, z";
constexpr const char* kAcceptedPosition = "accepted: three numbers from -1e12 to 1e12";

bool withinReach(const Vec3& p) {
  return p.allFinite() && p.cwiseAbs().maxCoeff() <= kFarthest_m;
}

bool nearlyUnit(const Quat& q) {
  return std::abs(q.norm() - 1.0) <= kUnitTolerance;
}

/// The numbers of a list with commas; empty when something in it is no number.
std::vector<double> numbersOf(const std::string& text) {
  std::vector<double> numbers;
  const char* at = text.data();
  const char* const end = at + text.size();
  for (;;) {
    while (at != end && *at == ' ') ++at;
    double number = 0.0;
    const auto [after, failed] = std::from_chars(at, end, number);
    if (failed != std::errc{}) return {};
    numbers.push_back(number);
    at = after;
    while (at != end && *at == ' ') ++at;
    if (at == end) return numbers;
    if (*at++ != ',') return {};
  }
}

std::vector<double> readNumbers(const Json& json, std::size_t count, const char* accepted) {
  std::vector<double> numbers;
  for (const Json& item : json.items()) numbers.push_back(item.asNumber());
  if (numbers.size() != count)
    json.fail(json.shown() + " has " + std::to_string(numbers.size()) + " numbers; " + accepted);
  return numbers;
}

Vec3 readPosition(const Json& json) {
  const std::vector<double> p = readNumbers(json, 3, kAcceptedPosition);
  const Vec3 position(p[0], p[1], p[2]);
  if (!withinReach(position)) json.fail(json.shown() + " is out of range; " + kAcceptedPosition);
  return position;
}

Quat readRotation(const Json& json) {
  const std::vector<double> q = readNumbers(json, 4, kAcceptedRotation);
  const Quat rotation(q[0], q[1], q[2], q[3]);
  if (!nearlyUnit(rotation)) json.fail(json.shown() + " is not of length 1; " + kAcceptedRotation);
  return rotation.normalized();
}

Pose readPose(const Json& json) {
  json.onlyKeys({"position", "rotation"});
  Pose pose;
  if (const Json* position = json.find("position")) pose.position = readPosition(*position);
  if (const Json* rotation = json.find("rotation")) pose.rotation = readRotation(*rotation);
  return pose;
}

const char* nameOf(Separation status) {
  switch (status) {
    case Separation::kSeparated:
      return "separated";
    case Separation::kTouching:
      return "touching";
    case Separation::kPenetrating:
      return "penetrating";
  }
  return "";
}

Json toJson(const Vec3& v) {
  return Json::array({v.x(), v.y(), v.z()});
}

Json toJson(const Feature& feature) {
  const char* kind = feature.kind == FeatureKind::kVertex ? "vertex"
                     : feature.kind == FeatureKind::kEdge ? "edge"
                                                          : "face";
  return Json::object({{"kind", kind}, {"index", feature.index}});
}

}  // namespace

Pose poseFromText(const std::string& text, const std::string& option) {
  const std::vector<double> n = numbersOf(text);
  if (n.size() != 3 && n.size() != 7)
    throw UsageError(option + " " + text + ": accepted: x,y,z or x,y,z,qw,qx,qy,qz");
  Pose pose;
  pose.position = Vec3(n[0], n[1], n[2]);
  if (!withinReach(pose.position)) throw UsageError(option + " " + text + ": position: " + kAcceptedPosition);
  if (n.size() == 3) return pose;
  pose.rotation = Quat(n[3], n[4], n[5], n[6]);
  if (!nearlyUnit(pose.rotation)) throw UsageError(option + " " + text + ": rotation: " + kAcceptedRotation);
  pose.rotation.normalize();
  return pose;
}

DistanceQuery readDistanceQuery(const Json& json) {
  json.onlyKeys({"a", "b", "poseA", "poseB"});
  DistanceQuery query;
  query.a = json.at("a").asString();
  query.b = json.at("b").asString();
  if (const Json* pose = json.find("poseA")) query.X_WA = readPose(*pose);
  if (const Json* pose = json.find("poseB")) query.X_WB = readPose(*pose);
  return query;
}

HullStore::Entry HullStore::load(const std::string& file) {
  try {
    Entry entry{{meshHull(file), 0.0}, std::nullopt};
    for (const Vec3& p : entry.part.core.vertices())
      if (!withinReach(p)) throw InputError(file + ": a vertex is out of range; " + kAcceptedPosition);
    return entry;
  } catch (const InputError& error) {
    return {{}, error.what()};
  }
}

const ConvexPart& HullStore::hullOf(const std::string& file) {
  auto found = entries_.find(file);
  if (found == entries_.end()) found = entries_.emplace(file, load(file)).first;
  if (found->second.refusal) throw InputError(*found->second.refusal);
  return found->second.part;
}

Json DistanceAnswers::answer(const DistanceQuery& query) {
  const ConvexPart& a = hulls_.hullOf(query.a);
  const ConvexPart& b = hulls_.hullOf(query.b);
  if (start_ == Start::kCold || query.a != last_a_ || query.b != last_b_) memory_ = {};
  last_a_ = query.a;
  last_b_ = query.b;
  const ClosestFeatures closest = closestFeatures(a, query.X_WA, b, query.X_WB, memory_);
  return Json::object({{"status", nameOf(closest.status)},
                       {"distance", closest.distance_m},
                       {"pointA", toJson(closest.p_A_W)},
                       {"pointB", toJson(closest.p_B_W)},
                       {"normal", toJson(closest.n_W)},
                       {"featureA", toJson(closest.features.a)},
                       {"featureB", toJson(closest.features.b)}});
}

}  // namespace carom::demos
