#include "engine/contact/time_of_impact.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "engine/contact/approach.h"

namespace carom {
namespace {

constexpr int kAdvances = 1000;        // proven intervals per search
constexpr int kProposals = 30;         // Newton's tries per interval; then each is half the last
constexpr double kLinearShrink = 0.9;  // paper §2.3: a linear decrement of 10 % guards Newton's step
constexpr double kSmallestShare =
    1e-10;  // of the searched interval: less progress than this is standing still
constexpr double kLandingMargin = 0.05;  // of the landing gap, either way: an impact there has landed
// Of what a gap has above the floor: what comes down fast beside a point in contact is to be struck at the
// height of that point, and what is in the window already comes down to this share in one look.
constexpr double kStruckShare = 0.9;
constexpr double kNextShare = 0.25;
constexpr double kFloorMargin = 0.02;        // of the floor: this near to it, an approach has come to it
constexpr long kQueryWork = 4;               // a query of closest features takes as long as so many poses
constexpr double kSharpCrossingSine = 0.01;  // edges that are flatter to each other are as good as parallel
constexpr double kUnheldSpeed = 2e-9;        // m/s: twice what is left over where paths are solved
constexpr double kRoundingOfPlaces = 1e-15;  // of a place in the world
constexpr int kFollowed = 16;  // of Newton's steps to the floor: one that converges takes five or six

// The smallest value over [0, dt] of a function that is `begin` and `end` at the ends and whose second
// derivative is at most M: the chord less K tau (1 - tau), K = M dt^2 / 2, tau = t / dt.
double lowerBound(double begin, double end, double k) {
  const double rise = end - begin;
  if (rise >= k) return begin;
  if (rise <= -k) return end;
  return begin - (k - rise) * (k - rise) / (4.0 * k);
}

// The largest gap at which a fast approach is an impact.
double highestImpact(const ImpactSearch& search) {
  return search.lands ? (1.0 + kLandingMargin) * search.window.landing : search.window.ceiling;
}

// Two edges that cross, each in its part's axes, and the direction across them: e_A x e_B, of length `sine`.
struct CrossingEdges {
  Vec3 edge_A;
  Vec3 edge_B;
  double sine = 0.0;   // when the interval begins
  double gap_m = 0.0;  // along them, then
};

// A unit direction that turns with one of the parts, or with none; or the one across two edges, which turns
// with both.
struct Direction {
  const MovingPart* frame = nullptr;
  Vec3 n_F = Vec3::Zero();  // in the frame's axes, or the world's
  const CrossingEdges* across = nullptr;
};

class Look {
 public:
  Look(const MovingPart& a, const MovingPart& b, const ImpactSearch& search)
      : a_(a), b_(b), search_(search) {}

  double separatingSpeedAt(double t, const ClosestFeatures& c) const {
    const Velocity va{a_.path->velocityAt(t), a_.path->angularVelocityAt(t)};
    const Velocity vb{b_.path->velocityAt(t), b_.path->angularVelocityAt(t)};
    return dot(c.n_W, vb.at(c.p_B_W - b_.path->positionAt(t)) - va.at(c.p_A_W - a_.path->positionAt(t)));
  }

  // Follows a fast approach from the time and the features of `found` along the paths, Newton's step after
  // step: whether it leads to the floor; as if the step had no end, unless it `ends_held`. Where parts move
  // without turning the gap is a convex function of the time, so that the steps never leap over its root;
  // else that costs nothing but the height at which the impact is struck, as what is proven does not hang on
  // it. An approach that slows down below the collision speed before is past; `passes_until_s` says when.
  bool comesToFloor(TimeOfImpact& found, FeaturePair tracked) const {
    double t = found.time_s;
    double gap = found.closest.distance_m;
    double speed = separatingSpeedAt(t, found.closest);
    const double reached = (1.0 + kFloorMargin) * found.floor;
    for (int i = 0; i < kFollowed && gap > reached; ++i) {
      t += (gap - found.floor) / -speed;
      const bool ends = search_.ends_held && t >= search_.end_s;
      if (ends) t = search_.end_s;
      const ClosestFeatures there =
          closestFeatures(*a_.part, a_.path->at(t), *b_.part, b_.path->at(t), tracked);
      ++found.queries;
      found.states += there.states;
      gap = there.distance_m;
      if (!(gap > reached)) return true;
      if (ends) {
        found.passes_until_s = t;
        return false;
      }
      speed = separatingSpeedAt(t, there);
      if (speed >= -search_.collision_speed_mps) {
        found.passes_until_s = t;
        return false;
      }
    }
    return true;
  }

