#include "engine/response/focused_solver.h"

#include <algorithm>
#include <array>
#include <functional>
#include <utility>
#include <vector>

#include "engine/response/conjugate_sweeps.h"

namespace carom {
namespace {

constexpr int kWideSweeps = 4;    // over all rows, before some are chosen
constexpr int kLocalSweeps = 12;  // over the rows that were chosen
// Of the ends of all rows: this share, at the bodies whose velocities have changed most, is swept alone.
constexpr double kLocalShare = 0.15;
// Of the sum over all rows of the squared change: rows that have less of it are not swept alone.
constexpr double kLocalChangeShare = 0.7;
// Fewer rows than these are not swept alone.
constexpr std::size_t kFewestRows = 10;

void clearStirs(const InvolvedBodies& involved, std::span<ImpulseBody> bodies) {
  for (const std::size_t i : involved.indices) bodies[i].stir = 0.0;
}

// How much the sweeps have stirred the bodies.
class Stirs {
 public:
  Stirs(const InvolvedBodies& involved, std::span<const ImpulseBody> bodies) : ends_(involved.ends) {
    for (const std::size_t i : involved.indices) stirs_.push_back(bodies[i].stir);
  }

  // The rows of the most stirred bodies, as indices.
  std::vector<std::size_t> rowsOfMostStirred() const {
    std::vector<std::size_t> chosen;
    const double least = leastOfMost();
    for (std::size_t i = 0; i < ends_.size(); ++i)
      if (std::max(of(ends_[i][0]), of(ends_[i][1])) > least) chosen.push_back(i);
    return chosen;
  }

  // Whether what is left to do lies mostly in these rows. In a wall from a cold start it lies everywhere, and
  // conjugate gradients must not be broken off.
  bool areMostIn(std::span<const std::size_t> chosen) const {
    double all = 0.0, theirs = 0.0;
    for (std::size_t i = 0; i < ends_.size(); ++i) all += squared(i);
    for (const std::size_t i : chosen) theirs += squared(i);
    return theirs >= kLocalChangeShare * all;
  }

 private:
  double of(int place) const { return stirs_[static_cast<std::size_t>(place)]; }
  double squared(std::size_t row) const {
    const double stir = of(ends_[row][0]) + of(ends_[row][1]);
    return stir * stir;
  }
  // The most stirred are above it. A body counts as often as it has rows.
  double leastOfMost() const {
    std::vector<int> rows(stirs_.size(), 0);
    for (const std::array<int, 2>& ends : ends_)
      for (const int place : ends) ++rows[static_cast<std::size_t>(place)];
    std::vector<std::pair<double, int>> stirred;
    int all = 0;
    for (std::size_t i = 0; i < stirs_.size(); ++i) {
      if (stirs_[i] <= 0.0) continue;
      stirred.emplace_back(stirs_[i], rows[i]);
      all += rows[i];
    }
    std::sort(stirred.begin(), stirred.end(), std::greater<>());
    int above = static_cast<int>(kLocalShare * all);
    for (const auto& [stir, count] : stirred)
      if ((above -= count) < 0) return stir;
    return 0.0;
  }

  const std::vector<std::array<int, 2>>& ends_;
  std::vector<double> stirs_;  // by the bodies' places
};

// Sweeps over some rows, then over those among them that need it most, and so on: each time at most twice
// `kLocalShare` of them. Returns the row visits.
long sweepInwards(std::span<ContactRow> rows, std::span<const std::size_t> chosen,
                  std::span<ImpulseBody> bodies, const SolverSettings& settings) {
  if (chosen.size() < kFewestRows) return 0;
  std::vector<ContactRow> local;
  local.reserve(chosen.size());
  for (const std::size_t i : chosen) local.push_back(rows[i]);
  ConjugateSweeps sweeps(local, bodies, settings.crew);
  clearStirs(sweeps.involved(), bodies);
  const SolverReport report = sweeps.solve(settings);
  long visits = report.visits;
  if (report.residual_mps > settings.residual_mps) {
    const Stirs stirs(sweeps.involved(), bodies);
    visits += sweepInwards(local, stirs.rowsOfMostStirred(), bodies, settings);
  }
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    rows[chosen[k]].impulse = local[k].impulse;
    rows[chosen[k]].torque = local[k].torque;
  }
  return visits;
}

}  // namespace

SolverReport solveContactsFocused(std::span<ContactRow> rows, std::span<ImpulseBody> bodies,
                                  const SolverSettings& settings) {
  if (rows.size() < kFocusedRows) return solveContactsFinely(rows, bodies, settings);
  ConjugateSweeps sweeps(rows, bodies, settings.crew);
  SolverReport total;
  const auto count = [&](long visits) {
    total.visits += visits;
    total.sweeps = static_cast<int>(total.visits / static_cast<long>(rows.size()));
  };
  const auto sweepAll = [&](const SolverSettings& all) {
    const SolverReport report = sweeps.solve(all);
    total.residual_mps = report.residual_mps;
    total.excess = report.excess;
    count(report.visits);
  };
  while (true) {  // each round is two sweeps or more of the number that ends it
    SolverSettings round{.sweeps = kWideSweeps,
                         .residual_mps = settings.residual_mps,
                         .friction = settings.friction,
                         .in_the_mean = settings.in_the_mean,
                         .crew = settings.crew};
    clearStirs(sweeps.involved(), bodies);
    sweepAll(round);
    if (hasConverged(total, round, round.residual_mps, rows.size()) ||
        total.sweeps + kWideSweeps > settings.sweeps)
      return total;
    const Stirs stirs(sweeps.involved(), bodies);
    const std::vector<std::size_t> chosen = stirs.rowsOfMostStirred();
    if (!stirs.areMostIn(chosen)) {
      SolverSettings rest = settings;
      rest.sweeps -= total.sweeps;
      sweepAll(rest);
      return total;
    }
    round.sweeps = kLocalSweeps;
    round.in_the_mean = false;  // these are the rows that have not converged
    count(sweepInwards(rows, chosen, bodies, round));
  }
}

}  // namespace carom
