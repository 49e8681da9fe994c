#pragma once
// Where a ray meets a solid first, found from the solid's definition alone: sharp polyhedra by cutting the
// ray with the half-spaces of their faces, rounded parts by marching the ray through the distance to the core
// until it has come to the rounding radius (sphere tracing, Hart 1996).

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/solid/solid.h"

namespace carom::oracle {

inline constexpr double kNoHit = std::numeric_limits<double>::infinity();

/// `t` counts in lengths of the ray's direction.
struct RayHit {
  double t = kNoHit;
  Vec3 normal = Vec3::Zero();
};

struct CastRay {
  Vec3 origin;
  Vec3 direction;
};

inline RayHit castSharp(const CastRay& ray, const ConvexPolyhedron& core) {
  double enter = 0.0, leave = kNoHit;
  int face = -1;
  for (int f = 0; f < core.faceCount(); ++f) {
    const double above = core.plane(f).signedDistance(ray.origin);
    const double rate = core.plane(f).normal.dot(ray.direction);
    if (rate < 0.0 && -above / rate > enter) enter = -above / rate, face = f;
    if (rate > 0.0) leave = std::min(leave, -above / rate);
    if (rate == 0.0 && above > 0.0) return {};
  }
  return face >= 0 && enter <= leave ? RayHit{enter, core.plane(face).normal} : RayHit{};
}

inline Vec3 nearestOnSegment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 along = b - a;
  const double length2 = along.squaredNorm();
  const double s = length2 > 0.0 ? std::clamp((p - a).dot(along) / length2, 0.0, 1.0) : 0.0;
  return a + s * along;
}

/// The nearest point of a core to a point outside it: of each face its foot of the perpendicular where that
/// lies on it, and of each side.
inline Vec3 nearestOnCore(const Vec3& p, const ConvexPolyhedron& core) {
  Vec3 nearest = core.vertex(0);
  const auto take = [&](const Vec3& q) {
    if ((p - q).squaredNorm() < (p - nearest).squaredNorm()) nearest = q;
  };
  if (core.faceCount() == 0) return nearestOnSegment(p, core.vertex(0), core.vertex(core.vertexCount() - 1));
  for (int f = 0; f < core.faceCount(); ++f) {
    const auto loop = core.faceVertices(f);
    const Vec3 n = core.plane(f).normal;
    const Vec3 foot = p - core.plane(f).signedDistance(p) * n;
    bool inside = true;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vec3 &a = core.vertex(loop[i]), &b = core.vertex(loop[(i + 1) % loop.size()]);
      inside = inside && (b - a).cross(foot - a).dot(n) >= 0.0;
      take(nearestOnSegment(p, a, b));
    }
    if (inside) take(foot);
  }
  return nearest;
}

inline RayHit castRounded(const CastRay& ray, const ConvexPart& part) {
  const double speed = ray.direction.norm();
  const Vec3 middle = part.core.center();
  const double around = part.core.radius() + part.radius_m;
  // Nothing outside the bounding ball needs marching.
  const double closest_t = (middle - ray.origin).dot(ray.direction) / (speed * speed);
  if ((ray.origin + closest_t * ray.direction - middle).norm() > around) return {};
  double t = std::max(0.0, ((middle - ray.origin).norm() - around) / speed);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 p = ray.origin + t * ray.direction;
    const Vec3 away = p - nearestOnCore(p, part.core);
    const double gap = away.norm() - part.radius_m;
    if (gap < 1e-10) return {t, away.normalized()};
    t += gap / speed;
    if ((p - middle).dot(ray.direction) > around * speed) return {};
  }
  return {};
}

/// The first point of the solid on a ray, with its outward normal; all in the world's frame.
inline RayHit castRay(const CastRay& ray_W, const Solid& solid, const Pose& X_WB) {
  const Quat R_BW = X_WB.rotation.conjugate();
  const CastRay ray_B{R_BW * (ray_W.origin - X_WB.position), R_BW * ray_W.direction};
  RayHit first;
  for (const ConvexPart& part : solid.parts()) {
    const RayHit hit = part.radius_m > 0.0 ? castRounded(ray_B, part) : castSharp(ray_B, part.core);
    if (hit.t < first.t) first = hit;
  }
  first.normal = X_WB.rotation * first.normal;
  return first;
}

}  // namespace carom::oracle
