#pragma once
// What the program `stress` can run (stress.cpp has the command line): each prints what it counted beside its
// bar, how to repeat a failure alone, and returns whether every bar was met.

#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <thread>
#include <vector>

#include "tests/bench/bin_pile.h"

namespace carom::bench {

struct TunnellingRun {
  long trials = 100'000;
  long first = 0;  ///< Number of the first trial: a failed one is repeated by its number.
  std::uint64_t seed = 1;
  int threads = 2;
};
bool runTunnelling(const TunnellingRun& run);

struct SweepRun {
  long sweeps = 1'000'000;
  long first = 0;  ///< Rounded down to a whole block.
  std::uint64_t seed = 1;
  int threads = 2;
};
bool runSweeps(const SweepRun& run);

struct CollisionRun {
  long collisions = 10'000'000;
  std::uint64_t seed = 1;
  int threads = 2;
};
bool runCollisions(const CollisionRun& run);

struct PileRun {
  std::vector<PileOf> kinds;
  std::vector<double> frictions;
  int bodies = 0;  ///< 0: 1000 hulls, 5000 boxes.
  double seconds = 20.0;
  double rate_hz = 60.0;
  int oracle_every = 1;  ///< Steps.
  std::uint64_t seed = 1;
  int threads = 1;       ///< That step.
  int peer_steps = 120;  ///< Of the settled heap, for each library; 0: no comparison.
};
bool runPiles(const PileRun& run);

struct EnergyRun {
  double share = 1.0;  ///< Of the scenes' whole lengths.
};
bool runEnergy(const EnergyRun& run);

struct TilesRun {
  long glides = 400;
  long first = 0;
  std::uint64_t seed = 1;
  int threads = 2;
};
bool runTiles(const TilesRun& run);

struct LandingsRun {
  long landings = 1'000'000;
  long first = 0;
  double largest_aspect = 1000.0;
  std::uint64_t seed = 1;
  int threads = 2;
};
bool runLandings(const LandingsRun& run);

/// Calls work(thread, i) for every i of [0, count), each once; tells how far it is every half minute.
template <typename Work>
void shareOut(long count, int threads, const Work& work) {
  std::atomic<long> next = 0, done = 0;
  std::vector<std::thread> started;
  for (int t = 0; t < threads; ++t)
    started.emplace_back([&, t] {
      for (long i = next++; i < count; i = next++, ++done) work(t, i);
    });
  constexpr auto kPause = std::chrono::milliseconds(20);
  constexpr int kPausesPerLine = 1500;
  for (int i = 1; done < count; ++i) {
    std::this_thread::sleep_for(kPause);
    if (i % kPausesPerLine == 0)
      std::fprintf(stderr, "%.1f %% done\n", 100.0 * static_cast<double>(done) / static_cast<double>(count));
  }
  for (std::thread& thread : started) thread.join();
}

}  // namespace carom::bench
