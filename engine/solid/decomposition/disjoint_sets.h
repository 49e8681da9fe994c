#pragma once
// Numbers that are joined into sets, each known by its least member (union-find with path halving). Tested in
// tests/engine/solid/decomposition/disjoint_sets_test.cpp.

#include <algorithm>
#include <vector>

#include "engine/foundation/index.h"

namespace carom {

class DisjointSets {
 public:
  /// A set of one more number, which it gives.
  int add() {
    parents_.push_back(count());
    return parents_.back();
  }
  /// The least of the set that `i` is in.
  int rootOf(int i) {
    while (parents_[at(i)] != i) {
      int& parent = parents_[at(i)];
      parent = parents_[at(parent)];
      i = parent;
    }
    return i;
  }
  void join(int a, int b) {
    const int root_a = rootOf(a), root_b = rootOf(b);
    parents_[at(std::max(root_a, root_b))] = std::min(root_a, root_b);
  }
  int count() const { return static_cast<int>(parents_.size()); }

 private:
  std::vector<int> parents_;
};

}  // namespace carom
