#include "demos/motion/phase_stopwatch.h"

#include "engine/foundation/contract.h"

namespace carom::demos {

PhaseStopwatch::PhaseStopwatch(Seconds now, bool keeps_slices)
    : now_(std::move(now)), keeps_slices_(keeps_slices), origin_s_(now_()) {}

/// Gives the time since the last look at the clock to the phase that was running.
double PhaseStopwatch::lap() {
  const double now_s = now_();
  if (!open_.empty()) phase_s_[static_cast<std::size_t>(open_.back().phase)] += now_s - last_s_;
  last_s_ = now_s;
  return now_s;
}

void PhaseStopwatch::beginFrame(int frame) {
  REQUIRE(open_.empty(), frame);
  frame_ = frame;
  phase_s_.fill(0.0);
  begin(FramePhase::kOther);
}

void PhaseStopwatch::begin(FramePhase phase) {
  const double now_s = lap();
  open_.push_back({phase, now_s});
}

void PhaseStopwatch::end() {
  REQUIRE(!open_.empty());
  const double now_s = lap();
  const Open ended = open_.back();
  open_.pop_back();
  if (keeps_slices_)
    slices_.push_back(
        {frame_, ended.phase, 1e6 * (ended.begin_s - origin_s_), 1e6 * (now_s - ended.begin_s)});
}

void PhaseStopwatch::endFrame(FrameCost& cost) {
  REQUIRE(open_.size() == 1, open_.size());
  const double begin_s = open_.front().begin_s;
  end();
  cost.frame = frame_;
  cost.total_ms = 1000.0 * (last_s_ - begin_s);
  for (std::size_t i = 0; i < kFramePhases; ++i) cost.phase_ms[i] = 1000.0 * phase_s_[i];
}

}  // namespace carom::demos
