#include "engine/solid/mass_properties.h"

#include <numbers>

namespace carom {
namespace {

// Inertia of mass m at offset d from the axis point (parallel-axis theorem).
Mat3 pointInertia(double mass, const Vec3& d) {
  return mass * (d.squaredNorm() * Mat3::Identity() - d * d.transpose());
}

}  // namespace

MassProperties MassProperties::combined(const MassProperties& a, const MassProperties& b) {
  MassProperties sum;
  sum.mass = a.mass + b.mass;
  sum.center = (a.mass * a.center + b.mass * b.center) / sum.mass;
  sum.inertia = a.inertia + pointInertia(a.mass, a.center - sum.center) + b.inertia +
                pointInertia(b.mass, b.center - sum.center);
  return sum;
}

// Signed tetrahedra between a reference point and a fan of each face: for a tetrahedron with one corner at
// the origin and the others at a, b, c (det = a . b x c), volume = det/6, first moment = det/24 (a+b+c), and
// the second moment is det/120 (sum v v^T + s s^T), s = a+b+c (the divergence theorem on monomials of degree
// <= 2).
MassProperties polyhedronMass(const ConvexPolyhedron& polyhedron) {
  const Vec3 reference = polyhedron.vertex(0);  // near the body: no cancellation far from the origin
  double volume = 0.0;
  Vec3 first = Vec3::Zero();
  Mat3 second = Mat3::Zero();
  for (int f = 0; f < polyhedron.faceCount(); ++f) {
    const std::span<const int> loop = polyhedron.faceVertices(f);
    const Vec3 a = polyhedron.vertex(loop[0]) - reference;
    for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
      const Vec3 b = polyhedron.vertex(loop[i]) - reference;
      const Vec3 c = polyhedron.vertex(loop[i + 1]) - reference;
      const double det = a.dot(b.cross(c));
      const Vec3 s = a + b + c;
      volume += det / 6.0;
      first += det / 24.0 * s;
      second += det / 120.0 * (a * a.transpose() + b * b.transpose() + c * c.transpose() + s * s.transpose());
    }
  }
  MassProperties result;
  if (!(volume > 0.0)) return result;
  const Vec3 center = first / volume;
  const Mat3 covariance = second - volume * center * center.transpose();
  result.mass = volume;
  result.center = reference + center;
  result.inertia = covariance.trace() * Mat3::Identity() - covariance;
  return result;
}

MassProperties ballMass(const Vec3& center, double radius_m) {
  const double mass = 4.0 / 3.0 * std::numbers::pi * radius_m * radius_m * radius_m;
  return {mass, center, 0.4 * mass * radius_m * radius_m * Mat3::Identity()};
}

MassProperties capsuleMass(const Vec3& a, const Vec3& b, double radius_m) {
  const Vec3 axis = b - a;
  const double h = axis.norm();
  const double r2 = radius_m * radius_m;
  const double cylinder = std::numbers::pi * r2 * h;
  const double caps = 4.0 / 3.0 * std::numbers::pi * r2 * radius_m;
  // A half ball's centroid is 3/8 r from its flat side.
  const double along = 0.5 * cylinder * r2 + 0.4 * caps * r2;
  const double across =
      cylinder * (0.25 * r2 + h * h / 12.0) + caps * (0.4 * r2 + 0.25 * h * h + 0.375 * h * radius_m);
  const Vec3 u = axis / h;
  const Mat3 uu = u * u.transpose();
  return {cylinder + caps, 0.5 * (a + b), along * uu + across * (Mat3::Identity() - uu)};
}

}  // namespace carom
