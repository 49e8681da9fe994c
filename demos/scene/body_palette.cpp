#include "demos/scene/body_palette.h"

namespace carom::demos {
namespace {

constexpr renderer::Color fromBytes(int r, int g, int b) {
  return {static_cast<float>(r) / 255.0f, static_cast<float>(g) / 255.0f, static_cast<float>(b) / 255.0f};
}

}  // namespace

const std::array<renderer::Color, kPaletteColors>& bodyPalette() {
  static constexpr std::array<renderer::Color, kPaletteColors> colors = {
      fromBytes(0, 114, 178),  fromBytes(230, 159, 0), fromBytes(0, 158, 115),  fromBytes(240, 228, 66),
      fromBytes(86, 180, 233), fromBytes(213, 94, 0),  fromBytes(204, 121, 167)};
  return colors;
}

const renderer::Color& paletteColor(std::size_t body) {
  return bodyPalette()[body % kPaletteColors];
}

}  // namespace carom::demos
