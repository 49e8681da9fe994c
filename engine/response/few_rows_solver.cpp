#include "engine/response/few_rows_solver.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "engine/response/newton_rows.h"
#include "engine/response/sweeps/solution.h"

namespace carom {
namespace {

constexpr int kFirstSweeps = 4;  // they find most rows that press
constexpr int kLastSweeps = 2;   // they bring impulses back into their cones, and say how far all is
// Of a row's own response: how far it gives way, for rows that repeat each other. Its square is below
// rounding, so that two steps leave nothing of it.
constexpr double kLeastGive = 1e-8;
// Steps that find who presses and who slides at once, at most. Where they go round in a circle ...
constexpr int kStraightSteps = 6;
// ... others give way by a hundredth, each a tenth of the one before: a path to the solution.
constexpr double kFirstGive = 1e-2;
constexpr double kGiveShare = 0.1;
constexpr int kEasedSteps = 16;
// Of the residual before: steps that leave more have found nothing. Where rows contradict each other, as
// between a wall and what is driven towards it, they press without measure; sweeps press no more than each
// takes.
constexpr double kFoundShare = 1e-3;

// Steps until the rows' conditions hold, or so many.
void takeSteps(NewtonRows& newton, double first_give, int most, double enough_mps) {
  double give = first_give;
  for (int step = 0; step < most && newton.step(give); ++step) {
    if (newton.miss() <= enough_mps) return;
    give = std::max(kLeastGive, kGiveShare * give);
  }
}

class FewRowsSolver {
 public:
  FewRowsSolver(std::span<ContactRow> rows, std::span<ImpulseBody> bodies, const SolverSettings& settings)
      : rows_(rows), bodies_(bodies), settings_(settings) {}

  // Both say whether the rows have converged.
  bool sweep(int sweeps) {
    SolverSettings some = settings_;
    some.sweeps = std::min(sweeps, settings_.sweeps - report_.sweeps);
    if (some.sweeps <= 0) return false;
    const SolverReport report = solveContacts(rows_, bodies_, some);
    report_.sweeps += report.sweeps;
    report_.visits += report.visits;
    report_.residual_mps = report.residual_mps;
    return report.residual_mps <= settings_.residual_mps;
  }
  bool solveAtOnce(double first_give, int steps) {
    if (report_.sweeps >= settings_.sweeps) return false;
    const Solution before(rows_, bodies_);
    const double residual_mps = report_.residual_mps;
    if (!newton_) newton_.emplace(rows_, bodies_, settings_.friction);
    takeSteps(*newton_, first_give, steps, settings_.residual_mps);
    applyAnew(before);
    if (sweep(kLastSweeps)) return true;
    if (report_.residual_mps <= kFoundShare * residual_mps) return false;
    before.restore(rows_, bodies_);
    report_.residual_mps = residual_mps;
    return false;
  }
  const SolverReport& report() const { return report_; }

 private:
  // Steps on the way may have been by impulses without measure: what rounding left of them is not momentum.
  void applyAnew(const Solution& before) {
    std::vector<Vec3> impulses;
    for (const ContactRow& row : rows_) impulses.push_back(row.impulse);
    before.restore(rows_, bodies_);
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      applyToRow(rows_[i], impulses[i] - rows_[i].impulse, bodies_);
      rows_[i].impulse = impulses[i];
    }
  }

  std::span<ContactRow> rows_;
  std::span<ImpulseBody> bodies_;
  const SolverSettings& settings_;
  std::optional<NewtonRows> newton_;
  SolverReport report_;
};

}  // namespace

SolverReport solveFewContacts(std::span<ContactRow> rows, std::span<ImpulseBody> bodies,
                              const SolverSettings& settings) {
  if (rows.size() > kMostNewtonRows) return solveContacts(rows, bodies, settings);
  FewRowsSolver solver(rows, bodies, settings);
  if (solver.sweep(kFirstSweeps) || solver.solveAtOnce(kLeastGive, kStraightSteps)) return solver.report();
  for (int sweeps = 2 * kFirstSweeps; solver.report().sweeps < settings.sweeps; sweeps *= 2)
    if (solver.solveAtOnce(kFirstGive, kEasedSteps) || solver.sweep(sweeps)) break;
  return solver.report();
}

}  // namespace carom
