#pragma once
// Where the shadow map shows a caster: a coarse grid over it. Shadows are looked up on the ground only where
// one may fall; all the rest of it is lit, as the look-up would find. Tested in
// tests/renderer/view/shadow_cells_test.cpp.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "renderer/image/grid_cover.h"
#include "renderer/view/shadow_fit.h"

namespace carom::renderer {

/// Three points of the ground, x and y in E.
using GroundTriangle = std::array<std::array<float, 2>, 3>;

class ShadowCells {
 public:
  static constexpr int kSide = 48;  ///< Cells along either side of the map.

  /// The map of `view`, with all that casts shadows on it.
  ShadowCells(const ShadowView& view, std::span<const ShadowCaster> casters);

  /// Triangles that cover those parts of the level plane z = `ground_z_E` where
  /// shadows may fall, within `reach_m` of the eye. Neighbours overlap a little, so that no gap shows.
  std::vector<GroundTriangle> groundTriangles(double ground_z_E, double reach_m) const;

 private:
  GridBlock blockOf(const ShadowCaster& caster) const;

  ShadowView view_;
  std::array<std::uint8_t, kSide * kSide> covered_{};  // By cell: whether a caster touches it.
};

}  // namespace carom::renderer
