#include "engine/response/one_point/impulse.h"

namespace carom {

namespace {

// Of the response of free bodies: an impulse along a locked axis is as large as its cone lets it be.
constexpr double kTraceOfResponse = 0x1p-40;
constexpr double kNoResponse = 0x1p-30;  // likewise: what rounding leaves of none, and the trace

bool isLocked(const ImpulseBody& body) {
  return body.inverse_mass > 0.0 && body.has_locks;
}

}  // namespace

Mat3 collisionMatrix(const ImpulseBody& a, const ImpulseBody& b, const Vec3& r_a, const Vec3& r_b) {
  const Mat3 cross_a = crossMatrix(r_a);
  const Mat3 cross_b = crossMatrix(r_b);
  const Mat3 turning_a = cross_a * a.inverse_tensor * cross_a;
  const Mat3 turning_b = cross_b * b.inverse_tensor * cross_b;
  const double inverse_mass = a.inverse_mass + b.inverse_mass;
  if (!isLocked(a) && !isLocked(b)) return inverse_mass * Mat3::Identity() - turning_a - turning_b;
  Mat3 moving = (a.inverse_mass * a.free_axes + b.inverse_mass * b.free_axes).asDiagonal();
  moving.diagonal().array() += kTraceOfResponse * inverse_mass;
  return moving - turning_a - turning_b;
}

bool isUnanswered(const ImpulseBody& a, const ImpulseBody& b, double response) {
  if (!isLocked(a) && !isLocked(b)) return false;
  return response <= kNoResponse * (a.inverse_mass + b.inverse_mass);
}

double frictionlessImpulse(const ImpulseBody& a, const ImpulseBody& b, const Vec3& r_a, const Vec3& r_b,
                           const Vec3& n, double restitution) {
  const double u = dot(n, b.velocity.at(r_b) - a.velocity.at(r_a));
  if (u >= 0.0) return 0.0;
  return -(1.0 + restitution) * u / dot(n, collisionMatrix(a, b, r_a, r_b) * n);
}

}  // namespace carom
