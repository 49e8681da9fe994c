#pragma once
// Several runs of one deterministic scene as one measurement: noise only ever adds time, so the least of a
// frame's times is the nearest to what the frame costs. Tested in tests/demos/budget/replays_test.cpp.

#include "demos/motion/frame_cost.h"

namespace carom::demos {

/// Throws SimulationInvalid when the replays were not the same run: names the first frame whose states
/// differ.
void requireSameStates(const std::vector<Replay>& replays);

/// Each frame, and each phase of it by itself, at the least of its times. There must be a replay.
std::vector<FrameCost> leastCosts(const std::vector<Replay>& replays);

/// The `count` that took longest, longest first.
std::vector<FrameCost> slowestFrames(std::vector<FrameCost> frames, std::size_t count);

std::vector<double> totals_ms(const std::vector<FrameCost>& frames);
std::vector<double> phaseTimes_ms(const std::vector<FrameCost>& frames, std::size_t phase);

}  // namespace carom::demos
