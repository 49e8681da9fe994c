#pragma once
// Colours as scenes and images hold them, and the light they stand for. Tested in
// tests/renderer/view/multiple_exposure_test.cpp.

#include <cmath>

namespace carom::renderer {

/// sRGB, each 0 to 1.
struct Color {
  float r = 0.8f;
  float g = 0.8f;
  float b = 0.8f;
};

/// The light of an sRGB channel (IEC 61966-2-1), 0 to 1.
inline float linearLight(float s) {
  return s <= 0.04045f ? s / 12.92f : std::pow((s + 0.055f) / 1.055f, 2.4f);
}

}  // namespace carom::renderer
