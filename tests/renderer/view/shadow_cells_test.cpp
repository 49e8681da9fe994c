#include "renderer/view/shadow_cells.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace carom::renderer {
namespace {

const Camera kCamera{Vec3(4.0, -9.0, 5.0), Vec3(0.0, 0.0, 1.0), 40.0};
const ShadowRequest kRequest{kCamera, 16.0 / 9.0, Vec3(0.5, -0.4, 0.8), 1024};
const double kGround_E = -kCamera.eye.z();

std::vector<ShadowCaster> scattered(unsigned seed, int count) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-3.0, 3.0), size(0.05, 0.4);
  std::vector<ShadowCaster> casters;
  for (int i = 0; i < count; ++i) {
    const Quat turned(Eigen::AngleAxisd(place(random), Vec3(1.0, 2.0, place(random)).normalized()));
    const Vec3 p_W(place(random), place(random), 3.5 + place(random));
    casters.push_back({{turned, p_W - kCamera.eye}, Vec3(size(random), size(random), size(random))});
  }
  return casters;
}

Vec3 pointIn(const ShadowCaster& caster, std::mt19937& random) {
  std::uniform_real_distribution<double> share(-1.0, 1.0);
  return caster.X_EB * Vec3(share(random) * caster.half.x(), share(random) * caster.half.y(),
                            share(random) * caster.half.z());
}

bool within(const std::vector<GroundTriangle>& triangles, const Vec2& p) {
  const auto side = [&](const std::array<float, 2>& a, const std::array<float, 2>& b) {
    return (b[0] - a[0]) * (p.y() - a[1]) - (b[1] - a[1]) * (p.x() - a[0]);
  };
  for (const auto& [a, b, c] : triangles) {
    const double s0 = side(a, b), s1 = side(b, c), s2 = side(c, a);
    if ((s0 >= 0.0 && s1 >= 0.0 && s2 >= 0.0) || (s0 <= 0.0 && s1 <= 0.0 && s2 <= 0.0)) return true;
  }
  return false;
}

TEST(ShadowCells, WhereACastersShadowFallsOnTheGroundIsCovered) {
  std::mt19937 random(3);
  for (unsigned seed = 0; seed < 20; ++seed) {
    const std::vector<ShadowCaster> casters = scattered(seed, 4);
    const ShadowView view = fitShadow(kRequest, casters);
    const auto triangles = ShadowCells(view, casters).groundTriangles(kGround_E, 1e3);
    for (const ShadowCaster& caster : casters)
      for (int i = 0; i < 20; ++i) {
        const Vec3 p = pointIn(caster, random), down = kRequest.to_light.normalized();
        const Vec3 on_ground = p - ((p.z() - kGround_E) / down.z()) * down;
        const Vec2 uv = view.rows.topLeftCorner<2, 3>() * on_ground + view.rows.block<2, 1>(0, 3);
        if (uv.minCoeff() < 0.0 || uv.maxCoeff() > 1.0) continue;  // Outside the map there are no shadows.
        EXPECT_TRUE(within(triangles, on_ground.head<2>())) << seed;
      }
  }
}

TEST(ShadowCells, MostOfTheGroundIsNot) {
  const std::vector<ShadowCaster> casters = {
      {{Quat::Identity(), Vec3(-2.0, 0.0, 1.0) - kCamera.eye}, Vec3(0.2, 0.2, 0.2)},
      {{Quat::Identity(), Vec3(2.0, 1.0, 1.0) - kCamera.eye}, Vec3(0.2, 0.2, 0.2)}};
  const ShadowCells cells(fitShadow(kRequest, casters), casters);
  const auto triangles = cells.groundTriangles(kGround_E, 1e3);
  double covered_m2 = 0.0;
  for (const auto& [a, b, c] : triangles)
    covered_m2 += 0.5 * std::abs((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
  EXPECT_GT(covered_m2, 2.0 * 0.16);
  EXPECT_LT(covered_m2, 3.0);  // Of a map some five metres wide.
}

TEST(ShadowCells, WithoutAMapThereIsNothingToLookUp) {
  const std::vector<ShadowCaster> casters = scattered(1, 3);
  const ShadowCells cells(ShadowView{}, casters);
  EXPECT_TRUE(cells.groundTriangles(kGround_E, 1e3).empty());
}

TEST(ShadowCells, ALightAlongTheGroundGivesNoTriangles) {
  const std::vector<ShadowCaster> casters = scattered(2, 3);
  const ShadowRequest low{kCamera, 16.0 / 9.0, Vec3(1.0, 0.2, 0.0), 1024};
  EXPECT_TRUE(ShadowCells(fitShadow(low, casters), casters).groundTriangles(kGround_E, 1e3).empty());
}

}  // namespace
}  // namespace carom::renderer
