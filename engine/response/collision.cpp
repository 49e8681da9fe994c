#include "engine/response/collision.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/response/standing_solver.h"
#include "engine/response/sweeps/energy_bound.h"

namespace carom {
namespace {

constexpr int kCollisionSweeps = 400;     // of each of the two phases, at most
constexpr double kConverged = 1e-12;      // of the approach speed: a sweep that changes less is the last
constexpr double kLeastApproach = 1e-10;  // of the approach speed: points that approach more slowly are left
constexpr int kMostStops = 4000;          // of approaches that the phases have left, at most
// Of the approach speed: what sweeps change by more at the end is solved at once ...
constexpr double kSlow = 1e-9;
// ... where it is no more rows than these ...
constexpr std::size_t kRowsAtOnce = 32;
// ... after so many sweeps more.
constexpr int kSweepsBefore = 20;

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

// Few rows that sweeps have not brought to rest, between bodies of very different mass, are solved at once.
void solveRows(std::span<ContactRow> rows, std::span<ImpulseBody> bodies, double approach_mps) {
  SolverSettings settings{kCollisionSweeps, kConverged * approach_mps, true};
  if (solveContacts(rows, bodies, settings).residual_mps <= kSlow * approach_mps) return;
  if (rows.size() > kRowsAtOnce) return;
  settings.sweeps = kSweepsBefore;
  solveStandingContacts(rows, bodies, settings);
  takeBackGain(rows, bodies);
}

// What the solves have left approaching, where they have not converged (rough ground, very unequal masses):
// one point after the other, the fastest first, is stopped by a collision of its own without restitution.
// Each takes energy away, so this ends.
void stopApproaches(std::span<ContactRow> rows, std::span<ImpulseBody> bodies, double tolerated_mps) {
  for (int i = 0; i < kMostStops; ++i) {
    std::size_t fastest = 0;
    double approach = 0.0;
    for (std::size_t k = 0; k < rows.size(); ++k) {
      const double speed = rowVelocity(rows[k], bodies).x();
      if (speed >= approach) continue;
      approach = speed;
      fastest = k;
    }
    if (approach >= -tolerated_mps) return;
    ContactRow& row = rows[fastest];
    const Vec3 impulse =
        pointCollisionImpulse({rowResponse(row, bodies), rowVelocity(row, bodies), row.friction, 0.0});
    applyToRow(row, impulse, bodies);
    row.impulse += impulse;
  }
}

}  // namespace

CollisionReport collide(std::span<ContactRow> rows, std::span<ImpulseBody> bodies,
                        std::span<const double> restitution) {
  CollisionReport report;
  std::vector<Vec3> before(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    before[i] = rowVelocity(rows[i], bodies);
    report.approach_mps = std::min(report.approach_mps, before[i].x());
    rows[i].lowest_speed = 0.0;
    rows[i].resistance = {};
  }
  const double approach_mps = std::abs(report.approach_mps);  // no minus zero where nothing approaches
  if (rows.size() == 1) {
    ContactRow& row = rows.front();
    row.impulse =
        pointCollisionImpulse({rowResponse(row, bodies), before[0], row.friction, restitution.front()});
    applyToRow(row, row.impulse, bodies);
    report.impulse_Ns = row.impulse.x();
    return report;
  }
  solveRows(rows, bodies, approach_mps);

  if (std::any_of(restitution.begin(), restitution.end(), [](double e) { return e > 0.0; })) {
    std::vector<Vec3> compressed(rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
      compressed[i] = rows[i].impulse;
      const double rebound = restitution[i] * rows[i].impulse.x();
      applyToRow(rows[i], Vec3(rebound, 0.0, 0.0), bodies);
      rows[i].impulse.x() += rebound;
      rows[i].lowest_speed = compressed[i].x() > 0.0 ? -restitution[i] * std::min(before[i].x(), 0.0) : 0.0;
    }
    solveRows(rows, bodies, approach_mps);
    if (twiceEnergyGain(rows, before, bodies) > 0.0) {
      report.restitution_cut = true;
      cutRestitution(rows, before, compressed, bodies);
    }
  }
  stopApproaches(rows, bodies, kLeastApproach * approach_mps);
  for (const ContactRow& row : rows) report.impulse_Ns += row.impulse.x();
  return report;
}

}  // namespace carom
