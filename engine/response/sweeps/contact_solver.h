#pragma once
// Simultaneous impulses at many contact points: block Gauss-Seidel on accumulated impulses with the true
// Coulomb cone (paper §2.4: an impulse at every colliding point; §3: friction in every collision). For each
// row: separating speed >= `lowest_speed`, normal impulse >= 0, complementary; the friction impulse opposes
// the sliding velocity, at most the coefficient's share of the normal one: the static coefficient of a point
// that does not slide when the row is prepared, else the dynamic one. Order matters to the path, not to the
// converged answer; rows are swept forwards and backwards in turn. Tested in
// tests/engine/response/sweeps/contact_solver_test.cpp.

#include <cmath>
#include <limits>
#include <span>

#include "engine/foundation/crew.h"
#include "engine/response/one_point/point_collision.h"
#include "engine/response/sweeps/dissection.h"

namespace carom {

/// Of turning at a contact point (turning_resistance.h), as shares of the normal impulse; 0: none.
struct TurningResistance {
  double rolling_m = 0.0;   ///< Of the torque along the contact.
  double spinning_m = 0.0;  ///< Of the torque about the normal.
  bool acts() const { return rolling_m > 0.0 || spinning_m > 0.0; }
};

/// One contact point between bodies a and b of the solver's list. What every visit reads comes first.
struct ContactRow {
  int a = -1;
  int b = -1;
  Vec3 n = Vec3::UnitZ();  ///< Unit, A to B.
  Vec3 r_a = Vec3::Zero();
  Vec3 r_b = Vec3::Zero();
  double lowest_speed = 0.0;    ///< m/s: the separating speed must not be below this.
  Vec3 impulse = Vec3::Zero();  ///< N s on B: (along n, t1, t2); on entry the warm start, already applied.
  double seen_stir = -1.0;      ///< The solver's: how much its bodies had been stirred at its last visit.

  // Filled by `prepareRow`.
  bool parts_idly = false;       ///< No impulse within the cone holds it where it separates without.
  bool resists_turning = false;  ///< Whether `resistance` acts.
  int part = kWhole;             ///< Of the bodies, that has both: see dissection.h.
  Vec3 t1 = Vec3::UnitX();
  Vec3 t2 = Vec3::UnitY();
  Mat3 inverse_response = Mat3::Zero();
  Vec3 normal_response = Vec3::Zero();  ///< First column of K in the frame (n, t1, t2).
  double largest_slip_response = 0.0;   ///< Largest eigenvalue of K's tangential part.
  double coefficient = 0.0;             ///< Of friction, for this solve: see `setCoefficient`.

