// A job that hangs, crashes or throws costs itself only; all others report.

#include "tests/explore/watch/guarded_run.h"

#include <gtest/gtest.h>

#include <csignal>
#include <ctime>
#include <map>
#include <stdexcept>

namespace carom::explore {
namespace {

TEST(GuardedRun, AHangACrashAndAnExceptionCostOneJobEach) {
  const Job job = [](std::uint64_t number, const TrialSettings& settings) {
    SeedReport report;
    report.seed = number;
    report.family = "jobs";
    settings.before_start();
    settings.before_step();
    for (volatile bool hangs = number == 13; hangs;) {
    }
    if (number == 17) std::raise(SIGKILL);
    if (number == 19) throw std::runtime_error("one\nline");
    report.outcome.totals.steps = 7;
    if (number == 23) report.outcome.findings.push_back({"energy", 0.1, 3, "tabs\tand\nlines"});
    return report;
  };
  std::map<std::uint64_t, SeedReport> reports;
  runGuarded(10, 100, 2, {.step_cpu_s = 0.05, .run_cpu_s = 1.0}, job, [&reports](const SeedReport& report) {
    EXPECT_TRUE(reports.emplace(report.seed, report).second);
  });
  ASSERT_EQ(reports.size(), 100u);
  const auto findings = [&reports](std::uint64_t number) { return reports.at(number).outcome.findings; };
  ASSERT_EQ(findings(13).size(), 1u);
  EXPECT_EQ(findings(13)[0].kind, "hang");
  EXPECT_EQ(findings(13)[0].step, 1);
  EXPECT_EQ(findings(17).at(0).kind, "crash");
  EXPECT_EQ(findings(19).at(0).kind, "abort");
  EXPECT_EQ(findings(23).at(0).detail, "tabs and lines");
  EXPECT_EQ(findings(23).at(0).figure, 0.1);
  EXPECT_TRUE(findings(109).empty());
  EXPECT_EQ(reports.at(109).outcome.totals.steps, 7);
}

TEST(GuardedRun, TheMakingOfAWorldHasALimitOfItsOwn) {
  const auto found = [](double start_cpu_s) {
    return runGuarded({.step_cpu_s = 0.05, .run_cpu_s = 0.05, .start_cpu_s = start_cpu_s},
                      [](const TrialSettings& settings) {
                        settings.before_start();
                        for (const std::clock_t begin = std::clock();
                             std::clock() - begin < CLOCKS_PER_SEC / 5;) {
                        }
                        settings.before_step();
                        return SeedReport{};
                      })
        .outcome.findings;
  };
  EXPECT_TRUE(found(10.0).empty());
  ASSERT_EQ(found(0.1).size(), 1u);
  EXPECT_EQ(found(0.1)[0].step, 0);
}

TEST(GuardedRun, ARunWhoseStepsAreShortButManyEndsAtItsOwnLimit) {
  const SeedReport report =
      runGuarded({.step_cpu_s = 0.5, .run_cpu_s = 0.1}, [](const TrialSettings& settings) {
        for (;;) settings.before_step();
        return SeedReport{};
      });
  ASSERT_EQ(report.outcome.findings.size(), 1u);
  EXPECT_EQ(report.outcome.findings[0].kind, "slow");
}

// Seeds whose worlds are run again, for their bits, were taken for slow ones.
TEST(GuardedRun, EveryRunOfASeedHasTheWholeLimit) {
  const SeedReport report =
      runGuarded({.step_cpu_s = 0.5, .run_cpu_s = 0.3}, [](const TrialSettings& settings) {
        for (int run = 0; run < 4; ++run) {
          settings.before_start();
          settings.before_step();
          for (const std::clock_t begin = std::clock(); std::clock() - begin < CLOCKS_PER_SEC / 10;) {
          }
        }
        return SeedReport{};
      });
  EXPECT_TRUE(report.outcome.findings.empty());
}

}  // namespace
}  // namespace carom::explore
