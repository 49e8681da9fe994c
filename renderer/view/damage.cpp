#include "renderer/view/damage.h"

#include <cstddef>
#include <limits>

#include "engine/foundation/contract.h"

namespace carom::renderer {
namespace {

// Joins a block with all those it meets, so that the blocks stay disjoint. Each round leaves one less.
void insertDisjoint(std::vector<GridBlock>& blocks, GridBlock block) {
  for (std::size_t i = 0; i < blocks.size();) {
    if (!blocks[i].meets(block)) {
      ++i;
      continue;
    }
    block = joined(block, blocks[i]);
    blocks.erase(blocks.begin() + static_cast<std::ptrdiff_t>(i));
    i = 0;
  }
  blocks.push_back(block);
}

// Joins the two whose rectangle adds the fewest tiles.
void joinNearest(std::vector<GridBlock>& blocks) {
  std::size_t first = 0, second = 1;
  std::int64_t least = std::numeric_limits<std::int64_t>::max();
  for (std::size_t i = 0; i < blocks.size(); ++i)
    for (std::size_t k = i + 1; k < blocks.size(); ++k) {
      const std::int64_t added = joined(blocks[i], blocks[k]).area() - blocks[i].area() - blocks[k].area();
      if (added < least) least = added, first = i, second = k;
    }
  const GridBlock block = joined(blocks[first], blocks[second]);
  insertDisjoint(blocks, block);
}

}  // namespace

Damage::Damage(int width, int height)
    : image_{0, width, 0, height},
      columns_((width + kTile - 1) / kTile),
      marked_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>((height + kTile - 1) / kTile)) {
  REQUIRE(width > 0 && height > 0, width, height);
}

void Damage::add(const GridBlock& pixels) {
  const GridBlock block = common(pixels, image_);
  if (whole_ || block.isEmpty()) return;
  for (int y = block.y_begin / kTile; y <= (block.y_end - 1) / kTile; ++y)
    for (int x = block.x_begin / kTile; x <= (block.x_end - 1) / kTile; ++x) {
      std::uint8_t& tile = marked_[static_cast<std::size_t>(y * columns_ + x)];
      marked_tiles_ += tile == 0 ? 1 : 0;
      tile = 1;
    }
  whole_ = static_cast<double>(marked_tiles_) > kMostShare * static_cast<double>(marked_.size());
}

std::vector<GridBlock> Damage::blocks() const {
  if (whole_) return {image_};
  std::vector<GridBlock> blocks = coverMarked(marked_, columns_);
  while (blocks.size() > static_cast<std::size_t>(kMostBlocks)) joinNearest(blocks);
  for (GridBlock& block : blocks)
    block = common({kTile * block.x_begin, kTile * block.x_end, kTile * block.y_begin, kTile * block.y_end},
                   image_);
  return blocks;
}

}  // namespace carom::renderer
