#pragma once
// What can be seen of the last step besides the bodies: contacts with their impulses, collisions, candidate
// pairs and swept bounds. Plain values, filled in by a world that is watched (World::watch); a world that is
// not spends nothing on them. Tested in tests/engine/simulation/bodies/step_view_test.cpp.

#include <cstdint>
#include <vector>

#include "engine/broad_phase/candidate_pairs.h"
#include "engine/foundation/frames.h"

namespace carom {

/// A point of contact and the impulse that it took.
struct ContactView {
  int body_a = -1;
  int body_b = -1;
  Vec3 p_A = Vec3::Zero();   ///< The point on A, in A's frame: so it also fits poses shown a little later.
  Vec3 p_B = Vec3::Zero();   ///< The point on B, in B's frame, likewise.
  Vec3 n_W = Vec3::UnitZ();  ///< Unit, from A to B.
  double gap_m = 0.0;        ///< When the impulse acted.
  Vec3 impulse_W = Vec3::Zero();  ///< N s on B; the opposite on A. Of lasting contact, in a whole step.
  std::uint64_t id = 0;           ///< `contactId` of the two features.
  double time_s = 0.0;            ///< World time of the impulse.
};

struct CandidateView {
  int body_a = -1;
  int body_b = -1;
  double gap_m = 0.0;  ///< At the end of the step.
};

struct StepView {
  double begin_s = 0.0;              ///< World time at which the last substep began.
  std::vector<ContactView> lasting;  ///< Lasting contacts of the last substep, those of resting bodies with
                                     ///< what they took when they came to rest.
  std::vector<ContactView> collisions;    ///< Those of times of impact, oldest first; grows until whoever
                                          ///< watches takes them out.
  std::vector<CandidateView> candidates;  ///< One a pair of parts, by bodies.
  std::vector<Bounds> swept;              ///< One a body, world, metres: what it may touch in the step, with
                                          ///< the room for its contacts.
};

}  // namespace carom
