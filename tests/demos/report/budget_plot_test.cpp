#include "demos/report/budget_plot.h"

#include <gtest/gtest.h>

#include "tests/demos/budget/budget_samples.h"

namespace carom::demos {
namespace {

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

BudgetPlot sample() {
  BudgetPlot plot;
  plot.title = "sample <1 & 2>";
  plot.frames = sampleReplay(120, [](FrameCost& f) {
                  if (f.frame == 40) phaseOf(f, FramePhase::kDraw) = 9.0;
                }).frames;
  plot.budget_ms = 16.7;
  plot.notes = {"within: p99"};
  return plot;
}

TEST(BudgetPlot, StacksThePhasesAndMarksDeadlinePercentilesAndSlowestFrames) {
  const std::string svg = plotSvg(sample());
  EXPECT_EQ(count(svg, "<polygon"), kFramePhases);
  EXPECT_EQ(count(svg, "class=\"mark\""), 5u);
  EXPECT_NE(svg.find("frame 40, 0.667 s, 18 ms"), std::string::npos) << svg;
  EXPECT_NE(svg.find("deadline 16.7 ms"), std::string::npos);
  for (const char* name : {">p50<", ">p95<", ">p99<", ">within: p99<", "sample &lt;1 &amp; 2>"})
    EXPECT_NE(svg.find(name), std::string::npos) << name;
  EXPECT_NE(svg.find("prefers-color-scheme: dark"), std::string::npos);
  EXPECT_NE(svg.find("@media print"), std::string::npos);
  EXPECT_EQ(count(svg, "class=\"other\""), 0u);
}

TEST(BudgetPlot, LaysAnotherRunOverItAndFitsInAPage) {
  BudgetPlot plot = sample();
  plot.other_ms.assign(120, 12.0);
  plot.other = "old.json";
  const std::string page = plotPage(plot);
  EXPECT_EQ(count(page, "class=\"other\""), 1u);
  EXPECT_NE(page.find("line: old.json"), std::string::npos);
  EXPECT_EQ(page.rfind("<!doctype html>", 0), 0u);
}

}  // namespace
}  // namespace carom::demos
