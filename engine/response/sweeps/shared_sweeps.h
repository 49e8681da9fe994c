#pragma once
// Sweeps over the rows of a dissected crowd (dissection.h), by several threads: the rows of parts that share
// no body at the same time. The bits are those of one thread. Tested in
// tests/engine/response/sweeps/shared_sweeps_test.cpp.

#include <cstddef>
#include <span>
#include <vector>

#include "engine/response/sweeps/contact_solver.h"

namespace carom {

/// Rows that share no body that moves, of which a visit takes 30 to 100 ns: with fewer, waiting for others
/// takes longer than they save.
inline constexpr std::size_t kWorthSharing = 150;

class SharedSweeps {
 public:
  /// `rows` stand by descending part. Without a crew, or where rows are few, one thread sweeps alone.
  SharedSweeps(std::span<ContactRow> rows, std::span<ImpulseBody> bodies, Crew* crew);

  /// As sweepRows over all of them.
  void sweep(const Sweep& sweep, SolverReport& report);

 private:
  struct Run {  // the rows of one part
    std::size_t begin = 0;
    std::size_t end = 0;
  };
  // Runs that share no body that moves.
  struct Tier {
    std::vector<Run> runs;
    std::size_t rows = 0;
  };
  std::span<ContactRow> rowsOf(const Run& run) const { return rows_.subspan(run.begin, run.end - run.begin); }

  std::span<ContactRow> rows_;
  std::span<ImpulseBody> bodies_;
  Crew* crew_;
  std::vector<Tier> tiers_;  // none: the rows are swept as they stand
  std::vector<SolverReport> reports_;
};

}  // namespace carom
