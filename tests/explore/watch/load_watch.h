#pragma once
// Oracle: what constant forces and torques have given to all bodies together, found from the bodies' paths
// alone: their impulse, their moment about the common centre of mass, and the work of the forces. What is
// constant in the world gives an impulse and a work that are known exactly; for the rest each step is halved
// until its halves say what the whole said. Tested in tests/explore/watch/world_judge_test.cpp.

#include <functional>

#include "tests/explore/watch/own_mechanics.h"

namespace carom::explore {

/// The bodies at a share of the way through the last step.
using StatesWithin = std::function<void(double share, std::vector<BodyState>& states)>;

/// Of all loads, since the start.
struct Pushed {
  Vec3R impulse = Vec3R::Zero();  ///< N s.
  Vec3R angular = Vec3R::Zero();  ///< N m s, about the common centre of mass.
  Real work_J = 0;                ///< Of what is constant in the world, without that of torques.
  Real impulse_scale = 0;         ///< The same, without regard to directions.
  Real angular_scale = 0;
  Real work_scale_J = 0;  ///< What the rounding of places is relative to.
  // What is not known of the momenta: the engine turns a load along with its body's flight, foreseen, and a
  // body turns otherwise where it meets others.
  Real impulse_unknown = 0;
  Real angular_unknown = 0;
};

class LoadWatch {
 public:
  LoadWatch(const World& world, std::span<const OwnBody> bodies)
      : world_(world), bodies_(bodies), dt_s_(world.settings().step_s) {
    for (const OwnBody& body : bodies) {
      mass_ += body.mass;
      any_ |= !loadOf(body).isZero();
    }
  }

  /// Whether there is a load.
  bool any() const { return any_; }

  /// After each step.
  void after(const StatesWithin& within) {
    if (!any_) return;
    const auto at = [&](double share) {
      Instant instant;
      instant.share = share;
      within(share, instant.states);
      look(instant);
      return instant;
    };
    const Instant begin = at(0.0), end = at(1.0);
    const Instant middle = at(0.5);
    const Part all = refined(at, begin, middle, end, between(begin, middle, end), kMostHalvings);
    sum_.impulse += all.impulse;
    sum_.angular += all.angular;
    measure(begin, end);
  }

  const Pushed& sum() const { return sum_; }

 private:
  static constexpr int kMostHalvings = 24;
  static constexpr Real kSame = 1e-13L;  // of what the loads can give within the step

  struct Part {
    Vec3R impulse = Vec3R::Zero(), angular = Vec3R::Zero();
    Part operator+(const Part& o) const { return {impulse + o.impulse, angular + o.angular}; }
  };
  struct Instant {
    double share = 0;
    std::vector<BodyState> states;
    Vec3R force = Vec3R::Zero(), moment = Vec3R::Zero();
    Real moment_size = 0;  ///< Sum of |F| r + |torque|.
  };

  const AppliedLoad& loadOf(const OwnBody& body) const {
    return world_.bodies()[static_cast<std::size_t>(body.index)].load;
  }
  static Vec3R turned(const BodyState& state, const Vec3& v_B) {
    return state.X_WB.rotation.cast<Real>().normalized() * v_B.cast<Real>();
  }
  static Vec3R forceOf(const AppliedLoad& load, const BodyState& s) {
    return load.force_W.cast<Real>() + turned(s, load.force_B);
  }
  static Vec3R torqueOf(const AppliedLoad& load, const BodyState& s) {
    return load.torque_W.cast<Real>() + turned(s, load.torque_B);
  }

  void look(Instant& instant) const {
    Vec3R middle = Vec3R::Zero();
    const auto state = [&](const OwnBody& body) -> const BodyState& {
      return instant.states[static_cast<std::size_t>(body.index)];
    };
    for (const OwnBody& body : bodies_) middle += body.mass / mass_ * state(body).X_WB.position.cast<Real>();
    for (const OwnBody& body : bodies_) {
      if (loadOf(body).isZero()) continue;
      const Vec3R force = forceOf(loadOf(body), state(body)), torque = torqueOf(loadOf(body), state(body));
      const Vec3R r = state(body).X_WB.position.cast<Real>() - middle;
      instant.force += force;
      instant.moment += r.cross(force) + torque;
      instant.moment_size += (r.norm() + body.reach_m) * force.norm() + torque.norm();
    }
  }

  // Simpson's rule: exact for what flies.
  Part between(const Instant& a, const Instant& m, const Instant& b) const {
    const Real sixth_s = (b.share - a.share) * dt_s_ / 6;
    return {sixth_s * (a.force + 4 * m.force + b.force), sixth_s * (a.moment + 4 * m.moment + b.moment)};
  }
  template <typename At>
  Part refined(const At& at, const Instant& a, const Instant& m, const Instant& b, const Part& whole,
               int halvings) const {
    const Instant left = at(0.5 * (a.share + m.share)), right = at(0.5 * (m.share + b.share));
    const Part first = between(a, left, m), second = between(m, right, b), both = first + second;
    // At least 16 parts: of what turns along an even number of turns looks like none.
    if (halvings == 0 || (halvings <= kMostHalvings - 3 && isSame(both, whole, a, b))) return both;
    return refined(at, a, left, m, first, halvings - 1) + refined(at, m, right, b, second, halvings - 1);
  }
  bool isSame(const Part& one, const Part& other, const Instant& a, const Instant& b) const {
    const Real most = std::max(a.moment_size, b.moment_size);
    const auto near = [](Real off, Real scale) { return off <= kSame * scale; };
    return near((one.angular - other.angular).norm(), most * dt_s_) &&
           near((one.impulse - other.impulse).norm(), forces() * dt_s_);
  }
  Real forces() const {
    Real sum = 0;
    for (const OwnBody& body : bodies_)
      sum += loadOf(body).force_W.cast<Real>().norm() + loadOf(body).force_B.cast<Real>().norm();
    return sum;
  }

  void measure(const Instant& begin, const Instant& end) {
    sum_.impulse_scale += forces() * dt_s_;
    sum_.angular_scale += std::max(begin.moment_size, end.moment_size) * dt_s_;
    for (const OwnBody& body : bodies_) {
      const AppliedLoad& load = loadOf(body);
      const BodyState& state = end.states[static_cast<std::size_t>(body.index)];
      const Real place = state.X_WB.position.cast<Real>().norm() + body.reach_m;
      sum_.work_scale_J += load.force_W.cast<Real>().norm() * place;
      const Vec3 way = state.X_WB.position - begin.states[static_cast<std::size_t>(body.index)].X_WB.position;
      sum_.work_J += load.force_W.cast<Real>().dot(way.cast<Real>());
      if (!load.turnsAlong()) continue;
      const Real spin = state.angular_velocity.norm() +
                        begin.states[static_cast<std::size_t>(body.index)].angular_velocity.norm();
      const Real turn = std::min(Real{2}, spin * dt_s_);
      const Real force = turn * load.force_B.norm() * dt_s_;
      sum_.impulse_unknown += force;
      sum_.angular_unknown += force * 2 * place + turn * load.torque_B.norm() * dt_s_;
    }
  }

  const World& world_;
  std::span<const OwnBody> bodies_;
  Real dt_s_ = 0, mass_ = 0;
  bool any_ = false;
  Pushed sum_;
};

}  // namespace carom::explore
