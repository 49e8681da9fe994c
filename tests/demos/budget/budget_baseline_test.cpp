#include "demos/budget/budget_baseline.h"

#include <gtest/gtest.h>

#include "demos/report/budget_json.h"
#include "engine/foundation/contract.h"
#include "tests/demos/budget/budget_samples.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/thrown_message.h"

namespace carom::demos {
namespace {

constexpr BudgetGate kGate{1000.0, 99.0};

/// A baseline of `result`, through the file as a user would have it.
Baseline savedAndRead(const BudgetResult& result) {
  const TemporaryFolder folder;
  Baseline baseline = readBaseline(folder.file("old.json", budgetJson(result, nullptr).text(2)));
  baseline.file = "old.json";
  return baseline;
}

BudgetResult slowedBy(FramePhase phase, double factor, double outside_load = 0.0) {
  const Replay replay = sampleReplay(120, [&](FrameCost& f) { phaseOf(f, phase) *= factor; });
  return sampleResult(kGate, {replay, replay}, outside_load);
}

TEST(BudgetBaseline, ASlowdownOf20PercentInOnePhaseIsCaughtAndThatPhaseAloneIsNamed) {
  const Baseline baseline = savedAndRead(sampleResult(kGate, {sampleReplay(120), sampleReplay(120)}));
  for (std::size_t p = 0; p < kFramePhases; ++p) {
    const BaselineComparison c =
        comparedToBaseline(slowedBy(static_cast<FramePhase>(p), 1.2), baseline, 10.0);
    EXPECT_EQ(c.verdict, BudgetVerdict::kOver);
    const std::vector<std::string> lines = baselineLines(c);
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_EQ(lines[0], std::string("slower: ") + kFramePhaseNames[p] +
                            ", mean 1.2 ms, was 1 ms (+20 %, tolerance 10 %)");
  }
}

TEST(BudgetBaseline, WithinTheToleranceAndFasterNothingIsNamed) {
  const Baseline baseline = savedAndRead(sampleResult(kGate, {sampleReplay(120), sampleReplay(120)}));
  for (const double factor : {0.5, 1.0, 1.09}) {
    const BaselineComparison c = comparedToBaseline(slowedBy(FramePhase::kDraw, factor), baseline, 10.0);
    EXPECT_EQ(c.verdict, BudgetVerdict::kWithin) << factor;
    EXPECT_EQ(baselineLines(c)[0], "no phase is slower than in old.json by more than 10 %");
  }
  EXPECT_EQ(comparedToBaseline(slowedBy(FramePhase::kDraw, 1.09), baseline, 5.0).verdict,
            BudgetVerdict::kOver);
}

// 15 and 55 microseconds of a frame of about 9 ms: half a percent of it lies between.
TEST(BudgetBaseline, APhaseThatIsNextToNothingIsNamedOnlyWhenTheFrameFeelsIt) {
  const auto measured = [](double other_ms) {
    const Replay replay = sampleReplay(120, [&](FrameCost& f) { phaseOf(f, FramePhase::kOther) = other_ms; });
    return sampleResult(kGate, {replay, replay});
  };
  const Baseline baseline = savedAndRead(measured(0.015));
  EXPECT_EQ(comparedToBaseline(measured(0.030), baseline, 10.0).verdict, BudgetVerdict::kWithin);
  const BaselineComparison c = comparedToBaseline(measured(0.070), baseline, 10.0);
  EXPECT_EQ(c.verdict, BudgetVerdict::kOver);
  EXPECT_EQ(baselineLines(c)[0].rfind("slower: other, mean 0.07 ms, was 0.015 ms", 0), 0u);
}

TEST(BudgetBaseline, ASlowdownThatOthersLoadExplainsIsInconclusive) {
  const Baseline baseline = savedAndRead(sampleResult(kGate, {sampleReplay(120), sampleReplay(120)}));
  const BaselineComparison c = comparedToBaseline(slowedBy(FramePhase::kDraw, 1.2, 0.3), baseline, 10.0);
  EXPECT_EQ(c.verdict, BudgetVerdict::kInconclusive);
  EXPECT_EQ(
      baselineLines(c)[0],
      "inconclusive: draw, mean 1.2 ms, was 1 ms (+20 %, tolerance 10 %), but others used 30 % of the CPU");
  EXPECT_EQ(comparedToBaseline(slowedBy(FramePhase::kDraw, 4.0, 0.3), baseline, 10.0).verdict,
            BudgetVerdict::kOver);
}

TEST(BudgetBaseline, FewSlowFramesThatTheMeanHidesAreCaughtByThePercentile) {
  const Baseline baseline = savedAndRead(sampleResult(kGate, {sampleReplay(120), sampleReplay(120)}));
  const Replay spikes =
      sampleReplay(120, [](FrameCost& f) { phaseOf(f, FramePhase::kImpulses) += f.frame < 2 ? 3.0 : 0.0; });
  const BaselineComparison c = comparedToBaseline(sampleResult(kGate, {spikes, spikes}), baseline, 10.0);
  EXPECT_EQ(baselineLines(c),
            std::vector<std::string>{"slower: frame, p99 13 ms, was 10 ms (+30 %, tolerance 10 %)"});
}

TEST(BudgetBaseline, AnotherSceneSizeLengthMachineOrBuildIsRefusedByName) {
  const Baseline baseline = savedAndRead(sampleResult(kGate, {sampleReplay(120), sampleReplay(120)}));
  EXPECT_NO_THROW(requireSameSubject(baseline, sampleSubject(120)));
  const std::vector<std::pair<std::string, std::function<void(BudgetSubject&)>>> changes = {
      {"scene: sample, not other;", [](BudgetSubject& s) { s.scene = "other"; }},
      {"content of the scene (file, meshes or seed): 1234, not 1235;",
       [](BudgetSubject& s) { s.scene_hash = "1235"; }},
      {"size: 640x360, not 640x361;", [](BudgetSubject& s) { s.height += 1; }},
      {"length: 120 frames at 60 fps, not 121 frames at 60 fps;", [](BudgetSubject& s) { s.frames += 1; }},
      {"length: 120 frames at 60 fps, not 120 frames at 30 fps;", [](BudgetSubject& s) { s.fps = 30.0; }},
      {"camera: main, not top;", [](BudgetSubject& s) { s.camera = "top"; }},
      {"preset: realtime, not fast;", [](BudgetSubject& s) { s.preset = "fast"; }},
      {"number of threads: 1, not 2;", [](BudgetSubject& s) { s.threads = 2; }},
      {"machine: a CPU, 2 cores, not a CPU, 4 cores;",
       [](BudgetSubject& s) { s.machine = "a CPU, 4 cores"; }},
      {"renderer: a renderer, not softpipe;", [](BudgetSubject& s) { s.renderer = "softpipe"; }},
      {"build: a build, not Debug;", [](BudgetSubject& s) { s.build = "Debug"; }}};
  for (const auto& [part, change] : changes) {
    BudgetSubject other = sampleSubject(120);
    change(other);
    const std::string message = thrownMessage<InputError>([&] { requireSameSubject(baseline, other); });
    EXPECT_EQ(message.rfind("old.json: is of another " + part, 0), 0u) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos);
  }
}

/// A hundred queries and a thousand triangles a frame, but for what `change` does.
BudgetResult worked(const std::function<void(FrameCost&)>& change = {}) {
  const Replay replay = sampleReplay(120, [&](FrameCost& f) {
    f.worked(Work::kQueries) = 100;
    f.worked(Work::kTriangles) = 1000;
    if (change) change(f);
  });
  return sampleResult(kGate, {replay, replay});
}

TEST(BudgetBaseline, OneQueryMoreInOneFrameIsNamedWithItsFrameWhateverTheTimes) {
  const Baseline baseline = savedAndRead(worked());
  const BaselineComparison c = comparedToBaseline(
      worked([](FrameCost& f) { f.worked(Work::kQueries) += f.frame == 17 ? 1 : 0; }), baseline, 10.0);
  EXPECT_EQ(c.verdict, BudgetVerdict::kOver);
  EXPECT_EQ(
      baselineLines(c)[1],
      "more work: queries, 12001, was 12000 (+0.00833 %), first at frame 17: 101, was 100; in no more time");
  EXPECT_EQ(
      comparedToBaseline(worked([](FrameCost& f) { f.worked(Work::kQueries) += f.frame == 17 ? 1 : 0; }),
                         baseline, 10.0, 1.0)
          .verdict,
      BudgetVerdict::kWithin);
}

TEST(BudgetBaseline, LessWorkAndTheSameWorkPass) {
  const Baseline baseline = savedAndRead(worked());
  const BaselineComparison less =
      comparedToBaseline(worked([](FrameCost& f) { f.worked(Work::kTriangles) = 900; }), baseline, 10.0);
  EXPECT_EQ(less.verdict, BudgetVerdict::kWithin);
  EXPECT_EQ(baselineLines(less)[1],
            "less work: triangles, 108000, was 120000 (-10 %), first at frame 0: 900, was 1000");
  EXPECT_EQ(baselineLines(comparedToBaseline(worked(), baseline, 10.0))[1],
            "the same work in every frame as in old.json");
}

TEST(BudgetBaseline, TimeWithoutWorkIsToldFromTimeOfWork) {
  const Baseline baseline = savedAndRead(worked());
  const auto slower = [](FrameCost& f) { phaseOf(f, FramePhase::kDraw) = 1.5; };
  EXPECT_EQ(baselineLines(comparedToBaseline(worked(slower), baseline, 10.0))[0],
            "slower: draw, mean 1.5 ms, was 1 ms (+50 %, tolerance 10 %); with no more work");
  EXPECT_EQ(baselineLines(comparedToBaseline(worked([&](FrameCost& f) {
                                               slower(f);
                                               f.worked(Work::kTriangles) = 1500;
                                             }),
                                             baseline, 10.0))[0],
            "slower: draw, mean 1.5 ms, was 1 ms (+50 %, tolerance 10 %); with more work: triangles +50 %");
}

TEST(BudgetBaseline, OfAnotherMachineGatesTheWorkAlone) {
  Baseline baseline = savedAndRead(worked());
  baseline.subject.machine = "another";
  const BaselineComparison c =
      comparedToBaseline(worked([](FrameCost& f) { phaseOf(f, FramePhase::kDraw) = 9.0; }), baseline, 10.0);
  EXPECT_EQ(c.verdict, BudgetVerdict::kWithin);
  EXPECT_EQ(baselineLines(c)[0],
            "no times were compared: old.json is of another machine: another, not a CPU, 2 cores");
}

TEST(BudgetBaseline, AFileFromBeforeThreadsIsOfOne) {
  const TemporaryFolder folder;
  std::string text = budgetJson(sampleResult(kGate, {sampleReplay(120), sampleReplay(120)}), nullptr).text(2);
  const std::string named = "\"threads\": 1,";
  ASSERT_NE(text.find(named), std::string::npos);
  text.erase(text.find(named), named.size());
  EXPECT_EQ(readBaseline(folder.file("old.json", text)).subject.threads, 1);
}

TEST(BudgetBaseline, AFileThatIsNoBudgetIsRefusedInOneLine) {
  const TemporaryFolder folder;
  for (const char* text : {"", "[]", "{}", "{ \"subject\": 3 }", "{ \"subject\": { \"scene\": \"x\" } }"}) {
    const std::filesystem::path file = folder.file("bad.json", text);
    const std::string message = thrownMessage<InputError>([&] { readBaseline(file); });
    EXPECT_NE(message.find("bad.json"), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
  EXPECT_THROW(readBaseline(folder.path() / "missing.json"), InputError);
}

}  // namespace
}  // namespace carom::demos
