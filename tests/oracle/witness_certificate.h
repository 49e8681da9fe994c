#pragma once
// Oracle: proves or refutes an answer about two parts without searching for one, at a cost linear in their
// features. Separated: both witnesses lie in their parts, so the distance is at most theirs, and the slab
// between the planes through the witnesses is free of both parts, so it is at least the slab's width.
// Penetrating: moving B by the depth along the normal frees it, so the depth is at least the least one, and
// `intersect` finds a common point. Tested in tests/oracle/oracle_test.cpp.

#include "tests/oracle/brute_force_distance.h"

namespace carom::oracle {

/// How far a point stands out of a core; at most 0 within a polyhedron, the distance for a point or segment.
inline Real outside(const Vec3R& p, const PlacedConvex& core) {
  if (core.flat()) return std::sqrt(pointCoreSquared(p, core));
  Real most = -std::numeric_limits<Real>::infinity();
  for (std::size_t f = 0; f < core.face_normals.size(); ++f)
    most = std::max(most, core.face_normals[f].dot(p - core.face_points[f]));
  return most;
}

struct ClaimedAnswer {
  Real distance_m = 0;
  Vec3R p_A, p_B, n;
};

/// By how much the claim may be wrong as a statement about the distance (0 when it is exact).
inline Real separationError(const PlacedConvex& a, const PlacedConvex& b, const ClaimedAnswer& claim) {
  const Real width = gapAlong(a, b, claim.n) - a.radius_m - b.radius_m;
  const Vec3R core_a = claim.p_A - a.radius_m * claim.n;
  const Vec3R core_b = claim.p_B + b.radius_m * claim.n;
  return std::max({std::abs(claim.n.norm() - 1), std::abs(width - claim.distance_m),
                   (claim.p_B - claim.p_A - claim.distance_m * claim.n).norm(), outside(core_a, a),
                   outside(core_b, b)});
}

inline bool segmentMeetsTriangle(const Vec3R& p, const Vec3R& q, const Vec3R& a, const Vec3R& b,
                                 const Vec3R& c) {
  const Vec3R n = (b - a).cross(c - a);
  const Real h_p = n.dot(p - a);
  const Real h_q = n.dot(q - a);
  if ((h_p < 0) == (h_q < 0)) return false;
  const Vec3R x = p + h_p / (h_p - h_q) * (q - p);
  return n.dot((b - a).cross(x - a)) >= 0 && n.dot((c - b).cross(x - b)) >= 0 &&
         n.dot((a - c).cross(x - c)) >= 0;
}

/// Whether two polyhedra have a common point: a vertex of one within the other, or an edge of one through a
/// face of the other (complete for convex polyhedra that overlap by more than rounding).
inline bool intersect(const PlacedConvex& a, const PlacedConvex& b) {
  const auto oneWay = [](const PlacedConvex& x, const PlacedConvex& y) {
    for (const Vec3R& p : x.vertices)
      if (outside(p, y) <= 0) return true;
    for (const auto& e : x.edges)
      for (const auto& t : y.triangles)
        if (segmentMeetsTriangle(x.vertices[e[0]], x.vertices[e[1]], y.vertices[t[0]], y.vertices[t[1]],
                                 y.vertices[t[2]]))
          return true;
    return false;
  };
  return oneWay(a, b) || oneWay(b, a);
}

}  // namespace carom::oracle
