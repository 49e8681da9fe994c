#include "engine/broad_phase/bounds_tree.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <numeric>

namespace carom {
namespace {

constexpr std::size_t kMostInLeaf = 8;

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

Bounds nothing() {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  return {Vec3::Constant(kInfinity), Vec3::Constant(-kInfinity)};
}

void include(Bounds& bounds, const Bounds& other) {
  bounds.low = bounds.low.cwiseMin(other.low);
  bounds.high = bounds.high.cwiseMax(other.high);
}

// The axis along which the bounds begin farthest apart.
Eigen::Index splitAxis(std::span<const Proxy> proxies, std::span<const int> members) {
  Bounds begins = nothing();
  for (int i : members) include(begins, {proxies[at(i)].bounds.low, proxies[at(i)].bounds.low});
  Eigen::Index axis = 0;
  (begins.high - begins.low).maxCoeff(&axis);
  return axis;
}

}  // namespace

void BoundsTree::build(std::span<const Proxy> proxies) {
  leaves_ = std::bit_ceil((proxies.size() + kMostInLeaf - 1) / kMostInLeaf);
  order_.resize(proxies.size());
  std::iota(order_.begin(), order_.end(), 0);
  for (std::size_t node = 1; node < leaves_; ++node) split(proxies, node);

  nodes_.assign(2 * leaves_, nothing());
  leaf_of_.resize(proxies.size());
  for (std::size_t leaf = 0; leaf < leaves_; ++leaf)
    for (std::size_t k = firstOfLeaf(leaf); k < firstOfLeaf(leaf + 1); ++k) {
      leaf_of_[at(order_[k])] = leaves_ + leaf;
      include(nodes_[leaves_ + leaf], proxies[at(order_[k])].bounds);
    }
  for (std::size_t node = 2 * leaves_ - 1; node > 1; --node) include(nodes_[node / 2], nodes_[node]);
}

// The lower half of what the node holds goes to its first child.
void BoundsTree::split(std::span<const Proxy> proxies, std::size_t node) {
  const std::size_t level = std::bit_floor(node);
  const std::size_t leaves = leaves_ / level;
  const std::size_t leaf = (node - level) * leaves;
  const std::size_t begin = firstOfLeaf(leaf);
  const std::size_t middle = firstOfLeaf(leaf + leaves / 2);
  const std::size_t end = firstOfLeaf(leaf + leaves);
  const std::span<int> members = std::span(order_).subspan(begin, end - begin);
  const Eigen::Index axis = splitAxis(proxies, members);
  std::nth_element(members.begin(), members.begin() + static_cast<std::ptrdiff_t>(middle - begin),
                   members.end(), [&](int i, int j) {
                     const double low_i = proxies[at(i)].bounds.low[axis];
                     const double low_j = proxies[at(j)].bounds.low[axis];
                     return low_i < low_j || (low_i == low_j && i < j);
                   });
}

void BoundsTree::grow(int proxy, const Bounds& bounds) {
  for (std::size_t node = leaf_of_[at(proxy)]; node > 0 && !nodes_[node].contains(bounds); node /= 2)
    include(nodes_[node], bounds);
}

void BoundsTree::findPartners(std::span<const Proxy> proxies, int proxy, std::vector<int>& found) const {
  found.clear();
  const Proxy& mine = proxies[at(proxy)];
  std::size_t node = 1;
  do {
    const bool meets = nodes_[node].overlaps(mine.bounds);
    if (meets && node < leaves_) {
      node *= 2;
      continue;
    }
    if (meets)
      for (std::size_t k = firstOfLeaf(node - leaves_); k < firstOfLeaf(node - leaves_ + 1); ++k)
        if (canPair(mine, proxies[at(order_[k])])) found.push_back(order_[k]);
    // On to the next that is not below this one: past the last of a level that is the root.
    ++node;
    node >>= std::countr_zero(node);
  } while (node != 1);
  std::sort(found.begin(), found.end());
}

}  // namespace carom
