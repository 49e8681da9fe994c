#pragma once
// The rows that a pair of shapes gives the contact solver: one for each point of its manifold.
// Internal to the simulation floor. Tested through tests/engine/simulation/.

#include <vector>

#include "engine/response/sweeps/contact_solver.h"
#include "engine/simulation/contacts/pair_table.h"

namespace carom {

/// Where a row comes from.
struct RowSource {
  int pair = -1;
  std::uint64_t id = 0;
  double gap_m = 0.0;
  double off_middle_m = 0.0;  ///< The row's point lies so far from the gap's middle, towards B.
  double slack_m = 0.0;       ///< It may be so far beside its true place: gaps are held in a band.
};
struct SourcedRow : RowSource {
  ContactRow row;
};

inline constexpr double kSamePlace = 10.0;  ///< Rest gaps: points this close are one.

/// What of one pair to make rows of.
struct RowRequest {
  int pair = -1;
  int row_a = -1;  ///< Indices of the two bodies in the solver's list.
  int row_b = -1;
  const ClosestFeatures* closest = nullptr;
  Pose X_WA;
  Pose X_WB;
  FormerPoints former;    ///< The pair's points up to now.
  double height_m = 0.0;  ///< Points up to this gap count, and up to the window's height at least.
  bool struck = false;    ///< The closest point gets a row wherever it is: it has been stopped there.
};

/// Which of the pair's parts the other may glide along.
Ground groundOf(const ShapePair& pair, const std::vector<Body>& bodies);

/// Appends the rows of a pair; the solver's `bodies` prepare them.
void appendRows(const RowRequest& request, const ShapePair& pair, const std::vector<Body>& bodies,
                const std::vector<Shape>& shapes, std::span<const ImpulseBody> solver_bodies,
                std::vector<SourcedRow>& rows);

/// The contact coefficients of two materials: friction is the geometric mean, restitution the larger.
Friction combinedFriction(const Material& a, const Material& b);
double combinedRestitution(const Material& a, const Material& b);
/// Of turning: geometric means, as of friction.
TurningResistance combinedResistance(const Material& a, const Material& b);

/// What a kinematic body does by the forces of a pair's contacts between two times of the step, J: they act
/// evenly, on its velocity in the mean. 0 for pairs without one.
double workOfForces(const ShapePair& pair, const std::vector<Body>& bodies, double begin_s, double end_s);

/// How a gap may change in `dt_s`. Within a band about the rest gap it is held, so that a body on more
/// contacts than it needs can lie still on all of them; above the band it may close to it, gently where the
/// contact `presses` already: bodies wedged between others never find all their gaps within the band. Where
/// restitution keeps almost all energy, gaps reopen only from much lower: being lifted is energy too. Where
/// bodies have not the room for their rest gaps, gaps and bands are those of ShapePair::room.
struct GapSpeeds {
  double momentum = 0.0;  ///< The separating speed must not be below this.
  double path =
      0.0;  ///< The same for the path, which also reopens gaps below the band; that gives no energy.
};
GapSpeeds gapSpeeds(double gap_m, const ShapePair& pair, double dt_s, bool presses = false);

/// m/s: what speeds may miss, so that it cannot use up a gap within a step.
inline double safeResidual(const CollisionWindow& window, double step_s) {
  constexpr double kGapShare = 0.4;  // of the rest gap
  return kGapShare * window.rest / step_s;
}

/// Where rows are that bound paths: the bodies' poses at `time_s`, and from there the rest of the step.
struct PathBounds {
  const std::vector<Body>& bodies;
  const std::vector<Shape>& shapes;
  double time_s = 0.0;
  double rest_of_step_s = 0.0;
  bool all = false;  ///< Also by what comes in so fast that it has its own time of impact.
};

/// Rows are linear in time, but what turns while it slides along another approaches it with the square of the
/// time. Raises the lowest speeds of the rows of a pair that would not end the step in the window on these
/// `paths` (indexed by the rows); whether it would not. What comes in fast is left to its time of impact: no
/// path lifts a body over a collision.
bool raiseForTurning(const PathBounds& bounds, const ShapePair& pair, std::span<const ImpulseBody> paths,
                     std::span<ContactRow> rows, StepCounters& counters);
inline constexpr int kTurningRounds = 2;  ///< Of raising and solving again.

}  // namespace carom
