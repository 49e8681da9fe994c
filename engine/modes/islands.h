#pragma once
// Islands: bodies that press on each other, directly or through others. An island comes to rest, and wakes,
// as one. Tested in tests/engine/modes/islands_test.cpp.

#include <vector>

namespace carom {

/// Disjoint sets of 0 .. n-1; a set is named by its smallest member.
class Islands {
 public:
  explicit Islands(int n);
  void join(int i, int j);
  int of(int i) const;

 private:
  std::vector<int> parent_;
};

}  // namespace carom
