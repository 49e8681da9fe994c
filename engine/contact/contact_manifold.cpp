#include "engine/contact/contact_manifold.h"

#include <algorithm>

#include "engine/contact/contact_id.h"
#include "engine/contact/manifold_reduction.h"
#include "engine/foundation/stack_arena.h"

namespace carom {
namespace {

constexpr double kSameGap = 1e-3;  // of the window's floor: gaps this close are one gap
// Bytes for a polygon of some hundred corners.
constexpr std::size_t kPolygonBytes = std::size_t{16} << 10;

void append(ContactManifold& manifold, const ManifoldPoint& point) {
  manifold.points[static_cast<std::size_t>(manifold.count++)] = point;
}

// Those of a polygon that has more than it can keep.
KeptCorners formerCorners(const ContactPolygon& polygon, FormerPoints former) {
  KeptCorners kept;
  if (polygon.corners.size() <= std::size_t{KeptCorners::kMost}) return kept;
  for (std::size_t i = 0; i < polygon.corners.size() && kept.count < KeptCorners::kMost; ++i)
    if (std::find(former.begin(), former.end(), contactId(polygon.corners[i].features)) != former.end())
      kept.index[static_cast<std::size_t>(kept.count++)] = static_cast<int>(i);
  return kept;
}

}  // namespace

ContactManifold contactManifold(const ClosestFeatures& closest, const PosedParts& parts,
                                const CollisionWindow& window, FormerPoints former, Ground ground) {
  StackArena<kPolygonBytes> arena;
  ContactPolygon polygon{Vec3::UnitZ(), ArenaVector<PolygonCorner>(&arena)};
  contactPolygon(closest, parts, window, ground, polygon);
  const KeptCorners kept =
      reducePolygon(polygon, sameCorner_m(parts.X_WA, parts.X_WB, window),
                    {formerCorners(polygon, former), tolerance::kRestBand * window.rest});
  ContactManifold manifold;
  double least = window.manifold;
  for (int i = 0; i < kept.count; ++i) {
    const PolygonCorner& c =
        polygon.corners[static_cast<std::size_t>(kept.index[static_cast<std::size_t>(i)])];
    append(manifold, {c.p_W, polygon.n_W, c.gap_m, contactId(c.features), c.features});
    least = std::min(least, c.gap_m);
  }
  // A polygon turned away from the contact's normal, or that lost the closest point beyond its rim, does not
  // hold that point's motion; the point itself does.
  const ContactPoint single = contactPoint(closest, parts.a, parts.X_WA, parts.b, parts.X_WB);
  const bool holds_closest = manifold.count > 0 && dot(polygon.n_W, single.n_W) > 1.0 - kSameCosine &&
                             least <= closest.distance_m + kSameGap * window.floor;
  if (!holds_closest)
    append(manifold, {single.p_W, single.n_W, single.gap_m, contactId(closest.features, PointRole::kClosest),
                      closest.features});
  return manifold;
}

}  // namespace carom
