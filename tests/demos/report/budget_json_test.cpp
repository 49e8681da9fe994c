#include "demos/report/budget_json.h"

#include <sstream>

#include <gtest/gtest.h>

#include "tests/demos/budget/budget_samples.h"

namespace carom::demos {
namespace {

std::vector<std::string> splitAt(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, separator);) parts.push_back(part);
  return parts;
}

/// Draw takes 1 ms more a frame: 10, 11, ... ms in all.
BudgetResult rising(int frames) {
  const Replay replay = sampleReplay(frames, [](FrameCost& f) { phaseOf(f, FramePhase::kDraw) += f.frame; });
  return sampleResult({100.0, 90.0}, {replay, replay}, 0.02);
}

TEST(BudgetJson, HoldsTheFiguresOfAClosedForm) {
  const Json json = Json::parse(budgetJson(rising(200), nullptr).text(2), "result");
  EXPECT_EQ(json.at("verdict").asString(), "over");
  const Json& frame = json.at("frame_ms");
  EXPECT_EQ(frame.at("min").asNumber(), 10.0);
  EXPECT_EQ(frame.at("p50").asNumber(), 109.0);
  EXPECT_EQ(frame.at("p95").asNumber(), 199.0);
  EXPECT_EQ(frame.at("p99").asNumber(), 207.0);
  EXPECT_EQ(frame.at("max").asNumber(), 209.0);
  EXPECT_EQ(frame.at("atPercentile").asNumber(), 189.0);
  EXPECT_EQ(json.at("overrun").at("frames").asNumber(), 109.0);
  EXPECT_EQ(json.at("overrun").at("worst_ms").asNumber(), 109.0);
  EXPECT_DOUBLE_EQ(json.at("fpsOnePercentLow").asNumber(), 1000.0 / 208.5);
  EXPECT_EQ(json.at("phases_ms").items().size(), kFramePhases);
  EXPECT_EQ(json.at("phases_ms").items()[6].at("name").asString(), "draw");
  EXPECT_EQ(json.at("phases_ms").items()[6].at("max").asNumber(), 200.0);
  EXPECT_EQ(json.at("replays").items().size(), 2u);
  EXPECT_EQ(json.at("outsideLoad").asNumber(), 0.02);
  const Json& slowest = json.at("slowest").items()[0];
  EXPECT_EQ(slowest.at("frame").asNumber(), 199.0);
  EXPECT_EQ(slowest.at("contacts").asNumber(), 199.0);
  EXPECT_EQ(slowest.at("events").asNumber(), 4.0 * 199.0);
  EXPECT_EQ(json.find("baseline"), nullptr);
}

TEST(BudgetJson, WhatTooFewFramesCannotTellIsNull) {
  const Json json = Json::parse(budgetJson(rising(50), nullptr).text(), "result");
  EXPECT_EQ(json.at("frame_ms").at("p99").kind(), Json::Kind::kNull);
  EXPECT_EQ(json.at("frame_ms").at("p95").kind(), Json::Kind::kNumber);
  EXPECT_EQ(json.at("fpsOnePercentLow").kind(), Json::Kind::kNull);
}

TEST(BudgetCsv, HasOneRowAFrameWithAColumnForEveryPhase) {
  const BudgetResult result = rising(120);
  const std::vector<std::string> lines = splitAt(budgetCsv(result), '\n');
  ASSERT_EQ(lines.size(), 121u);
  EXPECT_EQ(lines[0],
            "frame,time_s,frame_ms,forces_ms,broad_phase_ms,closest_features_ms,impulses_ms,"
            "time_of_impact_ms,modes_ms,draw_ms,readback_ms,encode_ms,other_ms,over_ms,contacts,pairs,"
            "queries,events,state");
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const std::vector<std::string> cells = splitAt(lines[i], ',');
    ASSERT_EQ(cells.size(), 19u);
    const FrameCost& frame = result.least[i - 1];
    EXPECT_EQ(std::stoi(cells[0]), frame.frame);
    EXPECT_EQ(std::stod(cells[2]), frame.total_ms);
    EXPECT_EQ(std::stod(cells[9]), frame.phase_ms[6]);
    EXPECT_EQ(std::stod(cells[13]), std::max(frame.total_ms - 100.0, 0.0));
    EXPECT_EQ(std::stoi(cells[14]), frame.contacts);
  }
}

}  // namespace
}  // namespace carom::demos
