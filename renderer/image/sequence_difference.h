#pragma once
// What two sequences of values have in common and what not, value by value in all their bits. Tested in
// tests/renderer/image/sequence_difference_test.cpp.

#include <cstddef>
#include <span>
#include <type_traits>
#include <vector>

namespace carom::renderer {

enum class Order {
  kMatters,  ///< Common is a longest sequence that is part of both in the same order (Hunt, Szymanski 1977).
  kIsFree,   ///< Common is what both hold, in whatever order.
};

/// The places of those that are not common, ascending.
struct SequenceDifference {
  std::vector<std::size_t> gone;  ///< In the first.
  std::vector<std::size_t> come;  ///< In the second.
  bool isEmpty() const { return gone.empty() && come.empty(); }
};

/// Of two arrays of values of `size` bytes each. Where a value occurs several times, what is common may be
/// less than the most, never more. O(n log n).
SequenceDifference differenceOfBytes(std::span<const std::byte> before, std::span<const std::byte> now,
                                     std::size_t size, Order order);

/// Of values without padding.
template <typename T>
SequenceDifference sequenceDifference(const std::vector<T>& before, const std::vector<T>& now, Order order) {
  static_assert(std::is_trivially_copyable_v<T>);
  return differenceOfBytes(std::as_bytes(std::span(before)), std::as_bytes(std::span(now)), sizeof(T), order);
}

}  // namespace carom::renderer
