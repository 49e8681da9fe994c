#pragma once
// An axis along which two parts were found apart. It stays as it is in the world: however the parts move from
// there, they do not meet as long as the approach along it of balls that hold them, and what turning about
// the middles of these can bring nearer, are less than the gap was. Tested in
// tests/engine/contact/separating_axis_test.cpp.

#include <algorithm>

#include "engine/foundation/dot.h"
#include "engine/foundation/frames.h"
#include "engine/motion/trajectory.h"

namespace carom {

/// What a bound of gaps asks of a part: a ball that holds its core, in the frame of its body.
struct CoreBall {
  Vec3 middle_B = Vec3::Zero();
  double off_m = 0.0;     ///< Of the middle from the body's centre of mass.
  double radius_m = 0.0;  ///< Of the core about the middle.
};

struct SeparatingAxis {
  Vec3 n_W = Vec3::UnitZ();  ///< Unit, from A to B.
  double offset_m = 0.0;     ///< From the middle of A's ball to that of B's along it, beyond the gap.
  Quat R_WA = Quat::Identity();
  Quat R_WB = Quat::Identity();
};

/// Of parts of bodies in these poses which `gap_m` keeps apart along `n_W`, at least.
inline SeparatingAxis separatingAxis(const Vec3& n_W, double gap_m, const Pose& X_WA, const CoreBall& a,
                                     const Pose& X_WB, const CoreBall& b) {
  return {n_W, dot(n_W, X_WB * b.middle_B - X_WA * a.middle_B) - gap_m, X_WA.rotation, X_WB.rotation};
}

/// What a bound of gaps asks of a path, over an interval of it.
struct PathBound {
  PathBound() = default;
  PathBound(const Trajectory& path, double begin_s, double end_s)
      : begin(path.at(begin_s)),
        axes_W(begin.rotation.toRotationMatrix()),
        travel_m((end_s - begin_s) * path.velocityAt(begin_s)),
        bend_m(0.5 * (end_s - begin_s) * (end_s - begin_s) * path.acceleration),
        turning(path.fastestSpin() * (end_s - begin_s)) {
    const double swerve = 0.5 * (end_s - begin_s) * (end_s - begin_s) * path.turningAcceleration();
    swerving = std::min(turning, 2.0);
    if (swerve >= swerving) return;  // where it goes at first says no more than how far it can come
    turn_W = (end_s - begin_s) * path.angularVelocityAt(begin_s);
    swerving = swerve;
  }

  Pose begin;  ///< Where the interval begins.
  Mat3 axes_W = Mat3::Identity();
  // Of the centre of mass: begin + share travel + share^2 bend, m.
  Vec3 travel_m = Vec3::Zero();
  Vec3 bend_m = Vec3::Zero();
  double turning = 0.0;  ///< rad, at most.
  // What turning does to a point at p_W from the centre of mass: share turn_W x p_W, m, but for a vector that
  // is no longer than swerving |p_W|.
  Vec3 turn_W = Vec3::Zero();
  double swerving = 0.0;
};

/// How far from where it was in one orientation a point that is 1 m from its centre can be in another, m.
inline double mostTurned(const Quat& R_before, const Quat& R_now) {
  const Eigen::Vector4d &before = R_before.coeffs(), &now = R_now.coeffs();
  // Half of this is the sine of a quarter of the angle; the chord is twice the sine of half of it.
  return 2.0 * std::sqrt(std::min((now - before).squaredNorm(), (now + before).squaredNorm()));
}

/// Likewise, anywhere on the path: at most across the circle.
inline double mostTurned(const Quat& R_before, const PathBound& path) {
  return std::min(mostTurned(R_before, path.begin.rotation) + path.turning, 2.0);
}

/// Of two parts, m: no less is their gap ...
struct GapBound {
  double at_begin_m = 0.0;  ///< ... where the interval of both paths begins, ...
  double within_m = 0.0;    ///< ... and anywhere in it.
};

/// The balls' middles are followed on their way; about these the cores turn.
inline GapBound boundGap(const SeparatingAxis& axis, const PathBound& a, const CoreBall& core_a,
                         const PathBound& b, const CoreBall& core_b) {
  const Vec3 &n = axis.n_W, arm_a = a.axes_W * core_a.middle_B, arm_b = b.axes_W * core_b.middle_B;
  const Vec3 apart = (b.begin.position + arm_b) - (a.begin.position + arm_a);
  const Vec3 going = (b.travel_m + b.turn_W.cross(arm_b)) - (a.travel_m + a.turn_W.cross(arm_a));
  const double turned_a = std::min(mostTurned(axis.R_WA, a.begin.rotation), 2.0);
  const double turned_b = std::min(mostTurned(axis.R_WB, b.begin.rotation), 2.0);
  const double gap = dot(n, apart) - axis.offset_m;
  const double nearer = std::min(0.0, dot(n, going)) + std::min(0.0, dot(n, b.bend_m - a.bend_m)) -
                        core_a.off_m * a.swerving - core_b.off_m * b.swerving;
  return {gap - core_a.radius_m * turned_a - core_b.radius_m * turned_b,
          gap + nearer - core_a.radius_m * std::min(turned_a + a.turning, 2.0) -
              core_b.radius_m * std::min(turned_b + b.turning, 2.0)};
}

}  // namespace carom
