#include "engine/response/contact_solver.h"

#include <algorithm>
#include <cmath>

namespace carom {
namespace {

// The normal impulse that keeps the separating speed at or above its bound.
double solveNormal(ContactRow& row, std::span<ImpulseBody> bodies) {
  const double speed = rowVelocity(row, bodies).x();
  const double before = row.impulse.x();
  row.impulse.x() = std::max(0.0, before - (speed - row.lowest_speed) / row.response(0, 0));
  const double change = row.impulse.x() - before;
  if (change != 0.0) applyToRow(row, Vec3(change, 0.0, 0.0), bodies);
  return std::abs(change) * row.response(0, 0);
}

// The friction impulse after one step: holding if the cone allows it. Otherwise a step against the sliding velocity,
// scaled by one number so that its fixed point is parallel to that velocity whatever the shape of K, then shortened
// to the cone.
Vec2 frictionStep(const ContactRow& row, const Vec2& impulse, const Vec2& slip) {
  const double k11 = row.response(1, 1), k12 = row.response(1, 2), k22 = row.response(2, 2);
  const double det = k11 * k22 - k12 * k12;
  const Vec2 holding = impulse - Vec2(k22 * slip.x() - k12 * slip.y(), k11 * slip.y() - k12 * slip.x()) / det;
  if (holding.norm() <= row.friction.static_coefficient * row.impulse.x()) return holding;
  const double half_difference = 0.5 * (k11 - k22);
  const double largest = 0.5 * (k11 + k22) + std::sqrt(half_difference * half_difference + k12 * k12);
  const Vec2 step = impulse - slip / largest;
  const double limit = row.friction.dynamic_coefficient * row.impulse.x();
  const double length = step.norm();
  return length > limit ? Vec2(step * (limit / length)) : step;
}

double solveFriction(ContactRow& row, std::span<ImpulseBody> bodies) {
  const Vec2 before = row.impulse.tail<2>();
  if (row.impulse.x() == 0.0 && before.isZero(0.0)) return 0.0;
  const Vec2 slip = rowVelocity(row, bodies).tail<2>();
  const Vec2 after = frictionStep(row, before, slip);
  const Vec2 change = after - before;
  row.impulse.tail<2>() = after;
  if (!change.isZero(0.0)) applyToRow(row, Vec3(0.0, change.x(), change.y()), bodies);
  return change.norm() * std::max(row.response(1, 1), row.response(2, 2));
}

}  // namespace

void prepareRow(ContactRow& row, std::span<const ImpulseBody> bodies) {
  const TangentBasis tangents = tangentBasis(row.n);
  row.t1 = tangents.t1;
  row.t2 = tangents.t2;
  Mat3 frame;
  frame << row.n, row.t1, row.t2;
  row.response = frame.transpose() *
                 collisionMatrix(bodies[static_cast<std::size_t>(row.a)], bodies[static_cast<std::size_t>(row.b)], row.r_a, row.r_b) *
                 frame;
}

void applyToRow(const ContactRow& row, const Vec3& impulse, std::span<ImpulseBody> bodies) {
  const Vec3 on_b = rowImpulse(row, impulse);
  bodies[static_cast<std::size_t>(row.a)].apply(-on_b, row.r_a);
  bodies[static_cast<std::size_t>(row.b)].apply(on_b, row.r_b);
}

Vec3 rowVelocity(const ContactRow& row, std::span<const ImpulseBody> bodies) {
  const Vec3 v = bodies[static_cast<std::size_t>(row.b)].velocity.at(row.r_b) -
                 bodies[static_cast<std::size_t>(row.a)].velocity.at(row.r_a);
  return {row.n.dot(v), row.t1.dot(v), row.t2.dot(v)};
}

SolverReport solveContacts(std::span<ContactRow> rows, std::span<ImpulseBody> bodies, const SolverSettings& settings) {
  SolverReport report;
  const std::size_t n = rows.size();
  while (report.sweeps < settings.sweeps) {
    report.residual_mps = 0.0;
    const bool forward = report.sweeps % 2 == 0;
    for (std::size_t i = 0; i < n; ++i) {
      ContactRow& row = rows[forward ? i : n - 1 - i];
      double change = solveNormal(row, bodies);
      if (settings.friction) change = std::max(change, solveFriction(row, bodies));
      report.residual_mps = std::max(report.residual_mps, change);
    }
    ++report.sweeps;
    if (report.residual_mps <= settings.residual_mps) break;
  }
  return report;
}

}  // namespace carom
