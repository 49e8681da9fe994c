#pragma once
// The pairs of parts that are near each other at the poses shown, asked anew from V-Clip: a frame may fall
// between two steps, and a recording holds poses only. Tested in tests/demos/overlay/near_pairs_test.cpp.

#include <span>
#include <string>
#include <vector>

#include "demos/scene/scene_world.h"
#include "engine/closest_features/vclip.h"
#include "engine/contact/collision_window.h"

namespace carom::demos {

/// The bodies that overlays speak of: all of them, or some that were named.
class BodyFocus {
 public:
  BodyFocus() = default;
  /// Names, comma separated; empty: all bodies. A repeated body's name means all its copies. Throws
  /// UsageError for an unknown name.
  BodyFocus(const std::string& names, const std::vector<std::string>& bodies);

  bool all() const { return chosen_.empty(); }
  bool has(int body) const { return all() || chosen_[static_cast<std::size_t>(body)]; }
  /// Of one named body all its pairs, of more those among them.
  bool hasPair(int a, int b) const;

 private:
  std::vector<bool> chosen_;
  int count_ = 0;
};

struct NearPair {
  int body_a = -1;
  int body_b = -1;
  const ConvexPart* part_a = nullptr;
  const ConvexPart* part_b = nullptr;
  Pose X_WA;
  Pose X_WB;
  ClosestFeatures closest;
  CollisionWindow window;
};

/// Pairs of different bodies of which at least one can move, nearest first: all closer than a share of the
/// bodies' size and, when there are none, the nearest farther off. The world's parts must outlive them.
std::vector<NearPair> nearPairs(const World& world, std::span<const BodyState> states,
                                const BodyFocus& focus = {});

}  // namespace carom::demos
