#include "engine/modes/sliding.h"

#include "engine/foundation/tolerances.h"

namespace carom {

double slidingSpeed(const ContactRow& row, std::span<const ImpulseBody> bodies) {
  return row.impulse.x() > 0.0 ? rowVelocity(row, bodies).tail<2>().norm() : 0.0;
}

bool slides(const ContactRow& row, std::span<const ImpulseBody> bodies) {
  return slidingSpeed(row, bodies) > tolerance::kSlidingSpeed;
}

}  // namespace carom
