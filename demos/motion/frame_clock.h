#pragma once
// Which instant a frame shows: frame k shows exactly t = k / fps, whatever the step of the simulation, and a
// duration holds round(duration x fps) frames. Where the step does not divide the frame, the instant lies
// between two steps. Exact: frame, rate and fps stay whole as long as they were given whole. Slow motion is a
// clock of more frames a second of the scene's time. Tested in tests/demos/motion/frame_clock_test.cpp.

#include <optional>

namespace carom::demos {

/// An instant between two steps: `fraction` in [0, 1) of the way from `step` to `step` + 1.
struct StepInstant {
  int step = 0;
  double fraction = 0.0;

  /// The last step that must have been made to know the state at this instant.
  int lastStepNeeded() const { return fraction > 0.0 ? step + 1 : step; }
};

class FrameClock {
 public:
  struct Rates {
    double fps = 30.0;
    double steps_per_second = 240.0;
  };
  explicit FrameClock(const Rates& rates) : rates_(rates) {}
  /// One frame, at exactly this time; a time within a billionth of a step of it counts as a step.
  static FrameClock still(double time_s, double steps_per_second);

  int frameCount(double duration_s) const;
  int stepCount(double duration_s) const;
  double fps() const { return rates_.fps; }
  double time(int frame) const { return still_s_ ? *still_s_ : frame / rates_.fps; }
  StepInstant instant(int frame) const;

 private:
  Rates rates_;
  std::optional<double> still_s_;
};

}  // namespace carom::demos
