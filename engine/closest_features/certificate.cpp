#include "engine/closest_features/certificate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace carom {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Of the bound on an answer's error: how exactly a surface is made that is to prove it.
constexpr double kNoiseShare = 0x1p-7;

// How far a point stands out of a core; at most 0 inside a polyhedron.
double outside(const ConvexPolyhedron& core, const Vec3& p) {
  if (core.vertexCount() == 1) return (p - core.vertex(0)).norm();
  if (core.faceCount() == 0) {
    const Edge& edge = core.edge(0);
    const double s = std::clamp(dot(edge.direction, p - core.vertex(0)), 0.0, edge.length_m);
    return (p - core.vertex(0) - s * edge.direction).norm();
  }
  double most = -kInfinity;
  for (int f = 0; f < core.faceCount(); ++f) most = std::max(most, core.plane(f).signedDistance(p));
  return most;
}

double highest(const ConvexPolyhedron& core, const Vec3& n) {
  double most = -kInfinity;
  for (const Vec3& v : core.vertices()) most = std::max(most, dot(n, v));
  return most;
}

double distanceToSegment(const Vec3& a, const Vec3& b) {
  const Vec3 d = b - a;
  const double s = d.squaredNorm() > 0.0 ? std::clamp(-dot(d, a) / d.squaredNorm(), 0.0, 1.0) : 0.0;
  return (a + s * d).norm();
}

// How far the origin is from a triangle. Of a sliver, whose plane is uncertain, the edges tell: its points
// are those of its edges, to rounding.
double distanceToTriangle(const std::array<Vec3, 3>& w) {
  const Vec3 side1 = w[1] - w[0];
  const Vec3 side2 = w[2] - w[0];
  const Vec3 n = side1.cross(side2);
  const double twice_area = n.norm();
  bool over = twice_area > 0x1p-46 * (side1.squaredNorm() + side2.squaredNorm());
  double nearest = kInfinity;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3& from = w[k];
    const Vec3& to = w[(k + 1) % 3];
    nearest = std::min(nearest, distanceToSegment(from, to));
    over = over && dot(n, from.cross(to)) > 0.0;
  }
  return over ? std::min(nearest, std::abs(dot(n, w[0])) / twice_area) : nearest;
}

// The solid angle under which the origin sees a triangle, positive from its inner side (van Oosterom and
// Strackee 1983).
double solidAngle(const std::array<Vec3, 3>& w) {
  const double l0 = w[0].norm(), l1 = w[1].norm(), l2 = w[2].norm();
  return 2.0 * std::atan2(dot(w[0], w[1].cross(w[2])),
                          l0 * l1 * l2 + dot(w[0], w[1]) * l2 + dot(w[1], w[2]) * l0 + dot(w[2], w[0]) * l1);
}

// The depth that the polytope proves: the least distance of its triangles from the origin, or minus infinity
// if it is no closed surface or does not wind around the origin. (Not the heights of their planes: a tracked
// triangle may have become a sliver, whose plane can stand anywhere while its points have hardly moved.)
double provenDepth(const InnerPolytope& polytope, const ConvexPolyhedron& a, const ConvexPolyhedron& b,
                   const Mat3& R_AB, const Vec3& t_AB) {
  using Corners = std::array<std::array<int, 2>, 3>;
  std::vector<Corners> triangles;
  std::vector<std::array<int, 3>> neighbours;
  polytope.forEachTriangle([&](const Corners& corners, const std::array<int, 3>& across) {
    triangles.push_back(corners);
    neighbours.push_back(across);
  });
  double least = triangles.empty() ? -kInfinity : kInfinity;
  double angle = 0.0;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    std::array<Vec3, 3> w;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& [va, vb] = triangles[i][k];
      w[k] = a.vertex(va) - (R_AB * b.vertex(vb) + t_AB);
      // The neighbour runs through the same edge the other way, and names this triangle across it.
      const std::array<int, 2>& next = triangles[i][(k + 1) % 3];
      const auto other = static_cast<std::size_t>(neighbours[i][k]);
      bool matched = false;
      for (std::size_t m = 0; m < 3; ++m)
        matched =
            matched || (triangles[other][m] == next && triangles[other][(m + 1) % 3] == triangles[i][k] &&
                        neighbours[other][m] == static_cast<int>(i));
      if (!matched) return -kInfinity;
    }
    angle += solidAngle(w);
    least = std::min(least, distanceToTriangle(w));
  }
  // A whole number of 4 pi, and at least one.
  return angle > 2.0 * std::numbers::pi ? least : -kInfinity;
}

}  // namespace

Certificate certify(const ClosestFeatures& answer, const ConvexPart& a, const Pose& X_WA, const ConvexPart& b,
                    const Pose& X_WB, const PairMemory* memory) {
  const Mat3 R_WA = X_WA.rotation.normalized().toRotationMatrix();
  const Mat3 R_WB = X_WB.rotation.normalized().toRotationMatrix();
  const Mat3 R_AB = R_WA.transpose() * R_WB;
  const Vec3 t_AB = R_WA.transpose() * (X_WB.position - X_WA.position);
  const Vec3 n_A = R_WA.transpose() * answer.n_W;
  const Vec3 n_B = R_WB.transpose() * answer.n_W;
  const Vec3 core_a = R_WA.transpose() * (answer.p_A_W - X_WA.position) - a.radius_m * n_A;
  const Vec3 core_b = R_WB.transpose() * (answer.p_B_W - X_WB.position) + b.radius_m * n_B;

  const double slab = dot(n_A, t_AB) - highest(b.core, -n_B) - highest(a.core, n_A) - a.radius_m - b.radius_m;
  Certificate certificate;
  certificate.error_m =
      std::max({std::abs(slab - answer.distance_m), outside(a.core, core_a), outside(b.core, core_b),
                (answer.p_B_W - answer.p_A_W - answer.distance_m * answer.n_W).norm(),
                std::abs(answer.n_W.norm() - 1.0) * (std::abs(answer.distance_m) + a.radius_m + b.radius_m)});
  const bool finite = std::isfinite(answer.distance_m) && answer.n_W.allFinite() &&
                      answer.p_A_W.allFinite() && answer.p_B_W.allFinite() &&
                      std::isfinite(certificate.error_m);
  if (!finite) certificate.error_m = kInfinity;
  const double core_gap = answer.distance_m + a.radius_m + b.radius_m;
  if (core_gap >= 0.0) return certificate;
  // Of a depth below the bound the witnesses, that close together, are proof enough.
  const double bound = certifiedError(a, X_WA, b, X_WB);
  const bool small = -core_gap <= bound;
  if (small || !memory || memory->penetration.triangleCount() == 0) {
    certificate.complete = small;
    return certificate;
  }
  double proven = provenDepth(memory->penetration, a.core, b.core, R_AB, t_AB);
  if (-core_gap - proven > bound) {  // the surface is an earlier query's
    InnerPolytope surface;
    surface.minimumTranslation({a.core, X_WA, b.core, X_WB}, kNoiseShare * bound);
    proven = std::max(proven, provenDepth(surface, a.core, b.core, R_AB, t_AB));
  }
  certificate.error_m = std::max(certificate.error_m, -core_gap - proven);
  return certificate;
}

double certifiedError(const ConvexPart& a, const Pose& X_WA, const ConvexPart& b, const Pose& X_WB) {
  const double size =
      (X_WB.position - X_WA.position).norm() + a.core.reach() + b.core.reach() + a.radius_m + b.radius_m;
  return 1e-12 * size + 0x1p-50 * (X_WA.position.norm() + X_WB.position.norm());
}

}  // namespace carom
