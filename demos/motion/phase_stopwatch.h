#pragma once
// Keeps the time of a frame's phases: each counts for itself, without those inside it, so that the phases of
// a frame add up to the frame. The clock is handed in, so that the tests need not wait. Tested in
// tests/demos/motion/phase_stopwatch_test.cpp.

#include <functional>

#include "demos/motion/frame_cost.h"

namespace carom::demos {

class PhaseStopwatch : public PhaseClock {
 public:
  using Seconds = std::function<double()>;

  /// `keeps_slices`: also where on the clock each phase was.
  PhaseStopwatch(Seconds now, bool keeps_slices);

  void beginFrame(int frame);
  void begin(StepPhase phase) override { begin(framePhase(phase)); }
  void begin(FramePhase phase);
  void end() override;
  /// Ends the frame and puts its times into `cost`.
  void endFrame(FrameCost& cost);

  std::vector<PhaseSlice> takeSlices() { return std::move(slices_); }

 private:
  struct Open {
    FramePhase phase;
    double begin_s;
  };
  double lap();

  Seconds now_;
  bool keeps_slices_;
  double origin_s_;
  double last_s_ = 0.0;
  int frame_ = 0;
  std::vector<Open> open_;
  std::array<double, kFramePhases> phase_s_{};
  std::vector<PhaseSlice> slices_;
};

/// A phase of the frame that lasts as long as this lives.
class FramePhaseScope {
 public:
  FramePhaseScope(PhaseStopwatch& watch, FramePhase phase) : watch_(watch) { watch_.begin(phase); }
  ~FramePhaseScope() { watch_.end(); }
  FramePhaseScope(const FramePhaseScope&) = delete;
  FramePhaseScope& operator=(const FramePhaseScope&) = delete;

 private:
  PhaseStopwatch& watch_;
};

}  // namespace carom::demos
