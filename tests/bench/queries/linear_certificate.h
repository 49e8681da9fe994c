#pragma once
// Proves one of our answers at a cost linear in the vertices, in double: for the long run, where the oracles
// in long double would take days. Two parts apart: witnesses in both parts and a free slab as wide as their
// distance. Two that intersect: moving B by the depth along the normal frees it, and a witness or the
// middle between them lies in both. What is not proven here is left to the exhaustive oracle.

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/closest_features/vclip.h"

namespace carom::bench {

/// The farthest that the core reaches along `n_W`, metres from the world's origin.
inline double reachAlong(const ConvexPolyhedron& core, const Pose& X_WP, const Vec3& n_W) {
  const Vec3 n_P = X_WP.rotation.conjugate() * n_W;
  double most = -std::numeric_limits<double>::infinity();
  for (const Vec3& v : core.vertices()) most = std::max(most, n_P.dot(v));
  return most + n_W.dot(X_WP.position);
}

/// How far a point stands out of a polyhedron; at most 0 within.
inline double outside(const ConvexPolyhedron& core, const Pose& X_WP, const Vec3& p_W) {
  const Vec3 p_P = X_WP.rotation.conjugate() * (p_W - X_WP.position);
  double most = -std::numeric_limits<double>::infinity();
  for (int f = 0; f < core.faceCount(); ++f) most = std::max(most, core.plane(f).signedDistance(p_P));
  return most;
}

/// By how much the answer about two polyhedra may be wrong, metres; of a depth, by how much it may be too
/// small, or how far the parts are from sharing the point that shows them to intersect. For unit rotations.
inline double provenWithin(const ConvexPart& a, const Pose& X_WA, const ConvexPart& b, const Pose& X_WB,
                           const ClosestFeatures& c) {
  const double width = -reachAlong(b.core, X_WB, -c.n_W) - reachAlong(a.core, X_WA, c.n_W);
  const double slab = std::max(std::abs(width - c.distance_m), std::abs(c.n_W.norm() - 1.0));
  if (c.distance_m > 0.0) {
    const double way = (c.p_B_W - c.p_A_W - c.distance_m * c.n_W).norm();
    return std::max({slab, way, outside(a.core, X_WA, c.p_A_W), outside(b.core, X_WB, c.p_B_W)});
  }
  double out = std::numeric_limits<double>::infinity();
  for (const Vec3& p : {Vec3(0.5 * (c.p_A_W + c.p_B_W)), c.p_A_W, c.p_B_W})
    out = std::min(out, std::max(outside(a.core, X_WA, p), outside(b.core, X_WB, p)));
  return std::max(slab, out);
}

}  // namespace carom::bench
