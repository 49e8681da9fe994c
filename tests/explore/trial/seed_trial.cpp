#include "tests/explore/trial/seed_trial.h"

#include "tests/explore/scene_text.h"
#include "tests/explore/trial/query_trial.h"

namespace carom::explore {

std::string familyOf(std::uint64_t seed) {
  return asksQueries(seed) ? "queries" : randomWorld(seed).family;
}

SeedReport trySeed(std::uint64_t seed, const TrialSettings& settings) {
  SeedReport report;
  report.seed = seed;
  if (asksQueries(seed)) {
    report.family = "queries";
    report.outcome = tryQueries(seed);
    return report;
  }
  const ExploredWorld world = randomWorld(seed);
  TrialSettings with = settings;
  with.replays = seed % 10 == 0;
  with.threads = seed % 20 == 0;
  report.family = world.family;
  report.outcome = tryWorld(readBack(world.scene), with);
  return report;
}

}  // namespace carom::explore
