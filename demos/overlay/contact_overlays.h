#pragma once
// Overlays of contacts (paper §2.1-§2.5, figs. 7-10): normals, impulses, contact polygons, the collision
// window, support polygons. Tested in tests/demos/overlay/overlays_test.cpp.

#include "demos/overlay/overlay_frame.h"
#include "demos/overlay/shown_contacts.h"
#include "renderer/drawing/overlay_painter.h"

namespace carom::demos {

void paintNormals(renderer::OverlayPainter& painter, const OverlayFrame& frame, const Pen& pen);
/// Of the last step's lasting contacts, and of the collisions since the frame before.
void paintImpulses(renderer::OverlayPainter& painter, const OverlayFrame& frame, const Pen& pen);
void paintManifolds(renderer::OverlayPainter& painter, const OverlayFrame& frame, const Pen& pen);
void paintWindows(renderer::OverlayPainter& painter, const OverlayFrame& frame, const Pen& pen);
void paintSupports(renderer::OverlayPainter& painter, const OverlayFrame& frame, const Pen& pen);

/// The height in a gauge, 0 at its lower end to 1, of a gap.
double gaugeHeight(double gap_m, const CollisionWindow& window);

/// The support polygon of a body at the poses shown: world corners level with the contacts, and where the
/// centre of mass falls on that level.
struct ShownSupport {
  std::vector<Vec3> corners_W;
  Vec3 foot_W = Vec3::Zero();
  bool holds = false;  ///< The foot lies in the polygon.
};
/// Nothing for a body that no contact holds up against `gravity`.
std::optional<ShownSupport> shownSupport(const OverlayFrame& frame, int body, const Vec3& gravity);

}  // namespace carom::demos
