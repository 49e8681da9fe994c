#include "engine/response/newton_solver.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "engine/response/newton_rows.h"
#include "engine/response/sweeps/solution.h"

namespace carom {
namespace {

constexpr int kFirstSweeps = 4;  // they find most rows that press
constexpr int kLastSweeps = 2;   // they bring impulses back into their cones, and say how far all is
// Of a row's own response. Its square is below rounding, so that two steps leave nothing of it.
constexpr double kLeastCompliance = 1e-8;
// Newton steps at the least compliance, at most: they find at once who presses and who slides.
constexpr int kNewtonSteps = 6;
// A continuation begins with this compliance where those steps cycle.
constexpr double kFirstCompliance = 1e-2;
// Of the compliance of the step before.
constexpr double kComplianceShare = 0.1;
// Steps of a continuation, at most.
constexpr int kContinuationSteps = 16;
// Of the residual before: steps that leave more have found nothing. Where rows contradict each other, as
// between a wall and what is driven towards it, they press without measure; sweeps press no more than each
// takes.
constexpr double kFoundShare = 1e-3;

// Steps until the rows' conditions hold, or so many.
void iterate(NewtonRows& newton, double first_compliance, int most, double enough_mps) {
  double compliance = first_compliance;
  for (int step = 0; step < most && newton.step(compliance); ++step) {
    if (newton.miss() <= enough_mps) return;
    compliance = std::max(kLeastCompliance, kComplianceShare * compliance);
  }
}

class NewtonSolver {
 public:
  NewtonSolver(std::span<ContactRow> rows, std::span<ImpulseBody> bodies, const SolverSettings& settings)
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
  bool takeSteps(double first_compliance, int steps) {
    if (report_.sweeps >= settings_.sweeps) return false;
    const Solution before(rows_, bodies_);
    const double residual_mps = report_.residual_mps;
    if (!newton_) newton_.emplace(rows_, bodies_, settings_.friction);
    iterate(*newton_, first_compliance, steps, settings_.residual_mps);
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

SolverReport solveContactsByNewton(std::span<ContactRow> rows, std::span<ImpulseBody> bodies,
                                   const SolverSettings& settings) {
  if (rows.size() > kMostNewtonRows) return solveContacts(rows, bodies, settings);
  NewtonSolver solver(rows, bodies, settings);
  if (solver.sweep(kFirstSweeps) || solver.takeSteps(kLeastCompliance, kNewtonSteps)) return solver.report();
  solver.takeSteps(kFirstCompliance, kContinuationSteps);  // where this finds nothing, others hardly do
  return solver.report();
}

}  // namespace carom
