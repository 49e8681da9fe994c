#include "engine/response/impulse.h"

namespace carom {

Mat3 collisionMatrix(const ImpulseBody& a, const ImpulseBody& b, const Vec3& r_a, const Vec3& r_b) {
  const Mat3 cross_a = crossMatrix(r_a);
  const Mat3 cross_b = crossMatrix(r_b);
  return (a.inverse_mass + b.inverse_mass) * Mat3::Identity() - cross_a * a.inverse_tensor * cross_a -
         cross_b * b.inverse_tensor * cross_b;
}

double frictionlessImpulse(const ImpulseBody& a, const ImpulseBody& b, const Vec3& r_a, const Vec3& r_b,
                           const Vec3& n, double restitution) {
  const double u = n.dot(b.velocity.at(r_b) - a.velocity.at(r_a));
  if (u >= 0.0) return 0.0;
  return -(1.0 + restitution) * u / n.dot(collisionMatrix(a, b, r_a, r_b) * n);
}

}  // namespace carom
