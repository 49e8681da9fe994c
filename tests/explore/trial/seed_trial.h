#pragma once
// What one seed does: five in six make a random world, the sixth a sequence of closest-feature queries. Every
// tenth world is replayed, every twentieth also run with two and three threads. Tested in
// tests/explore/watch/guarded_run_test.cpp.

#include <cstdint>
#include <string>

#include "tests/explore/trial/world_trial.h"

namespace carom::explore {

struct SeedReport {
  std::uint64_t seed = 0;
  std::string family;
  double cpu_s = 0.0;
  TrialOutcome outcome;
};

inline bool asksQueries(std::uint64_t seed) {
  return seed % 6 == 5;
}

/// "queries", or the family of the seed's world.
std::string familyOf(std::uint64_t seed);

SeedReport trySeed(std::uint64_t seed, const TrialSettings& settings);

}  // namespace carom::explore
