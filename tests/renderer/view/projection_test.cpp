#include "renderer/view/projection.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "engine/foundation/contract.h"

namespace carom::renderer {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

// The oracle: heading and pitch of the camera as angles, and the pinhole equation in the turned frame.
Vec2 pinhole(const Camera& camera, int width, int height, const Vec3& p_W) {
  const Vec3 view = camera.target - camera.eye, to_p = p_W - camera.eye;
  const double heading = std::atan2(view.y(), view.x());
  const double pitch = std::atan2(view.z(), std::hypot(view.x(), view.y()));
  const double ahead_level = std::cos(heading) * to_p.x() + std::sin(heading) * to_p.y();
  const double right = std::sin(heading) * to_p.x() - std::cos(heading) * to_p.y();
  const double ahead = std::cos(pitch) * ahead_level + std::sin(pitch) * to_p.z();
  const double up = -std::sin(pitch) * ahead_level + std::cos(pitch) * to_p.z();
  const double focal = 0.5 * height / std::tan(0.5 * camera.fov_degrees * kDegree);
  return {0.5 * width + focal * right / ahead, 0.5 * height - focal * up / ahead};
}

TEST(Projection, PointsLandWhereThePinholeEquationSays) {
  std::mt19937 random(20);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int i = 0; i < 500; ++i) {
    Camera camera;
    camera.eye = 10.0 * Vec3(unit(random), unit(random), unit(random));
    camera.target = 10.0 * Vec3(unit(random), unit(random), unit(random));
    camera.fov_degrees = 50.0 + 40.0 * unit(random);
    const Vec3 p = camera.target +
                   0.3 * (camera.target - camera.eye).norm() * Vec3(unit(random), unit(random), unit(random));
    const std::optional<Vec2> pixel = projectToPixel(camera, 1280, 720, p);
    ASSERT_TRUE(pixel.has_value());
    EXPECT_LT((*pixel - pinhole(camera, 1280, 720, p)).norm(), 1e-6) << "case " << i << " of seed 20";
  }
}

TEST(Projection, TheTargetLandsInTheMiddle) {
  const std::optional<Vec2> pixel = projectToPixel(Camera{}, 641, 359, Camera{}.target);
  ASSERT_TRUE(pixel.has_value());
  EXPECT_NEAR(pixel->x(), 320.5, 1e-9);
  EXPECT_NEAR(pixel->y(), 179.5, 1e-9);
}

TEST(Projection, HalfTheFieldOfViewReachesTheUpperRim) {
  Camera camera{Vec3(1.0, 2.0, 3.0), Vec3(1.0, 12.0, 3.0), 64.0};
  const Vec3 at_rim = camera.eye + Vec3(0.0, 5.0, 5.0 * std::tan(32.0 * kDegree));
  EXPECT_NEAR(projectToPixel(camera, 400, 300, at_rim)->y(), 0.0, 1e-9);
}

TEST(Projection, NothingBehindTheEyeHasAPixel) {
  const Camera camera{Vec3(0.0, 0.0, 0.0), Vec3(1.0, 0.0, 0.0), 40.0};
  EXPECT_FALSE(projectToPixel(camera, 320, 180, Vec3(-1.0, 0.1, 0.2)).has_value());
  EXPECT_FALSE(projectToPixel(camera, 320, 180, Vec3(0.0, 1.0, 0.0)).has_value());
}

TEST(Projection, LookingStraightDownHasYUpwards) {
  const Camera camera{Vec3(0.0, 0.0, 5.0), Vec3(0.0, 0.0, 0.0), 40.0};
  const std::optional<Vec2> north = projectToPixel(camera, 100, 100, Vec3(0.0, 1.0, 0.0));
  const std::optional<Vec2> east = projectToPixel(camera, 100, 100, Vec3(1.0, 0.0, 0.0));
  ASSERT_TRUE(north && east);
  EXPECT_NEAR(north->x(), 50.0, 1e-9);
  EXPECT_LT(north->y(), 50.0);
  EXPECT_GT(east->x(), 50.0);
}

TEST(Projection, TheMatrixAgreesWithThePixel) {
  const Camera camera{Vec3(6.0, -9.0, 5.0), Vec3(0.5, 0.2, 1.0), 40.0};
  const Vec3 p_W(1.0, 1.5, 2.0), p_E = p_W - camera.eye;
  const std::array<float, 16> m = clipFromE(camera, 1280, 720, {0.5, 200.0});
  double clip[4];
  for (std::size_t r = 0; r < 4; ++r)
    clip[r] = m[r] * p_E.x() + m[4 + r] * p_E.y() + m[8 + r] * p_E.z() + m[12 + r];
  const Vec2 pixel = pinhole(camera, 1280, 720, p_W);
  EXPECT_NEAR(640.0 * (1.0 + clip[0] / clip[3]), pixel.x(), 1e-3);
  EXPECT_NEAR(360.0 * (1.0 - clip[1] / clip[3]), pixel.y(), 1e-3);
}

TEST(Projection, ImpossibleCamerasAreRefused) {
  EXPECT_THROW(cameraAxes({Vec3(1, 2, 3), Vec3(1, 2, 3), 40.0}), InputError);
  EXPECT_THROW(cameraAxes({Vec3(1, 2, 3), Vec3(0, 0, 0), 0.0}), InputError);
  EXPECT_THROW(cameraAxes({Vec3(1, 2, 3), Vec3(0, 0, 0), 180.0}), InputError);
  EXPECT_THROW(cameraAxes({Vec3(1, 2, 3), Vec3(0, 0, 0), std::nan("")}), InputError);
  EXPECT_THROW(cameraAxes({Vec3(1, std::nan(""), 3), Vec3(0, 0, 0), 40.0}), InputError);
  EXPECT_THROW(cameraAxes({Vec3(1, 2, 3), Vec3(0, std::numeric_limits<double>::infinity(), 0), 40.0}),
               InputError);
}

}  // namespace
}  // namespace carom::renderer
