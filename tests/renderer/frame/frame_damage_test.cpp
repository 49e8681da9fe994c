#include "renderer/frame/frame_damage.h"

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "renderer/view/projection.h"
#include "renderer/view/shadow_fit.h"

namespace carom::renderer {
namespace {

// Few texels, so that a look-up reaches over many pixels.
constexpr FrameSizes kSizes{1600, 900, 64};
const Camera kCamera{Vec3(2.0, -9.0, 5.0), Vec3(0.0, 0.0, 0.5), 40.0};
const Vec3 kToLight = Vec3(0.5, -0.4, 0.8).normalized();
constexpr double kGround_W = 0.0;

void copyRows(const Eigen::Matrix<double, 3, 4>& from, float (&to)[3][4]) {
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 4; ++c) to[r][c] = static_cast<float>(from(r, c));
}

DrawnBody bodyAt(const Vec3& p_W, double half_m, BodyShader shader = BodyShader::kShadowed) {
  DrawnBody body{};
  Eigen::Matrix<double, 3, 4> rows;
  rows << Eigen::AngleAxisd(p_W.x(), Vec3(1.0, 2.0, 3.0).normalized()).toRotationMatrix(), p_W - kCamera.eye;
  copyRows(rows, body.record.rows);
  for (float& half : body.mesh.half) half = static_cast<float>(half_m);
  body.look.shader = shader;
  return body;
}

class FrameDamageOf : public testing::Test {
 protected:
  FrameDamageOf() {
    const std::array<float, 16> clip = clipFromE(kCamera, kSizes.width, kSizes.height, {1.0, 100.0});
    std::copy(clip.begin(), clip.end(), before_.block.clip_from_E);
    std::vector<ShadowCaster> casters = {
        {{Quat::Identity(), Vec3(0.0, 0.0, 1.0) - kCamera.eye}, Vec3(3.0, 3.0, 1.0)}};
    shadow_ = fitShadow({kCamera, 16.0 / 9.0, kToLight, kSizes.shadow_texels}, casters);
    copyRows(shadow_.rows, before_.block.shadow_rows);
    before_.block.ground[0] = static_cast<float>(kGround_W - kCamera.eye.z());
    now_ = before_;
  }

  Vec3 onMap(const Vec3& p_W) const {
    return shadow_.rows.leftCols<3>() * (p_W - kCamera.eye) + shadow_.rows.col(3);
  }
  // Whether the pixel that shows the point is drawn again; true outside of the image.
  static bool isDamaged(const Damage& damage, const Vec3& p_W) {
    const std::optional<Vec2> pixel = projectToPixel(kCamera, kSizes.width, kSizes.height, p_W);
    if (!pixel) return true;
    const int x = static_cast<int>(std::floor(pixel->x())),
              y = kSizes.height - 1 - static_cast<int>(std::floor(pixel->y()));
    if (x < 0 || y < 0 || x >= kSizes.width || y >= kSizes.height) return true;
    for (const GridBlock& block : damage.blocks())
      if (block.meets({x, x + 1, y, y + 1})) return true;
    return false;
  }
  FrameDamage damage() const { return frameDamage(before_, now_, kSizes); }

  FrameInputs before_, now_;
  ShadowView shadow_;
};

OcclusionTriangle triangleAt(const Vec3& p_W) {
  OcclusionTriangle triangle{};
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 p = p_W - kCamera.eye + 0.2 * Vec3(i == 1 ? 1.0 : 0.0, i == 2 ? 1.0 : 0.0, 0.0);
    for (int k = 0; k < 3; ++k) triangle[i].p_E[k] = static_cast<float>(p[k]);
  }
  return triangle;
}

TEST_F(FrameDamageOf, TheSameInputsIsNone) {
  before_.visible = now_.visible = {bodyAt(Vec3(0.0, 0.0, 1.0), 0.3)};
  before_.casting = now_.casting = before_.visible;
  before_.occlusion = now_.occlusion = {triangleAt(Vec3::Zero())};
  EXPECT_TRUE(damage().image.isEmpty());
  EXPECT_TRUE(damage().shadow_map.isEmpty());
}

