#pragma once
// Oracle: the momenta of all bodies together, as far as gravity and loads alone change them. Where nothing is
// static and nothing is around, these are the momentum and the angular momentum about the common centre of
// mass. Over a floor without friction they are the parts of both across its normal and about it, and the
// common centre of mass goes across the normal where its momentum takes it, so that the angular momentum
// about any fixed axis along the normal is known, too: "ice-..." where gravity is along the normal,
// "slope-..." where it is not. When a body comes to rest, which is slow then, the changes are counted from
// there on. Tested in tests/explore/watch/momentum_watch_test.cpp and
// tests/explore/watch/world_judge_test.cpp.

#include "tests/explore/watch/energy_watch.h"
#include "tests/explore/watch/ice_floor.h"
#include "tests/explore/watch/load_watch.h"

namespace carom::explore {

/// m/s, of the fastest point of a body: what has been slower for a while may come to rest (kRestSpeed of the
/// engine's tolerances.h).
constexpr double kSlowEnoughToRest = 0.02;

class MomentumWatch {
 public:
  /// `world` must outlive it, and has started and not been stepped.
  MomentumWatch(const World& world, std::span<const OwnBody> bodies, const Mechanics& start)
      : bodies_(bodies),
        gravity_(world.settings().gravity.cast<Real>()),
        dt_s_(world.settings().step_s),
        before_(world.states().begin(), world.states().end()) {
    for (const OwnBody& body : bodies) mass_ += body.mass;
    since_ = {start, {}, centerOf(before_), 0};
    const auto all = world.bodies();
    const bool freely = world.settings().fluids.empty() && !(world.settings().air.density_kgpm3 > 0.0) &&
                        std::all_of(all.begin(), all.end(), [](const BodyDescription& d) {
                          return !d.is_kinematic && !d.locks.any();
                        });
    is_closed_ = freely && bodies.size() == all.size();
    if (freely) floor_ = IceFloor::of(world, bodies);
  }

  /// Whether all bodies have been over a frictionless floor so far.
  bool isOnIce() const { return floor_.has_value(); }

  struct Step {
    int number = 0;  ///< From 1 on.
    /// Whether some island was asked whether it can rest: what comes to rest may be woken in the same step.
    bool asks_rest = false;
    const Pushed& pushed;  ///< By loads, since the start.
  };
  /// After each step.
  void after(const Mechanics& now, std::span<const BodyState> states, const Step& last, Findings& findings) {
    const Pushed& pushed = last.pushed;
    const int step = last.number;
    if (floor_ && !floor_->isBelow(before_, states)) floor_.reset();  // from now on its edges may be touched
    if (!is_closed_ && !floor_) return;
    momentum_scale_ = std::max({momentum_scale_, since_.mechanics.momentum_scale, now.momentum_scale});
    angular_scale_ = std::max({angular_scale_, since_.mechanics.angular_scale, now.angular_scale});
    const Change change = changeTo(now, pushed, step);
    if (is_closed_) {
      judge(change, pushed, {"momentum", "angular"}, findings);
      return;
    }
    bearWeights(states);
    if (judgeRest(states, last, findings)) {
      since_ = {now, pushed, centerOf(states), step};
    } else {
      const bool level = isLevel();
      judge(acrossFloor(change), pushed,
            level ? Kinds{"ice-momentum", "ice-angular"} : Kinds{"slope-momentum", "slope-angular"},
            findings);
      if (pushed.impulse_scale == 0) judgeCenter(states, step, findings);
    }
    before_.assign(states.begin(), states.end());
  }

 private:
  struct Start {
    Mechanics mechanics;
    Pushed pushed;
    Vec3R center = Vec3R::Zero();
    int step = 0;
  };
  struct Change {
    int step = 0;
    Vec3R momentum = Vec3R::Zero(), angular = Vec3R::Zero();  ///< That nothing explains.
    Real momentum_scale = 0, angular_scale = 0;
    Real borne = 0, borne_moment = 0;  ///< By the floor, N s and N m s: what is rounded, too.
  };
  struct Kinds {
    const char *momentum, *angular;
  };

