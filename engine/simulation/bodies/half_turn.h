#pragma once
// A body that spins and is no ball, in the middle of its step. Its angular velocity changes by itself, as its
// angular momentum stays. So a step in lasting contact is half a step of torque-free rotation, the impulses
// where that leads, and the other half: symmetric in time, and second order like the rows in mid-step
// (midstep_rows.h). Each half turns with its mean angular momentum under even forces, those of contacts being
// foreseen as in the last step: a top nutates freely much faster than on its tip. Internal to the simulation
// floor. Tested in tests/physics/flight/spinning_top_test.cpp.

#include "engine/simulation/bodies/body.h"

namespace carom {

struct HalfTurn {
  Quat R_WB = Quat::Identity();
  Vec3 spin = Vec3::Zero();  ///< rad/s, before the impulses.
  bool tumbles = false;      ///< Else orientation and spin are those of the step's beginning.
};

/// Changes of a point's velocity below `noticed_mps` are left out.
HalfTurn halfTurn(const Body& body, double step_s, double noticed_mps);

/// The constant spin that takes the body where both halves do, its spin in mid-step being `spin_after` once
/// the impulses have acted.
Vec3 meanSpin(const Body& body, const HalfTurn& half, const Vec3& spin_after, double step_s);

}  // namespace carom
