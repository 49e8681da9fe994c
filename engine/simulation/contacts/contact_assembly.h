#pragma once
// The contact rows of a step: those of all pairs of shapes that are near enough, island by island, the bodies
// of a crowd dissected so that several threads can sweep its rows. Internal to the simulation floor. Tested
// through tests/engine/simulation/ and tests/physics/.

#include <algorithm>
#include <span>
#include <vector>

#include "engine/contact/time_of_impact.h"
#include "engine/modes/islands.h"
#include "engine/response/sweeps/ordered_pass.h"
#include "engine/simulation/bodies/active_bodies.h"
#include "engine/simulation/bodies/half_turn.h"
#include "engine/simulation/contacts/carried_path.h"
#include "engine/simulation/contacts/contact_rows.h"
#include "engine/simulation/contacts/internal_edges.h"

namespace carom {

/// What of a row differs between the solve of the momentum and that of the paths, and what comes of both.
struct MomentumPart {
  Vec3 impulse;
  double lowest_speed = 0.0;
  OpeningPower opening;
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

  void clear() {
    rows.clear();
    sources.clear();
    pairs.clear();
    counters = {};
  }
};

/// Room that is kept from step to step, by body of the world; what belongs to bodies that are not active is
/// as they came to rest.
struct ContactRoom {
  std::vector<char> bends;
  std::vector<Vec3> accelerations;
  std::vector<Velocity> ways;      ///< Means of momenta, from which paths are led.
  std::vector<Velocity> led_from;  ///< Means of paths before they were raised for turning.
  std::vector<char> still;         ///< Whether a body lies still before the step's impulses.
  std::vector<char> near;          ///< Whether a body is within reach of lasting contact.
  std::vector<char> listed;        ///< All 0 but while bodies are listed.
  BearingContacts bearings;
  Islands joined;
  std::vector<UpwardPass> upward;  ///< Of the islands whose paths have asked for it.
  std::vector<char> is_ordered;    ///< Likewise.
  UpwardPass::Scratch of_order;
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
  /// What moves and hangs together by rows: those of one island stand together, and so do its pairs.
  struct Island {
    std::size_t row_begin = 0;
    std::size_t row_end = 0;
    std::size_t pair_begin = 0;
    std::size_t pair_end = 0;
    double push_mps = 0.0;  ///< What gravity, or a load, gives in the step: residuals are relative to it.
  };
  std::span<ContactRow> rowsOf(const Island& island) {
    return std::span(rows).subspan(island.row_begin, island.row_end - island.row_begin);
  }
  std::span<const PairRows> pairsOf(const Island& island) const {
    return std::span(pair_rows).subspan(island.pair_begin, island.pair_end - island.pair_begin);
  }
  /// Of some islands, by index: all bodies that their rows have, ascending.
  std::vector<int> bodiesOf(std::span<const std::size_t> some);

  std::vector<ContactRow> rows;
  std::vector<RowSource> sources;      ///< As long.
  std::vector<PairRows> pair_rows;     ///< The rows of each pair that has any, in their order.
  std::vector<HalfTurn> half_turns;    ///< One per body of the world.
  std::vector<ImpulseBody> bodies;     ///< In mid-step, one likewise, velocities after the solve.
  std::vector<char> touched;           ///< Moving bodies that some row pressed.
  std::vector<Velocity> before;        ///< Of the bodies, in mid-step, ahead of environment and contacts.
  std::vector<Velocity> gained;        ///< What the environment gives the bodies in the step, likewise.
  std::vector<Island> islands;         ///< In the order of the rows.
  std::vector<ImpulseBody> paths;      ///< The bodies with the mean velocities of their paths.
  std::vector<MomentumPart> momentum;  ///< Of the rows, while they are bounds on paths.
  std::vector<RowStretch> stretches;   ///< Scratch.
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

/// Where and how a pair comes down whose search has `found` it to, on these paths.
Landing landingOn(const Trajectory& a, const Trajectory& b, const TimeOfImpact& found);

/// Of pairs that come down within the step (ShapePair::landing), those that are solved with the lasting
/// contacts, before anything moves; the others are few enough to be left to their times of impact, and their
/// landings are reset. An impact that is solved ahead of its time takes from what holds the bodies until
/// then: the error is first order in the step, and accuracy is bought while the budget of row visits lasts,
/// of `rows`. `islands`: of the bodies, the pairs' joined.
std::vector<int> crowdedLandings(std::span<const int> pairs, const LastingWorld& world, std::size_t rows,
                                 Islands& islands);

/// So often can each of `rows` be visited within a step's budget.
inline int sweepsInBudget(std::size_t rows) {
  return tolerance::kSolverRowVisits / std::max(1, static_cast<int>(rows));
}

/// Solves islands within a step's budget of row visits, by `solve(island, sweeps, again)`, which returns its
/// report: each at first for its share, then those that have not come to `enough_mps` of it again, for what
/// the others have left. Returns all row visits.
template <typename Enough, typename Solve>
long solveWithinBudget(const LastingContacts& contacts, std::span<const std::size_t> islands,
                       const Enough& enough_mps, const Solve& solve) {
  const auto rowsOf = [&](std::size_t island) {
    return contacts.islands[island].row_end - contacts.islands[island].row_begin;
  };
  long visits = 0;
  std::size_t unfinished_rows = 0;
  std::vector<std::size_t> unfinished;
  for (const std::size_t island : islands) {
    const SolverReport report = solve(island, sweepsInBudget(contacts.rows.size()), false);
    visits += report.visits;
    if (report.residual_mps <= enough_mps(island)) continue;
    unfinished.push_back(island);
    unfinished_rows += rowsOf(island);
  }
  if (unfinished.empty()) return visits;
  const long sweeps = (tolerance::kSolverRowVisits - visits) / static_cast<long>(unfinished_rows);
  if (sweeps < 1) return visits;
  for (const std::size_t island : unfinished) visits += solve(island, static_cast<int>(sweeps), true).visits;
  return visits;
}

/// Makes the rows of all lasting pairs of which a body moves, prepared and with the impulses that they start
/// from, not yet applied. What these pairs remember is over then.
void assembleContacts(const LastingWorld& world, StepCounters& counters, LastingContacts& contacts);

/// Puts rows where `pairs` come down (ShapePair::landing) beside those solved already, or in place of what
/// these pairs had; what their bodies have of the rows taken out is given back. Returns the islands of the
/// new rows; of theirs, those with a body of such a pair are marked as not looked at.
std::vector<std::size_t> addLandings(const LastingWorld& world, std::span<const int> pairs,
                                     StepCounters& counters, LastingContacts& contacts);

}  // namespace carom
