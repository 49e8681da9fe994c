#include "engine/modes/sliding.h"

#include "engine/foundation/tolerances.h"

namespace carom {

double slidingSpeed(const ContactRow& row, std::span<const ImpulseBody> bodies) {
  if (!(row.impulse.x() > 0.0)) return 0.0;
  return (rowVelocity(row, bodies).tail<2>() - row.still_slip).norm();
}

bool slides(const ContactRow& row, std::span<const ImpulseBody> bodies) {
  return slidingSpeed(row, bodies) > tolerance::kSlidingSpeed;
}

}  // namespace carom
