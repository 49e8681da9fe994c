#include "demos/scene/scene_caption.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/environment/gravity.h"
#include "engine/motion/rigid_body.h"

namespace carom::demos {
namespace {

double degrees(double radians) {
  return radians * 180.0 / std::numbers::pi;
}

Inertia inertiaOfBody(const World& world, std::size_t body) {
  const Solid& solid = world.solids()[static_cast<std::size_t>(world.bodies()[body].solid)];
  const double density = world.mass(static_cast<int>(body)) / solid.volume();
  return inertiaOf(density, solid.volume(), solid.unitInertia());
}

bool movesFreely(const BodyDescription& body) {
  return !body.is_static && !body.is_kinematic;
}

}  // namespace

SceneCaption::SceneCaption(const Scene& scene, const SceneWorld& start)
    : world_(start.world), text_(scene.caption) {
  for (const CaptionPart& part : text_.parts)
    for (const BodyQuantity& quantity : part.bodies) {
      const auto found = std::find(start.names.begin(), start.names.end(), quantity.body);
      REQUIRE(found != start.names.end(), quantity.body);  // the reader has refused unknown ones
      index_[quantity.body] = static_cast<std::size_t>(found - start.names.begin());
    }
  for (const BodyState& state : start.world.states()) start_.push_back(state.X_WB);
}

double SceneCaption::kineticEnergyOf(std::size_t body, const BodyState& state) const {
  if (!movesFreely(world_.bodies()[body])) return 0.0;
  return kineticEnergy(inertiaOfBody(world_, body), state.X_WB.rotation,
                       {state.linear_velocity, state.angular_velocity});
}

double SceneCaption::bodyFigure(const BodyQuantity& quantity, std::span<const BodyState> bodies) const {
  const std::size_t body = index_.at(quantity.body);
  const BodyState& state = bodies[body];
  const std::string& name = quantity.quantity;
  const auto component = [&](const Vec3& v) { return v[name.back() - 'x']; };
  if (name.size() == 1) return component(state.X_WB.position);
  if (name.size() == 2) return component(name[0] == 'v' ? state.linear_velocity : state.angular_velocity);
  if (name == "speed") return state.linear_velocity.norm();
  if (name == "spin") return state.angular_velocity.norm();
  if (name == "energy") return kineticEnergyOf(body, state);
  if (name == "moved") return (state.X_WB.position - start_[body].position).norm();
  if (name == "turned") return degrees(state.X_WB.rotation.angularDistance(start_[body].rotation));
  REQUIRE(name == "tilt", name);
  return degrees(std::acos(std::clamp((state.X_WB.rotation * Vec3::UnitZ()).eval().z(), -1.0, 1.0)));
}

double SceneCaption::sceneFigure(const std::string& name, double time_s,
                                 std::span<const BodyState> bodies) const {
  if (name == "time") return time_s;
  double sum = 0.0;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (!movesFreely(world_.bodies()[i])) continue;
    sum += kineticEnergyOf(i, bodies[i]);
    if (name == "energy")
      sum += gravityPotential(inertiaOfBody(world_, i), world_.settings().gravity, bodies[i].X_WB.position);
  }
  return sum;
}

std::string SceneCaption::at(double time_s, std::span<const BodyState> bodies) const {
  return captionLine(text_, {[&](const std::string& name) { return sceneFigure(name, time_s, bodies); },
                             [&](const BodyQuantity& quantity) { return bodyFigure(quantity, bodies); }});
}

}  // namespace carom::demos
