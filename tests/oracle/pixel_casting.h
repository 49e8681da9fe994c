#pragma once
// What the middle of each pixel shows, by casting a ray through it: the oracle for depth, normal and id
// images.

#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "tests/oracle/ray_caster.h"

namespace carom::oracle {

/// A pinhole camera in plain numbers, z up.
struct CastView {
  Vec3 eye;
  Vec3 target;
  double fov_degrees = 40.0;  ///< Vertical.
  int width = 0;
  int height = 0;
};

/// A solid in its place, or with `endless_top` all that lies below that height.
struct CastBody {
  const Solid* solid = nullptr;
  Pose X_WB;
  double endless_top = -kNoHit;
};

/// Body -1 is the sky; t is the depth along the view.
struct CastPixel {
  int body = -1;
  RayHit hit;
};

inline CastRay rayThrough(const CastView& view, double x, double y) {
  const Vec3 look = view.target - view.eye;
  const double heading = std::atan2(look.y(), look.x());
  const double pitch = std::atan2(look.z(), std::hypot(look.x(), look.y()));
  const Vec3 ahead(std::cos(heading) * std::cos(pitch), std::sin(heading) * std::cos(pitch), std::sin(pitch));
  const Vec3 right(std::sin(heading), -std::cos(heading), 0.0);
  const Vec3 up(-std::cos(heading) * std::sin(pitch), -std::sin(heading) * std::sin(pitch), std::cos(pitch));
  const double scale = std::tan(0.5 * view.fov_degrees * std::numbers::pi / 180.0) / (0.5 * view.height);
  return {view.eye, ahead + scale * ((x - 0.5 * view.width) * right - (y - 0.5 * view.height) * up)};
}

inline CastPixel castPixel(const CastRay& ray, std::span<const CastBody> bodies) {
  CastPixel pixel;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    RayHit hit;
    if (std::isfinite(bodies[i].endless_top)) {
      const double t = (bodies[i].endless_top - ray.origin.z()) / ray.direction.z();
      if (t > 0.0) hit = {t, Vec3::UnitZ()};
    } else {
      hit = castRay(ray, *bodies[i].solid, bodies[i].X_WB);
    }
    if (hit.t < pixel.hit.t) pixel = {static_cast<int>(i), hit};
  }
  return pixel;
}

/// Rows from top to bottom.
inline std::vector<CastPixel> castPixels(const CastView& view, std::span<const CastBody> bodies) {
  std::vector<CastPixel> pixels;
  for (int y = 0; y < view.height; ++y)
    for (int x = 0; x < view.width; ++x)
      pixels.push_back(castPixel(rayThrough(view, x + 0.5, y + 0.5), bodies));
  return pixels;
}

/// Whether all pixels within one of it, those of the image's border left out, show the same body.
inline bool awayFromOutlines(const std::vector<CastPixel>& pixels, int width, int height, int x, int y) {
  const auto body = [&](int u, int v) { return pixels[static_cast<std::size_t>(v * width + u)].body; };
  if (x == 0 || y == 0 || x == width - 1 || y == height - 1) return false;
  for (int v = y - 1; v <= y + 1; ++v)
    for (int u = x - 1; u <= x + 1; ++u)
      if (body(u, v) != body(x, y)) return false;
  return true;
}

}  // namespace carom::oracle
