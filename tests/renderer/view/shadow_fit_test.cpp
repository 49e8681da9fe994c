#include "renderer/view/shadow_fit.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace carom::renderer {
namespace {

const Camera kCamera{Vec3(4.0, -9.0, 5.0), Vec3(0.0, 0.0, 1.0), 40.0};
const ShadowRequest kRequest{kCamera, 16.0 / 9.0, Vec3(0.5, -0.4, 0.8), 1024};

ShadowCaster boxAt(const Vec3& p_W, const Vec3& half) {
  return {{Quat(Eigen::AngleAxisd(0.4, Vec3(1, 2, 3).normalized())), p_W - kCamera.eye}, half};
}

Vec3 onMap(const ShadowView& view, const Vec3& p_W) {
  return view.rows.leftCols<3>() * (p_W - kCamera.eye) + view.rows.col(3);
}

TEST(ShadowFit, EveryCornerOfAVisibleCasterIsOnTheMap) {
  const std::vector<ShadowCaster> casters = {boxAt(Vec3(0.5, 0.3, 1.0), Vec3(0.5, 0.4, 0.3)),
                                             boxAt(Vec3(-1.5, 1.0, 0.5), Vec3(0.2, 0.9, 0.3))};
  const ShadowView view = fitShadow(kRequest, casters);
  for (const ShadowCaster& c : casters)
    for (int i = 0; i < 8; ++i) {
      const Vec3 corner((i & 1 ? 1 : -1) * c.half.x(), (i & 2 ? 1 : -1) * c.half.y(),
                        (i & 4 ? 1 : -1) * c.half.z());
      const Vec3 s = onMap(view, c.X_EB * corner + kCamera.eye);
      EXPECT_GT(s.minCoeff(), 0.0);
      EXPECT_LT(s.maxCoeff(), 1.0);
    }
}

TEST(ShadowFit, PointsOnOneRayOfLightShareATexelAndDepthGrowsAlongIt) {
  const ShadowView view = fitShadow(kRequest, std::vector{boxAt(Vec3(0.2, 0.1, 1.0), Vec3(0.5, 0.5, 0.5))});
  const Vec3 above(0.3, 0.2, 1.2), below = above - 0.7 * kRequest.to_light.normalized();
  EXPECT_LT((onMap(view, above) - onMap(view, below)).head<2>().norm(), 1e-12);
  EXPECT_LT(onMap(view, above).z(), onMap(view, below).z());
}

TEST(ShadowFit, ATexelIsAsLargeAsItSays) {
  const ShadowView view = fitShadow(kRequest, std::vector{boxAt(Vec3(0.2, 0.1, 1.0), Vec3(0.5, 0.5, 0.5))});
  const double per_metre = view.rows.row(0).head<3>().norm();
  EXPECT_NEAR(per_metre * view.texel_m * 1024.0, 1.0, 1e-12);
}

TEST(ShadowFit, SmallMotionsMoveTheMapByWholeTexels) {
  const Vec3 fixed(0.3, 0.4, 0.2);
  std::vector<ShadowCaster> casters = {boxAt(Vec3(0, 0, 1), Vec3(0.5, 0.5, 0.5)),
                                       boxAt(Vec3(2.0, 1.0, 1.0), Vec3(0.5, 0.5, 0.5))};
  const ShadowView before = fitShadow(kRequest, casters);
  for (int i = 1; i < 20; ++i) {
    casters[1] = boxAt(Vec3(2.0 + 0.0037 * i, 1.0 + 0.0021 * i, 1.0), Vec3(0.5, 0.5, 0.5));
    const ShadowView after = fitShadow(kRequest, casters);
    if (after.texel_m != before.texel_m) continue;
    const Vec3 shift = 1024.0 * (onMap(after, fixed) - onMap(before, fixed));
    EXPECT_NEAR(shift.x(), std::round(shift.x()), 1e-6);
    EXPECT_NEAR(shift.y(), std::round(shift.y()), 1e-6);
  }
}

TEST(ShadowFit, TheCoveredGroundIsWhatTheMapsCornersFallOn) {
  const ShadowView view = fitShadow(kRequest, std::vector{boxAt(Vec3(0.2, 0.1, 1.0), Vec3(0.5, 0.5, 0.5))});
  const double ground_z = 0.3;
  const std::array<Vec2, 4> corners = coveredGround(view, ground_z - kCamera.eye.z());
  const Vec2 expected[] = {Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)};
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec3 p_W(corners[i].x() + kCamera.eye.x(), corners[i].y() + kCamera.eye.y(), ground_z);
    EXPECT_LT((onMap(view, p_W).head<2>() - expected[i]).norm(), 1e-9) << i;
  }
}

TEST(ShadowFit, WithoutCastersOrBehindTheCameraThereIsNoMap) {
  EXPECT_EQ(fitShadow(kRequest, {}).texel_m, 0.0);
  const std::vector<ShadowCaster> behind = {boxAt(Vec3(8.0, -40.0, 5.0), Vec3(0.5, 0.5, 0.5))};
  EXPECT_EQ(fitShadow({kCamera, 1.0, Vec3(0.01, 0.02, 1.0), 1024}, behind).texel_m, 0.0);
}

TEST(ShadowFit, AFarCasterOutOfViewDoesNotCoarsenTheMap) {
  const std::vector<ShadowCaster> near = {boxAt(Vec3(0, 0, 1), Vec3(0.5, 0.5, 0.5))};
  std::vector<ShadowCaster> both = near;
  both.push_back(boxAt(Vec3(500.0, -1000.0, 1.0), Vec3(0.5, 0.5, 0.5)));
  // It lies behind the camera, and its shadow too.
  EXPECT_LT(fitShadow({kCamera, 1.0, Vec3(0.01, 0.02, 1.0), 1024}, both).texel_m,
            1.5 * fitShadow({kCamera, 1.0, Vec3(0.01, 0.02, 1.0), 1024}, near).texel_m);
}

}  // namespace
}  // namespace carom::renderer
