#include "renderer/drawing/solid_picture.h"

#include <array>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace carom::renderer {
namespace {

constexpr int kWidth = 160, kHeight = 120;
const Camera kCamera{{2.0, -5.0, 2.0}, {0.1, 0.0, 0.2}, 36.0};

// The oracle: a ray cut by the three pairs of parallel planes of a box, in the box's own frame.
double slabDepth(const Vec3& half, const Pose& X_WB, const Vec3& eye, const Vec3& ray) {
  const Vec3 from = X_WB.inverse() * eye, along = X_WB.rotation.conjugate() * ray;
  double in = 0.0, out = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < 3; ++i) {
    const double t1 = (-half[i] - from[i]) / along[i], t2 = (half[i] - from[i]) / along[i];
    in = std::max(in, std::min(t1, t2));
    out = std::min(out, std::max(t1, t2));
  }
  return in < out ? in : std::numeric_limits<double>::infinity();
}

TEST(SolidPicture, DepthIsThatOfTheNearestBoxOnEachRay) {
  const Solid first = Solid::box({1.0, 0.8, 0.6}), second = Solid::box({0.5, 1.6, 0.3});
  const Pose X_first{Quat(Eigen::AngleAxisd(0.4, Vec3(1, 2, 3).normalized())), Vec3(-0.3, 0.1, 0.2)};
  const Pose X_second{Quat(Eigen::AngleAxisd(-0.9, Vec3(0, 1, 1).normalized())), Vec3(0.5, 0.6, 0.1)};
  const std::array<PictureSolid, 2> solids = {PictureSolid{&first, X_first, {1.0f, 0.0f, 0.0f}},
                                              PictureSolid{&second, X_second, {0.0f, 0.0f, 1.0f}}};
  const SolidPicture picture = castSolids(solids, kCamera, kWidth, kHeight, {1.0f, 1.0f, 1.0f});
  const CameraAxes axes = cameraAxes(kCamera);
  const double focal = focalLengthPixels(kCamera, kHeight);
  int hits = 0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      double nearest = std::numeric_limits<double>::infinity();
      bool red = false;
      int of_red = 0, of_blue = 0;
      for (double dy : {0.25, 0.75})
        for (double dx : {0.25, 0.75}) {
          const Vec3 ray = axes.forward + (x + dx - 0.5 * kWidth) / focal * axes.right -
                           (y + dy - 0.5 * kHeight) / focal * axes.up;
          const double a = slabDepth({0.5, 0.4, 0.3}, X_first, kCamera.eye, ray);
          const double b = slabDepth({0.25, 0.8, 0.15}, X_second, kCamera.eye, ray);
          nearest = std::min({nearest, a, b});
          of_red += a < b;
          of_blue += b < a;
          red = red || a < b;
        }
      const auto index = static_cast<std::size_t>(y * kWidth + x);
      const double depth = static_cast<double>(picture.depth.depth_m[index]);
      if (std::isinf(nearest)) {
        ASSERT_TRUE(std::isinf(depth)) << x << ' ' << y;
        ASSERT_EQ(picture.image.pixel(x, y)[0] + picture.image.pixel(x, y)[2], 510);
        continue;
      }
      ASSERT_NEAR(depth, nearest, 1e-5) << x << ' ' << y;
      if (of_red == 4) {
        ASSERT_EQ(picture.image.pixel(x, y)[2], 0);
      }
      if (of_blue == 4) {
        ASSERT_EQ(picture.image.pixel(x, y)[0], 0);
      }
      ++hits;
    }
  EXPECT_GT(hits, 1000);
}

}  // namespace
}  // namespace carom::renderer
