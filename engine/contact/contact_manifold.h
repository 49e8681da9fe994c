#pragma once
// Multi-point contact (paper §2.4, fig. 8): the corners of the contact polygon, reduced to the few that the
// solver needs, and the closest point where they don't hold it. Each point carries an id made of features, so
// that it is recognised in the next step. Tested in tests/engine/contact/contact_manifold_test.cpp.

#include <array>
#include <cstdint>
#include <span>

#include "engine/contact/collision_window.h"
#include "engine/contact/contact_polygon.h"
#include "engine/contact/contact_state.h"

namespace carom {

struct ManifoldPoint {
  Vec3 p_W = Vec3::Zero();   ///< Halfway across the gap.
  Vec3 n_W = Vec3::UnitZ();  ///< Unit, from A to B.
  double gap_m = 0.0;
  std::uint64_t id = 0;  ///< `contactId` of `features`; no two points of a manifold have the same.
  FeaturePair features;
};

/// Up to four corners of the contact polygon with its normal: a deepest, and those that span the largest area
/// with it (`reducePolygon`). The closest point with its own normal is always there; where it is none of the
/// four, it is a fifth. Swapping the bodies gives the same points with features swapped and normals turned
/// round.
struct ContactManifold {
  static constexpr int kMaxPoints = 5;
  static constexpr int kFacePoints = 4;
  int count = 0;
  std::array<ManifoldPoint, kMaxPoints> points;
  std::span<const ManifoldPoint> view() const& { return {points.data(), static_cast<std::size_t>(count)}; }
  std::span<const ManifoldPoint> view() const&& = delete;  // it would outlive what it shows
  // Of a manifold that is a temporary too: a loop over it keeps it.
  const ManifoldPoint* begin() const { return points.data(); }
  const ManifoldPoint* end() const { return points.data() + count; }
};

/// The points that a pair had before its bodies moved on, by their ids.
using FormerPoints = std::span<const std::uint64_t>;

/// All points of contact of two parts whose closest features are known; at least one. Of a polygon with more
/// than four corners, the `former` four stay while they hold it nearly as well as any (`reducePolygon`).
ContactManifold contactManifold(const ClosestFeatures& closest, const PosedParts& parts,
                                const CollisionWindow& window, FormerPoints former = {},
                                Ground ground = Ground::kNone);

}  // namespace carom
