#pragma once
// The path of a body in lasting contact. Its forces act evenly, so its momentum changes evenly and its path
// bends with it (DEVIATES: the paper applies the step's gravity at its beginning): struck at any instant, the
// body has the energy that it has fallen, or slid, for. Where a bent path would dip towards another body on
// its way, it is straight. Internal to the simulation floor. Tested in
// tests/physics/friction/carried_energy_test.cpp and tests/engine/simulation/events/path_lifts_test.cpp.

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

/// The path at a mean velocity, bent as the momentum is or straight. It opens nothing yet.
void carryAlong(Body& body, const Velocity& mean, double rest_of_step_s, bool bends);

/// What a contact does on the paths of its two bodies, W, where they open it more than the momenta would.
struct OpeningPower {
  double of_a_W = 0.0;
  double of_b_W = 0.0;
};
/// Where a contact is: its normal from A to B, and its arms from their centres of mass.
struct ContactPlace {
  const Vec3& n_W;
  const Vec3& arm_a;
  const Vec3& arm_b;
};
/// Where the paths and the momenta of two bodies go, in the mean over the rest of the step.
struct PairMotions {
  Velocity path_a, path_b;
  Velocity momentum_a, momentum_b;
};
/// Of a contact that presses with this force: the virtual work of opening it, shared by how far each path is
/// led. The momenta know of none of it, and it raises what lies above. Openings slower than `noise_mps` are
/// the solver's.
OpeningPower openingPower(const ContactPlace& contact, double force_N, const PairMotions& motions,
                          double noise_mps);
/// What the solver may leave, of a pair with this window.
double openingNoise(const CollisionWindow& window, double rest_of_step_s);

/// May be called for several rows at the same time. Clears `bends` for the bodies of a row (indices of
/// `bends` and `accelerations`) whose bent paths would dip, on their way, by a noticeable share of what lies
/// between the row's gap and the window's floor.
void straightenDips(const ContactRow& row, double gap_m, const CollisionWindow& window, double rest_of_step_s,
                    std::span<const Vec3> accelerations, std::span<char> bends);

}  // namespace carom
