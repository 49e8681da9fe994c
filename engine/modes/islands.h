#pragma once
// Islands: bodies that press on each other, directly or through others. An island comes to rest, and wakes,
// as one. Tested in tests/engine/modes/islands_test.cpp.

#include <vector>

namespace carom {

/// Disjoint sets of 0 .. n-1; a set is named by its smallest member.
class Islands {
 public:
  explicit Islands(int n = 0) { part(n); }
  void join(int i, int j);
  int of(int i) const;
  /// Everybody is alone again, of 0 .. n-1. Cost: by how many had been joined, whatever n is.
  void part(int n);

 private:
  std::vector<int> parent_;
  std::vector<int> joined_;  ///< Whose parent is another.
};

}  // namespace carom
