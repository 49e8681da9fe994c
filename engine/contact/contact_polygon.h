#pragma once
// The contact polygon (paper §2.4, fig. 8): what of one part's face or edge lies over the V-region of the
// other's face and under the parallel plane at distance k. All corners, without a limit, each with the two
// features that make it. Also the stretch that two almost parallel edges share.
// Invariant: the corners and their names do not depend on which part is called A, on where in the world the
// two are, or on motion well below the tolerance `sameCorner_m`. Tested in
// tests/engine/contact/contact_polygon_test.cpp.

#include "engine/contact/collision_window.h"
#include "engine/contact/contact_state.h"
#include "engine/foundation/stack_arena.h"

namespace carom {

/// `features`: vertex and face, edge and edge, vertex and edge or vertex and vertex where they meet within
/// the tolerance; at the height k: the edge that rises through it and the other part's face, or both edges
/// where it runs along one.
struct PolygonCorner {
  Vec3 p_W = Vec3::Zero();  ///< Halfway across the gap.
  double gap_m = 0.0;       ///< Along the polygon's normal.
  FeaturePair features;
};

struct ContactPolygon {
  Vec3 n_W = Vec3::UnitZ();  ///< Unit, from A to B.
  /// Counter-clockwise seen from the tip of `n_W`. Two corners are a stretch, one is a point; none: nothing
  /// of the two parts lies flat, and the closest points are all the contact there is.
  ArenaVector<PolygonCorner> corners;
};

/// Normals whose cosine is this near to 1 are one direction; faces whose cosines to a direction are this near
/// to each other are as parallel to it.
inline constexpr double kSameCosine = 1e-9;

/// Corners closer than this are one corner, metres: far below every gap of the window, above the rounding of
/// the poses.
double sameCorner_m(const Pose& X_WA, const Pose& X_WB, const CollisionWindow& window);

/// Which of the parts is the ground: the one that cannot give way, if the other can.
enum class Ground { kNone, kA, kB };

/// The complete polygon of two parts whose closest features are known, written to `polygon`. The normal is
/// the reference face's: of the faces at the closest features the one more parallel to the contact by more
/// than rounding; else the ground's, along which the other part glides; else the larger; else, for equals,
/// the mean of both. Proportional to corners times sides.
void contactPolygon(const ClosestFeatures& closest, const PosedParts& parts, const CollisionWindow& window,
                    Ground ground, ContactPolygon& polygon);
ContactPolygon contactPolygon(const ClosestFeatures& closest, const ConvexPart& a, const Pose& X_WA,
                              const ConvexPart& b, const Pose& X_WB, const CollisionWindow& window);

}  // namespace carom
