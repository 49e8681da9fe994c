#pragma once
// Oracle: the signed gap of two parts as oracle::signedGap has it, in time for tens of thousands of pairs
// with 200-gons. The cross product of two edges is an axis of the separating-axis search only where both
// edges support their parts along it, faces on both sides falling away; that is seen from the four directions
// into the faces, in double with slack, and only what passes is measured in long double. Tested in
// tests/bench/queries/true_gap_test.cpp.

#include <map>

#include "tests/oracle/brute_force_distance.h"

namespace carom::bench {

using oracle::PlacedConvex;
using oracle::Real;
using oracle::Vec3R;

/// An edge and the directions from it into its faces (zero on a segment), in the world.
struct EdgeFan {
  Vec3 direction;
  Vec3 into_left;
  Vec3 into_right;
};

struct JudgedPart {
  PlacedConvex placed;
  std::vector<EdgeFan> fans;  ///< One for each edge.
};

/// Places parts by moving a copy of each that is prepared once.
class PartPlacer {
 public:
  JudgedPart at(const ConvexPart& part, const Pose& X_WP) {
    const PlacedConvex& rest = atRest(part);
    const Eigen::Matrix<Real, 3, 3> R = X_WP.rotation.cast<Real>().normalized().toRotationMatrix();
    const Mat3 R_double = R.cast<double>();
    const Vec3R t = X_WP.position.cast<Real>();
    JudgedPart judged{rest, {}};
    for (Vec3R& v : judged.placed.vertices) v = (R * v + t).eval();
    for (Vec3R& p : judged.placed.face_points) p = (R * p + t).eval();
    for (Vec3R& n : judged.placed.face_normals) n = (R * n).eval();
    judged.placed.edge_directions.clear();
    for (int e = 0; e < part.core.edgeCount(); ++e) {
      const Edge& edge = part.core.edge(e);
      judged.fans.push_back(
          {R_double * edge.direction, R_double * edge.into_left, R_double * edge.into_right});
    }
    return judged;
  }

 private:
  const PlacedConvex& atRest(const ConvexPart& part) {
    const auto found = rest_.find(&part);
    return found != rest_.end() ? found->second
                                : rest_.emplace(&part, oracle::place(part, Pose{})).first->second;
  }
  std::map<const ConvexPart*, PlacedConvex> rest_;
};

/// The largest gap of the cores along the axes that can have it; minus the exact depth when they intersect.
inline Real largestGap(const JudgedPart& a, const JudgedPart& b) {
  Real best = -std::numeric_limits<Real>::infinity();
  for (const Vec3R& n : a.placed.face_normals) best = std::max(best, gapAlong(a.placed, b.placed, n));
  for (const Vec3R& n : b.placed.face_normals) best = std::max(best, gapAlong(a.placed, b.placed, -n));
  constexpr double kParallelSine = 1e-12;  // such edges share their axes with the faces beside them
  const auto fallsAway = [](const EdgeFan& fan, const Vec3& n, double slack) {
    return n.dot(fan.into_left) <= slack && n.dot(fan.into_right) <= slack;
  };
  const auto consider = [&](std::size_t i, std::size_t j, double sign) {
    const auto& [p0, p1] = a.placed.edges[i];
    const auto& [q0, q1] = b.placed.edges[j];
    const Vec3R d = a.placed.vertices[p1] - a.placed.vertices[p0];
    const Vec3R e = b.placed.vertices[q1] - b.placed.vertices[q0];
    const Vec3R n = Real(sign) * d.cross(e).normalized();
    // No gap along n is larger than that between any two points of the parts.
    if (n.dot(b.placed.vertices[q0] - a.placed.vertices[p0]) > best)
      best = std::max(best, gapAlong(a.placed, b.placed, n));
  };
  for (std::size_t i = 0; i < a.fans.size(); ++i)
    for (std::size_t j = 0; j < b.fans.size(); ++j) {
      const Vec3 cross = a.fans[i].direction.cross(b.fans[j].direction);
      const double sine = cross.norm();
      if (sine <= kParallelSine) continue;
      const Vec3 n = cross / sine;
      const double slack = 1e-9 + 1e-15 / sine;  // the rounding of n, and of nearly flat edges
      if (fallsAway(a.fans[i], n, slack) && fallsAway(b.fans[j], -n, slack)) consider(i, j, 1.0);
      if (fallsAway(a.fans[i], -n, slack) && fallsAway(b.fans[j], n, slack)) consider(i, j, -1.0);
    }
  return best;
}

/// As oracle::signedGap.
inline Real trueGap(const JudgedPart& a, const JudgedPart& b) {
  const bool both_flat = a.placed.flat() && b.placed.flat();
  Real gap = both_flat ? Real(0) : largestGap(a, b);
  if (gap > 0 || both_flat) gap = oracle::surfaceDistance(a.placed, b.placed);
  return gap - a.placed.radius_m - b.placed.radius_m;
}

}  // namespace carom::bench
