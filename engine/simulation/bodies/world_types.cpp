#include "engine/simulation/bodies/world_types.h"

namespace carom {

const char* modeName(Mode mode) {
  switch (mode) {
    case Mode::kStatic:
      return "static";
    case Mode::kFree:
      return "free";
    case Mode::kColliding:
      return "colliding";
    case Mode::kSliding:
      return "sliding";
    case Mode::kContact:
      return "contact";
    case Mode::kResting:
      return "resting";
    case Mode::kKinematic:
      return "kinematic";
  }
  return "?";
}

}  // namespace carom
