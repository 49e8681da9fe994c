#pragma once
// Our own query as the benchmarks call it, with what a pair remembers from one query to the next.

#include "engine/closest_features/vclip.h"
#include "tests/bench/peers/library.h"

namespace carom::bench {

using Memory = PairMemory;

/// Back to a cold start, keeping the room that has been allocated.
inline void forget(Memory& memory) {
  memory.features = {};
  memory.penetration.forget();
}

inline ClosestFeatures ask(const ConvexPart& a, const Pose& X_WA, const ConvexPart& b, const Pose& X_WB,
                           Memory& memory) {
  return closestFeatures(a, X_WA, b, X_WB, memory);
}

inline PlainPose plain(const Pose& X) {
  return {{X.rotation.w(), X.rotation.x(), X.rotation.y(), X.rotation.z()},
          {X.position.x(), X.position.y(), X.position.z()}};
}

inline Pose posed(const PlainPose& X) {
  const auto& q = X.rotation_wxyz;
  return {Quat(q[0], q[1], q[2], q[3]), Vec3(X.position[0], X.position[1], X.position[2])};
}

/// The part in plain numbers; it must outlive the hull.
inline Hull plain(const ConvexPart& part) {
  Hull hull;
  hull.part = &part;
  for (const Vec3& v : part.core.vertices()) hull.vertices.push_back({v.x(), v.y(), v.z()});
  for (int f = 0; f < part.core.faceCount(); ++f) {
    const std::span<const int> loop = part.core.faceVertices(f);
    hull.faces.emplace_back(loop.begin(), loop.end());
  }
  return hull;
}

}  // namespace carom::bench
