#include "demos/budget/budget_verdict.h"

#include <gtest/gtest.h>

namespace carom::demos {
namespace {

struct Case {
  const char* what;
  TimeEvidence evidence;
  BudgetVerdict verdict;
};

constexpr BudgetVerdict kYes = BudgetVerdict::kWithin;
constexpr BudgetVerdict kNo = BudgetVerdict::kOver;
constexpr BudgetVerdict kUnknown = BudgetVerdict::kInconclusive;

TEST(BudgetVerdict, FollowsItsTable) {
  const std::vector<Case> cases = {
      {"kept by all", {10.0, 8.0, {8.0, 8.5, 9.0}, 0.0}, kYes},
      {"exactly the deadline", {10.0, 10.0, {10.0, 10.0}, 0.0}, kYes},
      {"kept by the least times, and nearly by a replay", {10.0, 9.9, {12.5, 30.0}, 0.0}, kYes},
      {"kept although others load the machine", {10.0, 9.0, {9.5, 9.5}, 0.8}, kYes},
      {"kept, but no replay came near", {10.0, 9.9, {12.6, 30.0}, 0.0}, kUnknown},
      {"broken by all, which agree", {10.0, 10.1, {10.2, 10.5, 12.7}, 0.0}, kNo},
      {"broken, the spread at its limit", {10.0, 10.1, {10.4, 13.0}, 0.0}, kNo},
      {"broken, the replays disagree", {10.0, 10.1, {10.4, 13.1}, 0.0}, kUnknown},
      {"broken by more than the replays disagree", {10.0, 14.0, {15.0, 20.0}, 0.0}, kNo},
      {"a quiet machine", {10.0, 10.1, {10.2, 10.2}, 0.05}, kNo},
      {"others take a tenth", {10.0, 10.1, {10.2, 10.2}, 0.1}, kUnknown},
      {"others take half: up to 5 times", {10.0, 49.9, {50.0, 50.0}, 0.5}, kUnknown},
      {"others take half: beyond 5 times", {10.0, 50.1, {50.2, 50.2}, 0.5}, kNo},
  };
  for (const Case& c : cases)
    EXPECT_STREQ(verdictName(verdictOf(c.evidence)), verdictName(c.verdict)) << c.what;
}

// Others' threads beside ours on the same cores lengthen every replay alike: the replays agree, and only the
// load tells. Whatever the load, a scene that fits is never called too slow.
TEST(BudgetVerdict, SteadyLoadFromOutsideNeverMakesAFalseNo) {
  for (double load = 0.0; load < 0.985; load += 0.005) {
    const double true_ms = 9.99, slowed_ms = true_ms / ((1.0 - load) * (1.0 - load));
    for (const double jitter : {1.0, 1.1, 1.24, 2.0}) {
      const TimeEvidence evidence{10.0, slowed_ms, {slowed_ms, slowed_ms * jitter}, load};
      if (load > kQuietLoad || slowed_ms <= 10.0) {
        EXPECT_NE(verdictOf(evidence), kNo) << load << ' ' << jitter;
      }
    }
  }
}

TEST(BudgetVerdict, TheSpreadIsLargestOverSmallest) {
  EXPECT_DOUBLE_EQ(spreadOf({4.0, 2.0, 3.0}), 2.0);
  EXPECT_DOUBLE_EQ(spreadOf({}), 1.0);
  EXPECT_DOUBLE_EQ(spreadOf({0.0, 1.0}), 1.0);
}

}  // namespace
}  // namespace carom::demos
