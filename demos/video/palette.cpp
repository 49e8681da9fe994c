#include "demos/video/palette.h"

#include <algorithm>
#include <cmath>

#include "engine/foundation/contract.h"

namespace carom::demos {
namespace {

/// The colours that fall into one cell.
struct Cell {
  std::uint32_t number = 0;
  std::array<std::uint64_t, 3> sum{};
  std::uint64_t count = 0;
  double mean(std::size_t channel) const {
    return static_cast<double>(sum[channel]) / static_cast<double>(count);
  }
};

/// Cells from `begin` to before `end` that become one entry.
struct Box {
  std::size_t begin = 0;
  std::size_t end = 0;
  std::size_t widest = 0;  ///< Channel.
  double score = 0.0;      ///< How much a cut helps; 0: it cannot be cut.
};

Box measured(std::span<const Cell> cells, std::size_t begin, std::size_t end) {
  Box box{begin, end, 0, 0.0};
  std::uint64_t count = 0;
  std::array<double, 3> low{}, high{};
  for (std::size_t i = begin; i < end; ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      const double mean = cells[i].mean(c);
      low[c] = i == begin ? mean : std::min(low[c], mean);
      high[c] = i == begin ? mean : std::max(high[c], mean);
    }
    count += cells[i].count;
  }
  for (std::size_t c = 1; c < 3; ++c)
    if (high[c] - low[c] > high[box.widest] - low[box.widest]) box.widest = c;
  // Rare colours count too: a small body must keep its own.
  if (end - begin > 1)
    box.score = (high[box.widest] - low[box.widest]) * std::pow(static_cast<double>(count), 0.35);
  return box;
}

/// Splits a box of at least two cells where half of its pixels lie on either side.
std::size_t cutOf(std::span<Cell> cells, const Box& box) {
  const auto first = cells.begin() + static_cast<std::ptrdiff_t>(box.begin);
  const auto last = cells.begin() + static_cast<std::ptrdiff_t>(box.end);
  std::sort(first, last, [&](const Cell& x, const Cell& y) {
    const double a = x.mean(box.widest), b = y.mean(box.widest);
    return a != b ? a < b : x.number < y.number;
  });
  std::uint64_t total = 0, below = 0;
  for (auto cell = first; cell != last; ++cell) total += cell->count;
  std::size_t cut = box.begin + 1;
  for (std::size_t i = box.begin; i + 1 < box.end; ++i) {
    below += cells[i].count;
    cut = i + 1;
    if (2 * below >= total) break;
  }
  return cut;
}

}  // namespace

Palette::Palette(std::span<const renderer::Image> pictures, int most) : entries_(kCells, 0) {
  REQUIRE(most >= 2 && most <= 256, most);
  std::vector<Cell> all(kCells);
  for (const renderer::Image& picture : pictures)
    for (std::size_t i = 0; i + 2 < picture.rgb.size(); i += 3) {
      Cell& cell = all[cellOf(&picture.rgb[i])];
      ++cell.count;
      for (std::size_t c = 0; c < 3; ++c) cell.sum[c] += picture.rgb[i + c];
    }
  std::vector<Cell> cells;
  for (std::size_t i = 0; i < kCells; ++i) {
    all[i].number = static_cast<std::uint32_t>(i);
    if (all[i].count > 0) cells.push_back(all[i]);
  }
  REQUIRE(!cells.empty());
  std::vector<Box> boxes{measured(cells, 0, cells.size())};
  while (boxes.size() < static_cast<std::size_t>(most)) {
    const auto best = std::max_element(boxes.begin(), boxes.end(),
                                       [](const Box& x, const Box& y) { return x.score < y.score; });
    if (best->score <= 0.0) break;
    const Box whole = *best;
    const std::size_t cut = cutOf(cells, whole);
    *best = measured(cells, whole.begin, cut);
    boxes.push_back(measured(cells, cut, whole.end));
  }
  for (const Box& box : boxes) {
    std::array<std::uint64_t, 3> sum{};
    std::uint64_t count = 0;
    for (std::size_t i = box.begin; i < box.end; ++i) {
      for (std::size_t c = 0; c < 3; ++c) sum[c] += cells[i].sum[c];
      count += cells[i].count;
      entries_[cells[i].number] = static_cast<std::uint8_t>(colors_.size());
    }
    ByteColor color{};
    for (std::size_t c = 0; c < 3; ++c) color[c] = static_cast<std::uint8_t>((sum[c] + count / 2) / count);
    colors_.push_back(color);
  }
}

}  // namespace carom::demos
