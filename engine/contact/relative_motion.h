#pragma once
// What two paths do to how their bodies lay to each other once. Bodies that fall side by side, or are carried
// together, hardly move so: what was found to be apart between them needs no other look. Tested in
// tests/engine/contact/relative_motion_test.cpp.

#include <algorithm>
#include <cmath>

#include "engine/broad_phase/candidate_pairs.h"
#include "engine/contact/separating_axis.h"

namespace carom {

/// How the bodies A and B lay to each other.
struct RelativePose {
  Vec3 offset_m = Vec3::Zero();  ///< From A's centre of mass to B's.
  Quat R_WA = Quat::Identity();
  Quat R_WB = Quat::Identity();
};

/// Where the intervals of their paths begin.
inline RelativePose relativePose(const PathBound& a, const PathBound& b) {
  return {b.begin.position - a.begin.position, a.begin.rotation, b.begin.rotation};
}

/// Anywhere within an interval of two paths.
struct RelativeMotion {
  Bounds way_m;         ///< B's centre of mass, seen from A's, is away from where it was by what is in here.
  double turn_m = 0.0;  ///< By turning a point of one comes no nearer to a point of the other, m.

  /// No point of one has come nearer to a point of the other, m.
  double most() const { return way_m.low.cwiseAbs().cwiseMax(way_m.high.cwiseAbs()).norm() + turn_m; }
  /// How much more it is than another, m: what that does not reach, this reaches by no more.
  double beyond(const RelativeMotion& other) const {
    const Vec3 over = (other.way_m.low - way_m.low).cwiseMax(way_m.high - other.way_m.high).cwiseMax(0.0);
    return over.norm() + std::max(0.0, turn_m - other.turn_m);
  }
};

/// Since they lay so. Their cores reach so far from their centres of mass.
inline RelativeMotion motionSince(const RelativePose& then, const PathBound& a, double reach_a_m,
                                  const PathBound& b, double reach_b_m) {
  const Vec3 begin = (b.begin.position - a.begin.position) - then.offset_m;
  const Vec3 travel = b.travel_m - a.travel_m, bend = b.bend_m - a.bend_m;
  return {
      {begin + travel.cwiseMin(0.0) + bend.cwiseMin(0.0), begin + travel.cwiseMax(0.0) + bend.cwiseMax(0.0)},
      reach_a_m * mostTurned(then.R_WA, a) + reach_b_m * mostTurned(then.R_WB, b)};
}

}  // namespace carom
