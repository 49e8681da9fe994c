#pragma once
// Where the shadow map shows a caster: a coarse grid over it. Shadows are looked up on the ground only where
// one may fall, and on a body only when another may stand between it and the sun; everything else is lit,
// as the look-up would find. Tested in tests/renderer/shadow_cells_test.cpp.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "renderer/shadow_fit.h"

namespace carom::renderer {

class ShadowCells {
 public:
  static constexpr int kSide = 48;  ///< Cells along either side of the map.

  /// The map of `view`, with all that casts shadows on it.
  ShadowCells(const ShadowView& view, std::span<const ShadowCaster> casters);

  /// Whether no other caster can darken this one (an index into the casters given).
  bool alone(std::size_t caster) const;

  /// Triangles (three points, x and y in E) that cover those parts of the level plane z = `ground_z_E` where
  /// shadows may fall, within `reach_m` of the eye. Neighbours overlap a little, so that no gap shows.
  std::vector<std::array<float, 2>> groundTriangles(double ground_z_E, double reach_m) const;

 private:
  struct Block {
    int x_begin = 0, x_end = 0, y_begin = 0, y_end = 0;
  };
  Block blockOf(const ShadowCaster& caster) const;
  std::vector<Block> coveredBlocks() const;
  std::uint8_t& casters(int x, int y) { return casters_[static_cast<std::size_t>(kSide * y + x)]; }
  std::uint8_t casters(int x, int y) const { return casters_[static_cast<std::size_t>(kSide * y + x)]; }

  ShadowView view_;
  std::vector<Block> blocks_;                          // By caster.
  std::array<std::uint8_t, kSide * kSide> casters_{};  // Of each cell; two stand for more.
};

}  // namespace carom::renderer
