#include "engine/response/sweeps/shared_sweeps.h"

#include <algorithm>

#include "engine/response/sweeps/dissection.h"

namespace carom {

SharedSweeps::SharedSweeps(std::span<ContactRow> rows, std::span<ImpulseBody> bodies, Crew* crew)
    : rows_(rows), bodies_(bodies), crew_(crew) {
  if (crew == nullptr || crew->threads() == 1 || rows.size() < kWorthSharing) return;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const bool same_tier = i > 0 && depthOf(rows[i].part) == depthOf(rows[i - 1].part);
    if (!same_tier) tiers_.emplace_back();
    Tier& tier = tiers_.back();
    if (same_tier && rows[i].part == rows[i - 1].part)
      tier.runs.back().end = i + 1;
    else
      tier.runs.push_back({i, i + 1});
    ++tier.rows;
  }
}

void SharedSweeps::sweep(const Sweep& sweep, SolverReport& report) {
  if (tiers_.empty()) {
    sweepRows(rows_, bodies_, sweep, report);
    return;
  }
  double residual_mps = 0.0;
  ++report.sweeps;
  for (std::size_t k = 0; k < tiers_.size(); ++k) {
    const Tier& tier = tiers_[sweep.forward ? k : tiers_.size() - 1 - k];
    reports_.assign(tier.runs.size(), {});
    const auto sweepRun = [&](int i) {
      const auto run = static_cast<std::size_t>(i);
      sweepRows(rowsOf(tier.runs[run]), bodies_, sweep, reports_[run]);
    };
    const int runs = static_cast<int>(tier.runs.size());
    if (tier.rows >= kWorthSharing)
      crew_->run(runs, sweepRun);
    else
      for (int i = 0; i < runs; ++i) sweepRun(i);
    for (const SolverReport& part : reports_) {
      residual_mps = std::max(residual_mps, part.residual_mps);
      report.visits += part.visits;
    }
  }
  report.residual_mps = residual_mps;
}

}  // namespace carom
