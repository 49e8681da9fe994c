#pragma once
// The name of a point of contact: the two features that make it (a vertex on a face, an edge across an edge,
// an edge at the height k over a face). The pair depends on neither poses nor which face served as the
// reference, so a point keeps its name while the bodies move. Tested in
// tests/engine/contact/contact_id_test.cpp.

#include <algorithm>
#include <cstdint>
#include <utility>

#include "engine/closest_features/pair/feature.h"

namespace carom {

/// A point is a corner of the contact polygon, or the closest point standing in for a lost one beside it.
enum class PointRole : std::uint8_t { kCorner = 0, kClosest = 1 };

inline FeaturePair swappedPair(const FeaturePair& pair) {
  return {pair.b, pair.a};
}

/// Different for different (pair, role), for feature indices from -1 to 2^29 - 2: role, kinds and indices
/// side by side in one word. Swapping the bodies swaps the two halves of the pair and nothing else.
inline std::uint64_t contactId(const FeaturePair& pair, PointRole role = PointRole::kCorner) {
  constexpr std::uint64_t kIndexMask = (1ull << 29) - 1;
  const auto part = [](const Feature& f) {
    return (static_cast<std::uint64_t>(f.kind) << 29) |
           (static_cast<std::uint64_t>(f.index + 1) & kIndexMask);
  };
  return (static_cast<std::uint64_t>(role) << 62) | (part(pair.a) << 31) | part(pair.b);
}

/// An order of pairs that does not change when the bodies are swapped; only (x, y) and (y, x) are equal in
/// it.
inline std::pair<std::uint64_t, std::uint64_t> symmetricKey(const FeaturePair& pair) {
  const auto part = [](const Feature& f) {
    return (static_cast<std::uint64_t>(f.kind) << 32) | static_cast<std::uint32_t>(f.index + 1);
  };
  return std::minmax({part(pair.a), part(pair.b)});
}

}  // namespace carom
