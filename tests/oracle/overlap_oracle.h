#pragma once
// Oracle: the smallest gap over every pair of bodies, by brute force and separating axes; for checking a
// world frame by frame. Pairs whose bounding boxes, or shadows on the line between their centres, are farther
// apart than the smallest gap so far are passed over: nearly all of thousands. Asked frame after frame, so
// are those that an axis of an earlier frame, turned with the body, still shows to be farther apart: a gap
// along any axis is at most theirs. Tested in tests/oracle/oracle_test.cpp.

#include <algorithm>
#include <limits>
#include <map>
#include <span>
#include <tuple>
#include <vector>

#include "engine/simulation/world.h"
#include "tests/oracle/brute_force_distance.h"

namespace carom::oracle {

struct PlacedSolid {
  const Solid* solid = nullptr;
  Pose X_WB;
  bool is_static = false;
};

struct SmallestGap {
  double gap_m =
      std::numeric_limits<double>::infinity();  ///< Negative: minus the depth of the deepest overlap.
  int body_a = -1;
  int body_b = -1;
};

/// A body at its pose with its bounding box in the world's axes.
struct BoundedBody {
  std::vector<PlacedConvex> parts;
  Vec3R low, high, center;
  Mat3R rotation;
  int index = -1;
  bool is_static = false;

  BoundedBody(const PlacedSolid& body, int number)
      : low(Vec3R::Constant(std::numeric_limits<Real>::infinity())),
        high(-low),
        center(body.X_WB.position.cast<Real>()),
        rotation(body.X_WB.rotation.cast<Real>().normalized().toRotationMatrix()),
        index(number),
        is_static(body.is_static) {
    for (const ConvexPart& part : body.solid->parts()) {
      parts.push_back(place(part, body.X_WB));
      for (const Vec3R& v : parts.back().vertices) {
        low = low.cwiseMin(v - Vec3R::Constant(parts.back().radius_m));
        high = high.cwiseMax(v + Vec3R::Constant(parts.back().radius_m));
      }
    }
  }
  /// At most the distance of the bodies; 0 when the boxes meet.
  Real boxDistance(const BoundedBody& other) const {
    return (low - other.high).cwiseMax(other.low - high).cwiseMax(Vec3R::Zero()).norm();
  }
};

/// By pair of parts, the axis along which their gap was largest when it was last looked for, in the frame of
/// the first body.
using RememberedAxes = std::map<std::tuple<int, std::size_t, int, std::size_t>, Vec3R>;

inline void lowerToPair(const BoundedBody& a, const BoundedBody& b, SmallestGap& smallest,
                        RememberedAxes* remembered) {
  if (b.index < a.index) return lowerToPair(b, a, smallest, remembered);
  const Vec3R between = b.center - a.center;
  const bool has_line = between.squaredNorm() > 0;
  for (std::size_t i = 0; i < a.parts.size(); ++i)
    for (std::size_t j = 0; j < b.parts.size(); ++j) {
      const PlacedConvex& pa = a.parts[i];
      const PlacedConvex& pb = b.parts[j];
      const auto fartherAlong = [&](const Vec3R& axis) {
        return gapAlong(pa, pb, axis.normalized()) - pa.radius_m - pb.radius_m > Real{smallest.gap_m};
      };
      if (has_line && fartherAlong(between)) continue;
      Vec3R* axis = nullptr;
      if (remembered != nullptr) {
        const auto [place, is_new] = remembered->try_emplace({a.index, i, b.index, j});
        axis = &place->second;
        if (!is_new && axis->squaredNorm() > 0 && fartherAlong(a.rotation * *axis)) continue;
      }
      const AxisGap axes = pa.flat() && pb.flat() ? AxisGap{} : largestAxisGap(pa, pb);
      if (axis != nullptr) *axis = a.rotation.transpose() * axes.axis;
      if (const auto gap = static_cast<double>(signedGap(pa, pb, axes)); gap < smallest.gap_m)
        smallest = {gap, a.index, b.index};
    }
}

/// Over all pairs of bodies of which at least one can move. `remembered`: of the same bodies in an earlier
/// frame.
inline SmallestGap smallestGap(std::span<const PlacedSolid> bodies, RememberedAxes* remembered = nullptr) {
  std::vector<BoundedBody> sorted;
  sorted.reserve(bodies.size());
  for (std::size_t i = 0; i < bodies.size(); ++i) sorted.emplace_back(bodies[i], static_cast<int>(i));
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const BoundedBody& a, const BoundedBody& b) { return a.low.x() < b.low.x(); });
  SmallestGap smallest;
  // Boxes that meet first: where there are any, few of the others can be nearer.
  for (const bool meeting : {true, false})
    for (std::size_t i = 0; i < sorted.size(); ++i)
      for (std::size_t j = i + 1; j < sorted.size(); ++j) {
        const Real reach = meeting ? Real{0} : Real{std::max(0.0, smallest.gap_m)};
        if (sorted[j].low.x() - sorted[i].high.x() > reach) break;
        if (sorted[i].is_static && sorted[j].is_static) continue;
        const Real apart = sorted[i].boxDistance(sorted[j]);
        if ((apart == Real{0}) == meeting && apart <= reach)
          lowerToPair(sorted[i], sorted[j], smallest, remembered);
      }
  return smallest;
}

/// The same for the bodies of a world as they stand.
inline SmallestGap smallestGap(const World& world, RememberedAxes* remembered = nullptr) {
  std::vector<PlacedSolid> bodies;
  for (std::size_t i = 0; i < world.bodies().size(); ++i) {
    const BodyDescription& body = world.bodies()[i];
    bodies.push_back(
        {&world.solids()[static_cast<std::size_t>(body.solid)], world.states()[i].X_WB, body.is_static});
  }
  return smallestGap(bodies, remembered);
}

}  // namespace carom::oracle
