#include "engine/environment/drag.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace carom {
namespace {

// Exact for polynomials of degree five on a triangle, with positive weights (Radon 1948): the middle, and
// points with barycentric coordinates (1 - 2 a, a, a) and their permutations.
struct TrianglePoints {
  double a;
  double weight;
};
constexpr double kMiddleWeight = 0.225;
constexpr std::array<TrianglePoints, 2> kDegreeFive{
    {{0.10128650732345634, 0.12593918054482715}, {0.47014206410511509, 0.13239415278850618}}};

// Calls visit(point, weight) for points of the facet whose weights add up to its area.
template <typename Visit>
void forPoints(std::span<const Vec3> facet, const Vec3& normal, Visit visit) {
  for (std::size_t i = 1; i + 1 < facet.size(); ++i) {
    const std::array<Vec3, 3> corner{facet[0], facet[i], facet[i + 1]};
    const double area = 0.5 * dot(normal, (corner[1] - corner[0]).cross(corner[2] - corner[0]));
    const Vec3 sum = corner[0] + corner[1] + corner[2];
    visit(sum / 3.0, kMiddleWeight * area);
    for (const TrianglePoints& points : kDegreeFive)
      for (const Vec3& c : corner) visit(points.a * sum + (1.0 - 3.0 * points.a) * c, points.weight * area);
  }
}

Vec3 velocityAt(const Vec6& v, const Vec3& p_B) {
  return v.head<3>() + v.tail<3>().cross(p_B);
}

// Points of the pieces on which the fluid's hold is linear in the depth.
template <typename Visit>
void forHeldPoints(std::span<const Vec3> facet, const Vec3& normal, const Hold& hold, CutScratch& scratch,
                   Visit visit) {
  const auto weigh = [&](const Vec3& p, double weight) { visit(p, weight * hold.at(p)); };
  if (!(hold.inverse_depth > 0.0)) return forPoints(facet, normal, weigh);
  const Plane full{hold.surface.normal, hold.surface.offset - 1.0 / hold.inverse_depth};
  clipPolygon(facet, full, scratch.rest);
  forPoints(scratch.rest, normal, weigh);
  clipPolygon(facet, {-full.normal, -full.offset}, scratch.rest);
  forPoints(scratch.rest, normal, weigh);
}

// The share of the mean pressure at a point: 1 + cos(attack) (p - c) . e / l, e the way the facet moves along
// itself, l the farthest that it reaches that way or back; never negative.
struct Lead {
  Vec3 middle = Vec3::Zero();
  Vec3 slope = Vec3::Zero();

  double at(const Vec3& p) const { return 1.0 + dot(slope, p - middle); }
};

Lead leadOf(std::span<const Vec3> facet, const Vec3& normal, const Vec6& velocity) {
  Lead lead{areaOf(facet, normal).centroid, Vec3::Zero()};
  const Vec3 u = velocityAt(velocity, lead.middle);
  const Vec3 along = u - dot(normal, u) * normal;
  double reach = 0.0, speed = u.norm();  // of the fastest point: what only turns has no leading edge
  for (const Vec3& corner : facet) {
    reach = std::max(reach, std::abs(dot(along, corner - lead.middle)));
    speed = std::max(speed, velocityAt(velocity, corner).norm());
  }
  // Squares of next to no speed are none: what stands has no leading edge.
  if (speed * reach > 0.0) lead.slope = along.norm() / (speed * reach) * along;
  return lead;
}

// Adds G^T T G, where G maps a velocity to that of a point.
void addAtPoint(const Vec3& p_B, const Mat3& t, Mat6& sum) {
  const Mat3 r = crossMatrix(p_B);
  const Mat3 tr = t * r;
  sum.topLeftCorner<3, 3>() += t;
  sum.topRightCorner<3, 3>() -= tr;
  sum.bottomLeftCorner<3, 3>() -= tr.transpose();
  sum.bottomRightCorner<3, 3>() -= r * tr;
}

}  // namespace

