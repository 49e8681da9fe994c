#include "engine/response/focused_solver.h"

#include <algorithm>
#include <vector>

namespace carom {
namespace {

constexpr int kWideSweeps = 4;        // over all rows, and ...
constexpr int kLocalSweeps = 12;      // ... over some
constexpr double kLocalShare = 0.15;  // of the bodies: so many of the most stirred are gone on with, ...
constexpr double kWorthwhile = 0.7;   // ... if they have so much of the squared stir
constexpr std::size_t kFewestRows = 10;

double& stirOf(std::span<ImpulseBody> bodies, int i) {
  return bodies[static_cast<std::size_t>(i)].stir;
}

void clearStirs(std::span<const ContactRow> rows, std::span<ImpulseBody> bodies) {
  for (const ContactRow& row : rows) stirOf(bodies, row.a) = stirOf(bodies, row.b) = 0.0;
}

// The rows of the most stirred bodies, as indices.
std::vector<std::size_t> rowsOfMostStirred(std::span<const ContactRow> rows, std::span<ImpulseBody> bodies) {
  std::vector<double> stirs;  // a body counts as often as it has rows
  stirs.reserve(2 * rows.size());
  for (const ContactRow& row : rows)
    for (const int i : {row.a, row.b})
      if (stirOf(bodies, i) > 0.0) stirs.push_back(stirOf(bodies, i));
  std::vector<std::size_t> chosen;
  if (stirs.empty()) return chosen;
  const auto most = static_cast<std::ptrdiff_t>(kLocalShare * static_cast<double>(stirs.size()));
  std::nth_element(stirs.begin(), stirs.begin() + most, stirs.end(), std::greater<>());
  const double least = stirs[static_cast<std::size_t>(most)];
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (std::max(stirOf(bodies, rows[i].a), stirOf(bodies, rows[i].b)) > least) chosen.push_back(i);
  return chosen;
}

// Whether what is left to do lies mostly in these rows. In a wall from a cold start it lies everywhere, and
// conjugate gradients must not be broken off.
bool haveMostStir(std::span<const std::size_t> chosen, std::span<const ContactRow> rows,
                  std::span<ImpulseBody> bodies) {
  const auto squared = [&](const ContactRow& row) {
    const double stir = stirOf(bodies, row.a) + stirOf(bodies, row.b);
    return stir * stir;
  };
  double all = 0.0, theirs = 0.0;
  for (const ContactRow& row : rows) all += squared(row);
  for (const std::size_t i : chosen) theirs += squared(rows[i]);
  return theirs >= kWorthwhile * all;
}

// Sweeps over some rows, then over those among them that need it most, and so on: each time at most twice
// `kLocalShare` of them. Returns the row visits.
long sweepInwards(std::span<ContactRow> rows, std::span<const std::size_t> chosen,
                  std::span<ImpulseBody> bodies, const SolverSettings& settings) {
  if (chosen.size() < kFewestRows) return 0;
  std::vector<ContactRow> local;
  local.reserve(chosen.size());
  for (const std::size_t i : chosen) local.push_back(rows[i]);
  clearStirs(local, bodies);
  const SolverReport report = solveContactsFinely(local, bodies, settings);
  long visits = report.visits;
  if (report.residual_mps > settings.residual_mps)
    visits += sweepInwards(local, rowsOfMostStirred(local, bodies), bodies, settings);
  for (std::size_t k = 0; k < chosen.size(); ++k) rows[chosen[k]] = local[k];
  return visits;
}

}  // namespace

SolverReport solveContactsFocused(std::span<ContactRow> rows, std::span<ImpulseBody> bodies,
                                  const SolverSettings& settings) {
  if (rows.size() < kFocusedRows) return solveContactsFinely(rows, bodies, settings);
  SolverReport total;
  const auto count = [&](long visits) {
    total.visits += visits;
    total.sweeps = static_cast<int>(total.visits / static_cast<long>(rows.size()));
  };
  const auto sweepAll = [&](const SolverSettings& all) {
    const SolverReport report = solveContactsFinely(rows, bodies, all);
    total.residual_mps = report.residual_mps;
    count(report.visits);
  };
  while (true) {  // each round is two sweeps or more of the number that ends it
    const bool careful = total.sweeps < settings.careful_sweeps;
    SolverSettings round{.sweeps = kWideSweeps,
                         .residual_mps = careful ? settings.residual_mps : settings.coarse_residual_mps,
                         .friction = settings.friction};
    clearStirs(rows, bodies);
    sweepAll(round);
    if (total.residual_mps <= round.residual_mps || total.sweeps + kWideSweeps > settings.sweeps)
      return total;
    const std::vector<std::size_t> chosen = rowsOfMostStirred(rows, bodies);
    if (!haveMostStir(chosen, rows, bodies)) {
      SolverSettings rest = settings;
      rest.sweeps -= total.sweeps;
      rest.careful_sweeps = std::max(0, rest.careful_sweeps - total.sweeps);
      sweepAll(rest);
      return total;
    }
    round.sweeps = kLocalSweeps;
    count(sweepInwards(rows, chosen, bodies, round));
  }
}

}  // namespace carom
