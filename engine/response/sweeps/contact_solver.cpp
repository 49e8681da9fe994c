#include "engine/response/sweeps/contact_solver.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "engine/foundation/index.h"
#include "engine/foundation/tolerances.h"
#include "engine/response/sweeps/shared_sweeps.h"
#include "engine/response/sweeps/turning_resistance.h"

namespace carom {
namespace {

constexpr double kStirShare = 0.1;  // of the residual: a row whose bodies were stirred less is not visited

// The impulse that holds the point: no sliding, the normal speed at its bound. Solved for all three parts at
// once, because on rough ground normal and friction impulses, taken in turn, undo each other. False when the
// cone forbids it. `miss`: the row's velocity less its bound.
bool holds(const ContactRow& row, const Vec3& miss, Vec3& impulse) {
  impulse = row.impulse - row.inverse_response * miss;
  return isInCone(row, impulse);
}

// The normal impulse that keeps the separating speed at or above its bound.
double normalImpulse(const ContactRow& row, const Vec3& miss) {
  return std::max(0.0, row.impulse.x() - miss.x() / row.normal_response.x());
}

// One step against the sliding velocity, scaled by one number so that its fixed point is parallel to that
// velocity whatever the shape of K, then shortened to the cone.
Vec2 frictionImpulse(const ContactRow& row, double normal_impulse, const Vec2& slip) {
  return shortened(row.impulse.tail<2>() - slip / row.largest_slip_response,
                   row.coefficient * normal_impulse);
}

double largest(const Vec3& v) {
  return v.cwiseAbs().maxCoeff();
}

struct RowChange {
  double speed_mps = 0.0;
  bool settled = true;  ///< The row's conditions hold now; else only a step towards them was taken.
};

// Whether the row does not press and need not: in a heap, nearly half of all visits.
bool isIdle(const ContactRow& row, const Vec3& velocity_W) {
  return row.parts_idly && row.impulse.isZero(0.0) && dot(row.n, velocity_W) >= row.lowest_speed;
}

// Brings the impulse of one row to its conditions, or nearer to them, with all else as it is.
RowChange solvePoint(ContactRow& row, std::span<ImpulseBody> bodies, bool friction) {
  const Vec3 velocity_W = rowVelocityInWorld(row, bodies);
  if (isIdle(row, velocity_W)) return {};
  const Vec3 miss = inRowFrame(row, velocity_W) - rowBound(row);
  Vec3 impulse = row.impulse;
  double change = 0.0;
  bool settled = true;
  const bool rough = row.coefficient > 0.0;
  if (friction && rough && holds(row, miss, impulse)) {
    change = largest(miss);
  } else {
    impulse.x() = normalImpulse(row, miss);
    impulse.tail<2>() = row.impulse.tail<2>();
    const double normal_change = impulse.x() - row.impulse.x();
    change = std::abs(normal_change) * row.normal_response.x();
    if (friction && ((rough && impulse.x() > 0.0) || !row.impulse.tail<2>().isZero(0.0))) {
      const Vec2 slip = miss.tail<2>() + normal_change * row.normal_response.tail<2>();
      impulse.tail<2>() = frictionImpulse(row, impulse.x(), slip);
      const double slip_change = (impulse - row.impulse).tail<2>().cwiseAbs().maxCoeff();
      change = std::max(change, slip_change * row.largest_slip_response);
      settled = false;
    }
  }
  if (change == 0.0) return {};
  applyToRow(row, impulse - row.impulse, bodies);
  row.impulse = impulse;
  return {change, settled};
}

// The same with a torque against turning: all held at once, or else each brought nearer with the other as it
// is. Kept out of the way of the rows without.
[[gnu::noinline]] RowChange solveTurningPoint(ContactRow& row, std::span<ImpulseBody> bodies) {
  const Vec3 miss = rowMiss(row, bodies);
  RowLoad load;
  RowChange change;
  if (holdsTurning(row, bodies, miss, load)) {
    change.speed_mps = largest(miss);
  } else {
    change = solvePoint(row, bodies, true);
    load = resistTurning(row, bodies, change.settled && row.impulse.x() > 0.0);
    change.settled = change.settled && load.torque.isZero(0.0);
  }
  const Vec3 torque_change = load.torque - row.torque;
  change.speed_mps = std::max(change.speed_mps, turningAsSpeed(row, torque_change));
  applyToRow(row, load.impulse - row.impulse, bodies);
  applyTorqueToRow(row, torque_change, bodies);
  row.impulse = load.impulse;
  row.torque = load.torque;
  return change;
}

RowChange solveRow(ContactRow& row, std::span<ImpulseBody> bodies, bool friction) {
  if (friction && row.resists_turning) [[unlikely]]
    return solveTurningPoint(row, bodies);
  return solvePoint(row, bodies, friction);
}

double& stirOf(std::span<ImpulseBody> bodies, int i) {
  return bodies[at(i)].stir;
}

}  // namespace

Mat3 rowResponse(const ContactRow& row, std::span<const ImpulseBody> bodies) {
  const Mat3 frame = rowFrame(row);
  return frame.transpose() * collisionMatrix(bodies[at(row.a)], bodies[at(row.b)], row.r_a, row.r_b) * frame;
}

double largestTangentialResponse(const Mat3& response) {
  const double half_difference = 0.5 * (response(1, 1) - response(2, 2));
  return 0.5 * (response(1, 1) + response(2, 2)) +
         std::sqrt(half_difference * half_difference + response(1, 2) * response(1, 2));
}

void prepareRow(ContactRow& row, std::span<const ImpulseBody> bodies) {
  const TangentBasis tangents = tangentBasis(row.n);
  row.t1 = tangents.t1;
  row.t2 = tangents.t2;
  const Mat3 response = rowResponse(row, bodies);
  row.normal_response = response.col(0);
  row.inverse_response = response.inverse();
  row.largest_slip_response = largestTangentialResponse(response);
  const bool slides = rowVelocity(row, bodies).tail<2>().norm() > tolerance::kSlipSpeed;
  setCoefficient(row, slides ? row.friction.dynamic_coefficient : row.friction.static_coefficient);
  row.resists_turning = row.resistance.acts();
  if (row.resists_turning) prepareResistance(row, bodies);
}

void setCoefficient(ContactRow& row, double coefficient) {
  row.coefficient = coefficient;
  row.parts_idly = coefficient * row.normal_response.tail<2>().norm() < row.normal_response.x();
}

void sweepRows(std::span<ContactRow> rows, std::span<ImpulseBody> bodies, const Sweep& sweep,
               SolverReport& report) {
  double residual_mps = 0.0;
  long visits = 0;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    ContactRow& row = rows[sweep.forward ? k : rows.size() - 1 - k];
    double& stir_a = stirOf(bodies, row.a);
    double& stir_b = stirOf(bodies, row.b);
    if (row.seen_stir >= 0.0 && stir_a + stir_b - row.seen_stir <= sweep.unnoticed_stir) continue;
    const double before = stir_a + stir_b;
    const RowChange change = solveRow(row, bodies, sweep.friction);
    if (bodies[at(row.a)].inverse_mass > 0.0) stir_a += change.speed_mps;
    if (bodies[at(row.b)].inverse_mass > 0.0) stir_b += change.speed_mps;
    row.seen_stir = change.settled ? stir_a + stir_b : before;
    residual_mps = std::max(residual_mps, change.speed_mps);
    ++visits;
  }
  report.residual_mps = residual_mps;
  report.visits += visits;
  ++report.sweeps;
}

SolverReport solveContacts(std::span<ContactRow> rows, std::span<ImpulseBody> bodies,
                           const SolverSettings& settings) {
  for (ContactRow& row : rows) {
    if (settings.resumes) break;
    row.seen_stir = -1.0;
    stirOf(bodies, row.a) = stirOf(bodies, row.b) = 0.0;
  }
  SharedSweeps sweeps(rows, bodies, settings.crew);
  SolverReport report;
  while (report.sweeps < settings.sweeps) {
    const bool careful = report.sweeps < settings.careful_sweeps;
    const double enough = careful ? settings.residual_mps : settings.coarse_residual_mps;
    const bool forward = report.sweeps % 2 == 0;
    sweeps.sweep({settings.friction, forward, kStirShare * enough}, report);
    if (report.residual_mps <= enough) break;
  }
  return report;
}

}  // namespace carom