  // The longest interval from `begin`, among those Newton proposes, over which the gap stays >= floor. What
  // `lands` is not let past its landing.
  double provenInterval(double begin, const ClosestFeatures& c, double speed, double floor, bool lands,
                        int& newton_steps) {
    const double gap = c.distance_m;
    const double landing = search_.window.landing;
    // Aim at the landing gap; what is in the window already, or far, comes down by most of its gap.
    const double low = floor + kNextShare * (gap - floor);
    const double aim = gap > highestImpact(search_) ? std::max(low, landing) : low;
    const double target = std::min(landing, floor + kStruckShare * (gap - floor));
    const double whole = search_.end_s - begin;
    // Far apart for their speeds: clear without a look at the end.
    const double clear = lands ? std::max(floor, target) : floor;
    const double curvature = curvatureBound({nullptr, c.n_W}, begin, whole);
    if (gap + (slowestSpeed(begin, c.n_W) - 0.5 * curvature * whole) * whole >= clear) return whole;
    const double sure = sureInterval(gap - clear, slowestSpeed(begin, c.n_W), curvature, whole);
    CrossingEdges edges;
    std::optional<Direction> held;
    // Or one as long along the direction that is held, where that proves more.
    const auto better = [&](const Chord& chord) {
      if (chord.lower_bound >= floor) return chord;
      if (!held) held = heldDirection(begin, c, edges);
      if (held->frame == chord.direction.frame && held->across == chord.direction.across) return chord;
      const Chord along = chordAlong(*held, begin, gap, chord.interval, floor);
      return along.lower_bound > chord.lower_bound ? along : chord;
    };
    Chord chord = better(bestChord(begin, c, whole, floor));
    const double least = std::max(sure, kSmallestShare * (search_.end_s - search_.begin_s));
    for (int i = 0; chord.interval > least; ++i) {
      double shorter = 0.0;
      if (chord.lower_bound >= floor) {
        const double past = lands ? pastLanding(begin, chord, target) : 0.0;
        if (!(past > 0.0)) return chord.interval;
        shorter = chord.interval - past;
      } else {
        shorter = shorterThan(chord, gap, speed, aim);
      }
      if (i >= kProposals) shorter = std::min(shorter, 0.5 * chord.interval);  // so that this ends
      ++newton_steps;
      chord = better(chordAlong(chord.direction, begin, gap, shorter, floor));
    }
    return sure;
  }

  /// Poses that were evaluated, those of a body that tumbles as often as its integrator has parts.
  long work() const { return work_; }

 private:
  // When what rises first, at this speed, and is `end` after `interval`, is nought again: of a parabola.
  static double backDown(double begin, double speed, double end, double interval) {
    const double bend = 2.0 * (begin + speed * interval - end) / (interval * interval);
    return (speed + std::sqrt(speed * speed + 2.0 * bend * begin)) / bend;
  }

  // The gap along a direction at the end of an interval, and the least that it can be within it: what is
  // proven to stay above the floor begins `margin` above it, changes by `rise`, and bends by 2 k at most, in
  // units of the interval. That is the gap itself, or the gap times the sine of two edges.
  struct Chord {
    Direction direction;
    double interval = 0.0;
    double end_gap = 0.0;
    double lower_bound = -std::numeric_limits<double>::infinity();
    double scale = 1.0;
    double margin = 0.0;
    double rise = 0.0;
    double k = 0.0;
  };

