#pragma once
// The path of a body in lasting contact. Its forces act evenly, so its momentum changes evenly and its path
// bends with it (DEVIATES: the paper applies the step's gravity at its beginning): struck at any instant, the
// body has the energy that it has fallen, or slid, for. Where a bent path would dip towards another body on
// its way, it is straight. Internal to the simulation floor. Tested in
// tests/physics/friction/carried_energy_test.cpp.

#include <span>
#include <vector>

#include "engine/simulation/contacts/contact_rows.h"

namespace carom {

/// What forces make of a body's velocity over the rest of a step.
struct CarriedStretch {
  Velocity begin;  ///< Of the momentum, at `body.path.start_s`, where the body is.
  Velocity gain;   ///< Its angular part by the tensor of the orientation `R_WB`.
  Quat R_WB;       ///< The orientation that contacts were solved for.
  Vec3 spin;       ///< The body's spin in that orientation before their impulses, rad/s.
  double rest_of_step_s = 0.0;
};

/// From now on the forces are those that give the momentum its gain.
void driveEvenly(Body& body, const CarriedStretch& stretch);

/// The path at a mean velocity, bent as the momentum is or straight.
void carryAlong(Body& body, const Velocity& mean, double rest_of_step_s, bool bends);

/// May be called for several rows at the same time. Clears `bends` for the bodies of a row (indices of
/// `bends` and `accelerations`) whose bent paths would dip, on their way, by a noticeable share of what lies
/// between the row's gap and the window's floor.
void straightenDips(const ContactRow& row, double gap_m, const CollisionWindow& window, double rest_of_step_s,
                    std::span<const Vec3> accelerations, std::span<char> bends);

}  // namespace carom
