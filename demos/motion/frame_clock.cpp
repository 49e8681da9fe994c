#include "demos/motion/frame_clock.h"

#include <algorithm>
#include <cmath>

namespace carom::demos {

FrameClock FrameClock::still(double time_s, double steps_per_second) {
  FrameClock clock({1.0, steps_per_second});
  clock.still_s_ = time_s;
  return clock;
}

int FrameClock::frameCount(double duration_s) const {
  if (still_s_) return 1;
  return static_cast<int>(std::lround(duration_s * rates_.fps));
}

int FrameClock::stepCount(double duration_s) const {
  return static_cast<int>(std::lround(duration_s * rates_.steps_per_second));
}

StepInstant FrameClock::instant(int frame) const {
  if (still_s_) {
    constexpr double kSameStep = 1e-9;  // Typed decimals are not exact; a step is some milliseconds.
    const double steps = *still_s_ * rates_.steps_per_second, nearest = std::round(steps);
    if (std::abs(steps - nearest) <= kSameStep * std::max(1.0, nearest))
      return {static_cast<int>(nearest), 0.0};
    return {static_cast<int>(std::floor(steps)), steps - std::floor(steps)};
  }
  // t = k / fps and step = t x rate, so step = k x rate / fps. fmod is exact, so that the whole part is never
  // off by one.
  const double numerator = frame * rates_.steps_per_second;
  const double remainder = std::fmod(numerator, rates_.fps);
  return {static_cast<int>(std::lround((numerator - remainder) / rates_.fps)), remainder / rates_.fps};
}

}  // namespace carom::demos