  // The share of a chord's interval that is expected to be proven, if what it is of changes at first at
  // `speed` and then as a parabola, to p x + q x^2 at the share x: `lowerBound` is no lower than the floor,
  // ((k - q) x - p)^2 <= 4 k margin.
  static double provenShare(const Chord& chord, double speed) {
    const double p = chord.scale * speed * chord.interval;
    const double bend = chord.k - (chord.rise - p);
    const double reach = p + 2.0 * std::sqrt(chord.k * std::max(0.0, chord.margin));
    return bend > reach ? reach / bend : 1.0;
  }

  // For how long a safe chord has been past its landing, at the speed of its end: not at all where it ends
  // above it, or slowly.
  double pastLanding(double begin, const Chord& chord, double target) {
    if (chord.end_gap >= (1.0 - kLandingMargin) * target) return 0.0;
    const double end_speed = supportSpeed(chord.direction, begin + chord.interval);
    if (end_speed >= -search_.collision_speed_mps) return 0.0;
    return std::min(0.5 * chord.interval, (chord.end_gap - target) / end_speed);
  }

  // What to try after a chord that proves too little, from a gap that changes at `speed`: what should be
  // proven, but no longer than where Newton's step and the chord itself come down to `aim`.
  static double shorterThan(const Chord& chord, double gap, double speed, double aim) {
    const double shrunk = kLinearShrink * chord.interval;
    const double proven = provenShare(chord, speed) * chord.interval;
    double down = shrunk;
    if (chord.end_gap < aim) {
      down = speed < 0.0 ? std::min(shrunk, chord.interval * (gap - aim) / (gap - chord.end_gap))
                         : std::min(shrunk, backDown(gap - aim, speed, chord.end_gap - aim, chord.interval));
    }
    if (proven > 0.0) return std::min(down, proven);
    return std::min(down, std::max((aim - gap) / speed, 0.5 * down));
  }

  // So long a gap cannot lose `margin` m whatever the parts do: it closes at most at this speed and
  // acceleration.
  static double sureInterval(double margin, double slowest_mps, double curvature, double whole) {
    if (!(margin > 0.0)) return 0.0;
    if (slowest_mps >= 0.0 && !(curvature > 0.0)) return whole;
    const double root = std::sqrt(slowest_mps * slowest_mps + 2.0 * curvature * margin);
    // The larger root of margin + slowest t - curvature t^2 / 2, by whichever form does not cancel.
    const double sure =
        slowest_mps < 0.0 ? 2.0 * margin / (root - slowest_mps) : (slowest_mps + root) / curvature;
    return std::min((1.0 - 1e-9) * sure, whole);
  }

  Pose poseOf(const MovingPart& moving, double t) const {
    ++work_;
    return moving.X_end != nullptr && t == search_.end_s ? *moving.X_end : moving.path->at(t);
  }

  // With the parts in these poses, world frame.
  Vec3 directionAt(const Direction& direction, const Pose& X_WA, const Pose& X_WB) const {
    if (direction.across != nullptr) return acrossEdges(*direction.across, X_WA, X_WB).normalized();
    if (direction.frame == nullptr) return direction.n_F;
    return (direction.frame == &a_ ? X_WA : X_WB).rotation * direction.n_F;
  }

  static Vec3 acrossEdges(const CrossingEdges& edges, const Pose& X_WA, const Pose& X_WB) {
    return (X_WA.rotation * edges.edge_A).cross(X_WB.rotation * edges.edge_B);
  }
  double sineAt(const CrossingEdges& edges, double t) const {
    return acrossEdges(edges, poseOf(a_, t), poseOf(b_, t)).norm();
  }

  // The direction that stays across the closest features as they turn: with the part that has the face, or
  // the edge beside a vertex; across two edges. Along every other one some corner dips at once, so that only
  // this one proves anything where nothing is left above the floor.
  Direction heldDirection(double begin, const ClosestFeatures& c, CrossingEdges& edges) {
    const FeatureKind a = c.features.a.kind, b = c.features.b.kind;
    if (a == FeatureKind::kEdge && b == FeatureKind::kEdge) return directionAcross(begin, c, edges);
    if (a == b) return {nullptr, c.n_W};
    return turningWith(a > b ? &a_ : &b_, begin, c.n_W);
  }

