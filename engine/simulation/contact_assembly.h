#pragma once
// The contact rows of a step: those of all pairs of shapes that are near enough, island by island, the bodies
// of a crowd dissected so that several threads can sweep its rows. Internal to the simulation floor. Tested
// through tests/engine/simulation/ and tests/physics/.

#include <vector>

#include "engine/modes/islands.h"
#include "engine/simulation/active_bodies.h"
#include "engine/simulation/contact_rows.h"
#include "engine/simulation/half_turn.h"

namespace carom {

/// What of a row differs between the solve of the momentum and that of the paths.
struct MomentumPart {
  Vec3 impulse;
  double lowest_speed = 0.0;
};

/// The rows of some pairs, as one thread makes them.
struct RowStretch {
  struct Pair {
    int pair = -1;
    int body_a = -1;
    int body_b = -1;
    std::size_t rows = 0;
  };
  std::vector<ContactRow> rows;
  std::vector<RowSource> sources;
  std::vector<Pair> pairs;
  std::vector<SourcedRow> of_pair;  ///< Scratch.
  StepCounters counters;
};

/// How a body moved before the step's impulses, once for all its rows.
struct BodyMotion {
  double mass_kg = 0.0;    ///< 0: it does not move.
  double speed_mps = 0.0;  ///< Of its middle, and of its surface about that.
  bool lies_still = true;
};

/// Room that is kept from step to step, by body of the world; what belongs to bodies that are not active is
/// as they came to rest.
struct ContactRoom {
  std::vector<char> bends;
  std::vector<Vec3> accelerations;
  std::vector<BodyMotion> motions;
  Islands joined;
};

/// The contact rows of a step with where they came from; kept for the modes, and their memory for the next
/// step.
struct LastingContacts {
  struct PairRows {
    int pair = -1;
    std::size_t begin = 0;
    std::size_t end = 0;
  };
  ContactRoom room;  ///< Scratch.
  std::vector<ContactRow> rows;
  std::vector<RowSource> sources;         ///< As long.
  std::vector<PairRows> pair_rows;        ///< The rows of each pair that has any, in their order.
  std::vector<HalfTurn> half_turns;       ///< One per body of the world.
  std::vector<ImpulseBody> bodies;        ///< In mid-step, one likewise, velocities after the solve.
  std::vector<char> touched;              ///< Moving bodies that some row pressed.
  std::vector<std::size_t> island_begin;  ///< Where each island's rows begin, and the end.
  std::vector<ImpulseBody> paths;         ///< The bodies with the mean velocities of their paths.
  std::vector<MomentumPart> momentum;     ///< Of the rows, while they are bounds on paths.
  std::vector<RowStretch> stretches;      ///< Scratch.
};

/// So many rows are looked at by one thread: to wait for another takes as long.
inline constexpr std::size_t kFewRows = 1000;

/// Of what a step's lasting contacts are made.
struct LastingWorld {
  std::vector<Body>& bodies;
  const std::vector<Shape>& shapes;
  PairTable& table;
  ActiveBodies& active;
  const WorldSettings& settings;
  Crew& crew;
};

/// Whether the pair is near enough, for its speed, to be solved as lasting contact in this step.
bool isLasting(const ShapePair& pair, double step_s);

/// Makes the rows of all lasting pairs of which a body moves, prepared and with the impulses that they start
/// from, not yet applied. What these pairs remember is over then.
void assembleContacts(const LastingWorld& world, StepCounters& counters, LastingContacts& contacts);

}  // namespace carom
