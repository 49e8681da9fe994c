#pragma once
// Overlays of the closest features (paper §2, figs. 1-5): V-regions, features with their witness points, and
// distances. Tested in tests/demos/overlay/overlays_test.cpp.

#include "demos/overlay/overlay_frame.h"
#include "renderer/drawing/overlay_painter.h"

namespace carom::demos {

void paintRegions(renderer::OverlayPainter& painter, const OverlayFrame& frame, const Pen& pen);
void paintClosest(renderer::OverlayPainter& painter, const OverlayFrame& frame, const Pen& pen);
void paintDistances(renderer::OverlayPainter& painter, const OverlayFrame& frame, const Pen& pen);

}  // namespace carom::demos
