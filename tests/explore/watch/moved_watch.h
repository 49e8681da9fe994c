#pragma once
// Oracle: a kinematic body at constant velocity is where that takes it, unless it was stopped and is late; a
// body with locked axes neither moves along nor turns about them, from the pose that its description gives
// it: the start may not move it there either. Tested in tests/explore/watch/moved_watch_test.cpp.

#include "engine/simulation/world.h"
#include "tests/explore/finding.h"

namespace carom::explore {

class MovedWatch {
 public:
  explicit MovedWatch(const World& world) : world_(world) {}

  /// `late_s` is the most that any kinematic body has been stopped for.
  void look(std::span<const BodyState> states, double late_s, int step, Findings& findings) const {
    const double time_s = step * world_.settings().step_s;
    for (std::size_t i = 0; i < states.size(); ++i) {
      const BodyDescription& body = world_.bodies()[i];
      if (body.is_kinematic && body.keyframes.empty() && late_s == 0.0) {
        const Vec3 expected = body.X_WB.position + time_s * body.linear_velocity;
        report("path", (states[i].X_WB.position - expected).norm(), expected.norm() + radius(i), step,
               findings);
      }
      if (!body.locks.any()) continue;
      const Vec3 moved = states[i].X_WB.position - body.X_WB.position;
      report("locked", (moved - body.locks.movingPart(moved)).norm(), body.X_WB.position.norm() + radius(i),
             step, findings);
      if (body.locks.turning == AxisLocks::Turning::kFree) continue;
      const Quat turned = states[i].X_WB.rotation * body.X_WB.rotation.conjugate();
      report("locked", (turned.vec() - body.locks.turningPart(turned.vec())).norm(), 1.0, step, findings);
    }
  }

 private:
  // Sums of up to a hundred steps, each rounded some times.
  static constexpr double kRounding = 0x1p-40;

  double radius(std::size_t body) const {
    return world_.solids()[static_cast<std::size_t>(world_.bodies()[body].solid)].radius();
  }
  static void report(const char* kind, double off, double scale, int step, Findings& findings) {
    if (off > kRounding * scale) findings.add(kind, off / scale, step, "share of the place and size");
  }

  const World& world_;
};

}  // namespace carom::explore