  Direction directionAcross(double begin, const ClosestFeatures& c, CrossingEdges& edges) {
    edges.edge_A = a_.part->core.edge(c.features.a.index).direction;
    edges.edge_B = b_.part->core.edge(c.features.b.index).direction;
    const Vec3 w = acrossEdges(edges, poseOf(a_, begin), poseOf(b_, begin));
    edges.sine = w.norm();
    if (edges.sine < kSharpCrossingSine) return {nullptr, c.n_W};
    if (dot(w, c.n_W) < 0.0) edges.edge_A = -edges.edge_A;
    const Direction across{.across = &edges};
    edges.gap_m = gapAlong(across, begin);
    return across;
  }

  // The gap between the parts along a direction; at most their distance.
  double gapAlong(const Direction& direction, double t) {
    const Pose X_WA = poseOf(a_, t);
    const Pose X_WB = poseOf(b_, t);
    const Vec3 n = directionAt(direction, X_WA, X_WB);
    support_a_ = a_.part->core.support(X_WA.rotation.conjugate() * n, support_a_);
    support_b_ = b_.part->core.support(X_WB.rotation.conjugate() * -n, support_b_);
    return dot(n, X_WB * b_.part->core.vertex(support_b_) - X_WA * a_.part->core.vertex(support_a_)) -
           a_.part->radius_m - b_.part->radius_m;
  }

  // (w . x)'' = w'' . x + 2 w' . x' + w . x'' with |w| <= 1, and that of floor |w|.
  double curvatureAcross(double begin, double interval, double floor) const {
    const Trajectory &a = *a_.path, &b = *b_.path;
    const double acceleration = (b.acceleration - a.acceleration).norm();
    const double fastest = (b.velocityAt(begin) - a.velocityAt(begin)).norm() + acceleration * interval;
    const double farthest = (b.positionAt(begin) - a.positionAt(begin)).norm() + fastest * interval;
    const double spin = a.fastestSpin() + b.fastestSpin();
    const double turning =
        a.turningAcceleration() + b.turningAcceleration() + 2.0 * a.fastestSpin() * b.fastestSpin();
    return turning * (farthest + a_.reach_m + b_.reach_m + a_.part->radius_m + b_.part->radius_m + floor) +
           2.0 * spin * (fastest + a.fastestSpin() * a_.reach_m + b.fastestSpin() * b_.reach_m) +
           acceleration + a.turningAcceleration() * a_.reach_m + b.turningAcceleration() * b_.reach_m;
  }

  // How fast the gap between the two vertices that `gapAlong` found last opens.
  double supportSpeed(const Direction& direction, double t) const {
    const Pose X_WA = poseOf(a_, t);
    const Pose X_WB = poseOf(b_, t);
    const Vec3 n = directionAt(direction, X_WA, X_WB);
    const Vec3 v_A = X_WA * a_.part->core.vertex(support_a_);
    const Vec3 v_B = X_WB * b_.part->core.vertex(support_b_);
    const Velocity va{a_.path->velocityAt(t), a_.path->angularVelocityAt(t)};
    const Velocity vb{b_.path->velocityAt(t), b_.path->angularVelocityAt(t)};
    if (direction.across != nullptr) {
      const Vec3 e_a = X_WA.rotation * direction.across->edge_A;
      const Vec3 e_b = X_WB.rotation * direction.across->edge_B;
      const Vec3 w_rate = va.angular.cross(e_a).cross(e_b) + e_a.cross(vb.angular.cross(e_b));
      const Vec3 n_rate = (w_rate - dot(n, w_rate) * n) / e_a.cross(e_b).norm();
      return dot(n, vb.at(v_B - X_WB.position) - va.at(v_A - X_WA.position)) + dot(n_rate, v_B - v_A);
    }
    // In a frame that turns, its body's plane passes the other's vertex.
    const Vec3& at_a = direction.frame == &a_ ? v_B : v_A;
    const Vec3& at_b = direction.frame == &b_ ? v_A : v_B;
    return dot(n, vb.at(at_b - X_WB.position) - va.at(at_a - X_WA.position));
  }

