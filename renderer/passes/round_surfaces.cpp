#include "renderer/passes/round_surfaces.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace carom::renderer {
namespace {

constexpr double kNowhere = std::numeric_limits<double>::infinity();

// From `origin` along `direction`; t counts in lengths of `direction`.
struct Ray {
  Vec3 origin;
  Vec3 direction;
  Vec3 at(double t) const { return origin + t * direction; }
};

// The first point of a surface on a ray, with the outward normal.
struct Hit {
  double t = kNowhere;
  Vec3 normal = Vec3::Zero();
  void takeNearer(double other_t, const Vec3& other_normal) {
    if (other_t > 0.0 && other_t < t) t = other_t, normal = other_normal;
  }
};

// The smaller root of a t^2 - 2 b t + c = 0, where the ray enters.
double entry(double a, double b, double c) {
  const double discriminant = b * b - a * c;
  return discriminant < 0.0 || !(a > 0.0) ? kNowhere : (b - std::sqrt(discriminant)) / a;
}

void meetBall(const Ray& ray, const Vec3& center, double radius_m, Hit& hit) {
  const Vec3 to_center = center - ray.origin;
  const double t = entry(ray.direction.squaredNorm(), ray.direction.dot(to_center),
                         to_center.squaredNorm() - radius_m * radius_m);
  if (t < hit.t) hit.takeNearer(t, (ray.at(t) - center) / radius_m);
}

void meetTube(const Ray& ray, const Vec3& a, const Vec3& b, double radius_m, Hit& hit) {
  const double length = (b - a).norm();
  if (!(length > 0.0)) return;
  const Vec3 axis = (b - a) / length, to_a = a - ray.origin;
  const Vec3 across = ray.direction - ray.direction.dot(axis) * axis;
  const Vec3 to_a_across = to_a - to_a.dot(axis) * axis;
  const double t =
      entry(across.squaredNorm(), across.dot(to_a_across), to_a_across.squaredNorm() - radius_m * radius_m);
  if (!(t < hit.t)) return;
  const Vec3 from_a = ray.at(t) - a;
  const double along = from_a.dot(axis);
  if (along >= 0.0 && along <= length) hit.takeNearer(t, (from_a - along * axis) / radius_m);
}

void meetFace(const Ray& ray, const ConvexPolyhedron& core, int f, double radius_m, Hit& hit) {
  const Plane& plane = core.plane(f);
  const double towards = plane.normal.dot(ray.direction);
  if (!(towards < 0.0)) return;
  const double t = (plane.offset + radius_m - plane.normal.dot(ray.origin)) / towards;
  if (!(t < hit.t)) return;
  const Vec3 p = ray.at(t);
  for (const Plane& side : core.faceSides(f))
    if (side.signedDistance(p) < 0.0) return;
  hit.takeNearer(t, plane.normal);
}

Hit meetPart(const Ray& ray, const ConvexPart& part) {
  const ConvexPolyhedron& core = part.core;
  Hit hit;
  if (core.faceCount() == 0) {
    const Vec3 &a = core.vertex(0), &b = core.vertex(core.vertexCount() - 1);
    meetBall(ray, a, part.radius_m, hit);
    if (core.vertexCount() > 1) meetBall(ray, b, part.radius_m, hit), meetTube(ray, a, b, part.radius_m, hit);
    return hit;
  }
  Hit bounds;
  meetBall(ray, core.center(), core.radius() + part.radius_m, bounds);
  if (bounds.t == kNowhere && (ray.origin - core.center()).norm() > core.radius() + part.radius_m) return hit;
  for (int f = 0; f < core.faceCount(); ++f) meetFace(ray, core, f, part.radius_m, hit);
  for (int e = 0; e < core.edgeCount(); ++e)
    meetTube(ray, core.vertex(core.edge(e).tail), core.vertex(core.edge(e).head), part.radius_m, hit);
  for (const Vec3& vertex : core.vertices()) meetBall(ray, vertex, part.radius_m, hit);
  return hit;
}

struct PixelRange {
  int begin = 0, end = 0;
};
struct PixelRect {
  PixelRange x, y;
};

// One axis of the image: what a coordinate of size 1 at depth 1 measures there, and its pixels.
struct ImageAxis {
  double focal_px;
  int size;
};

// The pixels whose middle may lie within the ball's shadow on one axis of the image. `across` is its centre's
// coordinate on that axis, `depth` the one along the view.
PixelRange shadowOnAxis(double across, double depth, double radius, const ImageAxis& axis) {
  const int size = axis.size;
  if (depth <= radius) return {0, size};
  const auto slope = [&](double edge) { return std::pair(edge / (depth - radius), edge / (depth + radius)); };
  const auto [low_a, low_b] = slope(across - radius);
  const auto [high_a, high_b] = slope(across + radius);
  const double low = 0.5 * size + axis.focal_px * std::min(low_a, low_b) - 1.0;
  const double high = 0.5 * size + axis.focal_px * std::max(high_a, high_b) + 1.0;
  return {static_cast<int>(std::clamp(std::floor(low), 0.0, static_cast<double>(size))),
          static_cast<int>(std::clamp(std::ceil(high), 0.0, static_cast<double>(size)))};
}

struct View {
  Camera camera;
  CameraAxes axes;
  double focal_px = 1.0;
};

PixelRect rectOf(const View& view, const Pose& X_WB, const ConvexPart& part, const DepthImage& image) {
  const Vec3 center_E = X_WB * part.core.center() - view.camera.eye;
  const double radius = part.core.radius() + part.radius_m, depth = center_E.dot(view.axes.forward);
  if (depth < -radius) return {};
  return {shadowOnAxis(center_E.dot(view.axes.right), depth, radius, {view.focal_px, image.width}),
          shadowOnAxis(-center_E.dot(view.axes.up), depth, radius, {view.focal_px, image.height})};
}

void addPart(const View& view, const Pose& X_WB, const ConvexPart& part, int instance,
             SurfaceImage& surfaces) {
  DepthImage& image = surfaces.depth;
  const PixelRect rect = rectOf(view, X_WB, part, image);
  const Quat to_B = X_WB.rotation.conjugate();
  const Vec3 origin = to_B * (view.camera.eye - X_WB.position);
  const Vec3 forward = to_B * view.axes.forward;
  const Vec3 right = to_B * (view.axes.right / view.focal_px), up = to_B * (view.axes.up / view.focal_px);
  for (int y = rect.y.begin; y < rect.y.end; ++y)
    for (int x = rect.x.begin; x < rect.x.end; ++x) {
      // Its component along the view is one: t is the depth.
      const Vec3 direction =
          forward + (x + 0.5 - 0.5 * image.width) * right - (y + 0.5 - 0.5 * image.height) * up;
      const Hit hit = meetPart({origin, direction}, part);
      const std::size_t pixel =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x);
      if (!(hit.t < static_cast<double>(image.depth_m[pixel]))) continue;
      const Eigen::Vector3f normal = (X_WB.rotation * hit.normal).cast<float>();
      image.depth_m[pixel] = static_cast<float>(hit.t);
      surfaces.instance[pixel] = instance;
      surfaces.normal_W[pixel] = {normal.x(), normal.y(), normal.z()};
    }
}

}  // namespace

void addRoundSurfaces(std::span<const Instance> instances, std::span<const Solid> solids,
                      const Camera& camera, int ground, SurfaceImage& surfaces) {
  const View view{camera, cameraAxes(camera), focalLengthPixels(camera, surfaces.depth.height)};
  for (std::size_t i = 0; i < instances.size(); ++i) {
    if (static_cast<int>(i) == ground) continue;
    const Solid& solid = solids[static_cast<std::size_t>(instances[i].solid)];
    for (std::size_t k = 0; k < solid.parts().size(); ++k)
      if (solid.parts()[k].radius_m > 0.0 && !solid.isPiece(k))
        addPart(view, instances[i].X_WB, solid.parts()[k], static_cast<int>(i), surfaces);
  }
}

}  // namespace carom::renderer
