#include "demos/overlay/shown_contacts.h"

#include <algorithm>

namespace carom::demos {
namespace {

constexpr double kNormalLength = 0.55;  // Of the smaller body's radius.
constexpr double kWeightLength = 0.7;   // Of a body's radius: an impulse that holds its weight for a step.
constexpr double kCollisionTime_s =
    0.12;                                // An arrow is as long as the body goes in it with the speed gained.
constexpr double kShortestArrow = 0.08;  // Of the radius; what is shorter is left out.
constexpr double kLongestArrow = 2.5;    // Of the radius.

ShownImpulse shownImpulse(const OverlayFrame& frame, const ContactView& contact) {
  const bool on_b = !frame.isStatic(contact.body_b);
  ShownImpulse shown;
  shown.body = on_b ? contact.body_b : contact.body_a;
  shown.p_W =
      0.5 * (frame.state(contact.body_a).X_WB * contact.p_A + frame.state(contact.body_b).X_WB * contact.p_B);
  shown.impulse_W = on_b ? contact.impulse_W : Vec3(-contact.impulse_W);
  return shown;
}

// `length_m` is for the whole impulse.
void addIfSeen(const OverlayFrame& frame, ShownImpulse impulse, double length_m,
               std::vector<ShownImpulse>& shown) {
  const double radius = frame.solid(impulse.body).radius();
  if (!(length_m > kShortestArrow * radius)) return;
  impulse.length_m = std::min(length_m, kLongestArrow * radius);
  shown.push_back(impulse);
}

}  // namespace

ContactManifold manifoldOf(const NearPair& pair) {
  return contactManifold(pair.closest, {*pair.part_a, pair.X_WA, *pair.part_b, pair.X_WB}, pair.window);
}

bool touches(const NearPair& pair) {
  return pair.closest.distance_m <= kGaugeOverCeiling * pair.window.ceiling;
}

double normalLength(const OverlayFrame& frame, const NearPair& pair) {
  return kNormalLength * frame.pairRadius(pair.body_a, pair.body_b);
}

std::vector<ShownImpulse> shownImpulses(const OverlayFrame& frame) {
  std::vector<ShownImpulse> shown;
  if (frame.step == nullptr) return shown;
  const World& world = frame.scene.world;
  const double speed = std::max(world.settings().gravity.norm(), 1e-3) *
                       world.settings().step_s;  // what a step of weight gives
  for (const ContactView& contact : frame.step->lasting) {
    if (!frame.focus.hasPair(contact.body_a, contact.body_b)) continue;
    const ShownImpulse impulse = shownImpulse(frame, contact);
    const double weights = impulse.impulse_W.norm() / (world.mass(impulse.body) * speed);
    addIfSeen(frame, impulse, kWeightLength * frame.solid(impulse.body).radius() * weights, shown);
  }
  std::vector<ShownImpulse> collisions;
  for (const ContactView& contact : frame.collisions)
    if (frame.focus.hasPair(contact.body_a, contact.body_b))
      collisions.push_back(shownImpulse(frame, contact));
  std::stable_sort(collisions.begin(), collisions.end(), [](const ShownImpulse& x, const ShownImpulse& y) {
    return x.impulse_W.norm() > y.impulse_W.norm();
  });
  for (ShownImpulse& impulse : collisions) {
    impulse.is_collision = true;
    addIfSeen(frame, impulse, kCollisionTime_s * impulse.impulse_W.norm() / world.mass(impulse.body), shown);
  }
  return shown;
}

}  // namespace carom::demos
