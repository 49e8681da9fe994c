#include "engine/modes/support_polygon.h"

#include <algorithm>
#include <limits>

namespace carom {
namespace {

// A contact holds a body up when its normal leans against the weight by more than this cosine.
constexpr double kUpwards = 1e-3;

double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

double distanceToSegment(const Vec2& a, const Vec2& b, const Vec2& p) {
  const Vec2 d = b - a;
  const double squared = d.squaredNorm();
  const double t = squared > 0.0 ? std::clamp(dot(p - a, d) / squared, 0.0, 1.0) : 0.0;
  return (p - a - t * d).norm();
}

}  // namespace

// Andrew's monotone chain.
std::vector<Vec2> convexCover(std::vector<Vec2> points) {
  const auto before = [](const Vec2& a, const Vec2& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  };
  std::sort(points.begin(), points.end(), before);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  std::vector<Vec2> cover;
  const auto append = [&](const Vec2& p, std::size_t fixed) {
    while (cover.size() >= fixed + 2 &&
           cross(cover.back() - cover[cover.size() - 2], p - cover.back()) <= 0.0)
      cover.pop_back();
    cover.push_back(p);
  };
  for (const Vec2& p : points) append(p, 0);
  const std::size_t upper = cover.size() - 1;
  for (std::size_t i = points.size() - 1; i-- > 0;) append(points[i], upper);
  cover.pop_back();
  return cover;
}

double distanceOutside(std::span<const Vec2> cover, const Vec2& p) {
  bool inside = cover.size() >= 3;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < cover.size(); ++i) {
    const Vec2& a = cover[i];
    const Vec2& b = cover[(i + 1) % cover.size()];
    if (cross(b - a, p - a) < 0.0) inside = false;
    nearest = std::min(nearest, distanceToSegment(a, b, p));
  }
  return inside ? 0.0 : nearest;
}

double supportMiss(const Vec3& center_W, const Vec3& weight_N, std::span<const BodyContact> contacts) {
  const Vec3 down = weight_N.normalized();
  // The effective force and its moment about the centre: the weight, and every contact that does not hold up.
  Vec3 force = weight_N;
  Vec3 moment = Vec3::Zero();
  Vec3 level = Vec3::Zero();
  int supports = 0;
  for (const BodyContact& c : contacts) {
    if (dot(c.n_W, down) < -kUpwards) {
      level += c.p_W;
      ++supports;
    } else {
      force += c.force_N;
      moment += (c.p_W - center_W).cross(c.force_N);
    }
  }
  const double pressing = dot(force, down);
  if (supports == 0 || !(pressing > 0.0)) return std::numeric_limits<double>::infinity();
  level /= supports;
  // The line of action runs along the force through centre + (F x M)/F^2; follow it to the supports' level.
  const Vec3 on_line = center_W + force.cross(moment) / force.squaredNorm();
  const Vec3 foot = on_line + force * (dot(level - on_line, down) / pressing);
  const TangentBasis plane = tangentBasis(down);
  const auto project = [&](const Vec3& p) {
    return Vec2(dot(plane.t1, p - level), dot(plane.t2, p - level));
  };
  std::vector<Vec2> points;
  for (const BodyContact& c : contacts)
    if (dot(c.n_W, down) < -kUpwards) points.push_back(project(c.p_W));
  return distanceOutside(convexCover(std::move(points)), project(foot));
}

}  // namespace carom
