#pragma once
// Overlays that stand beside the picture: the legend of the modes' colours, the statistics, the timings.
// Tested in tests/demos/overlay/overlays_test.cpp.

#include <optional>
#include <string>
#include <vector>

#include "demos/overlay/overlay_frame.h"
#include "renderer/drawing/overlay_painter.h"

namespace carom::demos {

/// A line of a panel, with a square of colour before it or without.
struct PanelRow {
  std::string text;
  std::optional<renderer::Color> swatch;
};
using Panel = std::vector<PanelRow>;

/// All modes in their colours, with how many bodies are in each.
Panel legendPanel(const OverlayFrame& frame);
Panel statisticsPanel(const OverlayFrame& frame);
Panel timingsPanel(const OverlayFrame& frame);

/// Where panels go: one below the other in the upper left corner.
std::vector<renderer::PixelRect> placedPanels(const renderer::Canvas& canvas, std::span<const Panel> panels,
                                              const Pen& pen);
void paintPanel(renderer::Canvas& canvas, const Panel& panel, const renderer::PixelRect& rect,
                const Pen& pen);

/// Of the bodies that can move, at the states shown.
struct ShownEnergy {
  double kinetic_J = 0.0;
  double potential_J = 0.0;  ///< Zero at the world's origin.
};
ShownEnergy shownEnergy(const World& world, std::span<const BodyState> states);

}  // namespace carom::demos
