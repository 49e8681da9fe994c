#include "engine/simulation/contact_rows.h"

#include <algorithm>
#include <cmath>

namespace carom {

void appendRows(const RowRequest& request, const ShapePair& pair, const std::vector<Body>& bodies,
                const std::vector<Shape>& shapes, std::span<const ImpulseBody> solver_bodies,
                std::vector<SourcedRow>& rows) {
  const auto index = [](int i) { return static_cast<std::size_t>(i); };
  const ContactManifold manifold =
      contactManifold(*request.closest, *shapes[index(pair.shapes.a)].part, request.X_WA,
                      *shapes[index(pair.shapes.b)].part, request.X_WB, pair.window);
  for (const ManifoldPoint& point : manifold.view()) {
    SourcedRow sourced{ContactRow{}, request.pair, point.id, point.gap_m};
    ContactRow& row = sourced.row;
    row.a = request.row_a;
    row.b = request.row_b;
    row.n = point.n_W;
    row.r_a = point.p_W - request.X_WA.position;
    row.r_b = point.p_W - request.X_WB.position;
    row.friction = combinedFriction(bodies[index(pair.body_a)].material, bodies[index(pair.body_b)].material);
    prepareRow(row, solver_bodies);
    rows.push_back(sourced);
  }
}

Friction combinedFriction(const Material& a, const Material& b) {
  return {std::sqrt(a.static_friction * b.static_friction),
          std::sqrt(a.dynamic_friction * b.dynamic_friction)};
}

double combinedRestitution(const Material& a, const Material& b) {
  return std::max(a.restitution, b.restitution);
}

GapSpeeds gapSpeeds(double gap_m, const CollisionWindow& window, double dt_s, bool presses) {
  const double band = tolerance::kRestBand * window.rest;
  if (gap_m > window.rest + band) {
    const double share = presses ? tolerance::kGapGain : 1.0;
    const double closing = share * (window.rest + band - gap_m) / dt_s;
    return {closing, closing};
  }
  const double missing = window.rest - band - gap_m;
  if (missing <= 0.0) return {};
  return {0.0, std::min(tolerance::kGapGain * missing / dt_s, tolerance::kGapSpeed)};
}

}  // namespace carom