TEST_F(FrameDamageOf, AnotherViewIsAllOfIt) {
  now_.block.shadow_rows[0][3] += 0.5f;
  EXPECT_TRUE(damage().image.isWhole());
  EXPECT_TRUE(damage().shadow_map.isWhole());
  now_ = before_;
  now_.ground_seen = !before_.ground_seen;
  EXPECT_TRUE(damage().image.isWhole());
}

TEST_F(FrameDamageOf, AMovedBodyIsWhereItWasAndWhereItIs) {
  const Vec3 from(-1.0, 0.0, 1.0), to(1.5, 1.0, 0.5);
  before_.visible = {bodyAt(from, 0.2), bodyAt(Vec3(0.0, -3.0, 0.5), 0.2)};
  now_.visible = {bodyAt(to, 0.2), before_.visible[1]};
  EXPECT_TRUE(isDamaged(damage().image, from));
  EXPECT_TRUE(isDamaged(damage().image, to));
  EXPECT_FALSE(isDamaged(damage().image, Vec3(0.0, -3.0, 0.5)));
  EXPECT_TRUE(damage().shadow_map.isEmpty()) << "it does not cast";
}

TEST_F(FrameDamageOf, BodiesDrawnInAnotherOrderAreDamagedBothOrWhereTheyMayMeet) {
  const DrawnBody a = bodyAt(Vec3(-0.1, 0.0, 1.0), 0.2), b = bodyAt(Vec3(0.1, 0.0, 1.0), 0.2);
  before_.visible = {a, b};
  now_.visible = {b, a};
  EXPECT_TRUE(isDamaged(damage().image, Vec3(0.0, 0.0, 1.0)));
}

TEST_F(FrameDamageOf, TrianglesThatComeAndGoAreCovered) {
  before_.occlusion = {triangleAt(Vec3(-2.0, 0.0, 0.0)), triangleAt(Vec3(1.0, 2.0, 0.0))};
  now_.occlusion = {triangleAt(Vec3(1.0, 2.0, 0.0)), triangleAt(Vec3(2.0, -1.0, 0.0))};
  EXPECT_TRUE(isDamaged(damage().image, Vec3(-1.95, 0.05, 0.0)));
  EXPECT_TRUE(isDamaged(damage().image, Vec3(2.05, -0.95, 0.0)));
  EXPECT_FALSE(isDamaged(damage().image, Vec3(1.05, 2.05, 0.0)));
}

TEST_F(FrameDamageOf, GroundShadowsThatComeAndGoAreCovered) {
  const auto triangle = [](double x, double y) {
    const auto at = [&](double px, double py) -> std::array<float, 2> {
      return {static_cast<float>(px - kCamera.eye.x()), static_cast<float>(py - kCamera.eye.y())};
    };
    return GroundTriangle{at(x, y), at(x + 0.3, y), at(x, y + 0.3)};
  };
  before_.ground_shadows = {triangle(-2.0, 0.0), triangle(1.0, 2.0)};
  now_.ground_shadows = {triangle(1.0, 2.0), triangle(2.0, -1.0)};
  EXPECT_TRUE(isDamaged(damage().image, Vec3(-1.9, 0.1, kGround_W)));
  EXPECT_TRUE(isDamaged(damage().image, Vec3(2.1, -0.9, kGround_W)));
  EXPECT_FALSE(isDamaged(damage().image, Vec3(1.1, 2.1, kGround_W)));
}

// Points on ground and bodies whose look-up may meet what a caster does to the map: the softening reaches two
// and a half texels, the lift along the normal 2.2.
TEST_F(FrameDamageOf, ShadowsOfACasterThatComesAreCoveredAsFarAsLookUpsReach) {
  constexpr double kLookUp_texels = 4.7;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> across(-3.0, 3.0), share(-1.0, 1.0);
  int checked = 0;
  for (int round = 0; round < 40; ++round) {
    const Vec3 at(across(random), across(random), 3.5), lower = at - 2.6 * kToLight / kToLight.z();
    now_.casting = {bodyAt(at, 0.05)};
    before_.visible = now_.visible = {bodyAt(lower, 0.4)};
    before_.ground_shadows = now_.ground_shadows = {GroundTriangle{}};
    const FrameDamage found = damage();
    if (found.image.isWhole()) continue;
    const Vec3 center = onMap(at);
    for (int i = 0; i < 200; ++i) {
      const Vec3 on_ground(at.x() + across(random), at.y() + across(random), kGround_W);
      const Vec3 in_body = lower + 0.4 * Vec3(share(random), share(random), share(random)).normalized();
      for (const Vec3& p : {on_ground, in_body}) {
        const Vec3 offset = onMap(p) - center;
        if (offset.head<2>().cwiseAbs().maxCoeff() * kSizes.shadow_texels > kLookUp_texels ||
            offset.z() < 0.0)
          continue;
        ++checked;
        EXPECT_TRUE(isDamaged(found.image, p)) << p.transpose();
      }
    }
  }
  EXPECT_GT(checked, 1000);
}

