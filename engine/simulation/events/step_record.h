#pragma once
// Fills in the view of a step for whoever watches the world (step_view.h). Reads the step's working data and
// changes none of it. Internal to the simulation floor. Tested in
// tests/engine/simulation/bodies/step_view_test.cpp.

#include "engine/simulation/bodies/step_view.h"
#include "engine/simulation/contacts/lasting_contact.h"
#include "engine/simulation/events/contact_cluster.h"

namespace carom {

/// The world's working data at an instant, `time_s` of the world.
struct RecordedWorld {
  const std::vector<Body>& bodies;
  const std::vector<Shape>& shapes;
  const PairTable& table;
  double time_s = 0.0;
  int substeps = 1;
};

/// The lasting contacts just solved, of a substep that begins at `world.time_s`.
void recordContacts(const RecordedWorld& world, const LastingContacts& contacts, StepView& view);
/// The collision that the cluster has just solved, `time_s` after the substep's beginning.
void recordCollision(const std::vector<Body>& bodies, const ContactCluster& cluster, double time_s,
                     StepView& view);
/// Candidate pairs and swept bounds as the step leaves them.
void recordPairs(const RecordedWorld& world, StepView& view);

}  // namespace carom
