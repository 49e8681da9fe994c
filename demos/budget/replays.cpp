#include "demos/budget/replays.h"

#include <algorithm>

#include "demos/format/content_hash.h"
#include "demos/system/exit_code.h"
#include "engine/foundation/contract.h"

namespace carom::demos {

namespace {

/// The clock must be the only thing that two replays differ in.
void requireSameWork(const FrameCost& first, const FrameCost& other, std::size_t replay) {
  for (std::size_t w = 0; w < kWorkKinds; ++w)
    if (first.work[w] != other.work[w])
      throw SimulationInvalid("replays 1 and " + std::to_string(replay) + " do other work at frame " +
                              std::to_string(first.frame) + ": " + kWork[w].name + " " +
                              std::to_string(first.work[w]) + " became " + std::to_string(other.work[w]));
}

}  // namespace

void requireSameStates(const std::vector<Replay>& replays) {
  for (std::size_t r = 1; r < replays.size(); ++r) {
    REQUIRE(replays[r].frames.size() == replays[0].frames.size(), r);
    for (std::size_t i = 0; i < replays[0].frames.size(); ++i) {
      const FrameCost& first = replays[0].frames[i];
      const FrameCost& other = replays[r].frames[i];
      if (first.state_hash == other.state_hash) {
        requireSameWork(first, other, r + 1);
        continue;
      }
      throw SimulationInvalid("replays 1 and " + std::to_string(r + 1) + " part at frame " +
                              std::to_string(first.frame) + ": state " + hexText(first.state_hash) +
                              " became " + hexText(other.state_hash) +
                              "; the same scene must give the same states, so no time was judged");
    }
  }
}

std::vector<FrameCost> leastCosts(const std::vector<Replay>& replays) {
  REQUIRE(!replays.empty());
  std::vector<FrameCost> least = replays[0].frames;
  for (const Replay& replay : replays)
    for (std::size_t i = 0; i < least.size(); ++i) {
      least[i].total_ms = std::min(least[i].total_ms, replay.frames[i].total_ms);
      for (std::size_t p = 0; p < kFramePhases; ++p)
        least[i].phase_ms[p] = std::min(least[i].phase_ms[p], replay.frames[i].phase_ms[p]);
    }
  return least;
}

std::vector<FrameCost> slowestFrames(std::vector<FrameCost> frames, std::size_t count) {
  std::stable_sort(frames.begin(), frames.end(),
                   [](const FrameCost& x, const FrameCost& y) { return x.total_ms > y.total_ms; });
  frames.resize(std::min(count, frames.size()));
  return frames;
}

std::vector<double> totals_ms(const std::vector<FrameCost>& frames) {
  std::vector<double> times;
  for (const FrameCost& frame : frames) times.push_back(frame.total_ms);
  return times;
}

std::vector<double> phaseTimes_ms(const std::vector<FrameCost>& frames, std::size_t phase) {
  std::vector<double> times;
  for (const FrameCost& frame : frames) times.push_back(frame.phase_ms[phase]);
  return times;
}

}  // namespace carom::demos
