#include "demos/motion/phase_stopwatch.h"

#include <numeric>

#include <gtest/gtest.h>

#include "tests/demos/budget/budget_samples.h"

namespace carom::demos {
namespace {

TEST(PhaseStopwatch, APhaseCountsForItselfWithoutThoseInsideIt) {
  double now_s = 5.0;
  PhaseStopwatch watch([&now_s] { return now_s; }, true);
  FrameCost cost;
  watch.beginFrame(3);
  now_s += 0.001;
  {
    const PhaseScope outer(&watch, StepPhase::kTimeOfImpact);
    now_s += 0.002;
    {
      const PhaseScope inner(&watch, StepPhase::kImpulses);
      now_s += 0.004;
    }
    now_s += 0.008;
  }
  now_s += 0.016;
  watch.endFrame(cost);
  EXPECT_EQ(cost.frame, 3);
  EXPECT_NEAR(phaseOf(cost, FramePhase::kTimeOfImpact), 10.0, 1e-9);
  EXPECT_NEAR(phaseOf(cost, FramePhase::kImpulses), 4.0, 1e-9);
  EXPECT_NEAR(phaseOf(cost, FramePhase::kOther), 17.0, 1e-9);
  EXPECT_NEAR(cost.total_ms, 31.0, 1e-9);
  const std::vector<PhaseSlice> slices = watch.takeSlices();
  ASSERT_EQ(slices.size(), 3u);
  EXPECT_EQ(slices[1].phase, FramePhase::kTimeOfImpact);
  EXPECT_NEAR(slices[1].begin_us, 1000.0, 1e-6);
  EXPECT_NEAR(slices[1].length_us, 14000.0, 1e-6);
}

TEST(PhaseStopwatch, EveryFrameStartsFromZeroAndItsPhasesAddUp) {
  double now_s = 0.0;
  PhaseStopwatch watch([&now_s] { return now_s += 0.25; }, false);
  for (int frame = 0; frame < 3; ++frame) {
    FrameCost cost;
    watch.beginFrame(frame);
    for (int i = 0; i < 4; ++i) {
      const FramePhaseScope phase(watch, static_cast<FramePhase>(i));
    }
    watch.endFrame(cost);
    EXPECT_DOUBLE_EQ(cost.total_ms, 2250.0);
    EXPECT_DOUBLE_EQ(std::accumulate(cost.phase_ms.begin(), cost.phase_ms.end(), 0.0), cost.total_ms);
    EXPECT_DOUBLE_EQ(phaseOf(cost, FramePhase::kForces), 250.0);
  }
  EXPECT_TRUE(watch.takeSlices().empty());
}

}  // namespace
}  // namespace carom::demos
