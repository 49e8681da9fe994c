#pragma once
// A bounding volume hierarchy over proxies: who can pair with one of them, while bounds grow within a step.
// The tree is a heap: the children of node k are 2k and 2k + 1, its leaves are runs of a few proxies. Where
// it splits decides what a query costs, never what it finds. Tested in
// tests/engine/broad_phase/bounds_tree_test.cpp.

#include <span>
#include <vector>

#include "engine/broad_phase/candidate_pairs.h"

namespace carom {

class BoundsTree {
 public:
  /// Splits at medians, along the axis on which the bounds are spread most. Cost O(n log n).
  void build(std::span<const Proxy> proxies);
  void clear() { nodes_.clear(); }
  bool isBuilt() const { return !nodes_.empty(); }
  /// To be told when a proxy's bounds have grown. Cost O(log n).
  void grow(int proxy, const Bounds& bounds);
  /// All that can pair with a proxy, ascending. The proxies are those built from, as grown since. Cost about
  /// O(log n + found).
  void findPartners(std::span<const Proxy> proxies, int proxy, std::vector<int>& found) const;

 private:
  void split(std::span<const Proxy> proxies, std::size_t node);
  std::size_t firstOfLeaf(std::size_t leaf) const { return leaf * order_.size() / leaves_; }

  std::size_t leaves_ = 0;  ///< A power of two: nodes leaves_ to 2 leaves_ - 1.
  std::vector<Bounds> nodes_;
  std::vector<int> order_;            ///< The proxies, leaf by leaf.
  std::vector<std::size_t> leaf_of_;  ///< The node that holds a proxy.
};

}  // namespace carom