void addPressure(std::span<const Vec3> facet, const Vec3& normal, double pressure, const Hold& hold,
                 CutScratch& scratch, StreamDrag& drag) {
  const Vec3 v = drag.velocity.head<3>();
  const Vec3 turning = normal.cross(drag.velocity.tail<3>());  // n . (omega x r) = r . (n x omega)
  const double ahead = dot(normal, v);
  bool some = false, all = true;
  for (const Vec3& p : facet) (ahead + dot(turning, p) > 0.0 ? some : all) = ahead + dot(turning, p) > 0.0;
  if (!some) return;
  std::span<const Vec3> windward = facet;
  if (!all) {
    clipPolygon(facet, {-turning, ahead}, scratch.next);
    windward = scratch.next;
  }
  const Lead lead = leadOf(facet, normal, drag.velocity);
  double sum = 0.0;
  Vec3 first = Vec3::Zero();
  Mat3 second = Mat3::Zero();
  forHeldPoints(windward, normal, hold, scratch, [&](const Vec3& p, double weight) {
    const double share = weight * pressure * (ahead + dot(turning, p)) * lead.at(p);
    const Vec3 arm = p.cross(normal);
    sum += share;
    first += share * arm;
    second += (share * arm) * arm.transpose();
  });
  drag.quadratic.topLeftCorner<3, 3>() += sum * normal * normal.transpose();
  drag.quadratic.topRightCorner<3, 3>() += normal * first.transpose();
  drag.quadratic.bottomLeftCorner<3, 3>() += first * normal.transpose();
  drag.quadratic.bottomRightCorner<3, 3>() += second;
}

void addSkinFriction(std::span<const Vec3> facet, const Vec3& normal, double friction, StreamDrag& drag) {
  const Mat3 along = Mat3::Identity() - normal * normal.transpose();
  forPoints(facet, normal, [&](const Vec3& p, double weight) {
    const double speed = (along * velocityAt(drag.velocity, p)).norm();
    addAtPoint(p, weight * friction * speed * along, drag.quadratic);
  });
}

// With A, F and S the integrals of 1, r and r r^T over the facet: ((A I, -[F]x), ([F]x, tr S I - S)).
void addLinear(std::span<const Vec3> facet, const Vec3& normal, double c, const Hold& hold,
               CutScratch& scratch, StreamDrag& drag) {
  double area = 0.0;
  Vec3 first = Vec3::Zero();
  Mat3 second = Mat3::Zero();
  forHeldPoints(facet, normal, hold, scratch, [&](const Vec3& p, double weight) {
    const double share = weight * c;
    area += share;
    first += share * p;
    second += (share * p) * p.transpose();
  });
  const Mat3 arm = crossMatrix(first);
  drag.linear.topLeftCorner<3, 3>() += area * Mat3::Identity();
  drag.linear.topRightCorner<3, 3>() -= arm;
  drag.linear.bottomLeftCorner<3, 3>() += arm;
  drag.linear.bottomRightCorner<3, 3>() += second.trace() * Mat3::Identity() - second;
}

// Of -kappa |u| u the matrix is half of what its derivative has: kappa/2 (|u| I + u u^T / |u|), which is not
// negative and gives the same force.
void addPointDrag(const Vec3& p_B, double kappa, const Vec3& axis, StreamDrag& drag) {
  const Mat3 across = Mat3::Identity() - axis * axis.transpose();
  const Vec3 u = across * velocityAt(drag.velocity, p_B);
  const double speed = u.norm();
  if (!(speed > 0.0)) return;
  addAtPoint(p_B, 0.5 * kappa * (speed * across + (u / speed) * u.transpose()), drag.quadratic);
}

void addPointLinear(const Vec3& p_B, double c, double t, StreamDrag& drag) {
  addAtPoint(p_B, c * Mat3::Identity(), drag.linear);
  drag.linear.bottomRightCorner<3, 3>() += t * Mat3::Identity();
}

}  // namespace carom
