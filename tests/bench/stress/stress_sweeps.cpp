// stress sweeps: blocks of random sweeps, each block from a seed of its own, so that the counts do not depend
// on the threads.

#include <cstdio>

#include "tests/bench/queries/random_sweep.h"
#include "tests/bench/stress/stress.h"

namespace carom::bench {
namespace {

constexpr long kBlock = 1000;

void add(SweepCounts& sum, const SweepCounts& c) {
  sum.sweeps += c.sweeps;
  sum.impacts += c.impacts;
  sum.stopped += c.stopped;
  sum.missed += c.missed;
  sum.misplaced += c.misplaced;
  sum.undecided += c.undecided;
  sum.queries += c.queries;
  sum.looks += c.looks;
  sum.most_queries = std::max(sum.most_queries, c.most_queries);
}

}  // namespace

bool runSweeps(const SweepRun& run) {
  std::vector<SweepCounts> counts(static_cast<std::size_t>(run.threads));
  const long first = run.first / kBlock;
  shareOut((run.sweeps + kBlock - 1) / kBlock, run.threads, [&](int thread, long i) {
    const long block = first + i;
    RandomSweeps sweeps(run.seed * 0x9e3779b97f4a7c15ull + static_cast<std::uint64_t>(block));
    for (long k = 0; k < std::min(kBlock, run.sweeps - i * kBlock); ++k)
      if (!sweeps.next())
        std::fprintf(stderr, "sweep %ld: wrong; again: stress sweeps --seed %llu --first %ld --sweeps %ld\n",
                     block * kBlock + k, static_cast<unsigned long long>(run.seed), block * kBlock, k + 1);
    add(counts[static_cast<std::size_t>(thread)], sweeps.counts());
  });
  SweepCounts sum;
  for (const SweepCounts& c : counts) add(sum, c);
  const auto per = [&sum](long n) { return static_cast<double>(n) / static_cast<double>(sum.sweeps); };
  std::printf("%ld sweeps: %ld impacts, %ld stopped at the floor, %ld clear\n", sum.sweeps, sum.impacts,
              sum.stopped, sum.sweeps - sum.impacts - sum.stopped);
  std::printf(
      "%ld missed contacts (bar 0), %ld outside the window (bar 0), %ld undecided by the oracle (bar 0)\n",
      sum.missed, sum.misplaced, sum.undecided);
  std::printf("%.2f distance queries a sweep (bar 10), %d at most; the oracle took %.0f looks a sweep\n",
              per(sum.queries), sum.most_queries, per(sum.looks));
  return sum.missed + sum.misplaced + sum.undecided == 0 && per(sum.queries) <= 10.0;
}

}  // namespace carom::bench
