#pragma once
// Candidate pairs of proxies that come again with every step, few of which are active: what has left the fat
// bounds that it was given is paired anew, with fat bounds; of the pairs that overlap with theirs, those that
// overlap without are the candidates. What is not active costs nothing. Tested in
// tests/engine/broad_phase/pair_finder_test.cpp.

#include <span>
#include <vector>

#include "engine/broad_phase/bounds_tree.h"

namespace carom {

class PairFinder {
 public:
  /// The pairs, ascending, of which one is `active` (ascending); the other proxies are what they were when
  /// they were active last. All must be active in the first call, and when their number has changed. Throws
  /// TooManyPairs. Cost about O(active log n + pairs).
  const std::vector<IndexPair>& find(std::span<const Proxy> proxies, std::span<const int> active);
  /// Within a step a proxy's bounds have grown by these. Cost O(log n).
  void grow(int proxy, const Bounds& bounds);
  /// All that a proxy can pair with, ascending, active or not. Cost about O(log n + found).
  void findPartners(std::span<const Proxy> proxies, int proxy, std::vector<int>& found) const;
  /// How many proxies were paired anew by the last call of `find`.
  std::size_t pairedAnew() const { return left_.size(); }

 private:
  bool hasLeft(const Proxy& proxy, int i) const;
  bool isActive(int i) const { return active_in_[static_cast<std::size_t>(i)] == round_; }
  bool isLeft(int i) const { return left_in_[static_cast<std::size_t>(i)] == round_; }
  void fatten(std::span<const Proxy> proxies);
  void pairAnew();

  BoundsTree tree_;              ///< Of the fat proxies, and of what they have grown to since.
  std::vector<Proxy> fat_;       ///< As they were paired last.
  std::vector<IndexPair> near_;  ///< Of the fat proxies, one of them active, ascending.
  std::vector<IndexPair> pairs_;
  std::vector<int> left_;
  // In which call each was active last, and had left its fat bounds last: nothing has to be cleared.
  int round_ = 0;
  std::vector<int> active_in_;
  std::vector<int> left_in_;
  std::vector<int> found_;  ///< Scratch.
};

}  // namespace carom
