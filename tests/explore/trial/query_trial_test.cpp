// Answers that depend on the memory, are no numbers, or are wrong both with and without, are each seen.

#include "tests/explore/trial/query_trial.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace carom::explore {
namespace {

bool has(const TrialOutcome& outcome, const std::string& kind) {
  return std::any_of(outcome.findings.begin(), outcome.findings.end(),
                     [&kind](const Finding& finding) { return finding.kind == kind; });
}

QuerySequence cubes() {
  QuerySequence sequence;
  sequence.a = sequence.b = {boxPolyhedron(Vec3::Ones()), 0.0};
  for (int i = 0; i < 100; ++i) sequence.X_AB.push_back({Quat::Identity(), Vec3(1.5 + 0.01 * i, 0.1, 0.2)});
  return sequence;
}

bool isFresh(const PairMemory& memory) {
  return memory.features.a.index < 0;
}

TEST(QueryTrial, HonestAnswersAreWithoutFindings) {
  EXPECT_TRUE(tryQueries(cubes()).findings.empty());
}

TEST(QueryTrial, AnAnswerThatMemoryChangesIsSeenAndShrunkToTwoPoses) {
  const Query lying = [](const ConvexPart& a, const ConvexPart& b, const Pose& X, PairMemory& memory) {
    const bool lies = !isFresh(memory) && X.position.x() > 2.0;
    ClosestFeatures answer = askEngine(a, b, X, memory);
    if (lies) {
      answer.distance_m -= 1e-9;
      answer.status = Separation::kPenetrating;
    }
    return answer;
  };
  const TrialOutcome outcome = tryQueries(cubes(), lying);
  EXPECT_TRUE(has(outcome, "query-memory"));
  EXPECT_TRUE(has(outcome, "query-status"));
  EXPECT_EQ(shrunkQueries(cubes(), "query-memory", lying).X_AB.size(), 2u);
}

TEST(QueryTrial, AnAnswerThatIsNoNumberOrWrongIsSeen) {
  const Query none = [](const ConvexPart& a, const ConvexPart& b, const Pose& X, PairMemory& memory) {
    ClosestFeatures answer = askEngine(a, b, X, memory);
    answer.n_W.x() = std::numeric_limits<double>::quiet_NaN();
    return answer;
  };
  EXPECT_TRUE(has(tryQueries(cubes(), none), "query-nan"));
  const Query wrong = [](const ConvexPart& a, const ConvexPart& b, const Pose& X, PairMemory& memory) {
    ClosestFeatures answer = askEngine(a, b, X, memory);
    answer.distance_m += 1e-8;
    return answer;
  };
  EXPECT_TRUE(has(tryQueries(cubes(), wrong), "query-truth"));
}

}  // namespace
}  // namespace carom::explore
