#pragma once
// Where the shadow map shows a caster: a coarse grid over it. Shadows are looked up on the ground only where
// one may fall; all the rest of it is lit, as the look-up would find. Tested in
// tests/renderer/shadow_cells_test.cpp.

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "renderer/shadow_fit.h"

namespace carom::renderer {

class ShadowCells {
 public:
  static constexpr int kSide = 48;  ///< Cells along either side of the map.

  /// The map of `view`, with all that casts shadows on it.
  ShadowCells(const ShadowView& view, std::span<const ShadowCaster> casters);

  /// Triangles (three points, x and y in E) that cover those parts of the level plane z = `ground_z_E` where
  /// shadows may fall, within `reach_m` of the eye. Neighbours overlap a little, so that no gap shows.
  std::vector<std::array<float, 2>> groundTriangles(double ground_z_E, double reach_m) const;

 private:
  struct Block {
    int x_begin = 0, x_end = 0, y_begin = 0, y_end = 0;
  };
  Block blockOf(const ShadowCaster& caster) const;
  std::vector<Block> coveredBlocks() const;
  bool& covered(int x, int y) { return covered_[static_cast<std::size_t>(kSide * y + x)]; }
  bool covered(int x, int y) const { return covered_[static_cast<std::size_t>(kSide * y + x)]; }

  ShadowView view_;
  std::array<bool, kSide * kSide> covered_{};  // By cell.
};

}  // namespace carom::renderer