  Change changeTo(const Mechanics& now, const Pushed& pushed, int step) const {
    const Mechanics& then = since_.mechanics;
    const Vec3R fallen = (step - since_.step) * dt_s_ * mass_ * gravity_;
    Change change;
    change.step = step;
    change.momentum = now.momentum - then.momentum - fallen - (pushed.impulse - since_.pushed.impulse);
    change.angular = now.angular - then.angular - (pushed.angular - since_.pushed.angular);
    change.momentum_scale = momentum_scale_ + pushed.impulse_scale;
    change.angular_scale = angular_scale_ + pushed.angular_scale;
    return change;
  }
  static void judge(const Change& change, const Pushed& pushed, const Kinds& kinds, Findings& findings) {
    const Real rounding = kRounding * change.step;
    const Real off = change.momentum.norm(), turned = change.angular.norm();
    if (off > rounding * (change.momentum_scale + change.borne) + pushed.impulse_unknown)
      findings.add(kinds.momentum, static_cast<double>(off / change.momentum_scale), change.step,
                   "of sum m |v| + |F| t");
    if (turned > rounding * (change.angular_scale + change.borne_moment) + pushed.angular_unknown)
      findings.add(kinds.angular, static_cast<double>(turned / change.angular_scale), change.step,
                   "of sum m r |v| + I w + r |F| t + |torque| t");
  }

  // Whether gravity has no part across the floor's normal, to rounding.
  bool isLevel() const {
    const Vec3R n = floor_->normal();
    return (gravity_ - n.dot(gravity_) * n).norm() <= kRounding * gravity_.norm();
  }
  // The floor's impulses bear the weights of each step, and are rounded in size and direction.
  void bearWeights(std::span<const BodyState> states) {
    const Vec3R center = centerOf(states);
    for (const OwnBody& body : bodies_) {
      const Real impulse = body.mass * gravity_.norm() * dt_s_;
      borne_ += impulse;
      borne_moment_ += impulse * ((placeOf(body, states) - center).norm() + body.reach_m);
    }
  }
  Change acrossFloor(Change change) const {
    const Vec3R n = floor_->normal();
    change.momentum -= n.dot(change.momentum) * n;
    change.angular = n.dot(change.angular) * n;
    change.borne = borne_;
    change.borne_moment = borne_moment_;
    change.momentum_scale += borne_ / change.step;
    change.angular_scale += borne_moment_ / change.step;
    return change;
  }
  void judgeCenter(std::span<const BodyState> states, int step, Findings& findings) const {
    const Vec3R n = floor_->normal();
    const Real time_s = (step - since_.step) * dt_s_;
    const Vec3R way = time_s * since_.mechanics.momentum / mass_ + time_s * time_s / 2 * gravity_;
    Vec3R off = centerOf(states) - since_.center - way;
    off -= n.dot(off) * n;
    Real size = 0;
    for (const OwnBody& body : bodies_) size = std::max(size, placeOf(body, states).norm() + body.reach_m);
    if (off.norm() > kRounding * step * (size + way.norm()))
      findings.add(isLevel() ? "ice-drift" : "slope-drift",
                   static_cast<double>(off.norm() / (size + way.norm())), step,
                   "of way and size: the centre of mass is " + shown(static_cast<double>(off.norm())) +
                       " m beside where its momentum takes it");
  }

  static double speedOf(const OwnBody& body, const BodyState& state) {
    return state.linear_velocity.norm() + state.angular_velocity.norm() * static_cast<double>(body.reach_m);
  }
  // Whether a body may have been put to rest in this step.
  bool judgeRest(std::span<const BodyState> states, const Step& last, Findings& findings) const {
    bool any = false;
    for (const OwnBody& body : bodies_) {
      const auto i = static_cast<std::size_t>(body.index);
      if (before_[i].mode == Mode::kResting) continue;
      const double speed = speedOf(body, before_[i]);
      const bool slow = speed < kSlowEnoughToRest, rests = states[i].mode == Mode::kResting;
      any |= rests || (slow && last.asks_rest);
      if (rests && !slow)
        findings.add("ice-rest", speed, last.number, "m/s, of a point of a body that was put to rest");
    }
    return any;
  }

  static Vec3R placeOf(const OwnBody& body, std::span<const BodyState> states) {
    return states[static_cast<std::size_t>(body.index)].X_WB.position.cast<Real>();
  }
  Vec3R centerOf(std::span<const BodyState> states) const {
    Vec3R center = Vec3R::Zero();
    for (const OwnBody& body : bodies_) center += body.mass / mass_ * placeOf(body, states);
    return center;
  }

  std::span<const OwnBody> bodies_;
  Vec3R gravity_;
  Real dt_s_ = 0, mass_ = 0;
  bool is_closed_ = false;
  std::optional<IceFloor> floor_;
  Start since_;  ///< What is judged is what has changed since then.
  std::vector<BodyState> before_;
  Real momentum_scale_ = 0, angular_scale_ = 0;
  Real borne_ = 0, borne_moment_ = 0;  ///< Weights over time, N s and N m s.
};

}  // namespace carom::explore
