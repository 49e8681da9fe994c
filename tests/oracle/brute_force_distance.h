#pragma once
// Oracle: the distance of two parts by trying every vertex against every triangle and every edge against
// every edge, in long double; parts that intersect are told by the separating axes, which give their depth.
// Tested against closed forms in tests/oracle/oracle_test.cpp.

#include <algorithm>
#include <limits>

#include "tests/oracle/separating_axes.h"

namespace carom::oracle {

inline Real nearestParameter(const Vec3R& p, const Vec3R& a, const Vec3R& d) {
  const Real length_squared = d.squaredNorm();
  return length_squared > 0 ? std::clamp(d.dot(p - a) / length_squared, Real(0), Real(1)) : Real(0);
}

inline Real pointSegmentSquared(const Vec3R& p, const Vec3R& a, const Vec3R& b) {
  const Vec3R d = b - a;
  return (p - (a + nearestParameter(p, a, d) * d)).squaredNorm();
}

/// Every candidate is a pair of points on the segments, so near-parallel ones cannot give less than the
/// truth.
inline Real segmentSegmentSquared(const Vec3R& a, const Vec3R& b, const Vec3R& c, const Vec3R& d) {
  Real best = std::min({pointSegmentSquared(a, c, d), pointSegmentSquared(b, c, d),
                        pointSegmentSquared(c, a, b), pointSegmentSquared(d, a, b)});
  const Vec3R u = b - a;
  const Vec3R v = d - c;
  const Real determinant = u.cross(v).squaredNorm();
  if (determinant > 0) {
    const Vec3R w = c - a;
    Real s = std::clamp(w.cross(v).dot(u.cross(v)) / determinant, Real(0), Real(1));
    for (int pass = 0; pass < 3; ++pass) {  // alternate between the segments: repairs the rounding of s
      const Vec3R on_ab = a + s * u;
      const Vec3R on_cd = c + nearestParameter(on_ab, c, v) * v;
      best = std::min(best, (on_cd - on_ab).squaredNorm());
      s = nearestParameter(on_cd, a, u);
    }
  }
  return best;
}

inline Real pointTriangleSquared(const Vec3R& p, const Vec3R& a, const Vec3R& b, const Vec3R& c) {
  const Vec3R n = (b - a).cross(c - a);
  const Real area_squared = n.squaredNorm();
  const bool above = area_squared > 0 && n.dot((b - a).cross(p - a)) >= 0 &&
                     n.dot((c - b).cross(p - b)) >= 0 && n.dot((a - c).cross(p - c)) >= 0;
  if (above) {
    const Real height = n.dot(p - a);
    return height * height / area_squared;
  }
  return std::min({pointSegmentSquared(p, a, b), pointSegmentSquared(p, b, c), pointSegmentSquared(p, c, a)});
}

/// From a point to the surface of a core (the whole core of a point or segment).
inline Real pointCoreSquared(const Vec3R& p, const PlacedConvex& core) {
  Real best = std::numeric_limits<Real>::infinity();
  const std::vector<Vec3R>& v = core.vertices;
  if (!core.triangles.empty())
    for (const auto& t : core.triangles)
      best = std::min(best, pointTriangleSquared(p, v[t[0]], v[t[1]], v[t[2]]));
  else if (!core.edges.empty())
    for (const auto& e : core.edges) best = std::min(best, pointSegmentSquared(p, v[e[0]], v[e[1]]));
  else
    for (const Vec3R& q : v) best = std::min(best, (p - q).squaredNorm());
  return best;
}

/// The distance of the cores' surfaces: that of the cores when they are disjoint. Rounding radii are left
/// out.
inline Real surfaceDistance(const PlacedConvex& a, const PlacedConvex& b) {
  Real best = std::numeric_limits<Real>::infinity();
  for (const Vec3R& p : a.vertices) best = std::min(best, pointCoreSquared(p, b));
  for (const Vec3R& p : b.vertices) best = std::min(best, pointCoreSquared(p, a));
  for (const auto& e : a.edges)
    for (const auto& f : b.edges)
      best = std::min(best, segmentSegmentSquared(a.vertices[e[0]], a.vertices[e[1]], b.vertices[f[0]],
                                                  b.vertices[f[1]]));
  return std::sqrt(best);
}

/// The signed gap of two parts, rounding radii subtracted: their distance, or minus their exact penetration
/// depth. `axes`: their largest gap along an axis; anything if both are flat.
inline Real signedGap(const PlacedConvex& a, const PlacedConvex& b, const AxisGap& axes) {
  const bool flat = a.flat() && b.flat();
  const Real gap = flat || axes.gap_m > 0 ? surfaceDistance(a, b) : axes.gap_m;
  return gap - a.radius_m - b.radius_m;
}

inline Real signedGap(const PlacedConvex& a, const PlacedConvex& b) {
  return signedGap(a, b, a.flat() && b.flat() ? AxisGap{} : largestAxisGap(a, b));
}

}  // namespace carom::oracle