  Vec2 still_slip = Vec2::Zero();  ///< m/s along (t1, t2): the velocity that counts as not sliding.
  Friction friction;
  TurningResistance resistance;        ///< Of solves with friction.
  Vec3 torque = Vec3::Zero();          ///< N m s on B about (n, t1, t2), as `impulse`.
  double largest_turn_response = 0.0;  ///< 1/(kg m^2); filled by `prepareRow` where `resistance` acts.
};

/// Needs the bodies' velocities before the solve: they say which coefficient of friction counts.
void prepareRow(ContactRow& row, std::span<const ImpulseBody> bodies);
/// Sets which coefficient counts in the solve of a prepared row.
void setCoefficient(ContactRow& row, double coefficient);
/// R_WR of the row's frame: its columns are (n, t1, t2).
inline Mat3 rowFrame(const ContactRow& row) {
  Mat3 frame;
  frame << row.n, row.t1, row.t2;
  return frame;
}
/// A world vector as (n, t1, t2).
inline Vec3 inRowFrame(const ContactRow& row, const Vec3& v_W) {
  return {dot(row.n, v_W), dot(row.t1, v_W), dot(row.t2, v_W)};
}
/// K, 1/kg, in the row's frame (n, t1, t2).
Mat3 rowResponse(const ContactRow& row, std::span<const ImpulseBody> bodies);
/// The largest eigenvalue of a response's part along (t1, t2).
double largestTangentialResponse(const Mat3& response);
/// World-frame impulse on B for an impulse in the row's frame.
inline Vec3 rowImpulse(const ContactRow& row, const Vec3& impulse) {
  return impulse.x() * row.n + impulse.y() * row.t1 + impulse.z() * row.t2;
}
inline void applyToRow(const ContactRow& row, const Vec3& impulse, std::span<ImpulseBody> bodies) {
  const Vec3 on_b = rowImpulse(row, impulse);
  ImpulseBody& a = bodies[static_cast<std::size_t>(row.a)];
  ImpulseBody& b = bodies[static_cast<std::size_t>(row.b)];
  if (a.inverse_mass > 0.0) a.apply(-on_b, row.r_a);
  if (b.inverse_mass > 0.0) b.apply(on_b, row.r_b);
}
/// Velocity of the point on B relative to that on A, m/s, world frame.
inline Vec3 rowVelocityInWorld(const ContactRow& row, std::span<const ImpulseBody> bodies) {
  return bodies[static_cast<std::size_t>(row.b)].velocity.at(row.r_b) -
         bodies[static_cast<std::size_t>(row.a)].velocity.at(row.r_a);
}
/// The same as (separating, t1, t2).
inline Vec3 rowVelocity(const ContactRow& row, std::span<const ImpulseBody> bodies) {
  return inRowFrame(row, rowVelocityInWorld(row, bodies));
}
/// What would hold the point: (separating, t1, t2), m/s.
inline Vec3 rowBound(const ContactRow& row) {
  return {row.lowest_speed, row.still_slip.x(), row.still_slip.y()};
}
/// By how much the velocity misses it.
inline Vec3 rowMiss(const ContactRow& row, std::span<const ImpulseBody> bodies) {
  return rowVelocity(row, bodies) - rowBound(row);
}

/// Whether an impulse in the row's frame presses and is within the row's Coulomb cone.
inline bool isInCone(const ContactRow& row, const Vec3& impulse) {
  const double limit = row.coefficient * impulse.x();
  return impulse.x() >= 0.0 && impulse.tail<2>().squaredNorm() <= limit * limit;
}
/// `v` in its direction, but no longer than `most`.
inline Vec2 shortened(const Vec2& v, double most) {
  const double squared = v.squaredNorm();
  return squared > most * most ? Vec2(v * (most / std::sqrt(squared))) : v;
}

struct SolverSettings {
  int sweeps = 0;             ///< At most.
  double residual_mps = 0.0;  ///< A sweep that changes no row's speed by more has converged.
  bool friction = true;
  int careful_sweeps = std::numeric_limits<int>::max();  ///< After so many the coarse residual is enough.
  double coarse_residual_mps = 0.0;
  /// Of 6 x 6 blocks: what steps of all held rows may take (standing_solver.h).
  long most_products = std::numeric_limits<long>::max();
  bool resumes = false;  ///< Goes on where the last call stopped: rows that it left settled are not visited.
  Crew* crew = nullptr;  ///< Who sweeps; none: the caller alone, which changes no bit of the outcome.
};

struct SolverReport {
  int sweeps = 0;
  double residual_mps = 0.0;  ///< The largest change of speed in the last sweep.
  long visits = 0;            ///< Rows looked at, over all sweeps.
  long products = 0;          ///< Of 6 x 6 blocks: what a step of all held rows takes (standing_solver.h).
};

inline constexpr double kVisitAll = -std::numeric_limits<double>::infinity();  ///< As `unnoticed_stir`.

/// How rows are swept: from the first to the last or back, over those whose bodies have been stirred by more
/// than `unnoticed_stir` since their last visit.
struct Sweep {
  bool friction = true;
  bool forward = true;
  double unnoticed_stir = kVisitAll;
};

/// One sweep. Adds to the report, whose residual is of this sweep.
void sweepRows(std::span<ContactRow> rows, std::span<ImpulseBody> bodies, const Sweep& sweep,
               SolverReport& report);

SolverReport solveContacts(std::span<ContactRow> rows, std::span<ImpulseBody> bodies,
                           const SolverSettings& settings);

}  // namespace carom
