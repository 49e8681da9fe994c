#include "demos/report/trace_events.h"

#include <map>

#include <gtest/gtest.h>

#include "demos/asset/asset_path.h"
#include "demos/format/json.h"
#include "demos/motion/phase_stopwatch.h"
#include "tests/demos/budget/budget_samples.h"
#include "tests/support/temporary_folder.h"

namespace carom::demos {
namespace {

/// Two frames of a clock that counts seconds.
Replay tracedReplay() {
  double now_s = 100.0;
  PhaseStopwatch watch([&now_s] { return now_s += 1.0; }, true);
  Replay replay = sampleReplay(2);
  for (FrameCost& frame : replay.frames) {
    watch.beginFrame(frame.frame);
    watch.begin(FramePhase::kTimeOfImpact);
    watch.begin(FramePhase::kImpulses);
    watch.end();
    watch.end();
    watch.endFrame(frame);
  }
  replay.slices = watch.takeSlices();
  return replay;
}

struct Span {
  double begin_us;
  double end_us;
};

TEST(TraceEvents, PhasesLieWithinTheirFramesAndEveryEventHasWhatTheFormatAsksFor) {
  const Json trace =
      Json::parse(traceText(sampleResult({1000.0, 50.0}, {tracedReplay(), sampleReplay(2)})), "trace");
  std::map<std::string, std::vector<Span>> spans;
  int counters = 0, names = 0;
  for (const Json& event : trace.at("traceEvents").items()) {
    EXPECT_EQ(event.at("pid").asNumber(), 1.0);
    EXPECT_EQ(event.at("tid").asNumber(), 1.0);
    const std::string kind = event.at("ph").asString();
    const double begin_us = event.at("ts").asNumber();
    if (kind == "C") ++counters;
    if (kind == "M") ++names;
    if (kind != "X") event.at("args");
    if (kind == "X")
      spans[event.at("name").asString()].push_back({begin_us, begin_us + event.at("dur").asNumber()});
  }
  EXPECT_EQ(counters, 6);
  EXPECT_EQ(names, 2);
  ASSERT_EQ(spans["frame 0"].size() + spans["frame 1"].size(), 2u);
  ASSERT_EQ(spans["time of impact"].size(), 2u);
  ASSERT_EQ(spans["impulses"].size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    const Span frame = spans["frame " + std::to_string(i)][0];
    const Span outer = spans["time of impact"][i], inner = spans["impulses"][i];
    EXPECT_DOUBLE_EQ(frame.end_us - frame.begin_us, 5e6);
    EXPECT_DOUBLE_EQ(outer.begin_us - frame.begin_us, 1e6);
    EXPECT_DOUBLE_EQ(inner.begin_us - outer.begin_us, 1e6);
    EXPECT_DOUBLE_EQ(inner.end_us - inner.begin_us, 1e6);
    EXPECT_LT(inner.end_us, outer.end_us);
    EXPECT_LT(outer.end_us, frame.end_us);
  }
}

}  // namespace
}  // namespace carom::demos
