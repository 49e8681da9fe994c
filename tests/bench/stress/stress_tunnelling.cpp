// stress tunnelling: trials by number, shared out among threads; the counts do not depend on how.

#include <cstdio>

#include "tests/bench/stress/stress.h"
#include "tests/bench/stress/tunnelling_trials.h"

namespace carom::bench {
namespace {

struct ShotCounts {
  long trials = 0, tunnelled = 0, overlapped = 0, missed = 0, steps = 0, stalled = 0;
  double smallest_gap_m = std::numeric_limits<double>::infinity();

  void operator+=(const ShotCounts& other) {
    trials += other.trials;
    tunnelled += other.tunnelled;
    overlapped += other.overlapped;
    missed += other.missed;
    steps += other.steps;
    stalled += other.stalled;
    smallest_gap_m = std::min(smallest_gap_m, other.smallest_gap_m);
  }
};
using Table = std::array<ShotCounts, kShots>;

ShotCounts countsOf(const ShotResult& r) {
  return {1, r.tunnelled, !(r.smallest_gap_m > 0.0), !r.met, r.steps, r.stalled, r.smallest_gap_m};
}

void printTable(const Table& table) {
  std::printf("%-15s %8s %9s %10s %9s %14s %s\n", "shot", "trials", "tunnelled", "overlapped", "never met",
              "smallest gap/m", "stopped bodies a step");
  for (std::size_t s = 0; s < kShots; ++s) {
    const ShotCounts& c = table[s];
    if (c.trials > 0)
      std::printf("%-15s %8ld %9ld %10ld %9ld %14.3g %.5f\n", kShotNames[s], c.trials, c.tunnelled,
                  c.overlapped, c.missed, c.smallest_gap_m,
                  static_cast<double>(c.stalled) / static_cast<double>(c.steps));
  }
}

}  // namespace

bool runTunnelling(const TunnellingRun& run) {
  std::vector<Table> tables(static_cast<std::size_t>(run.threads));
  shareOut(run.trials, run.threads, [&](int thread, long i) {
    const long number = run.first + i;
    const Shot shot = shotOf(number);
    const ShotResult result = TunnellingTrial(shot, seedOf(run.seed, number)).run();
    const ShotCounts counts = countsOf(result);
    tables[static_cast<std::size_t>(thread)][static_cast<std::size_t>(shot)] += counts;
    if (counts.tunnelled + counts.overlapped + counts.missed > 0)
      std::fprintf(stderr,
                   "trial %ld (%s, %.4g at %g Hz): %s%s%s; again: stress tunnelling --seed %llu --first %ld "
                   "--trials 1\n",
                   number, kShotNames[static_cast<std::size_t>(shot)], result.speed, result.rate_hz,
                   counts.tunnelled ? "tunnelled " : "", counts.overlapped ? "overlapped " : "",
                   counts.missed ? "never met" : "", static_cast<unsigned long long>(run.seed), number);
  });
  Table all;
  ShotCounts sum;
  for (const Table& table : tables)
    for (std::size_t s = 0; s < kShots; ++s) {
      all[s] += table[s];
      sum += table[s];
    }
  printTable(all);
  std::printf("%ld trials: %ld tunnelled (bar 0), %ld overlapped (bar 0), %ld never met (bar 0)\n",
              sum.trials, sum.tunnelled, sum.overlapped, sum.missed);
  return sum.tunnelled + sum.overlapped + sum.missed == 0;
}

}  // namespace carom::bench
