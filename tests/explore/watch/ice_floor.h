#pragma once
// The one static body of a world, where it is a floor without friction: a convex polyhedron, over one face of
// which all bodies that move are. Nothing but the inside of that face can touch them, so that it pushes them
// along its normal only. Tested in tests/explore/watch/momentum_watch_test.cpp.

#include <algorithm>
#include <optional>

#include "tests/explore/watch/own_mechanics.h"

namespace carom::explore {

/// Then nothing rubs on it, whatever the other's material: two coefficients combine to their geometric mean.
inline bool isFrictionless(const Material& m) {
  return m.static_friction == 0.0 && m.dynamic_friction == 0.0 && m.rolling_resistance_m == 0.0 &&
         m.spinning_resistance_m == 0.0;
}

class IceFloor {
 public:
  /// None: there are other bodies than one static one and `bodies`, or it is no such floor, or a body is not
  /// over a face.
  static std::optional<IceFloor> of(const World& world, std::span<const OwnBody> bodies) {
    const auto all = world.bodies();
    const auto fixed =
        std::find_if(all.begin(), all.end(), [](const BodyDescription& d) { return d.is_static; });
    if (bodies.empty() || fixed == all.end() || bodies.size() + 1 != all.size()) return std::nullopt;
    const Solid& solid = world.solids()[static_cast<std::size_t>(fixed->solid)];
    const ConvexPart& part = solid.parts().front();
    if (!isFrictionless(fixed->material) || solid.parts().size() != 1 || part.radius_m > 0.0)
      return std::nullopt;
    IceFloor floor(world, bodies, fixed->X_WB, part.core);
    for (; floor.face_ < part.core.faceCount(); ++floor.face_)
      if (floor.isBelow(world.states(), world.states())) return floor;
    return std::nullopt;
  }

  /// Unit, out of the floor.
  Vec3R normal() const {
    return X_WF_.rotation.cast<Real>().normalized() * core_->plane(face_).normal.cast<Real>().normalized();
  }

  /// Whether each body is over the face at the end of a step, and farther within its sides than its speeds at
  /// both ends of the step could have taken it beyond them in between.
  bool isBelow(std::span<const BodyState> before, std::span<const BodyState> states) const {
    const Pose X_FW = X_WF_.inverse();
    return std::all_of(bodies_.begin(), bodies_.end(), [&](const OwnBody& body) {
      const auto i = static_cast<std::size_t>(body.index);
      const double speed = before[i].linear_velocity.norm() + states[i].linear_velocity.norm();
      const double wide = static_cast<double>(body.reach_m) + dt_s_ * speed;
      const Vec3 center_F = X_FW * states[i].X_WB.position;
      const auto sides = core_->faceSides(face_);
      return core_->plane(face_).signedDistance(center_F) > 0.0 &&
             std::all_of(sides.begin(), sides.end(), [&center_F, wide](const Plane& side) {
               return side.signedDistance(center_F) > wide;
             });
    });
  }

 private:
  IceFloor(const World& world, std::span<const OwnBody> bodies, const Pose& X_WF,
           const ConvexPolyhedron& core)
      : bodies_(bodies), dt_s_(world.settings().step_s), X_WF_(X_WF), core_(&core) {}

  std::span<const OwnBody> bodies_;
  double dt_s_ = 0.0;
  Pose X_WF_;
  const ConvexPolyhedron* core_;
  int face_ = 0;
};

}  // namespace carom::explore
