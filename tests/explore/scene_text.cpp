#include "tests/explore/scene_text.h"

#include <cmath>

#include "demos/format/json.h"
#include "demos/language/scene_file.h"

namespace carom::explore {
namespace {

using demos::Json;

Json numbers(const Vec3& v) {
  return Json::array({v.x(), v.y(), v.z()});
}

void setPose(Json& json, const Pose& X) {
  json.set("position", numbers(X.position));
  if (!(X.rotation.vec().isZero(0.0)))
    json.set("rotation", Json::array({X.rotation.w(), X.rotation.x(), X.rotation.y(), X.rotation.z()}));
}

Json shapeJson(const demos::Shape& shape);

Json formJson(const demos::BoxShape& box) {
  return Json::object({{"box", numbers(box.size_m)}});
}
Json formJson(const demos::SphereShape& sphere) {
  return Json::object({{"sphere", Json::object({{"radius", sphere.radius_m}})}});
}
Json formJson(const demos::CapsuleShape& capsule) {
  return Json::object(
      {{"capsule", Json::object({{"radius", capsule.radius_m}, {"length", capsule.length_m}})}});
}
Json formJson(const demos::HullShape& hull) {
  if (!hull.file.empty()) {
    // Of the assets: named as a scene beside them names it.
    Json mesh = Json::object({{"file", "meshes/" + hull.file.filename().string()}});
    if (hull.fit_m) mesh.set("fit", *hull.fit_m);
    return Json::object({{hull.as_hull ? "hull" : "mesh", std::move(mesh)}});
  }
  Json points = Json::array();
  for (const Vec3& p : hull.points) points.push(numbers(hull.scale * p));
  return Json::object({{"hull", Json::object({{"points", std::move(points)}})}});
}
Json formJson(const demos::RoundedBoxShape& box) {
  return Json::object(
      {{"roundedBox", Json::object({{"size", numbers(box.size_m)}, {"radius", box.radius_m}})}});
}
Json formJson(const demos::CompoundShape& compound) {
  Json parts = Json::array();
  for (const demos::CompoundPart& part : compound.parts) {
    Json json = Json::object({{"shape", shapeJson(part.shape)}});
    setPose(json, part.X_SP);
    parts.push(std::move(json));
  }
  return Json::object({{"compound", std::move(parts)}});
}

Json shapeJson(const demos::Shape& shape) {
  return std::visit([](const auto& form) { return formJson(form); }, shape.form);
}

Json materialJson(const demos::Body& body) {
  const Material& m = body.material;
  Json json = Json::object({{"staticFriction", m.static_friction},
                            {"dynamicFriction", m.dynamic_friction},
                            {"restitution", m.restitution}});
  if (!body.mass_kg) json.set("density", m.density_kgpm3);  // one of them
  return json;
}

Json kinematicJson(const demos::Body& body) {
  if (body.keyframes.empty()) return Json(true);
  Json keys = Json::array();
  for (const Keyframe& key : body.keyframes) {
    Json json = Json::object({{"time", key.time_s}});
    setPose(json, key.X_WB);
    keys.push(std::move(json));
  }
  return Json::object({{"interpolation", body.interpolation == Interpolation::kSmooth ? "smooth" : "linear"},
                       {"repeats", body.path_repeats},
                       {"keyframes", std::move(keys)}});
}

Json locksJson(const AxisLocks& locks) {
  Json names = Json::array();
  constexpr const char* kMoving[] = {"x", "y", "z"};
  constexpr const char* kTurning[] = {"turnX", "turnY", "turnZ"};
  for (int i = 0; i < 3; ++i)
    if (locks.free_axes[i] == 0.0) names.push(kMoving[i]);
  for (int i = 0; i < 3; ++i)
    if (locks.turning == AxisLocks::Turning::kLocked ||
        (locks.turning == AxisLocks::Turning::kOneAxis && locks.axis_W[i] == 0.0))
      names.push(kTurning[i]);
  return names;
}

Json bodyJson(const demos::Body& body) {
  Json json = Json::object({{"name", body.name}});
  if (body.is_static) json.set("static", true);
  json.set("shape", shapeJson(body.shape));
  if (body.is_kinematic) json.set("kinematic", kinematicJson(body));
  if (body.keyframes.empty()) setPose(json, body.X_WS);
  if (body.locks.any()) json.set("locked", locksJson(body.locks));
  if (body.mass_kg) json.set("mass", *body.mass_kg);
  if (!body.load.force_W.isZero(0.0)) json.set("force", numbers(body.load.force_W));
  if (!body.load.torque_W.isZero(0.0)) json.set("torque", numbers(body.load.torque_W));
  if (!body.load.force_B.isZero(0.0)) json.set("bodyForce", numbers(body.load.force_B));
  if (!body.load.torque_B.isZero(0.0)) json.set("bodyTorque", numbers(body.load.torque_B));
  if (!body.linear_velocity.isZero(0.0)) json.set("linearVelocity", numbers(body.linear_velocity));
  if (!body.angular_velocity.isZero(0.0)) json.set("angularVelocity", numbers(body.angular_velocity));
  json.set("material", materialJson(body));
  return json;
}

Json fluidJson(const demos::NamedFluid& named) {
  const Fluid& fluid = named.fluid;
  Json json = Json::object({{"name", named.name}});
  if (std::isfinite(fluid.min.x()))
    json.set("box", Json::object({{"min", numbers(fluid.min)}, {"max", numbers(fluid.max)}}));
  else
    json.set("level", fluid.max.z());
  json.set("density", fluid.density_kgpm3);
  json.set("drag", fluid.drag);
  json.set("linearDrag", fluid.linear_drag_mps);
  json.set("flow", numbers(fluid.flow));
  json.set("addedMass", fluid.added_mass);
  Json waves = Json::array();
  for (const Wave& wave : fluid.waves)
    waves.push(Json::object({{"amplitude", wave.amplitude_m},
                             {"wavelength", wave.wavelength_m},
                             {"direction", Json::array({wave.direction.x(), wave.direction.y()})}}));
  if (!fluid.waves.empty()) json.set("waves", std::move(waves));
  return json;
}

}  // namespace

std::string sceneText(const demos::Scene& scene) {
  Json json = Json::object({{"format", 1},
                            {"description", scene.description},
                            {"rate", scene.rate_hz},
                            {"duration", scene.duration_s},
                            {"gravity", numbers(scene.gravity)}});
  if (scene.air.density_kgpm3 > 0.0)
    json.set("air", Json::object({{"density", scene.air.density_kgpm3},
                                  {"wind", numbers(scene.air.wind)},
                                  {"skinFriction", scene.air.skin_friction}}));
  if (!scene.fluids.empty()) {
    Json fluids = Json::array();
    for (const demos::NamedFluid& fluid : scene.fluids) fluids.push(fluidJson(fluid));
    json.set("fluids", std::move(fluids));
  }
  Json bodies = Json::array();
  for (const demos::Body& body : scene.bodies) bodies.push(bodyJson(body));
  json.set("bodies", std::move(bodies));
  return json.text(1);
}

demos::Scene readBack(const demos::Scene& scene) {
  return demos::parseScene(sceneText(scene), "explored.json");
}

}  // namespace carom::explore