TEST_F(FrameDamageOf, BodiesThatOnlyTheSunReachesAndThoseNearerToItStayAsTheyAre) {
  const Vec3 at(0.0, 0.0, 1.0);
  now_.casting = {bodyAt(at, 0.05)};
  before_.visible =
      now_.visible = {bodyAt(at - kToLight, 0.2, BodyShader::kSunlit), bodyAt(at + 2.0 * kToLight, 0.2)};
  EXPECT_TRUE(damage().image.isEmpty());
  EXPECT_FALSE(damage().shadow_map.isEmpty());
}

TEST_F(FrameDamageOf, TheMapIsDrawnAgainWhereACasterWasAndIs) {
  const Vec3 from(-1.0, 0.0, 1.0), to(1.5, 1.0, 0.5);
  before_.casting = {bodyAt(from, 0.3)};
  now_.casting = {bodyAt(to, 0.3)};
  for (const Vec3& p_W : {from, to}) {
    const int x = static_cast<int>(onMap(p_W).x() * kSizes.shadow_texels),
              y = static_cast<int>(onMap(p_W).y() * kSizes.shadow_texels);
    bool covered = false;
    for (const GridBlock& block : damage().shadow_map.blocks())
      covered = covered || block.meets({x, x + 1, y, y + 1});
    EXPECT_TRUE(covered) << x << "," << y;
  }
}

TEST_F(FrameDamageOf, ABodyBesideTheEyeMayBeAnywhere) {
  now_.visible = {bodyAt(kCamera.eye, 0.3)};
  EXPECT_TRUE(damage().image.isWhole());
}

TEST_F(FrameDamageOf, WhatIsNoNumberMayShadeAnything) {
  now_.casting = {bodyAt(Vec3::Zero(), 0.3)};
  now_.casting[0].record.rows[1][3] = std::numeric_limits<float>::quiet_NaN();
  before_.visible = now_.visible = {bodyAt(Vec3(2.0, 1.0, 0.0), 0.4)};
  EXPECT_TRUE(isDamaged(damage().image, Vec3(2.0, 1.0, 0.0)));
  constexpr int kTexels = 64;
  const GridBlock shaded = shadowMapBounds(now_.block, now_.casting[0], kTexels);
  EXPECT_EQ(shaded.x_begin, 0);
  EXPECT_EQ(shaded.x_end, kTexels);
  EXPECT_EQ(shaded.y_begin, 0);
  EXPECT_EQ(shaded.y_end, kTexels);
}

TEST(ScreenBounds, HoldTheCornersOfABody) {
  FrameBlock block{};
  const std::array<float, 16> clip = clipFromE(kCamera, kSizes.width, kSizes.height, {1.0, 100.0});
  std::copy(clip.begin(), clip.end(), block.clip_from_E);
  const ScreenBounds bounds(block, kSizes.width, kSizes.height);
  const Vec3 at(0.5, 0.4, 1.0);
  const GridBlock found = bounds.of(bodyAt(at, 0.0));
  const Vec2 pixel = *projectToPixel(kCamera, kSizes.width, kSizes.height, at);
  EXPECT_NEAR(0.5 * (found.x_begin + found.x_end), pixel.x(), 1.0);
  EXPECT_NEAR(0.5 * (found.y_begin + found.y_end), kSizes.height - pixel.y(), 1.0);
  EXPECT_GE(found.x_end - found.x_begin, 4);
  EXPECT_LE(found.x_end - found.x_begin, 6);
}

}  // namespace
}  // namespace carom::renderer
