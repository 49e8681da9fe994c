#pragma once
// Two polyhedra and where the second stands in the frame of the first: what every part of a query works on.
// Tested in tests/engine/closest_features/pair/polyhedron_pair_test.cpp.

#include <cmath>

#include "engine/solid/convex_polyhedron.h"

namespace carom {

/// A rotation by a quaternion that need not be unit: drift of its length changes nothing.
class Rotation {
 public:
  explicit Rotation(const Quat& q)
      : u_(q.x(), q.y(), q.z()), w_(q.w()), s_(twiceTheInverse(q.squaredNorm())) {}
  /// The inverse of a, then b.
  static Rotation between(const Quat& a, const Quat& b) {
    return {a.conjugate() * b, twiceTheInverse(a.squaredNorm() * b.squaredNorm())};
  }

  Vec3 operator*(const Vec3& v) const {
    const Vec3 c = u_.cross(v);
    return v + s_ * (w_ * c + u_.cross(c));
  }
  /// The inverse rotation of v.
  Vec3 back(const Vec3& v) const {
    const Vec3 c = u_.cross(v);
    return v + s_ * (u_.cross(c) - w_ * c);
  }
  Mat3 matrix() const;

 private:
  Rotation(const Quat& q, double s) : u_(q.x(), q.y(), q.z()), w_(q.w()), s_(s) {}

  // Of almost 1 the series 1 - e is exact to rounding and spares the query a division's latency.
  static double twiceTheInverse(double x) {
    const double e = x - 1.0;
    return std::abs(e) < 0x1p-27 ? 2.0 - 2.0 * e : 2.0 / x;
  }

  Vec3 u_;
  double w_, s_;
};

struct PolyhedronPair {
  PolyhedronPair(const ConvexPolyhedron& a_in, const Pose& X_WA, const ConvexPolyhedron& b_in,
                 const Pose& X_WB);

  Vec3 toA(const Vec3& p_B) const { return directionToA(p_B) + t_AB; }
  Vec3 toB(const Vec3& p_A) const { return directionToB(p_A - t_AB); }
  Vec3 directionToA(const Vec3& d_B) const { return R_AB * d_B; }
  Vec3 directionToB(const Vec3& d_A) const { return R_AB.transpose() * d_A; }
  /// The same pair seen from the other side.
  PolyhedronPair swapped() const;

  const ConvexPolyhedron& a;
  const ConvexPolyhedron& b;
  Mat3 R_AB;
  Vec3 t_AB;

 private:
  PolyhedronPair(const ConvexPolyhedron& a_in, const ConvexPolyhedron& b_in, const Mat3& R, const Vec3& t)
      : a(a_in), b(b_in), R_AB(R), t_AB(t) {}
};

inline Mat3 Rotation::matrix() const {
  const Vec3 t = s_ * u_;
  const double xx = t.x() * u_.x(), yy = t.y() * u_.y(), zz = t.z() * u_.z();
  const double xy = t.x() * u_.y(), xz = t.x() * u_.z(), yz = t.y() * u_.z();
  const double wx = t.x() * w_, wy = t.y() * w_, wz = t.z() * w_;
  Mat3 m;
  m << 1.0 - (yy + zz), xy - wz, xz + wy,  //
      xy + wz, 1.0 - (xx + zz), yz - wx,   //
      xz - wy, yz + wx, 1.0 - (xx + yy);
  return m;
}

inline PolyhedronPair::PolyhedronPair(const ConvexPolyhedron& a_in, const Pose& X_WA,
                                      const ConvexPolyhedron& b_in, const Pose& X_WB)
    : a(a_in), b(b_in) {
  R_AB = Rotation::between(X_WA.rotation, X_WB.rotation).matrix();
  t_AB = Rotation(X_WA.rotation).back(X_WB.position - X_WA.position);
}

inline PolyhedronPair PolyhedronPair::swapped() const {
  return {b, a, R_AB.transpose(), -directionToB(t_AB)};
}

}  // namespace carom
