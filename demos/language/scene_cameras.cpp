#include "demos/language/scene_cameras.h"

#include <algorithm>

#include "demos/format/nearest_name.h"
#include "demos/language/scene_values.h"

namespace carom::demos {
namespace {

constexpr double kLongestTime_s = 1e6;
constexpr std::size_t kMostPoints = 1000;  // Of a path: more are no path that a person wrote.
constexpr Range kFov{1.0, 150.0};

void requireApart(const Vec3& a, const Vec3& b, const Json& json, const char* what) {
  if (!((a - b).norm() > kSmallestLength_m)) json.fail(what);
}

void readStill(const Json& json, SceneCamera& camera) {
  json.onlyKeys({"eye", "target", "fovDegrees", "aperture", "focus"});
  camera.eye = readVec3(json.at("eye"), kCoordinate);
  camera.target = readVec3(json.at("target"), kCoordinate);
  requireApart(camera.eye, camera.target, json, "eye and target coincide");
}

Vec3 readOffset(const Json& json) {
  const Vec3 offset = readVec3(json, kCoordinate);
  if (!(offset.norm() > kSmallestLength_m))
    json.fail(json.shown() + " has no direction; accepted: a vector of some length");
  return offset;
}

void readFit(const Json& json, SceneCamera& camera) {
  json.onlyKeys({"fit", "direction", "fovDegrees", "aperture", "focus"});
  if (!json.at("fit").asBoolean()) json.at("fit").fail("accepted: true, or another kind of camera");
  FitView fit;
  if (const Json* direction = json.find("direction")) fit.direction = readOffset(*direction);
  camera.motion = fit;
}

void readFrame(const Json& json, SceneCamera& camera) {
  json.onlyKeys({"frame", "direction", "fill", "fovDegrees", "aperture", "focus"});
  const Json& what = json.at("frame");
  if (what.asString() != "moving") what.fail(what.shown() + " is unknown; accepted: \"moving\"");
  FrameMoving frame;
  if (const Json* direction = json.find("direction")) frame.direction = readOffset(*direction);
  if (const Json* fill = json.find("fill")) frame.fill = readNumber(*fill, {0.05, 1.0});
  camera.motion = frame;
}

void readFollow(const Json& json, const BodyNames& names, SceneCamera& camera) {
  json.onlyKeys({"follow", "offset", "fovDegrees", "aperture", "focus"});
  FollowBody follow{json.at("follow").asString(), {}};
  names.require(follow.body, json.at("follow"));
  if (const Json* offset = json.find("offset")) follow.offset_m = readOffset(*offset);
  camera.motion = follow;
}

void readOrbit(const Json& json, SceneCamera& camera) {
  json.onlyKeys({"orbit", "fovDegrees", "aperture", "focus"});
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

CameraKeyframes::Key readKey(const Json& json, double fov_degrees) {
  json.onlyKeys({"time", "eye", "target", "fovDegrees"});
  CameraKeyframes::Key key;
  key.time_s = readNumber(json.at("time"), {0.0, kLongestTime_s});
  key.camera.eye = readVec3(json.at("eye"), kCoordinate);
  key.camera.target = readVec3(json.at("target"), kCoordinate);
  key.camera.fov_degrees = fov_degrees;
  if (const Json* fov = json.find("fovDegrees")) key.camera.fov_degrees = readNumber(*fov, kFov);
  requireApart(key.camera.eye, key.camera.target, json, "eye and target coincide");
  return key;
}

/// `fovDegrees` of the camera is that of the keyframes without their own.
void readKeyframes(const Json& json, SceneCamera& camera) {
  json.onlyKeys({"keyframes", "interpolation", "fovDegrees", "aperture", "focus"});
  const Json& list = json.at("keyframes");
  if (list.items().empty() || list.items().size() > kMostPoints)
    list.fail(std::to_string(list.items().size()) + " keyframes; accepted: 1 to " +
              std::to_string(kMostPoints));
  CameraKeyframes path;
  for (const Json& item : list.items()) {
    path.keys.push_back(readKey(item, camera.fov_degrees));
    if (path.keys.size() > 1 && !(path.keys.back().time_s > path.keys[path.keys.size() - 2].time_s))
      item.at("time").fail(item.at("time").shown() +
                           " is not after the keyframe before; accepted: times that rise");
  }
  if (const Json* how = json.find("interpolation")) {
    const std::string& name = how->asString();
    if (name != "linear" && name != "smooth")
      how->fail(how->shown() + " is unknown; accepted: linear, smooth");
    path.smooth = name == "smooth";
  }
  camera.eye = path.keys.front().camera.eye;
  camera.target = path.keys.front().camera.target;
  camera.fov_degrees = path.keys.front().camera.fov_degrees;
  camera.motion = path;
}

void readDolly(const Json& json, const BodyNames& names, double duration_s, SceneCamera& camera) {
  json.onlyKeys({"dolly", "fovDegrees", "aperture", "focus"});
  const Json& written = json.at("dolly");
  written.onlyKeys({"points", "target", "start", "seconds", "ease"});
  Dolly dolly;
  dolly.seconds = duration_s;
  const Json& points = written.at("points");
  if (points.items().size() < 2 || points.items().size() > kMostPoints)
    points.fail(std::to_string(points.items().size()) + " points; accepted: 2 to " +
                std::to_string(kMostPoints));
  for (const Json& point : points.items()) {
    const Vec3 p = readVec3(point, kCoordinate);
    if (!dolly.points.empty())
      requireApart(p, dolly.points.back(), point, "the same as the point before; accepted: another place");
    dolly.points.push_back(p);
  }
  const Json& target = written.at("target");
  if (target.kind() == Json::Kind::kString) {
    names.require(target.asString(), target);
    dolly.body = target.asString();
  } else {
    camera.target = readVec3(target, kCoordinate);
  }
  if (const Json* value = written.find("start")) dolly.start_s = readNumber(*value, {0.0, kLongestTime_s});
  if (const Json* value = written.find("seconds"))
    dolly.seconds = readNumber(*value, {0.0, kLongestTime_s, true});
  if (const Json* value = written.find("ease")) dolly.eased = value->asBoolean();
  camera.eye = dolly.points.front();
  camera.motion = dolly;
}

}  // namespace

BodyNames::BodyNames(const std::vector<Body>& bodies) {
  for (const Body& body : bodies)
    for (int copy = 0; copy < body.repeat.total(); ++copy) in_order.push_back(nameOfCopy(body, copy));
  sorted = in_order;
  std::sort(sorted.begin(), sorted.end());
}

void BodyNames::require(const std::string& name, const Json& place) const {
  if (!std::binary_search(sorted.begin(), sorted.end(), name))
    place.fail("unknown body \"" + name + "\"" + acceptedNames(name, in_order));
}

SceneCamera readCamera(const Json& json, const BodyNames& names, double duration_s) {
  json.onlyKeys({"eye", "target", "fovDegrees", "fit", "direction", "frame", "fill", "follow", "offset",
                 "orbit", "keyframes", "interpolation", "dolly", "aperture", "focus"});
  SceneCamera camera;
  if (const Json* fov = json.find("fovDegrees")) camera.fov_degrees = readNumber(*fov, kFov);
  if (const Json* value = json.find("aperture")) camera.aperture_m = readNumber(*value, {0.0, 1000.0});
  if (const Json* value = json.find("focus")) camera.focus_m = readNumber(*value, kLength);
  if (json.find("fit") != nullptr)
    readFit(json, camera);
  else if (json.find("frame") != nullptr)
    readFrame(json, camera);
  else if (json.find("follow") != nullptr)
    readFollow(json, names, camera);
  else if (json.find("orbit") != nullptr)
    readOrbit(json, camera);
  else if (json.find("keyframes") != nullptr)
    readKeyframes(json, camera);
  else if (json.find("dolly") != nullptr)
    readDolly(json, names, duration_s, camera);
  else
    readStill(json, camera);
  return camera;
}

}  // namespace carom::demos
