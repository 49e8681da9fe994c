#include "demos/budget/replays.h"

#include <gtest/gtest.h>

#include "demos/system/exit_code.h"
#include "tests/demos/budget/budget_samples.h"
#include "tests/support/thrown_message.h"

namespace carom::demos {
namespace {

TEST(Replays, EachFrameAndEachPhaseCountWithTheLeastOfTheirTimes) {
  const Replay a =
      sampleReplay(3, [](FrameCost& f) { phaseOf(f, FramePhase::kDraw) = f.frame == 1 ? 9.0 : 4.0; });
  const Replay b =
      sampleReplay(3, [](FrameCost& f) { phaseOf(f, FramePhase::kModes) = f.frame == 1 ? 2.0 : 8.0; });
  const std::vector<FrameCost> least = leastCosts({a, b});
  const std::vector<double> totals = totals_ms(least);
  EXPECT_EQ(totals, (std::vector<double>{13.0, 11.0, 13.0}));
  EXPECT_EQ(phaseTimes_ms(least, static_cast<std::size_t>(FramePhase::kDraw)),
            (std::vector<double>{1.0, 1.0, 1.0}));
  EXPECT_EQ(least[2].contacts, 2);
}

TEST(Replays, StatesThatPartAreRefusedAndTheFirstSuchFrameIsNamed) {
  const Replay good = sampleReplay(5);
  const Replay bad = sampleReplay(5, [](FrameCost& f) { f.state_hash += f.frame >= 3; });
  EXPECT_NO_THROW(requireSameStates({good, good, good}));
  EXPECT_EQ(thrownMessage<SimulationInvalid>([&] {
              requireSameStates({good, good, bad});
            }),
            "replays 1 and 3 part at frame 3: state 00000000000003eb became 00000000000003ec; the same scene "
            "must give the same states, so no time was judged");
  EXPECT_THROW(sampleResult({10.0, 50.0}, {good, bad}), SimulationInvalid);
}

TEST(Replays, TheSlowestFramesComeSlowestFirst) {
  const Replay r =
      sampleReplay(6, [](FrameCost& f) { phaseOf(f, FramePhase::kDraw) = 10.0 * ((f.frame * 5) % 6); });
  std::vector<int> order;
  for (const FrameCost& f : slowestFrames(r.frames, 3)) order.push_back(f.frame);
  EXPECT_EQ(order, (std::vector<int>{1, 2, 3}));
  EXPECT_EQ(slowestFrames(r.frames, 99).size(), 6u);
}

}  // namespace
}  // namespace carom::demos
