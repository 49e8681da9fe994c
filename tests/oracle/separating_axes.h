#pragma once
// Oracle: the separating-axis theorem by brute force. Every face normal of both parts and every cross product
// of their edge directions is an axis; all vertices are projected on each. The largest gap is positive
// exactly when the cores are disjoint, and is minus the exact penetration depth when they intersect. At least
// one of the parts must have faces. Tested in tests/oracle/oracle_test.cpp.

#include <limits>

#include "tests/oracle/placed_convex.h"

namespace carom::oracle {

struct AxisGap {
  Real gap_m = -std::numeric_limits<Real>::infinity();
  Vec3R axis = Vec3R::Zero();  ///< Unit, from A to B.
};

/// How far B lies beyond A along unit `axis`; negative when their shadows overlap.
inline Real gapAlong(const PlacedConvex& a, const PlacedConvex& b, const Vec3R& axis) {
  Real most_a = -std::numeric_limits<Real>::infinity();
  Real least_b = std::numeric_limits<Real>::infinity();
  for (const Vec3R& v : a.vertices) most_a = std::max(most_a, axis.dot(v));
  for (const Vec3R& v : b.vertices) least_b = std::min(least_b, axis.dot(v));
  return least_b - most_a;
}

/// The largest gap of the cores (rounding radii left out) over all separating axes.
inline AxisGap largestAxisGap(const PlacedConvex& a, const PlacedConvex& b) {
  AxisGap best;
  const auto consider = [&](const Vec3R& axis) {
    Real least_a = std::numeric_limits<Real>::infinity(), most_a = -least_a;
    Real least_b = least_a, most_b = most_a;
    for (const Vec3R& v : a.vertices) {
      const Real h = axis.dot(v);
      least_a = std::min(least_a, h);
      most_a = std::max(most_a, h);
    }
    for (const Vec3R& v : b.vertices) {
      const Real h = axis.dot(v);
      least_b = std::min(least_b, h);
      most_b = std::max(most_b, h);
    }
    if (least_b - most_a > best.gap_m) best = {least_b - most_a, axis};
    if (least_a - most_b > best.gap_m) best = {least_a - most_b, -axis};
  };
  for (const Vec3R& n : a.face_normals) consider(n);
  for (const Vec3R& n : b.face_normals) consider(n);
  constexpr Real kParallelSine = 1e-12L;  // such edges share their axes with the faces beside them
  for (const Vec3R& d1 : a.edge_directions)
    for (const Vec3R& d2 : b.edge_directions) {
      const Vec3R n = d1.cross(d2);
      const Real sine = n.norm();
      if (sine > kParallelSine) consider(n / sine);
    }
  return best;
}

}  // namespace carom::oracle
