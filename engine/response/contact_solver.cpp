#include "engine/response/contact_solver.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "engine/foundation/tolerances.h"

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

// One step against the sliding velocity, scaled by one number so that its fixed point is parallel to that
// velocity whatever the shape of K, then shortened to the cone.
Vec2 frictionStep(const ContactRow& row, const Vec2& impulse, const Vec2& slip) {
  const double k11 = row.response(1, 1), k12 = row.response(1, 2), k22 = row.response(2, 2);
  const double half_difference = 0.5 * (k11 - k22);
  const double largest = 0.5 * (k11 + k22) + std::sqrt(half_difference * half_difference + k12 * k12);
  const Vec2 step = impulse - slip / largest;
  const double limit = row.coefficient * row.impulse.x();
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

// The impulse that holds the point: no sliding, the normal speed at its bound. Solved for all three parts at
// once, because on rough ground normal and friction impulses, taken in turn, undo each other. False when the
// cone forbids it.
bool holdPoint(ContactRow& row, std::span<ImpulseBody> bodies, double& change) {
  const Vec3 miss = rowVelocity(row, bodies) - Vec3(row.lowest_speed, 0.0, 0.0);
  const Vec3 step = -(row.inverse_response * miss);
  const Vec3 held = row.impulse + step;
  if (!(held.x() >= 0.0) || held.tail<2>().norm() > row.coefficient * held.x()) return false;
  row.impulse = held;
  applyToRow(row, step, bodies);
  change = miss.norm();
  return true;
}

double solveRow(ContactRow& row, std::span<ImpulseBody> bodies, bool friction) {
  double change = 0.0;
  if (friction && holdPoint(row, bodies, change)) return change;
  change = solveNormal(row, bodies);
  return friction ? std::max(change, solveFriction(row, bodies)) : change;
}

}  // namespace

void prepareRow(ContactRow& row, std::span<const ImpulseBody> bodies) {
  const TangentBasis tangents = tangentBasis(row.n);
  row.t1 = tangents.t1;
  row.t2 = tangents.t2;
  Mat3 frame;
  frame << row.n, row.t1, row.t2;
  row.response = frame.transpose() *
                 collisionMatrix(bodies[static_cast<std::size_t>(row.a)],
                                 bodies[static_cast<std::size_t>(row.b)], row.r_a, row.r_b) *
                 frame;
  row.inverse_response = row.response.inverse();
  const bool slides = rowVelocity(row, bodies).tail<2>().norm() > tolerance::kSlipSpeed;
  row.coefficient = slides ? row.friction.dynamic_coefficient : row.friction.static_coefficient;
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

SolverReport solveContacts(std::span<ContactRow> rows, std::span<ImpulseBody> bodies,
                           const SolverSettings& settings) {
  SolverReport report;
  const std::size_t n = rows.size();
  while (report.sweeps < settings.sweeps) {
    report.residual_mps = 0.0;
    const bool forward = report.sweeps % 2 == 0;
    for (std::size_t i = 0; i < n; ++i) {
      ContactRow& row = rows[forward ? i : n - 1 - i];
      report.residual_mps = std::max(report.residual_mps, solveRow(row, bodies, settings.friction));
    }
    ++report.sweeps;
    if (report.residual_mps <= settings.residual_mps) break;
  }
  return report;
}

}  // namespace carom
