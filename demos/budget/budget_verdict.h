#pragma once
// Whether a measured time keeps a limit, on a machine that is never quite still. What speaks for "yes" is
// proof: the time was reached. What speaks against it may be noise, so "no" must hold with an allowance for
// the noise that was seen; between the two the answer is that there is none. Tested in
// tests/demos/budget/budget_verdict_test.cpp.

#include <vector>

namespace carom::demos {

enum class BudgetVerdict { kWithin, kOver, kInconclusive };
const char* verdictName(BudgetVerdict verdict);

struct TimeEvidence {
  double limit_ms = 0.0;
  double least_ms = 0.0;           ///< From every frame's least time over the replays.
  std::vector<double> replays_ms;  ///< The same figure of each replay by itself; none is below `least_ms`.
  double outside_load = 0.0;       ///< Share of the machine's CPU time that others used meanwhile, 0 to 1.
};

/// Replays that differ by less are taken to agree.
inline constexpr double kReplaysAgree = 1.25;
/// A share of others up to this is taken for a quiet machine.
inline constexpr double kQuietLoad = 0.05;

/// Largest over smallest; 1 for none.
double spreadOf(const std::vector<double>& replays_ms);

/// By what factor the time may have been lengthened from outside: the spread of the replays once they
/// disagree, times what others' share of the CPU can do, with the same margin.
double noiseAllowance(const TimeEvidence& evidence);

/// Within: the limit was kept, and by itself some replay came near it (1.25). Over: the limit was broken by
/// more than the allowance. Inconclusive: neither.
BudgetVerdict verdictOf(const TimeEvidence& evidence);

}  // namespace carom::demos
