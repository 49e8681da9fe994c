#include "demos/report/budget_report.h"

#include <gtest/gtest.h>

#include "tests/demos/budget/budget_samples.h"

namespace carom::demos {
namespace {

/// Frame 7 takes 30 ms of time of impact; the others 10 ms in all.
Replay spiky(int frames) {
  return sampleReplay(frames, [](FrameCost& f) {
    if (f.frame == 7) phaseOf(f, FramePhase::kTimeOfImpact) = 30.0;
  });
}

std::string lastLine(const std::string& text) {
  const std::size_t begin = text.rfind('\n', text.size() - 2);
  return text.substr(begin + 1, text.size() - begin - 2);
}

TEST(BudgetReport, TellsTheSlowestFrameItsContactsAndWhichPhaseTookIt) {
  const std::string report = budgetReport(sampleResult({16.7, 99.0}, {spiky(120), spiky(120)}), nullptr);
  EXPECT_NE(report.find("frame 7            0.117    39.000         7      14       21      28  time of "
                        "impact 30 ms\n"),
            std::string::npos)
      << report;
  EXPECT_NE(report.find("over 16.7 ms: 1 of 120 frames (0.8 %), the worst by 22.3 ms, 22.3 ms in all\n"),
            std::string::npos)
      << report;
  EXPECT_NE(report.find("fps: 100.0 at the median, 1 % low 25.6\n"), std::string::npos) << report;
  for (const char* name : kFramePhaseNames)
    EXPECT_NE(report.find(std::string("\n") + name), std::string::npos);
  EXPECT_EQ(lastLine(report), "within: p99 10.0 ms, budget 16.7 ms, 6.7 ms (40 %) to spare");
}

TEST(BudgetReport, TellsHowManyThreadsStep_WhereThereAreSeveral) {
  BudgetResult result = sampleResult({16.7, 99.0}, {sampleReplay(120), sampleReplay(120)});
  EXPECT_EQ(budgetReport(result, nullptr).find("threads"), std::string::npos);
  result.subject.threads = 2;
  EXPECT_NE(budgetReport(result, nullptr).find("; a build; 2 threads step; others"), std::string::npos);
}

TEST(BudgetReport, TheHistogramMarksTheBudgetEvenWhereNoFrameLies) {
  for (const double budget_ms : {10.0, 39.0}) {
    const std::string report = budgetReport(sampleResult({budget_ms, 50.0}, {spiky(40), spiky(40)}), nullptr);
    EXPECT_NE(report.find("< budget"), std::string::npos) << report;
  }
}

TEST(BudgetReport, AVerdictSaysByHowMuchAndWhy) {
  const auto line = [](double budget_ms, double outside_load) {
    const Replay slower = sampleReplay(100, [](FrameCost& f) { f.phase_ms.fill(1.4); });
    return verdictLine(sampleResult({budget_ms, 99.0}, {sampleReplay(100), slower}, outside_load));
  };
  EXPECT_EQ(line(5.0, 0.0), "over: p99 10.0 ms, budget 5 ms, 5 ms (100 %) too slow");
  EXPECT_EQ(
      line(9.0, 0.0),
      "inconclusive: p99 10.0 ms, budget 9 ms, but the replays differ by a factor of 1.4: a no would take "
      "more than 12.6 ms; try a quieter machine");
  EXPECT_EQ(
      line(9.0, 0.5),
      "inconclusive: p99 10.0 ms, budget 9 ms, but the replays differ by a factor of 1.4 and others used 50 "
      "% of the CPU: a no would take more than 63.0 ms; try a quieter machine");
  EXPECT_EQ(percentileName(99.9), "p99.9");
}

}  // namespace
}  // namespace carom::demos
