#pragma once
// The colours of bodies that a scene gives none: those of Okabe and Ito (Color Universal Design, 2008) that
// stay apart for every common kind of colour vision. Tested in tests/demos/scene/body_palette_test.cpp.

#include <array>

#include "renderer/frame/frame_renderer.h"

namespace carom::demos {

inline constexpr std::size_t kPaletteColors = 7;

/// Blue, orange, bluish green, yellow, sky blue, vermilion, reddish purple: neighbours differ most.
const std::array<renderer::Color, kPaletteColors>& bodyPalette();

/// The colour of a scene's i-th body, in turn.
const renderer::Color& paletteColor(std::size_t body);

}  // namespace carom::demos
