#pragma once
// Runs trials in processes of their own, so that a hang or a crash of one seed costs that seed only. A step
// that takes more CPU time than the limit ends its process; what it was at is known from a page of shared
// memory. Reports come over a pipe as lines of text. Tested in tests/explore/watch/guarded_run_test.cpp.

#include <cstdint>
#include <functional>
#include <vector>

#include "tests/explore/trial/seed_trial.h"

namespace carom::explore {

struct Limits {
  double step_cpu_s = 1.0;    ///< Of one step.
  double run_cpu_s = 5.0;     ///< Of all steps of a world, which some seeds run several times.
  double start_cpu_s = 20.0;  ///< Of the making of its world, in which meshes are decomposed.
};

/// A job number's work: told the settings that keep the limits, it reports.
using Job = std::function<SeedReport(std::uint64_t job, const TrialSettings& settings)>;

/// Runs the jobs from `first` on, `count` of them, in `processes` at a time, and hands each report to `take`
/// as it arrives. A job whose process died reports one finding: "hang" for a step over its limit, "slow" for
/// steps that are together, or "crash" with the signal.
void runGuarded(std::uint64_t first, std::uint64_t count, int processes, const Limits& limits, const Job& job,
                const std::function<void(const SeedReport&)>& take);

/// One job.
SeedReport runGuarded(const Limits& limits, const std::function<SeedReport(const TrialSettings&)>& job);

}  // namespace carom::explore
