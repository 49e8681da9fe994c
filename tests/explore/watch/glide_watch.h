#pragma once
// Oracle: what slides over flush tiles without friction keeps its speed and its height (the ghost collision).
// Judges scenes that say so: one body that moves, without spin, over static boxes laid along x with their
// tops at z = 0; until it leaves them. Tested in tests/explore/watch/world_judge_test.cpp.

#include <cmath>

#include "demos/scene/scene.h"
#include "tests/explore/watch/energy_watch.h"

namespace carom::explore {

constexpr double kGlideBar = 1e-6;  // of the speed, and metres of height

class GlideWatch {
 public:
  GlideWatch(const demos::Scene& scene, const World& world) : scene_(scene) {
    if (scene.description.find("glide") == std::string::npos) return;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
      const demos::Body& body = scene.bodies[i];
      if (body.material.static_friction > 0.0 || body.material.restitution > 0.0) return;
      if (body.is_static) {
        const auto* box = std::get_if<demos::BoxShape>(&body.shape.form);
        if (box == nullptr || body.X_WS.position.z() + 0.5 * box->size_m.z() != 0.0) return;
      } else if (slider_ >= 0 || !body.angular_velocity.isZero(0.0)) {
        slider_ = -1;
        return;
      } else {
        slider_ = static_cast<int>(i);
      }
    }
    if (slider_ < 0) return;
    reach_m_ = solidOf(world, slider_).radius();
    width_m_ = smallestWidth(solidOf(world, slider_));
    start_ = world.states()[static_cast<std::size_t>(slider_)];
  }

  void look(std::span<const BodyState> states, int step, Findings& findings) {
    if (slider_ < 0) return;
    const BodyState& now = states[static_cast<std::size_t>(slider_)];
    if (!overTiles(now.X_WB.position)) {
      slider_ = -1;
      return;
    }
    const Vec3 before(start_.linear_velocity.x(), start_.linear_velocity.y(), 0.0);
    const Vec3 after(now.linear_velocity.x(), now.linear_velocity.y(), 0.0);
    const double lost = (before - after).norm() / before.norm();
    const double lift = now.X_WB.position.z() - start_.X_WB.position.z() - kLift * width_m_;
    if (lost > kGlideBar) findings.add("ghost", lost, step, "of its speed changed over flush tiles");
    if (lift > kGlideBar) findings.add("ghost-lift", lift, step, "m lifted over flush tiles");
  }

 private:
  /// Whether all below the slider's bounding ball is tiles.
  bool overTiles(const Vec3& p) const {
    double from = p.x() - reach_m_;
    for (bool grown = true; grown && from < p.x() + reach_m_;) {
      grown = false;
      for (const demos::Body& body : scene_.bodies) {
        if (!body.is_static) continue;
        const Vec3 half = 0.5 * std::get<demos::BoxShape>(body.shape.form).size_m;
        const Vec3& middle = body.X_WS.position;
        const double rounding = 1e-12 * half.x();
        if (std::abs(p.y() - middle.y()) + reach_m_ > half.y()) continue;
        if (middle.x() - half.x() > from + rounding || middle.x() + half.x() <= from + rounding) continue;
        from = middle.x() + half.x();
        grown = true;
      }
    }
    return from >= p.x() + reach_m_;
  }

  const demos::Scene& scene_;
  int slider_ = -1;
  double reach_m_ = 0.0, width_m_ = 0.0;
  BodyState start_;
};

}  // namespace carom::explore
