#include "engine/response/standing_solver.h"

#include "engine/response/conjugate_sweeps.h"
#include "engine/response/held_rows.h"
#include "engine/response/sweeps/solution.h"

namespace carom {
namespace {

// Direct steps, at most: each leaves a fifth to a fiftieth of the residual.
constexpr int kDirectSteps = 4;
// Times the residual that is enough. A heap in which some contact comes and goes stays below this and above
// enough, so there a step that gains little is the last.
constexpr double kNearlyEnough = 5.0;
// Of the best residual: a step that leaves more gains little.
constexpr double kGainingShare = 0.2;
// Of the residual that is enough: the sweeps after a step go on to this, for the next step to start from.
constexpr double kFiner = 0.1;
// Times the best residual: a step that leaves more has found held rows that contradict each other.
constexpr double kHopeless = 10.0;
// Sweeps after a step, at most: fewer do not bring the impulses back into their cones.
constexpr int kSweepsAfter = 16;

}  // namespace

SolverReport solveStandingContacts(std::span<ContactRow> rows, std::span<ImpulseBody> bodies,
                                   const SolverSettings& settings) {
  SolverReport total = solveContactsFinely(rows, bodies, settings);
  const SolverSettings after{
      .sweeps = kSweepsAfter, .residual_mps = kFiner * settings.residual_mps, .crew = settings.crew};
  if (total.residual_mps <= settings.residual_mps) return total;
  HeldRows held(rows, bodies);
  total.products = held.products();
  if (total.products > settings.most_products) return total;
  Solution best(rows, bodies);
  double least_mps = total.residual_mps;
  for (int step = 0; step < kDirectSteps && (step + 1) * total.products <= settings.most_products; ++step) {
    if (!held.step(rows, bodies)) break;
    const SolverReport report = solveContactsFinely(rows, bodies, after);
    total.sweeps += report.sweeps;
    total.visits += report.visits;
    total.residual_mps = report.residual_mps;
    if (report.residual_mps > kHopeless * least_mps) break;
    if (report.residual_mps <= settings.residual_mps) return total;
    if (report.residual_mps >= least_mps) continue;
    const bool gains = report.residual_mps <= kGainingShare * least_mps;
    best = Solution(rows, bodies);
    least_mps = report.residual_mps;
    if (!gains && least_mps <= kNearlyEnough * settings.residual_mps) break;
  }
  best.restore(rows, bodies);
  total.residual_mps = least_mps;
  return total;
}

}  // namespace carom
