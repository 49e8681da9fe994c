#include "engine/modes/islands.h"

#include <algorithm>
#include <numeric>

namespace carom {

Islands::Islands(int n) : parent_(static_cast<std::size_t>(n)) {
  std::iota(parent_.begin(), parent_.end(), 0);
}

int Islands::of(int i) const {
  while (parent_[static_cast<std::size_t>(i)] != i) i = parent_[static_cast<std::size_t>(i)];
  return i;
}

void Islands::join(int i, int j) {
  const int a = of(i);
  const int b = of(j);
  const int name = std::min(a, b);
  for (const int k : {i, j, a, b}) parent_[static_cast<std::size_t>(k)] = name;  // short ways from now on
}

}  // namespace carom
