#include "demos/overlay/panel_overlays.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "demos/format/formatted.h"
#include "demos/overlay/mode_colors.h"
#include "engine/environment/gravity.h"
#include "engine/motion/rigid_body.h"

namespace carom::demos {
namespace {

using renderer::Canvas;
using renderer::PixelRect;

// In ems.
constexpr double kRow = 1.45;
constexpr double kMargin = 0.6;  // Around the rows, and between panels.
constexpr double kSwatch = 1.8;  // From a square's left side to its text.

void fillBox(Canvas& canvas, const Vec2& low, const Vec2& high, const renderer::Ink& ink) {
  const std::array<Vec2, 4> corners = {low, Vec2(high.x(), low.y()), high, Vec2(low.x(), high.y())};
  canvas.fill(corners, ink);
}

renderer::TextStyle textStyle(const Pen& pen) {
  return {pen.text_px, {overlay_color::kBlack}};
}

std::array<int, kModes> modeCounts(const OverlayFrame& frame) {
  std::array<int, kModes> counts{};
  for (const BodyState& state : frame.bodies) ++counts[static_cast<std::size_t>(state.mode)];
  return counts;
}

std::string energyText(double energy_J) {
  const double size = std::abs(energy_J);
  if (size < 1e4) return formatted("%.4g J", energy_J);
  return size < 1e7 ? formatted("%.2f kJ", 1e-3 * energy_J) : formatted("%.4g MJ", 1e-6 * energy_J);
}

}  // namespace

ShownEnergy shownEnergy(const World& world, std::span<const BodyState> states) {
  ShownEnergy energy;
  for (std::size_t i = 0; i < states.size(); ++i) {
    const BodyDescription& body = world.bodies()[i];
    if (body.is_static || body.is_kinematic) continue;
    const Solid& solid = world.solids()[static_cast<std::size_t>(body.solid)];
    const Inertia inertia = inertiaOf(body.material.density_kgpm3, solid.volume(), solid.unitInertia());
    energy.kinetic_J += kineticEnergy(inertia, states[i].X_WB.rotation,
                                      {states[i].linear_velocity, states[i].angular_velocity});
    energy.potential_J += gravityPotential(inertia, world.settings().gravity, states[i].X_WB.position);
  }
  return energy;
}

Panel statisticsPanel(const OverlayFrame& frame) {
  Panel rows;
  rows.push_back({formatted("t = %.3f s   frame %d", frame.time_s, frame.frame), {}});
  const std::array<int, kModes> counts = modeCounts(frame);
  std::string modes;
  for (std::size_t i = 0; i < kModes; ++i)
    if (counts[i] > 0)
      modes.append(modes.empty() ? "" : ", ")
          .append(std::to_string(counts[i]))
          .append(" ")
          .append(modeName(static_cast<Mode>(i)));
  rows.push_back({modes, {}});
  rows.push_back(
      {"smallest gap " + (frame.pairs.empty() ? "–" : lengthText(frame.pairs.front().closest.distance_m)),
       {}});
  const ShownEnergy energy = shownEnergy(frame.scene.world, frame.bodies);
  rows.push_back({"energy " + energyText(energy.kinetic_J + energy.potential_J) + " = " +
                      energyText(energy.kinetic_J) + " kinetic + " + energyText(energy.potential_J) +
                      " potential",
                  {}});
  return rows;
}

Panel timingsPanel(const OverlayFrame& frame) {
  Panel rows;
  for (std::size_t i = 0; i < kFramePhases; ++i)
    if (frame.cost.phase_ms[i] > 0.0)
      rows.push_back({formatted("%.2f ms  ", frame.cost.phase_ms[i]) + kFramePhaseNames[i], {}});
  rows.push_back({formatted("%.2f ms  in all", frame.cost.total_ms), {}});
  return rows;
}

Panel legendPanel(const OverlayFrame& frame) {
  const std::array<int, kModes> counts = modeCounts(frame);
  Panel rows;
  for (std::size_t i = 0; i < kModes; ++i) {
    const Mode mode = static_cast<Mode>(i);
    if (mode == Mode::kKinematic && counts[i] == 0) continue;  // few scenes have such bodies
    rows.push_back({std::string(modeName(mode)) + "  " + std::to_string(counts[i]), modeColor(mode)});
  }
  return rows;
}

std::vector<PixelRect> placedPanels(const Canvas& canvas, std::span<const Panel> panels, const Pen& pen) {
  const double em = pen.text_px;
  Vec2 corner = Vec2::Constant(kMargin * em);
  std::vector<PixelRect> rects;
  for (const Panel& panel : panels) {
    double widest = 0.0;
    for (const PanelRow& row : panel)
      widest =
          std::max(widest, canvas.textWidth(row.text, textStyle(pen)) + (row.swatch ? kSwatch * em : 0.0));
    const Vec2 size(widest + 2.0 * kMargin * em,
                    em * (kRow * static_cast<double>(panel.size()) + 2.0 * kMargin));
    rects.push_back({corner, corner + size});
    corner.y() += size.y() + kMargin * em;
  }
  return rects;
}

void paintPanel(Canvas& canvas, const Panel& panel, const PixelRect& rect, const Pen& pen) {
  const double em = pen.text_px;
  fillBox(canvas, rect.low, rect.high, {overlay_color::kWhite, 0.82});
  Vec2 at = rect.low + Vec2(kMargin * em, (kMargin + 0.5 * kRow) * em);
  for (const PanelRow& row : panel) {
    if (row.swatch) fillBox(canvas, at + Vec2(0.0, -0.5 * em), at + Vec2(em, 0.5 * em), {*row.swatch});
    canvas.text(at + Vec2(row.swatch ? kSwatch * em : 0.0, 0.0), row.text, textStyle(pen));
    at.y() += kRow * em;
  }
}

}  // namespace carom::demos
