#include "engine/contact/time_of_impact.h"

#include <algorithm>
#include <cmath>

#include "engine/contact/approach.h"

namespace carom {
namespace {

constexpr int kAdvances = 1000;        // proven intervals per search
constexpr int kProposals = 80;         // tries per interval, each shorter than the last
constexpr double kLinearShrink = 0.9;  // paper §2.3: a linear decrement of 10 % guards Newton's step
constexpr double kSmallestShare =
    1e-10;                            // of the searched interval: less progress than this is standing still
constexpr double kFloorSlack = 0.02;  // of the floor: a slow approach is stopped this near to it

// The smallest value over [0, dt] of a function that is `begin` and `end` at the ends and whose second
// derivative is at most M: the chord less K tau (1 - tau), K = M dt^2 / 2, tau = t / dt.
double lowerBound(double begin, double end, double k) {
  const double rise = end - begin;
  if (rise >= k) return begin;
  if (rise <= -k) return end;
  return begin - (k - rise) * (k - rise) / (4.0 * k);
}

class Search {
 public:
  Search(const MovingPart& a, const MovingPart& b, const ImpactSearch& search)
      : a_(a), b_(b), search_(search) {}

  double separatingSpeedAt(double t, const ClosestFeatures& c) const {
    const Velocity va{a_.path->velocityAt(t), a_.path->spin};
    const Velocity vb{b_.path->velocityAt(t), b_.path->spin};
    return c.n_W.dot(vb.at(c.p_B_W - b_.path->at(t).position) - va.at(c.p_A_W - a_.path->at(t).position));
  }

  // The gap between the parts along a fixed direction; at most their distance.
  double gapAlong(const Vec3& n, double t) {
    const Pose X_WA = a_.path->at(t);
    const Pose X_WB = b_.path->at(t);
    support_a_ = a_.part->core.support(X_WA.rotation.conjugate() * n, support_a_);
    support_b_ = b_.part->core.support(X_WB.rotation.conjugate() * -n, support_b_);
    return n.dot(X_WB * b_.part->core.vertex(support_b_) - X_WA * a_.part->core.vertex(support_a_)) -
           a_.part->radius_m - b_.part->radius_m;
  }

  double curvatureBound(const Vec3& n) const {
    return std::abs(n.dot(b_.path->acceleration - a_.path->acceleration)) +
           a_.path->spin.squaredNorm() * a_.reach_m + b_.path->spin.squaredNorm() * b_.reach_m;
  }

  // The longest interval from `begin`, among those Newton proposes, over which the gap along n stays >=
  // floor.
  double provenInterval(double begin, double gap, double speed, const Vec3& n, double floor,
                        int& newton_steps) {
    const double curvature = curvatureBound(n);
    // Aim between floor and gap when already low, else at the landing gap.
    const double aim = std::max(floor + 0.25 * (gap - floor),
                                std::min(search_.window.landing, floor + 0.75 * (gap - floor)));
    double interval = search_.end_s - begin;
    for (int i = 0; i < kProposals; ++i) {
      const double end_gap = gapAlong(n, begin + interval);
      if (lowerBound(gap, end_gap, 0.5 * curvature * interval * interval) >= floor) return interval;
      ++newton_steps;
      double proposal = kLinearShrink * interval;
      if (end_gap < aim)
        proposal = std::min(proposal, interval * (gap - aim) / (gap - end_gap));  // the chord
      if (speed < 0.0)
        proposal = std::min(proposal, std::max((aim - gap) / speed, 0.5 * proposal));  // Newton
      else
        proposal *= 0.5;
      interval = proposal;
    }
    return 0.0;
  }

 private:
  const MovingPart& a_;
  const MovingPart& b_;
  const ImpactSearch& search_;
  int support_a_ = 0;
  int support_b_ = 0;
};

}  // namespace

TimeOfImpact timeOfImpact(const MovingPart& a, const MovingPart& b, const ImpactSearch& search,
                          const ClosestFeatures& at_begin, FeaturePair& tracked) {
  TimeOfImpact result;
  result.time_s = search.begin_s;
  result.closest = at_begin;
  if (a.path->still() && b.path->still()) return result;
  // A pair that begins below the floor (bodies that start closer) may not come closer than it is.
  const double floor = std::min(search.window.floor, (1.0 - 1e-9) * at_begin.distance_m);
  const double smallest = kSmallestShare * (search.end_s - search.begin_s);
  Search looks(a, b, search);
  for (int i = 0; i < kAdvances; ++i) {
    const double gap = result.closest.distance_m;
    const double speed = looks.separatingSpeedAt(result.time_s, result.closest);
    if (gap <= search.window.ceiling && speed < -search.collision_speed_mps) {
      result.outcome = TimeOfImpact::Outcome::kImpact;
      return result;
    }
    if (result.time_s >= search.end_s) return result;
    if (speed < 0.0 && gap < (1.0 + kFloorSlack) * floor) break;
    const double interval =
        looks.provenInterval(result.time_s, gap, speed, result.closest.n_W, floor, result.newton_steps);
    if (interval <= smallest) break;
    const bool last = result.time_s + interval >= search.end_s;
    result.time_s = last ? search.end_s : result.time_s + interval;
    if (last) return result;
    result.closest =
        closestFeatures(*a.part, a.path->at(result.time_s), *b.part, b.path->at(result.time_s), tracked);
    ++result.queries;
  }
  result.outcome = TimeOfImpact::Outcome::kStopped;
  return result;
}

}  // namespace carom