  // M, for an interval from `begin`. What a frame turns by itself stands still in it; for the other's
  // vertices x, seen from its centre, (n . x)'' = n'' . x + 2 n' . x' + n . x'', with |n'| <= spin.
  double curvatureBound(const Direction& direction, double begin, double interval) const {
    const double turning_a = a_.path->turningAcceleration() * a_.reach_m;
    const double turning_b = b_.path->turningAcceleration() * b_.reach_m;
    const Vec3 acceleration = b_.path->acceleration - a_.path->acceleration;
    if (direction.frame == nullptr) return std::abs(dot(direction.n_F, acceleration)) + turning_a + turning_b;
    const Trajectory& frame = *direction.frame->path;
    const MovingPart& other = direction.frame == &a_ ? b_ : a_;
    const double fastest =
        (b_.path->velocityAt(begin) - a_.path->velocityAt(begin)).norm() + acceleration.norm() * interval;
    const double farthest =
        (b_.path->positionAt(begin) - a_.path->positionAt(begin)).norm() + fastest * interval;
    return frame.turningAcceleration() * (farthest + other.reach_m) +
           2.0 * frame.fastestSpin() * (fastest + other.path->fastestSpin() * other.reach_m) +
           acceleration.norm() + (direction.frame == &a_ ? turning_b : turning_a);
  }

  static double turningSpeed(const Trajectory& path, double t, const Vec3& n) {
    return path.tumbling.empty() ? n.cross(path.angularVelocityAt(t)).norm() : path.fastestSpin();
  }

  // A speed that no two points of the parts separate slower than along n, but for the curvature.
  double slowestSpeed(double t, const Vec3& n) const {
    return dot(n, b_.path->velocityAt(t) - a_.path->velocityAt(t)) -
           turningSpeed(*a_.path, t, n) * a_.reach_m - turningSpeed(*b_.path, t, n) * b_.reach_m;
  }

  Direction turningWith(const MovingPart* frame, double begin, const Vec3& n) const {
    if (frame == nullptr || frame->path->fastestSpin() == 0.0) return {nullptr, n};
    return {frame, frame->path->at(begin).rotation.conjugate() * n};
  }

  // Across two edges, of length w = e_A x e_B, a vertex of B is h = w . (x_B - x_A) from one of A. That h
  // stays above floor |w| follows as for other directions, as |w|'' >= -|w''|.
  Chord chordAcross(const CrossingEdges& edges, double begin, double interval, double floor) {
    const Direction direction{.across = &edges};
    const double end_gap = gapAlong(direction, begin + interval);
    const double start = edges.sine * (edges.gap_m - floor);
    const double end = sineAt(edges, begin + interval) * (end_gap - floor);
    const double k = 0.5 * curvatureAcross(begin, interval, floor) * interval * interval;
    return {direction,  interval, end_gap,     floor + lowerBound(start, end, k),
            edges.sine, start,    end - start, k};
  }

  Chord chordAlong(const Direction& direction, double begin, double gap, double interval, double floor) {
    if (direction.across != nullptr) return chordAcross(*direction.across, begin, interval, floor);
    const double end_gap = gapAlong(direction, begin + interval);
    const double k = 0.5 * curvatureBound(direction, begin, interval) * interval * interval;
    return {direction, interval, end_gap, lowerBound(gap, end_gap, k), 1.0, gap - floor, end_gap - gap, k};
  }

  // A face turns with its part, and so does the gap below it: the direction that turns with who has the face,
  // else with the larger one; where that does not prove the interval, with the other or none, if it is
  // better.
  Chord bestChord(double begin, const ClosestFeatures& c, double interval, double floor) {
    const bool face_a = c.features.a.kind == FeatureKind::kFace;
    const bool face_b = c.features.b.kind == FeatureKind::kFace;
    const bool a_first = face_a || (!face_b && a_.reach_m >= b_.reach_m);
    const std::array<const MovingPart*, 3> frames{a_first ? &a_ : &b_, a_first ? &b_ : &a_, nullptr};
    Chord best;
    for (const MovingPart* frame : frames) {
      const Chord chord = chordAlong(turningWith(frame, begin, c.n_W), begin, c.distance_m, interval, floor);
      if (chord.lower_bound > best.lower_bound) best = chord;
      if (best.lower_bound >= floor) break;
    }
    return best;
  }

