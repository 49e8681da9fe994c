#pragma once
// Multi-point contact (paper §2.4, fig. 8): where a face or an edge of one part lies on a face of the other,
// it is clipped against the V-region of that face and the parallel plane at distance k; the corners of what
// is left are the points of contact. Each point carries an id made of features, so that it is recognised in
// the next step. Tested in tests/engine/contact/contact_manifold_test.cpp.

#include <array>
#include <cstdint>
#include <span>

#include "engine/contact/collision_window.h"
#include "engine/contact/contact_state.h"

namespace carom {

struct ManifoldPoint {
  Vec3 p_W = Vec3::Zero();   ///< Halfway across the gap.
  Vec3 n_W = Vec3::UnitZ();  ///< Unit, from A to B.
  double gap_m = 0.0;
  std::uint64_t id = 0;
};

/// Up to four points with the normal of the reference face: the deepest, and those that span the largest area
/// with it. The closest point with its own normal is always there; where it is none of the four, it is a
/// fifth.
struct ContactManifold {
  static constexpr int kMaxPoints = 5;
  static constexpr int kFacePoints = 4;
  int count = 0;
  std::array<ManifoldPoint, kMaxPoints> points;
  std::span<const ManifoldPoint> view() const { return {points.data(), static_cast<std::size_t>(count)}; }
};

/// All points of contact of two parts whose closest features are known; at least one.
ContactManifold contactManifold(const ClosestFeatures& closest, const ConvexPart& a, const Pose& X_WA,
                                const ConvexPart& b, const Pose& X_WB, const CollisionWindow& window);

}  // namespace carom
