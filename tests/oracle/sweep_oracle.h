#pragma once
// Oracle: up to which time two parts on given paths are proven to stay apart. No point of a part is faster
// than its centre plus spin times reach, so a gap g at one look is left no sooner than g / (sum of the
// speeds): looks follow each other at these intervals (conservative advancement), and are as dense as the gap
// is small. A look is the largest shadow gap over separating axes, in long double; while one axis still shows
// a gap it is used again. Shares nothing with V-Clip nor with the engine's search but the paths themselves.
// Tested in tests/oracle/sweep_oracle_test.cpp.

#include "engine/motion/trajectory.h"
#include "tests/oracle/separating_axes.h"

namespace carom::oracle {

struct SweptPart {
  const ConvexPart* part = nullptr;  ///< With faces.
  const Trajectory* path = nullptr;

  /// Of any point of the part between two times, m/s: the centre's speed is largest at one of the ends.
  double fastest(double from_s, double to_s) const {
    const double linear = std::max(path->velocityAt(from_s).norm(), path->velocityAt(to_s).norm());
    return linear + path->spin.norm() * (part->core.radiusAbout(Vec3::Zero()) + part->radius_m);
  }
};

/// How far B lies beyond A along a unit axis, with their rounding; at most the distance of the parts.
inline Real shadowGap(const ConvexPart& a, const Pose& X_WA, const ConvexPart& b, const Pose& X_WB,
                      const Vec3R& axis) {
  const auto most = [](const ConvexPart& part, const Pose& X, const Vec3R& n) {
    const Vec3R n_B = X.rotation.cast<Real>().normalized().conjugate() * n;
    Real m = -std::numeric_limits<Real>::infinity();
    for (const Vec3& v : part.core.vertices()) m = std::max(m, n_B.dot(v.cast<Real>()));
    return m + n.dot(X.position.cast<Real>()) + part.radius_m;
  };
  return -most(a, X_WA, axis) - most(b, X_WB, -axis);
}

struct SweepProof {
  double proven_s = 0.0;  ///< Apart by more than the threshold from the beginning to here.
  int looks = 0;
  bool touched = false;  ///< At `proven_s` the threshold is reached; otherwise the end is, or the bound.
};

constexpr double kSmallestAdvance = 1e-13;  // of the sweep: what is left of the gap is rounding

/// From `from_s` to `to_s`, in at most `most_looks`.
inline SweepProof provenApart(const SweptPart& a, const SweptPart& b, double from_s, double to_s,
                              double threshold_m, int most_looks = 200000) {
  SweepProof proof{from_s, 0, false};
  Vec3R axis = Vec3R::Zero();
  const double speed = a.fastest(from_s, to_s) + b.fastest(from_s, to_s);
  Real last = 0;  // what the axis showed when it was found
  while (proof.proven_s < to_s && proof.looks < most_looks) {
    ++proof.looks;
    const Pose X_a = a.path->at(proof.proven_s), X_b = b.path->at(proof.proven_s);
    Real gap = axis.squaredNorm() > 0 ? shadowGap(*a.part, X_a, *b.part, X_b, axis) : Real{-1};
    if (gap < last / 2 || gap <= Real{threshold_m}) {
      const AxisGap best = largestAxisGap(place(*a.part, X_a), place(*b.part, X_b));
      axis = best.axis;
      last = gap = best.gap_m - a.part->radius_m - b.part->radius_m;
    }
    const double safe_s = speed > 0.0 ? static_cast<double>((gap - threshold_m) / speed) : to_s - from_s;
    proof.touched = gap <= Real{threshold_m} || safe_s < kSmallestAdvance * (to_s - from_s);
    if (proof.touched) return proof;
    proof.proven_s = std::min(to_s, proof.proven_s + safe_s);
  }
  return proof;
}

}  // namespace carom::oracle
