#pragma once
// Made-up measurements: times that a test chooses, states that agree.

#include <functional>

#include "demos/budget/budget_result.h"

namespace carom::demos {

/// Frame times of 1 ms a phase, 10 ms in all, but for what `change` does.
inline Replay sampleReplay(int frames, const std::function<void(FrameCost&)>& change = {}) {
  Replay replay;
  for (int i = 0; i < frames; ++i) {
    FrameCost cost;
    cost.frame = i;
    cost.time_s = i / 60.0;
    cost.state_hash = 1000u + static_cast<std::uint64_t>(i);
    cost.phase_ms.fill(1.0);
    cost.contacts = i;
    cost.pairs = 2 * i;
    cost.queries = 3 * i;
    cost.events = 4 * i;
    if (change) change(cost);
    cost.total_ms = 0.0;
    for (const double phase_ms : cost.phase_ms) cost.total_ms += phase_ms;
    replay.frames.push_back(cost);
  }
  return replay;
}

inline BudgetSubject sampleSubject(int frames) {
  return {"sample", "1234",           640,          360,      60.0, frames, "main", "realtime",
          1,        "a CPU, 2 cores", "a renderer", "a build"};
}

inline BudgetResult sampleResult(const BudgetGate& gate, std::vector<Replay> replays,
                                 std::optional<double> outside_load = 0.0) {
  const int frames = static_cast<int>(replays[0].frames.size());
  return judged(sampleSubject(frames), gate, std::move(replays), outside_load);
}

inline double& phaseOf(FrameCost& cost, FramePhase phase) {
  return cost.phase_ms[static_cast<std::size_t>(phase)];
}

}  // namespace carom::demos
