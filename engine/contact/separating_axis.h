#pragma once
// An axis along which two parts were found apart. It stays as it is in the world: however the parts move from
// there, they do not meet as long as their centres' approach along it, and what turning can bring nearer, are
// less than the gap was. Tested in tests/engine/contact/separating_axis_test.cpp.

#include <algorithm>

#include "engine/foundation/dot.h"
#include "engine/foundation/frames.h"
#include "engine/motion/trajectory.h"

namespace carom {

struct SeparatingAxis {
  Vec3 n_W = Vec3::UnitZ();  ///< Unit, from A to B.
  double offset_m = 0.0;     ///< From A's centre to B's along it, beyond the gap.
  Quat R_WA = Quat::Identity();
  Quat R_WB = Quat::Identity();
};

/// Of parts of bodies in these poses which `gap_m` keeps apart along `n_W`, at least.
inline SeparatingAxis separatingAxis(const Vec3& n_W, double gap_m, const Pose& X_WA, const Pose& X_WB) {
  return {n_W, dot(n_W, X_WB.position - X_WA.position) - gap_m, X_WA.rotation, X_WB.rotation};
}

/// What a bound of gaps asks of a path, over an interval of it.
struct PathBound {
  PathBound() = default;
  PathBound(const Trajectory& path, double begin_s, double end_s)
      : begin_m(path.positionAt(begin_s)),
        travel_m((end_s - begin_s) * path.velocityAt(begin_s)),
        bend_m(0.5 * (end_s - begin_s) * (end_s - begin_s) * path.acceleration),
        rotation(path.X_WB.rotation),
        turning(path.fastestSpin() * (end_s - path.start_s)) {}

  // Of the centre of mass: begin + share travel + share^2 bend, m.
  Vec3 begin_m = Vec3::Zero();
  Vec3 travel_m = Vec3::Zero();
  Vec3 bend_m = Vec3::Zero();
  Quat rotation = Quat::Identity();  ///< Where the path begins.
  double turning = 0.0;              ///< rad, from there until the interval ends, at most.
};

/// How far from where it was in one orientation a point that is 1 m from its centre can be in another, m.
inline double mostTurned(const Quat& R_before, const Quat& R_now) {
  const Eigen::Vector4d &before = R_before.coeffs(), &now = R_now.coeffs();
  // Half of this is the sine of a quarter of the angle; the chord is twice the sine of half of it.
  return 2.0 * std::sqrt(std::min((now - before).squaredNorm(), (now + before).squaredNorm()));
}

/// Likewise, anywhere on the path: at most across the circle.
inline double mostTurned(const Quat& R_before, const PathBound& path) {
  return std::min(mostTurned(R_before, path.rotation) + path.turning, 2.0);
}

/// No less is the gap of two parts within the interval of both paths, m. Their cores reach so far from the
/// bodies' centres of mass.
inline double leastGap(const SeparatingAxis& axis, const PathBound& a, double reach_a_m, const PathBound& b,
                       double reach_b_m) {
  return dot(axis.n_W, b.begin_m - a.begin_m) - axis.offset_m +
         std::min(0.0, dot(axis.n_W, b.travel_m - a.travel_m)) +
         std::min(0.0, dot(axis.n_W, b.bend_m - a.bend_m)) - reach_a_m * mostTurned(axis.R_WA, a) -
         reach_b_m * mostTurned(axis.R_WB, b);
}

}  // namespace carom
