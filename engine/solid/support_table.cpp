#include "engine/solid/support_table.h"

#include <algorithm>
#include <cmath>

namespace carom {
namespace {

// With fewer vertices a climb from anywhere is as short as a look at a table.
constexpr int kFewVertices = 12;

}  // namespace

SupportTable::SupportTable(int vertex_count, const std::function<int(const Vec3&, int)>& support) {
  if (vertex_count <= kFewVertices) return;
  cells_per_side_ = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(vertex_count) / 3.0)));
  const auto side = static_cast<std::size_t>(cells_per_side_);
  vertices_.reserve(6 * side * side);
  int near = 0;
  for (int axis = 0; axis < 3; ++axis)
    for (const bool negative : {false, true})
      for (int i = 0; i < cells_per_side_; ++i) {
        for (int j = 0; j < cells_per_side_; ++j) {
          near = support(middleOf(axis, negative, i, j), near);
          vertices_.push_back(near);
        }
        near = vertices_[vertices_.size() - side];
      }
}

Vec3 SupportTable::middleOf(int axis, bool negative, int i, int j) const {
  const auto middle = [this](int k) { return (2.0 * k + 1.0) / cells_per_side_ - 1.0; };
  Vec3 d;
  d[axis] = negative ? -1.0 : 1.0;
  d[(axis + 1) % 3] = middle(i);
  d[(axis + 2) % 3] = middle(j);
  return d;
}

std::size_t SupportTable::cellOf(const Vec3& direction) const {
  int axis = 0;
  if (std::abs(direction.y()) > std::abs(direction.x())) axis = 1;
  if (std::abs(direction.z()) > std::abs(direction[axis])) axis = 2;
  const double major = std::abs(direction[axis]);
  // From -1 to 1, but for the zero vector's and NaN; the division, unlike one by `major` beforehand, cannot
  // overflow.
  const auto cell = [&](double component) {
    const double k = 0.5 * cells_per_side_ * (component / major + 1.0);
    return static_cast<std::size_t>(k > 0.0 ? static_cast<int>(std::min(k, cells_per_side_ - 1.0)) : 0);
  };
  const auto cells_per_side = static_cast<std::size_t>(cells_per_side_);
  const std::size_t side = 2 * static_cast<std::size_t>(axis) + (direction[axis] < 0.0 ? 1 : 0);
  const std::size_t row = cell(direction[(axis + 1) % 3]);
  const std::size_t column = cell(direction[(axis + 2) % 3]);
  return (side * cells_per_side + row) * cells_per_side + column;
}

}  // namespace carom
