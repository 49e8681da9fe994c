#pragma once
// Overlays of the bodies' motion: swept bounds and candidate pairs, velocities, trails, names. Tested in
// tests/demos/overlay/overlays_test.cpp.

#include "demos/overlay/overlay_frame.h"
#include "renderer/drawing/overlay_painter.h"

namespace carom::demos {

void paintBounds(renderer::OverlayPainter& painter, const OverlayFrame& frame, const Pen& pen);
void paintCandidates(renderer::OverlayPainter& painter, const OverlayFrame& frame, const Pen& pen);
void paintVelocities(renderer::OverlayPainter& painter, const OverlayFrame& frame, const Pen& pen);
void paintTrails(renderer::OverlayPainter& painter, const OverlayFrame& frame, const Pen& pen);
void paintLabels(renderer::OverlayPainter& painter, const OverlayFrame& frame, const Pen& pen);

/// An arrow of a velocity is as long as the body goes in this time, seconds.
inline constexpr double kVelocityTime_s = 0.15;

}  // namespace carom::demos
