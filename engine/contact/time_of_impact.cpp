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
    1e-10;                              // of the searched interval: less progress than this is standing still
constexpr double kLandingSlack = 0.05;  // of the landing gap, either way: an impact there has landed
constexpr double kFloorSlack = 0.02;    // of the floor: a slow approach is stopped this near to it

// The smallest value over [0, dt] of a function that is `begin` and `end` at the ends and whose second
// derivative is at most M: the chord less K tau (1 - tau), K = M dt^2 / 2, tau = t / dt.
double lowerBound(double begin, double end, double k) {
  const double rise = end - begin;
  if (rise >= k) return begin;
  if (rise <= -k) return end;
  return begin - (k - rise) * (k - rise) / (4.0 * k);
}

class Look {
 public:
  Look(const MovingPart& a, const MovingPart& b, const ImpactSearch& search)
      : a_(a), b_(b), search_(search) {}

  Pose poseOf(const MovingPart& moving, double t) const {
    return moving.X_end != nullptr && t == search_.end_s ? *moving.X_end : moving.path->at(t);
  }

  double separatingSpeedAt(double t, const ClosestFeatures& c) const {
    const Velocity va{a_.path->velocityAt(t), a_.path->angularVelocityAt(t)};
    const Velocity vb{b_.path->velocityAt(t), b_.path->angularVelocityAt(t)};
    return c.n_W.dot(vb.at(c.p_B_W - b_.path->positionAt(t)) - va.at(c.p_A_W - a_.path->positionAt(t)));
  }

  // The gap between the parts along a fixed direction; at most their distance.
  double gapAlong(const Vec3& n, double t) {
    const Pose X_WA = poseOf(a_, t);
    const Pose X_WB = poseOf(b_, t);
    support_a_ = a_.part->core.support(X_WA.rotation.conjugate() * n, support_a_);
    support_b_ = b_.part->core.support(X_WB.rotation.conjugate() * -n, support_b_);
    return n.dot(X_WB * b_.part->core.vertex(support_b_) - X_WA * a_.part->core.vertex(support_a_)) -
           a_.part->radius_m - b_.part->radius_m;
  }

  // How fast the two vertices that `gapAlong` found last part along n.
  double supportSpeed(const Vec3& n, double t) const {
    const auto speedOf = [&](const MovingPart& moving, int vertex) {
      const Vec3 r = poseOf(moving, t).rotation * moving.part->core.vertex(vertex);
      return n.dot(Velocity{moving.path->velocityAt(t), moving.path->angularVelocityAt(t)}.at(r));
    };
    return speedOf(b_, support_b_) - speedOf(a_, support_a_);
  }

  double curvatureBound(const Vec3& n) const {
    return std::abs(n.dot(b_.path->acceleration - a_.path->acceleration)) +
           a_.path->turningAcceleration() * a_.reach_m + b_.path->turningAcceleration() * b_.reach_m;
  }

  static double turningSpeed(const Trajectory& path, const Vec3& n) {
    return path.tumbling.inertia == nullptr ? n.cross(path.spin).norm() : path.fastestSpin();
  }

  // A speed that no two points of the parts separate slower than along n, but for the curvature.
  double slowestSpeed(double t, const Vec3& n) const {
    return n.dot(b_.path->velocityAt(t) - a_.path->velocityAt(t)) - turningSpeed(*a_.path, n) * a_.reach_m -
           turningSpeed(*b_.path, n) * b_.reach_m;
  }

  // The longest interval from `begin`, among those Newton proposes, over which the gap along n stays >=
  // floor.
  double provenInterval(double begin, double gap, double speed, const Vec3& n, double floor,
                        int& newton_steps) {
    const double curvature = curvatureBound(n);
    // Aim between floor and gap when already low, else at the landing gap.
    const double landing = search_.window.landing;
    const double low = floor + 0.75 * (gap - floor);
    const double near =
        search_.lands && gap > (1.0 + kLandingSlack) * landing ? landing : std::min(landing, low);
    const double aim = std::max(floor + 0.25 * (gap - floor), near);
    double interval = search_.end_s - begin;
    // Far apart for their speeds: clear without a look at the end.
    const double target = std::min(aim, landing);
    const double clear = search_.lands ? std::max(floor, target) : floor;
    if (gap + (slowestSpeed(begin, n) - 0.5 * curvature * interval) * interval >= clear) return interval;
    for (int i = 0; i < kProposals; ++i) {
      const double end_gap = gapAlong(n, begin + interval);
      if (lowerBound(gap, end_gap, 0.5 * curvature * interval * interval) >= floor) {
        // Safe; but what ends deep in the window and fast has passed its landing.
        if (!search_.lands || end_gap >= (1.0 - kLandingSlack) * target) return interval;
        const double end_speed = supportSpeed(n, begin + interval);
        if (end_speed >= -search_.collision_speed_mps) return interval;
        ++newton_steps;
        interval -= std::min(0.5 * interval, (end_gap - target) / end_speed);
        continue;
      }
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

TimeOfImpact beginSearch(const ImpactSearch& search, const ClosestFeatures& at_begin) {
  TimeOfImpact found;
  found.time_s = search.begin_s;
  found.closest = at_begin;
  // A pair that begins below the floor (bodies that start closer) may not come closer than it is.
  found.floor = std::min(search.window.floor, (1.0 - 1e-9) * at_begin.distance_m);
  return found;
}

void lookFurther(const MovingPart& a, const MovingPart& b, const ImpactSearch& search, TimeOfImpact& found,
                 FeaturePair& tracked) {
  if (found.looks++ > 0) {
    found.closest =
        closestFeatures(*a.part, a.path->at(found.time_s), *b.part, b.path->at(found.time_s), tracked);
    ++found.queries;
  }
  Look look(a, b, search);
  const double gap = found.closest.distance_m;
  const double speed = look.separatingSpeedAt(found.time_s, found.closest);
  const bool fast = speed < -search.collision_speed_mps;
  const double highest = search.lands ? (1.0 + kLandingSlack) * search.window.landing : search.window.ceiling;
  if (fast && gap <= highest) {
    found.outcome = TimeOfImpact::Outcome::kImpact;
    return;
  }
  if (found.time_s >= search.end_s) {
    found.outcome = TimeOfImpact::Outcome::kClear;
    return;
  }
  found.outcome = TimeOfImpact::Outcome::kStopped;
  if ((speed < 0.0 && gap < (1.0 + kFloorSlack) * found.floor) || found.looks > kAdvances) return;
  const double interval =
      look.provenInterval(found.time_s, gap, speed, found.closest.n_W, found.floor, found.newton_steps);
  if (interval <= kSmallestShare * (search.end_s - search.begin_s)) {
    if (fast && gap <= search.window.ceiling) found.outcome = TimeOfImpact::Outcome::kImpact;
    return;
  }
  const bool last = found.time_s + interval >= search.end_s;
  found.time_s = last ? search.end_s : found.time_s + interval;
  found.outcome = last ? TimeOfImpact::Outcome::kClear : TimeOfImpact::Outcome::kPending;
}

TimeOfImpact timeOfImpact(const MovingPart& a, const MovingPart& b, const ImpactSearch& search,
                          const ClosestFeatures& at_begin, FeaturePair& tracked) {
  TimeOfImpact found = beginSearch(search, at_begin);
  if (a.path->still() && b.path->still()) found.outcome = TimeOfImpact::Outcome::kClear;
  while (found.outcome == TimeOfImpact::Outcome::kPending) lookFurther(a, b, search, found, tracked);
  return found;
}

}  // namespace carom
