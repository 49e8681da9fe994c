#include "demos/frame_clock.h"

#include <cmath>

namespace carom::demos {

int FrameClock::frameCount(double duration_s) const {
  return static_cast<int>(std::lround(duration_s * rates_.fps));
}

int FrameClock::stepCount(double duration_s) const {
  return static_cast<int>(std::lround(duration_s * rates_.steps_per_second));
}

StepInstant FrameClock::instant(int frame) const {
  // t = k / fps and step = t x rate, so step = k x rate / fps. fmod is exact, so that the whole part is never
  // off by one.
  const double numerator = frame * rates_.steps_per_second;
  const double remainder = std::fmod(numerator, rates_.fps);
  return {static_cast<int>(std::lround((numerator - remainder) / rates_.fps)), remainder / rates_.fps};
}

Pose interpolated(const Pose& a, const Pose& b, double fraction) {
  if (fraction == 0.0) return a;
  return {a.rotation.slerp(fraction, b.rotation), a.position + fraction * (b.position - a.position)};
}

}  // namespace carom::demos
