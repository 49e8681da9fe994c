#pragma once
// Counting is done in int, indexing in std::size_t.

#include <cstddef>

namespace carom {

/// A count that is not negative as an index.
constexpr std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

}  // namespace carom
