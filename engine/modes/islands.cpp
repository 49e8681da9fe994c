#include "engine/modes/islands.h"

#include <algorithm>

namespace carom {

void Islands::part(int n) {
  for (const int i : joined_) parent_[static_cast<std::size_t>(i)] = i;
  joined_.clear();
  for (int i = static_cast<int>(parent_.size()); i < n; ++i) parent_.push_back(i);
}

int Islands::of(int i) const {
  while (parent_[static_cast<std::size_t>(i)] != i) i = parent_[static_cast<std::size_t>(i)];
  return i;
}

void Islands::join(int i, int j) {
  const int a = of(i);
  const int b = of(j);
  const int name = std::min(a, b);
  for (const int k : {i, j, a, b}) {
    int& parent = parent_[static_cast<std::size_t>(k)];
    if (parent == k && k != name) joined_.push_back(k);
    parent = name;  // short ways from now on
  }
}

}  // namespace carom
