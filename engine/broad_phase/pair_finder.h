#pragma once
// Candidate pairs of proxies that come again with every step, few of which are active. Proxies of one group,
// such as the pieces of a body, go together: groups are paired first, by bounds that hold all of theirs, and
// then what of two groups reaches into the other's. A group that has left the fat bounds it was given is
// paired anew, with fat bounds. What is not active costs nothing. Tested in
// tests/engine/broad_phase/pair_finder_test.cpp.

#include <span>
#include <vector>

#include "engine/broad_phase/bounds_tree.h"

namespace carom {

class PairFinder {
 public:
  /// The pairs, ascending, of which one is of an `active` group (ascending); the proxies of other groups are
  /// what they were when these were active last. Groups are numbered from 0, and those of one stand together
  /// in their order. All must be active in the first call, and when the number of proxies or who is of which
  /// group has changed. Throws TooManyPairs. Cost about O(active log groups + their proxies + pairs).
  const std::vector<IndexPair>& find(std::span<const Proxy> proxies, std::span<const int> active);
  /// Within a step the bounds of one of the group have grown to hold these. Cost O(log groups).
  void grow(int group, const Bounds& bounds);
  /// All pairs of `some` proxies of one group, each with what it can pair with, ascending, active or not.
  /// Cost about O(log groups + found, and for each of them the proxies of the groups that it is near).
  void findPartners(std::span<const Proxy> proxies, std::span<const int> some, std::vector<IndexPair>& found);
  /// How many groups were paired anew by the last call of `find`.
  std::size_t pairedAnew() const { return left_.size(); }

 private:
  bool isActive(int group) const { return active_in_[static_cast<std::size_t>(group)] == round_; }
  bool isLeft(int group) const { return left_in_[static_cast<std::size_t>(group)] == round_; }
  int begin(int group) const { return first_[static_cast<std::size_t>(group)]; }
  int end(int group) const { return first_[static_cast<std::size_t>(group) + 1]; }
  bool isSingle(int group) const { return end(group) == begin(group) + 1; }
  void startAgain(std::span<const Proxy> proxies);
  Proxy wholeOf(std::span<const Proxy> proxies, int group) const;
  bool hasLeft(int group) const;
  void fatten();
  void pairAnew();
  void addPairsOf(std::span<const IndexPair> near, std::span<const Proxy> proxies);
  void add(int a, int b);

  BoundsTree tree_;              ///< Of the fat groups, and of what they have grown to since.
  std::vector<int> first_;       ///< Proxy of each group, and the end.
  std::vector<Proxy> whole_;     ///< Groups, as they were when they were active last.
  std::vector<Proxy> fat_;       ///< As they were paired last.
  std::vector<IndexPair> near_;  ///< Of the fat groups, one of them active, ascending.
  std::vector<IndexPair> pairs_;
  std::vector<int> left_;
  // In which call each group was active last, and had left its fat bounds last: nothing has to be cleared.
  int round_ = 0;
  std::vector<int> active_in_;
  std::vector<int> left_in_;
  std::vector<int> found_;         ///< Scratch.
  std::vector<int> reaching_;      ///< Scratch: of the groups beside one, what reaches into its bounds ...
  std::vector<std::size_t> ends_;  ///< ... and the ends of each.
};

}  // namespace carom
