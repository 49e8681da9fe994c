#pragma once
// Rolling and spinning resistance of a contact point: a torque impulse against the relative angular velocity,
// Coulomb-like (Coulomb 1785; Johnson, Contact Mechanics, 9.2). Of the normal impulse j its part along the
// contact is at most `rolling_m` j, about the normal at most `spinning_m` j; below that, no turning. For the
// contact solver, with whose impulses it is solved. Tested in
// tests/engine/response/sweeps/turning_resistance_test.cpp and
// tests/physics/friction/rolling_resistance_test.cpp.

#include "engine/response/sweeps/contact_solver.h"

namespace carom {

/// Angular velocity of B relative to A about (n, t1, t2), rad/s.
Vec3 rowSpin(const ContactRow& row, std::span<const ImpulseBody> bodies);
/// Gives B a torque impulse about (n, t1, t2), N m s, and A its opposite.
void applyTorqueToRow(const ContactRow& row, const Vec3& torque, std::span<ImpulseBody> bodies);
/// Gives the bodies all that the row has: its impulse and, where it resists turning, its torque.
inline void applyLoad(const ContactRow& row, std::span<ImpulseBody> bodies) {
  applyToRow(row, row.impulse, bodies);
  if (row.resists_turning) applyTorqueToRow(row, row.torque, bodies);
}
/// Takes that from the bodies again; the row keeps it.
inline void takeBackLoad(ContactRow row, std::span<ImpulseBody> bodies) {
  row.impulse = -row.impulse;
  row.torque = -row.torque;
  applyLoad(row, bodies);
}
/// As if the rows had never given anything.
inline void undoLoads(std::span<ContactRow> rows, std::span<ImpulseBody> bodies) {
  for (ContactRow& row : rows) {
    takeBackLoad(row, bodies);
    row.impulse.setZero();
    row.torque.setZero();
  }
}
/// Of `prepareRow`: what the resistance needs to know of the bodies. Cuts levers so long (longer than the
/// bodies) that the torque of a normal impulse could undo half of what that does to the separating speed:
/// pressed apart by what presses them together, contacts would have no impulses to agree on.
void prepareResistance(ContactRow& row, std::span<const ImpulseBody> bodies);

/// From now on the row resists no turning: resistance belongs to lasting contact, not to collisions.
inline void endResistance(ContactRow& row) {
  row.resistance = {};
  row.resists_turning = false;
}

/// What a row gives its bodies, about (n, t1, t2).
struct RowLoad {
  Vec3 impulse = Vec3::Zero();  ///< N s.
  Vec3 torque = Vec3::Zero();   ///< N m s.
};

/// The load that leaves the point without sliding and, about the axes that resist, without turning, the
/// normal speed at its bound; whether it is within the limits. `miss`: the row's velocity less its bound.
bool holdsTurning(const ContactRow& row, std::span<const ImpulseBody> bodies, const Vec3& miss,
                  RowLoad& load);
/// One step of the torque against the turning that there is, cut to the limits that the row's impulse gives;
/// the impulse as it is, or, of a point that `is_held`, such as keeps it so, where friction can.
RowLoad resistTurning(const ContactRow& row, std::span<const ImpulseBody> bodies, bool is_held);
/// The speed, m/s, that as much energy would give the point along its normal as such a torque the turning.
double turningAsSpeed(const ContactRow& row, const Vec3& torque);

}  // namespace carom
