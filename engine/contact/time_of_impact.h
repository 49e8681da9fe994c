#pragma once
// Collision time searching (paper §2.3, figs. 6 and 7): the first time at which two moving parts come into
// the collision window fast enough to collide, or can be carried no further without leaving it downwards.
//
// The search never trusts d(t) between two looks at it (DEVIATES: the paper finds the root by Newton's
// method). The gap between the parts along any direction n(t) bounds d(t) from below. Where n stands still,
// every vertex moves along it with a second derivative of at most M = |acceleration| + spin_A^2 r_A +
// spin_B^2 r_B (twice the latter for bodies that tumble). A function with that bound stays above its chord
// less M t (dt - t) / 2, so from the gap at the two ends of an interval follows a lower bound for all of it.
// What slides over a face that turns stays near it, but not along a direction that stands still, in which the
// face's far corners dip at once: there n turns with the face's part, and M holds what a turning frame adds.
// Between two edges that cross, n stays across both.
// Newton's step towards the landing gap (with the paper's linear correction as its guard) only proposes the
// interval. Invariant: up to the returned time the distance is >= the floor. Valid for any speed and any
// rotation.
//
// The floor decides whether there is an impact, the window where it is struck (DEVIATES: in the paper every
// approach in the window is a collision). What comes into the window fast is an impact only if the parts' own
// paths lead below the floor: a box that slides over a seam, or past the edge of a lower step, approaches
// that edge obliquely, but passes it. Tested in tests/engine/contact/time_of_impact_test.cpp.

#include "engine/closest_features/vclip.h"
#include "engine/contact/collision_window.h"
#include "engine/motion/trajectory.h"

namespace carom {

struct MovingPart {
  const ConvexPart* part = nullptr;
  const Trajectory* path = nullptr;
  double reach_m = 0.0;         ///< The largest distance of the part's core from the body's centre of mass.
  const Pose* X_end = nullptr;  ///< `path` at the end of the search, where the caller has it already.
};

struct ImpactSearch {
  CollisionWindow window;
  double collision_speed_mps = 0.0;  ///< In the window, an approach faster than this is a collision.
  double begin_s = 0.0;
  double end_s = 0.0;
  /// The contact will last: it is struck at the landing gap, where it is then held, not anywhere in the
  /// window.
  bool lands = false;
  /// What comes down after the end is held by then: an approach counts only if it leads to the floor before.
  bool ends_held = false;
};

struct TimeOfImpact {
  enum class Outcome : std::uint8_t {
    kClear,   ///< No impact before the end.
    kImpact,  ///< In the window, approaching faster than the collision speed, and on the way below the floor.
    kStopped,  ///< Cannot be carried further: slow approach at the floor, or the search's bound.
    kPending   ///< Nothing up to `time_s`; what comes after has not been looked at.
  };
  Outcome outcome = Outcome::kPending;
  double time_s = 0.0;      ///< Up to here the gap is proven.
  ClosestFeatures closest;  ///< At `time_s`, but for kClear and kPending: at the last look.
  int queries = 0;          ///< Closest-feature queries made.
  long states = 0;          ///< Feature pairs visited by these queries.
  int newton_steps = 0;
  int looks = 0;  ///< At the pair, the first without a query.
  long work = 0;  ///< Poses evaluated, about 0.2 us each.
  double floor =
      0.0;  ///< The gap that the search keeps, m: the window's, or less where the pair began below.
  double passes_until_s =
      0.0;  ///< A fast approach has been followed so far, and does not lead below the floor.
};

/// The search before its first look. `at_begin`: the closest features at `begin_s`, which must be separated.
TimeOfImpact beginSearch(const ImpactSearch& search, const ClosestFeatures& at_begin);
/// One look at `found.time_s` and, unless that is the outcome, one more interval proven: the caller may do
/// other things before it looks again, or never. `tracked` follows the search.
void lookFurther(const MovingPart& a, const MovingPart& b, const ImpactSearch& search, TimeOfImpact& found,
                 FeaturePair& tracked);
/// The whole search.
TimeOfImpact timeOfImpact(const MovingPart& a, const MovingPart& b, const ImpactSearch& search,
                          const ClosestFeatures& at_begin, FeaturePair& tracked);

}  // namespace carom
