#pragma once
// The rings of a plane polygon as one ring that runs along the sides of all: each hole is joined to what is
// around it by the shortest free bridge. Tested in
// tests/engine/solid/decomposition/polygon_triangles_test.cpp.

#include <optional>
#include <vector>

#include "engine/solid/decomposition/polygon_triangles.h"

namespace carom {

/// Bridges have two sides each; as what lies beyond a node's side they are numbered from here on.
constexpr int kBridges = 1 << 30;

/// A corner on the way around, with the side that begins there.
struct RingNode {
  int corner = -1;
  int beyond = 0;  ///< On the other side of that: a ring's or triangle's side (SideNumber), or a bridge's.
};

struct JoinedRing {
  std::vector<RingNode> nodes;
  int bridges = 0;
};

/// Nothing where a hole has no free way to the ring.
std::optional<JoinedRing> joinedRing(const Rings& rings, const std::vector<Vec2>& corners,
                                     double tolerance_m);

}  // namespace carom