  const MovingPart& a_;
  const MovingPart& b_;
  const ImpactSearch& search_;
  int support_a_ = 0;
  int support_b_ = 0;
  mutable long work_ = 0;
};

}  // namespace

TimeOfImpact beginSearch(const ImpactSearch& search, const ClosestFeatures& at_begin) {
  TimeOfImpact found;
  found.time_s = search.begin_s;
  found.closest = at_begin;
  // A pair that begins below the floor (bodies that start closer) may not come closer than it is, but for
  // what paths that are held leave over, and the rounding of where it is.
  const double gap = at_begin.distance_m;
  const double unheld = kUnheldSpeed * (search.end_s - search.begin_s) +
                        kRoundingOfPlaces * at_begin.p_A_W.lpNorm<Eigen::Infinity>();
  found.floor = std::min(search.window.floor, gap - std::clamp(unheld, 1e-9 * gap, 0.01 * gap));
  return found;
}

namespace {

void lookOnce(Look& look, const MovingPart& a, const MovingPart& b, const ImpactSearch& search,
              TimeOfImpact& found, FeaturePair& tracked) {
  if (found.looks++ > 0) {
    found.closest =
        closestFeatures(*a.part, a.path->at(found.time_s), *b.part, b.path->at(found.time_s), tracked);
    ++found.queries;
    found.states += found.closest.states;
  }
  const double gap = found.closest.distance_m;
  const double speed = look.separatingSpeedAt(found.time_s, found.closest);
  const bool fast = speed < -search.collision_speed_mps;
  const bool followed = found.time_s < found.passes_until_s;
  if (fast && !followed && gap <= highestImpact(search) && look.comesToFloor(found, tracked)) {
    found.outcome = TimeOfImpact::Outcome::kImpact;
    return;
  }
  if (found.time_s >= search.end_s) {
    found.outcome = TimeOfImpact::Outcome::kClear;
    return;
  }
  found.outcome = TimeOfImpact::Outcome::kStopped;
  const bool comes_down = gap + speed * (search.end_s - found.time_s) < found.floor;
  if ((comes_down && gap < (1.0 + kFloorMargin) * found.floor) || found.looks > kAdvances) return;
  const bool lands = search.lands && found.time_s >= found.passes_until_s;
  const double interval =
      look.provenInterval(found.time_s, found.closest, speed, found.floor, lands, found.newton_steps);
  if (interval <= kSmallestShare * (search.end_s - search.begin_s)) {
    if (fast && gap <= search.window.ceiling) found.outcome = TimeOfImpact::Outcome::kImpact;
    return;
  }
  // Their sum may round to less than the end.
  const bool last = interval >= search.end_s - found.time_s || found.time_s + interval >= search.end_s;
  found.time_s = last ? search.end_s : found.time_s + interval;
  found.outcome = last ? TimeOfImpact::Outcome::kClear : TimeOfImpact::Outcome::kPending;
}

}  // namespace

void lookFurther(const MovingPart& a, const MovingPart& b, const ImpactSearch& search, TimeOfImpact& found,
                 FeaturePair& tracked) {
  Look look(a, b, search);
  const int queries = found.queries;
  lookOnce(look, a, b, search, found, tracked);
  found.work += look.work() + kQueryWork * (found.queries - queries);
}

TimeOfImpact timeOfImpact(const MovingPart& a, const MovingPart& b, const ImpactSearch& search,
                          const ClosestFeatures& at_begin, FeaturePair& tracked) {
  TimeOfImpact found = beginSearch(search, at_begin);
  if (a.path->still() && b.path->still()) found.outcome = TimeOfImpact::Outcome::kClear;
  while (found.outcome == TimeOfImpact::Outcome::kPending) lookFurther(a, b, search, found, tracked);
  return found;
}

}  // namespace carom
