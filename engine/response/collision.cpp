#include "engine/response/collision.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/response/newton_solver.h"
#include "engine/response/sweeps/energy_bound.h"
#include "engine/response/sweeps/principal_pivoting.h"
#include "engine/response/sweeps/turning_resistance.h"

namespace carom {
namespace {

// Of each of the two phases, at most, where Newton's method, whose steps bound themselves, does not solve it.
constexpr int kCollisionSweeps = 400;
// Of few rows that pivots have found no way to stop: there may be none, and each sweep presses on.
constexpr int kSweepsOfFew = 60;
constexpr double kConverged = 1e-12;      // of the approach speed: a sweep that changes less is the last
constexpr double kLeastApproach = 1e-10;  // of the approach speed: points that approach more slowly are left

// 2 (E_after - E_before) = sum over the points of impulse . (u_before + u_after).
double twiceEnergyGain(std::span<const ContactRow> rows, const std::vector<Vec3>& before,
                       std::span<const ImpulseBody> bodies) {
  double gain = 0.0;
  for (std::size_t i = 0; i < rows.size(); ++i)
    gain += dot(rows[i].impulse, before[i] + rowVelocity(rows[i], bodies));
  return gain;
}

// Takes back the share of the restitution phase that would leave more energy than there was. Velocities
// between the end of compression and the end of restitution are linear in the share, so the energy is a
// convex parabola of it.
void cutRestitution(std::span<ContactRow> rows, const std::vector<Vec3>& before,
                    const std::vector<Vec3>& compressed, std::span<ImpulseBody> bodies) {
  std::vector<Vec3> whole(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) whole[i] = rows[i].impulse;
  const auto setShare = [&](double share) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const Vec3 impulse = compressed[i] + share * (whole[i] - compressed[i]);
      applyToRow(rows[i], impulse - rows[i].impulse, bodies);
      rows[i].impulse = impulse;
    }
  };
  double low = 0.0;
  double high = 1.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    setShare(middle);
    (twiceEnergyGain(rows, before, bodies) <= 0.0 ? low : high) = middle;
  }
  setShare(low);
}

void solveRows(std::span<ContactRow> rows, std::span<ImpulseBody> bodies, double enough_mps) {
  solveContactsByNewton(rows, bodies, {kCollisionSweeps, enough_mps, true});
}

// What the solves have left approaching, where they have not converged (rough ground that rows contradict
// each other on), is stopped without friction: that takes energy away, and among bodies that can move there
// is always a solution.
void stopApproaches(std::span<ContactRow> rows, std::span<ImpulseBody> bodies, double tolerated_mps) {
  const bool any = std::any_of(rows.begin(), rows.end(), [&](const ContactRow& row) {
    return rowVelocity(row, bodies).x() < -tolerated_mps;
  });
  if (!any) return;
  std::vector<ContactRow> stops(rows.begin(), rows.end());
  for (ContactRow& row : stops) {
    row.impulse.setZero();
    row.lowest_speed = 0.0;
  }
  const auto size = static_cast<Eigen::Index>(rows.size());
  if (!pivotRows(stops, bodies, Eigen::VectorXd::Constant(size, tolerated_mps))) {
    const int sweeps = rows.size() <= kMostNewtonRows ? kSweepsOfFew : kCollisionSweeps;
    solveContacts(stops, bodies, {sweeps, tolerated_mps, false});
  }
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i].impulse += stops[i].impulse;
}

}  // namespace

void collide(std::span<ContactRow> rows, std::span<ImpulseBody> bodies, std::span<const double> restitution,
             double enough_mps) {
  double lowest_mps = 0.0;
  std::vector<Vec3> before(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    before[i] = rowVelocity(rows[i], bodies);
    lowest_mps = std::min(lowest_mps, before[i].x());
    rows[i].lowest_speed = 0.0;
    endResistance(rows[i]);
  }
  const double approach_mps = std::abs(lowest_mps);  // no minus zero where nothing approaches
  if (rows.size() == 1) {
    ContactRow& row = rows.front();
    row.impulse =
        pointCollisionImpulse({rowResponse(row, bodies), before[0], row.friction, restitution.front()});
    applyToRow(row, row.impulse, bodies);
    return;
  }
  const double residual_mps = std::max(enough_mps, kConverged * approach_mps);
  solveRows(rows, bodies, residual_mps);
  takeBackGain(rows, bodies);

  if (std::any_of(restitution.begin(), restitution.end(), [](double e) { return e > 0.0; })) {
    std::vector<Vec3> compressed(rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
      compressed[i] = rows[i].impulse;
      const double rebound = restitution[i] * rows[i].impulse.x();
      applyToRow(rows[i], Vec3(rebound, 0.0, 0.0), bodies);
      rows[i].impulse.x() += rebound;
      rows[i].lowest_speed = compressed[i].x() > 0.0 ? -restitution[i] * std::min(before[i].x(), 0.0) : 0.0;
    }
    solveRows(rows, bodies, residual_mps);
    if (twiceEnergyGain(rows, before, bodies) > 0.0) cutRestitution(rows, before, compressed, bodies);
  }
  stopApproaches(rows, bodies, std::max(enough_mps, kLeastApproach * approach_mps));
}

}  // namespace carom
