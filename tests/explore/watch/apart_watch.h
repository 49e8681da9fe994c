#pragma once
// Oracle: whether any two bodies of a world overlap, frame after frame, by brute force. A pair is apart when
// its bounding balls are, or when some axis shows a gap: that of an earlier frame, the line of centres, or
// one that the separating axes find in long double (tests/oracle). Only where none does is the exact gap
// asked for. Tested in tests/explore/watch/apart_watch_test.cpp.

#include <map>
#include <optional>
#include <tuple>

#include "engine/simulation/world.h"
#include "tests/oracle/brute_force_distance.h"

namespace carom::explore {

struct Meeting {
  int body_a = -1;
  int body_b = -1;
  double depth_m = 0.0;  ///< >= 0.
};

class ApartWatch {
 public:
  explicit ApartWatch(const World& world) : world_(world) {}

  /// The deepest overlap of two bodies of which one can move, at these states; none: all are apart.
  std::optional<Meeting> deepest(std::span<const BodyState> states) {
    std::optional<Meeting> found;
    const auto bodies = world_.bodies();
    for (std::size_t a = 0; a < bodies.size(); ++a)
      for (std::size_t b = a + 1; b < bodies.size(); ++b) {
        if (bodies[a].is_static && bodies[b].is_static) continue;
        const double depth =
            depthOf(static_cast<int>(a), states[a].X_WB, static_cast<int>(b), states[b].X_WB);
        if (depth >= 0.0 && !(found && found->depth_m >= depth))
          found = Meeting{static_cast<int>(a), static_cast<int>(b), depth};
      }
    return found;
  }

 private:
  using PartPair = std::tuple<int, std::size_t, int, std::size_t>;

  const Solid& solidOf(int body) const {
    const int solid = world_.bodies()[static_cast<std::size_t>(body)].solid;
    return world_.solids()[static_cast<std::size_t>(solid)];
  }

  // Rounding of a difference of projections, doubled several times over.
  static double noise(const Pose& X_a, const Pose& X_b, double reach) {
    return 0x1p-49 * (X_a.position.norm() + X_b.position.norm() + reach);
  }

  static double mostAlong(const ConvexPart& part, const Mat3& R, const Vec3& offset, const Vec3& axis) {
    const Vec3 axis_B = R.transpose() * axis;
    double most = -std::numeric_limits<double>::infinity();
    for (const Vec3& v : part.core.vertices()) most = std::max(most, axis_B.dot(v));
    return most + axis.dot(offset) + part.radius_m;
  }

  /// Negative when they are apart.
  double depthOf(int a, const Pose& X_a, int b, const Pose& X_b) {
    const Solid& solid_a = solidOf(a);
    const Solid& solid_b = solidOf(b);
    const Vec3 between = X_b.position - X_a.position;
    const double reach = solid_a.radius() + solid_b.radius();
    if (between.norm() > reach * (1.0 + 0x1p-40)) return -1.0;
    const double uncertainty = noise(X_a, X_b, reach);
    const Mat3 R_a = X_a.rotation.normalized().toRotationMatrix();
    const Mat3 R_b = X_b.rotation.normalized().toRotationMatrix();
    double deepest = -1.0;
    for (std::size_t i = 0; i < solid_a.parts().size(); ++i)
      for (std::size_t j = 0; j < solid_b.parts().size(); ++j) {
        const ConvexPart& pa = solid_a.parts()[i];
        const ConvexPart& pb = solid_b.parts()[j];
        const auto apartAlong = [&](const Vec3& axis) {
          return -mostAlong(pb, R_b, between, -axis) - mostAlong(pa, R_a, Vec3::Zero(), axis) > uncertainty;
        };
        Vec3& kept_A = axes_[{a, i, b, j}];
        if (!kept_A.isZero(0.0) && apartAlong(R_a * kept_A)) continue;
        const double length = between.norm();
        if (length > 0.0 && apartAlong(between / length)) {
          kept_A = R_a.transpose() * (between / length);
          continue;
        }
        const oracle::PlacedConvex placed_a = oracle::place(pa, X_a), placed_b = oracle::place(pb, X_b);
        oracle::AxisGap best;
        if (!placed_a.flat() || !placed_b.flat()) best = oracle::largestAxisGap(placed_a, placed_b);
        kept_A = R_a.transpose() * best.axis.cast<double>();
        const oracle::Real radii = placed_a.radius_m + placed_b.radius_m;
        if (best.gap_m > radii) continue;
        const auto gap = static_cast<double>(oracle::signedGap(placed_a, placed_b, best));
        if (gap <= 0.0) deepest = std::max(deepest, -gap);
      }
    return deepest;
  }

  const World& world_;
  std::map<PartPair, Vec3> axes_;  ///< That last showed a gap, in the frame of the first body.
};

}  // namespace carom::explore
