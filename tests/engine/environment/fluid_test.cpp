#include "engine/environment/fluid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace carom {
namespace {

constexpr double kGravity = 9.81;

Fluid wavy() {
  Fluid fluid;
  fluid.max.z() = 0.7;
  fluid.waves = {{0.2, 5.0, Vec2(0.6, 0.8), 0.0, 0.4}, {0.1, 3.0, Vec2(-1.0, 0.0), 2.0, -1.0}};
  return fluid;
}

TEST(Fluid, SurfaceIsTheSumOfItsSines) {
  const Fluid fluid = wavy();
  const Vec2 p(1.3, -2.1);
  const double t = 3.7, k1 = 2.0 * std::numbers::pi / 5.0, k2 = 2.0 * std::numbers::pi / 3.0;
  const double psi1 = k1 * (0.6 * p.x() + 0.8 * p.y()) - std::sqrt(kGravity * k1) * t + 0.4;
  const double psi2 = -k2 * p.x() - std::numbers::pi * t - 1.0;
  const SurfacePoint surface = surfaceAt(fluid, kGravity, p, t);
  EXPECT_NEAR(surface.height_m, 0.7 + 0.2 * std::sin(psi1) + 0.1 * std::sin(psi2), 1e-14);
  EXPECT_NEAR(surface.slope.x(), 0.2 * k1 * 0.6 * std::cos(psi1) - 0.1 * k2 * std::cos(psi2), 1e-14);
  EXPECT_NEAR(surface.slope.y(), 0.2 * k1 * 0.8 * std::cos(psi1), 1e-14);
  EXPECT_NEAR(fluid.waveHeight(), 0.3, 1e-15);
}

TEST(Fluid, WaterOnTheSurfaceRisesAsTheSurfaceDoes) {
  const Fluid fluid = wavy();
  const double t = 1.9, h = 1e-5;
  for (double x : {0.0, 0.7, 2.2, 4.1}) {
    const Vec2 p(x, 0.3 * x);
    const double rise =
        (surfaceAt(fluid, kGravity, p, t + h).height_m - surfaceAt(fluid, kGravity, p, t - h).height_m) /
        (2.0 * h);
    const WaterMotion water = waterMotionAt(fluid, kGravity, Vec3(p.x(), p.y(), fluid.max.z()), t);
    EXPECT_NEAR(water.velocity.z(), rise, 1e-8);
  }
}

TEST(Fluid, WaterIsIncompressibleIrrotationalAndAcceleratesAsItsVelocityChanges) {
  const Fluid fluid = wavy();
  const double t = 0.8, h = 1e-4;
  const Vec3 p(0.4, -0.3, 0.1);
  const auto velocity = [&](const Vec3& at, double time) {
    return waterMotionAt(fluid, kGravity, at, time).velocity;
  };
  Mat3 gradient;
  for (Eigen::Index i = 0; i < 3; ++i)
    gradient.col(i) = (velocity(p + h * Vec3::Unit(i), t) - velocity(p - h * Vec3::Unit(i), t)) / (2.0 * h);
  EXPECT_NEAR(gradient.trace(), 0.0, 1e-7);
  EXPECT_LT((gradient - gradient.transpose()).norm(), 1e-7);
  const Vec3 change = (velocity(p, t + h) - velocity(p, t - h)) / (2.0 * h);
  EXPECT_LT((waterMotionAt(fluid, kGravity, p, t).acceleration - change).norm(), 1e-6);
}

TEST(Fluid, FlowIsEverywhere) {
  Fluid fluid;
  fluid.flow = Vec3(0.4, -0.2, 0.0);
  EXPECT_EQ(waterMotionAt(fluid, kGravity, Vec3(3.0, 2.0, -9.0), 5.0).velocity, fluid.flow);
}

}  // namespace
}  // namespace carom
