#pragma once
// The colours of the modes: told apart by colour-blind people too (Okabe and Ito 2008).

#include "engine/simulation/world.h"
#include "renderer/frame/frame_renderer.h"

namespace carom::demos {

inline constexpr std::size_t kModes = 7;

inline renderer::Color modeColor(Mode mode) {
  switch (mode) {
    case Mode::kStatic:
      return {0.62f, 0.62f, 0.62f};
    case Mode::kFree:
      return {0.34f, 0.71f, 0.91f};
    case Mode::kColliding:
      return {0.84f, 0.37f, 0.00f};
    case Mode::kSliding:
      return {0.90f, 0.62f, 0.00f};
    case Mode::kContact:
      return {0.80f, 0.47f, 0.65f};
    case Mode::kResting:
      return {0.00f, 0.62f, 0.45f};
    case Mode::kKinematic:
      return {0.00f, 0.45f, 0.70f};
  }
  return {};
}

}  // namespace carom::demos
