#pragma once
// Candidate pairs of things that come again with every step, few of which are active. They are paired by fat
// bounds, kept in a tree: what stays within those it was given has the same neighbours, and what has left
// them is paired anew. What is not active costs nothing. Tested in
// tests/engine/broad_phase/pair_finder_test.cpp.

#include <span>
#include <vector>

#include "engine/broad_phase/bounds_tree.h"

namespace carom {

class PairFinder {
 public:
  /// The pairs, ascending, of which one is `active` (ascending); the others are what they were when they were
  /// active last, and whether a thing moves does not change. All must be active in the first call, and when
  /// their number has changed. Throws TooManyPairs. Cost about O(active log things + pairs).
  const std::vector<IndexPair>& find(std::span<const Proxy> proxies, std::span<const int> active);
  /// Within a step the bounds of the thing have grown to hold these. Cost O(log things).
  void grow(int thing, const Bounds& bounds);
  /// All that one thing can pair with, ascending, active or not. Cost about O(log things + found).
  void findPartners(std::span<const Proxy> proxies, int thing, std::vector<int>& found) const;
  /// How many things were paired anew by the last call of `find`.
  std::size_t pairedAnew() const { return left_.size(); }

 private:
  /// In which call a thing was active last, and had left its fat bounds last: nothing has to be cleared.
  struct LastCalls {
    int active = -1;
    int left = -1;
  };

  bool isActive(int thing) const { return last_[static_cast<std::size_t>(thing)].active == call_; }
  bool isLeft(int thing) const { return last_[static_cast<std::size_t>(thing)].left == call_; }
  void tellLeft(std::span<const Proxy> proxies, std::span<const int> active);
  void fatten(std::span<const Proxy> proxies);
  void pairAnew(std::span<const Proxy> proxies);

  BoundsTree tree_;              ///< Of the fat bounds, and of what they have grown to since.
  std::vector<IndexPair> near_;  ///< By these, one of them active, ascending.
  std::vector<IndexPair> pairs_;
  std::vector<int> left_;
  int call_ = 0;
  std::vector<LastCalls> last_;
  std::vector<int> found_;  ///< Scratch.
};

}  // namespace carom
