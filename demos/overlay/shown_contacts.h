#pragma once
// What overlays show of contacts, as plain values: points with normals, and impulses with the arrows that
// stand for them. Drawn by contact_overlays.h, and by pages that play a recording. Tested in
// tests/demos/overlay/overlays_test.cpp.

#include <vector>

#include "demos/overlay/overlay_frame.h"
#include "engine/contact/contact_manifold.h"

namespace carom::demos {

/// The gap of a gauge of the collision window at its upper end, in ceilings (epsilon2).
inline constexpr double kGaugeOverCeiling = 1.5;

ContactManifold manifoldOf(const NearPair& pair);
/// Near enough for the collision window to speak of a contact.
bool touches(const NearPair& pair);
/// How long a contact's normal is drawn, metres.
double normalLength(const OverlayFrame& frame, const NearPair& pair);

/// An impulse on the body that can move, B if both can.
struct ShownImpulse {
  int body = -1;
  Vec3 p_W = Vec3::Zero();
  Vec3 impulse_W = Vec3::Zero();
  double length_m = 0.0;  ///< Of its arrow.
  bool is_collision = false;
};
/// Those whose arrows are long enough to be seen: of the last step's lasting contacts, then of the collisions
/// since the frame before, the strongest first. None for a recording, which holds no impulses.
std::vector<ShownImpulse> shownImpulses(const OverlayFrame& frame);

}  // namespace carom::demos
