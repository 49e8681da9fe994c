#pragma once
// What the overlays of one frame are drawn from: plain values and the engine's answers for the poses shown.
// Positions that belong to bodies follow the bodies as shown, also between two steps.

#include <span>
#include <vector>

#include "demos/motion/frame_cost.h"
#include "demos/overlay/near_pairs.h"
#include "demos/scene/scene_world.h"
#include "engine/simulation/bodies/step_view.h"
#include "renderer/drawing/canvas.h"

namespace carom::demos {

struct OverlayFrame {
  const SceneWorld& scene;
  const BodyFocus& focus;
  std::span<const BodyState> bodies;  ///< As shown.
  int frame = 0;
  double time_s = 0.0;
  std::vector<NearPair> pairs;            ///< Nearest first.
  const StepView* step = nullptr;         ///< The last step; null for a recording.
  std::vector<ContactView> collisions;    ///< Since the frame before.
  std::vector<std::vector<Vec3>> trails;  ///< Of each body, oldest first; the last is where it is.
  FrameCost cost;                         ///< Of the frame, as far as it goes.

  const Solid& solid(int body) const {
    const BodyDescription& description = scene.world.bodies()[static_cast<std::size_t>(body)];
    return scene.world.solids()[static_cast<std::size_t>(description.solid)];
  }
  /// How far the body reaches as it is drawn, metres: lines within it are lifted over its surface by that.
  double drawnRadius(int body) const { return scene.drawnRadius(static_cast<std::size_t>(body)); }
  const BodyState& state(int body) const { return bodies[static_cast<std::size_t>(body)]; }
  bool isStatic(int body) const { return scene.world.bodies()[static_cast<std::size_t>(body)].is_static; }
  /// The smaller of two bodies' radii, metres: a scale for what is drawn at their contact.
  double pairRadius(int a, int b) const { return std::min(solid(a).radius(), solid(b).radius()); }
};

/// Widths and sizes for an image's height: readable at 360 rows, not heavy at 1080.
struct Pen {
  explicit Pen(int height) : thin_px(1.0 + height / 900.0), text_px(9.0 + height / 120.0) {}
  double thin_px;
  double text_px;
  double thick_px() const { return 1.8 * thin_px; }
  double dot_px() const { return 2.0 * thin_px; }
};

namespace overlay_color {
inline constexpr renderer::Color kBlue = {0.00f, 0.30f, 0.62f};
inline constexpr renderer::Color kSky = {0.10f, 0.50f, 0.80f};
inline constexpr renderer::Color kGreen = {0.00f, 0.50f, 0.34f};
inline constexpr renderer::Color kOrange = {0.85f, 0.50f, 0.00f};
inline constexpr renderer::Color kRed = {0.80f, 0.20f, 0.00f};
inline constexpr renderer::Color kPurple = {0.62f, 0.20f, 0.52f};
inline constexpr renderer::Color kBlack = {0.08f, 0.08f, 0.10f};
inline constexpr renderer::Color kWhite = {1.0f, 1.0f, 1.0f};
}  // namespace overlay_color

/// "1.25 mm", "0.341 m": a length with three digits in the unit that suits it.
std::string lengthText(double length_m);

}  // namespace carom::demos
