#pragma once
// What candidate pairs are found by: axis-aligned bounds that overlap. Those of many things, from step to
// step, are found by pair_finder.h. Tested in tests/engine/broad_phase/candidate_pairs_test.cpp.

#include <span>
#include <vector>

#include "engine/foundation/contract.h"
#include "engine/foundation/frames.h"

namespace carom {

struct Bounds {
  Vec3 low = Vec3::Zero();
  Vec3 high = Vec3::Zero();

  bool overlaps(const Bounds& other) const {
    return low.x() <= other.high.x() && other.low.x() <= high.x() && low.y() <= other.high.y() &&
           other.low.y() <= high.y() && low.z() <= other.high.z() && other.low.z() <= high.z();
  }
  bool contains(const Bounds& other) const {
    return (low.array() <= other.low.array()).all() && (other.high.array() <= high.array()).all();
  }
};

/// The same with a margin on every side.
inline Bounds widened(Bounds bounds, double margin) {
  bounds.low.array() -= margin;
  bounds.high.array() += margin;
  return bounds;
}

/// The bounds of both.
inline Bounds together(const Bounds& a, const Bounds& b) {
  return {a.low.cwiseMin(b.low), a.high.cwiseMax(b.high)};
}

/// One thing to pair: two that don't move never pair.
struct Proxy {
  Bounds bounds;
  bool moves = true;
};

inline bool canPair(const Proxy& p, const Proxy& q) {
  return (p.moves || q.moves) && p.bounds.overlaps(q.bounds);
}

struct IndexPair {
  int a = -1;
  int b = -1;  ///< a < b.
  friend auto operator<=>(const IndexPair&, const IndexPair&) = default;
};

/// What is kept of so many pairs takes half a gigabyte. Heaps have some ten a body; only bodies that lie
/// within each other, or fly through half of the others in one step, come near it.
inline constexpr std::size_t kMostPairs = 1000000;

/// More than `kMostPairs` things could meet within one step: no step of such a world is made.
class TooManyPairs : public InputError {
 public:
  TooManyPairs();
};

/// The pairs, ascending, of one of `a` and one of `b` whose bounds overlap, each by its place. No more
/// than `most`. Cost O(a + b + those of each that reach into the bounds of the others).
void overlapsBetween(std::span<const Bounds> a, std::span<const Bounds> b, std::size_t most,
                     std::vector<IndexPair>& found);

}  // namespace carom
