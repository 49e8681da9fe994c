#include "renderer/drawing/solid_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "engine/foundation/contract.h"

namespace carom::renderer {
namespace {

constexpr int kRays = 2;  // A pixel's, along either axis.
constexpr double kAmbient = 0.80;
const Vec3 kToLight_V = Vec3(-0.35, 0.75, -0.55).normalized();  // Right, up, forward of the camera.

/// A face's plane in the camera's axes, with its shade.
struct CastPlane {
  Vec3 normal;
  double offset = 0.0;
  Color color;
};

struct Casting {
  int width, height;  // Of the grid of rays.
  double focal;       // In rays.
  std::vector<double> depth_m;
  std::vector<Color> colors;
};

struct RayBox {
  int left, top, right, bottom;
};

Color shaded(const Color& color, const Vec3& normal_V) {
  const double light = kAmbient + (1.0 - kAmbient) * std::max(0.0, normal_V.dot(kToLight_V));
  const auto share = [&](float c) { return static_cast<float>(light) * c; };
  return {share(color.r), share(color.g), share(color.b)};
}

// Where the part can be seen; all of the image when it reaches behind the eye.
RayBox rayBox(const std::vector<Vec3>& corners_V, const Casting& casting) {
  Vec2 low = Vec2::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const Vec3& p : corners_V) {
    if (p.z() <= 0.0) return {0, 0, casting.width, casting.height};
    const Vec2 at(0.5 * casting.width + casting.focal * p.x() / p.z(),
                  0.5 * casting.height - casting.focal * p.y() / p.z());
    low = low.cwiseMin(at);
    high = high.cwiseMax(at);
  }
  const auto within = [](double x, int most) {
    return static_cast<int>(std::clamp(x, 0.0, static_cast<double>(most)));
  };
  return {within(low.x(), casting.width), within(low.y(), casting.height),
          within(high.x() + 1.0, casting.width), within(high.y() + 1.0, casting.height)};
}

// A ray enters a convex polyhedron through the last of the planes that it comes in through, unless it has
// gone out of another before.
void castPart(const std::vector<CastPlane>& planes, const RayBox& box, Casting& casting) {
  for (int y = box.top; y < box.bottom; ++y)
    for (int x = box.left; x < box.right; ++x) {
      const Vec3 ray((x + 0.5 - 0.5 * casting.width) / casting.focal,
                     (0.5 * casting.height - y - 0.5) / casting.focal, 1.0);
      double in = 0.0, out = std::numeric_limits<double>::infinity();
      const CastPlane* entered = nullptr;
      for (const CastPlane& plane : planes) {
        const double slope = plane.normal.dot(ray);
        const double t = plane.offset / slope;
        if (slope < 0.0 && t > in) {
          in = t;
          entered = &plane;
        } else if (slope > 0.0) {
          out = std::min(out, t);
        } else if (slope == 0.0 && plane.offset < 0.0) {
          out = -1.0;
        }
      }
      const std::size_t index =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(casting.width) + static_cast<std::size_t>(x);
      if (entered == nullptr || in >= out || in >= casting.depth_m[index]) continue;
      casting.depth_m[index] = in;
      casting.colors[index] = entered->color;
    }
}

std::uint8_t meanByte(float sum) {
  return static_cast<std::uint8_t>(std::lround(255.0f * std::clamp(sum / (kRays * kRays), 0.0f, 1.0f)));
}

SolidPicture gathered(const Casting& casting) {
  SolidPicture picture;
  const int width = casting.width / kRays, height = casting.height / kRays;
  picture.image = {width, height, {}};
  picture.depth = {width, height, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      double nearest = std::numeric_limits<double>::infinity();
      std::array<float, 3> sum{};
      for (int ray = 0; ray < kRays * kRays; ++ray) {
        const auto row = static_cast<std::size_t>(kRays * y + ray / kRays);
        const std::size_t index =
            row * static_cast<std::size_t>(casting.width) + static_cast<std::size_t>(kRays * x + ray % kRays);
        nearest = std::min(nearest, casting.depth_m[index]);
        const Color& color = casting.colors[index];
        sum = {sum[0] + color.r, sum[1] + color.g, sum[2] + color.b};
      }
      picture.depth.depth_m.push_back(static_cast<float>(nearest));
      for (float channel : sum) picture.image.rgb.push_back(meanByte(channel));
    }
  return picture;
}

}  // namespace

SolidPicture castSolids(std::span<const PictureSolid> solids, const Camera& camera, int width, int height,
                        const Color& background) {
  const CameraAxes axes = cameraAxes(camera);
  Mat3 R_VW;
  R_VW << axes.right.transpose(), axes.up.transpose(), axes.forward.transpose();
  Casting casting{kRays * width, kRays * height, kRays * focalLengthPixels(camera, height), {}, {}};
  const std::size_t rays = static_cast<std::size_t>(casting.width) * static_cast<std::size_t>(casting.height);
  casting.depth_m.assign(rays, std::numeric_limits<double>::infinity());
  casting.colors.assign(rays, background);
  for (const PictureSolid& solid : solids)
    for (const ConvexPart& part : solid.solid->parts()) {
      REQUIRE(part.radius_m == 0.0 && part.core.faceCount() > 0, part.radius_m);
      std::vector<Vec3> corners;
      for (const Vec3& v : part.core.vertices()) corners.push_back(R_VW * (solid.X_WB * v - camera.eye));
      std::vector<CastPlane> planes;
      for (int f = 0; f < part.core.faceCount(); ++f) {
        const Vec3 normal = R_VW * (solid.X_WB.rotation * part.core.plane(f).normal);
        const Vec3& on_it = corners[static_cast<std::size_t>(part.core.faceVertices(f)[0])];
        planes.push_back({normal, normal.dot(on_it), shaded(solid.color, normal)});
      }
      castPart(planes, rayBox(corners, casting), casting);
    }
  return gathered(casting);
}

}  // namespace carom::renderer
