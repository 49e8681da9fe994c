#include "renderer/view/shadow_cells.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace carom::renderer {
namespace {

// Texels around a caster within which a look-up may meet it: the tent of the filter reaches two, the lift
// above a grazed surface two more.
constexpr double kLookUpReach = 5.0;
constexpr double kOverlap = 0.02;  // Of a cell.

}  // namespace

ShadowCells::ShadowCells(const ShadowView& view, std::span<const ShadowCaster> casters) : view_(view) {
  if (view_.texel_m == 0.0) return;
  for (const ShadowCaster& caster : casters) {
    const GridBlock block = blockOf(caster);
    for (int y = block.y_begin; y < block.y_end; ++y)
      for (int x = block.x_begin; x < block.x_end; ++x) covered_[static_cast<std::size_t>(kSide * y + x)] = 1;
  }
}

// The cells that the caster's bounds on the map touch.
GridBlock ShadowCells::blockOf(const ShadowCaster& caster) const {
  int begin[2], end[2];
  for (int i = 0; i < 2; ++i) {
    const Vec3 axis = view_.rows.block<1, 3>(i, 0).transpose();
    const double middle = axis.dot(caster.X_EB.position) + view_.rows(i, 3);
    const double half = (caster.X_EB.rotation.conjugate() * axis).cwiseAbs().dot(caster.half) +
                        kLookUpReach * view_.texel_m * axis.norm();
    const auto cell = [](double t) { return static_cast<int>(std::floor(std::clamp(t, -1.0, 2.0) * kSide)); };
    begin[i] = std::clamp(cell(middle - half), 0, kSide);
    end[i] = std::clamp(cell(middle + half) + 1, 0, kSide);
  }
  return {begin[0], end[0], begin[1], end[1]};
}

std::vector<GroundTriangle> ShadowCells::groundTriangles(double ground_z_E, double reach_m) const {
  std::vector<GroundTriangle> triangles;
  if (view_.texel_m == 0.0) return triangles;
  const std::array<Vec2, 4> map = coveredGround(view_, ground_z_E);
  const auto corner = [&](double x, double y) {
    return Vec2(map[0] + (x / kSide) * (map[1] - map[0]) + (y / kSide) * (map[3] - map[0]));
  };
  for (const GridBlock& block : coverMarked(covered_, kSide)) {
    const double left = block.x_begin - kOverlap, right = block.x_end + kOverlap;
    const double low = block.y_begin - kOverlap, high = block.y_end + kOverlap;
    const std::array<Vec2, 4> at = {corner(left, low), corner(right, low), corner(right, high),
                                    corner(left, high)};
    if (!std::all_of(at.begin(), at.end(), [&](const Vec2& p) { return p.norm() < reach_m; })) continue;
    const auto point = [&](std::size_t i) -> std::array<float, 2> {
      return {static_cast<float>(at[i].x()), static_cast<float>(at[i].y())};
    };
    triangles.push_back({point(0), point(1), point(2)});
    triangles.push_back({point(0), point(2), point(3)});
  }
  return triangles;
}

}  // namespace carom::renderer
