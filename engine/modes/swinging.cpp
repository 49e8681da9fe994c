#include "engine/modes/swinging.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/foundation/tolerances.h"

namespace carom {
namespace {

constexpr int kTurns = 2;          // So often it turns round before it swings: once could be a blow.
constexpr double kLongHalf = 2.0;  // Half a swing that lasts so many times the one before is none.

// Of motions about the same centre: positive where they go the same way; with itself, a squared speed.
double similarity(const Velocity& v, const Velocity& w, double radius_m) {
  return dot(v.linear, w.linear) + radius_m * radius_m * dot(v.angular, w.angular);
}

}  // namespace

void SwingWatch::follow(const Velocity& velocity, double radius_m, double rise_m, double step_s) {
  relative_amplitude_ = rise_m / (tolerance::kSwingRise * radius_m);
  since_s_ += step_s;
  if (!(relative_amplitude_ < 1.0) || (turns_ >= kTurns && since_s_ > kLongHalf * half_s_ + step_s)) {
    forget();
    return;
  }
  if (similarity(velocity, fastest_, radius_m) < 0.0) {
    half_s_ = since_s_;
    since_s_ = 0.0;
    ++turns_;
    fastest_ = velocity;
  } else if (similarity(velocity, velocity, radius_m) > similarity(fastest_, fastest_, radius_m)) {
    fastest_ = velocity;
  }
}

double SwingWatch::keeps(double step_s) const {
  if (turns_ < kTurns) return 1.0;
  // Dry friction slows small swings as much as larger ones, so it takes the larger share of them. And what
  // falls from one point of contact to the next and back, half a swing in a few steps, gains by each turn in
  // proportion to a step's gravity: nothing less than such a share ends that.
  const double dry = tolerance::kSwingDamping / std::sqrt(relative_amplitude_);
  // v' = -c v - w^2 x is damped critically by c = 2 w; half a swing takes pi / w.
  const double damping = std::min(dry, std::numbers::pi / half_s_);
  return 1.0 / (1.0 + damping * (1.0 - relative_amplitude_) * step_s);
}

}  // namespace carom
