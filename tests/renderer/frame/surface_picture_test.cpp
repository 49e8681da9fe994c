// Surfaces with pictures of their own, and with normals that are not their triangles': what is drawn, and
// what the surface images say of it.
#include <gtest/gtest.h>

#include <cmath>

#include "renderer/frame/frame_renderer.h"

namespace carom::renderer {
namespace {

// A slab of 2 by 2 by 0.2 m shown as a square of that size in its upper plane, whose corners say with `lean`
// that it is rounder than it is.
Solid shownSlab(std::vector<SurfacePicture> pictures, double lean = 0.0, double repeats = 1.0) {
  BoundingSurface look;
  look.mesh.vertices = {{-1, -1, 0.1}, {1, -1, 0.1}, {1, 1, 0.1}, {-1, 1, 0.1}};
  look.mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  for (const Triangle& t : look.mesh.triangles)
    for (const int v : t) {
      const Vec3& p = look.mesh.vertices[static_cast<std::size_t>(v)];
      if (lean > 0.0) look.normals.push_back(Vec3(lean * p.x(), lean * p.y(), 1.0).normalized());
      look.uv.emplace_back(repeats * 0.5 * (1.0 + p.x()), repeats * 0.5 * (1.0 - p.y()));
    }
  look.picture_of.assign(2, pictures.empty() ? -1 : 0);
  look.pictures = std::move(pictures);
  return Solid::box(Vec3(2, 2, 0.2)).shownAs(std::move(look));
}

struct Drawn {
  explicit Drawn(const Solid& solid) : renderer({200, 200}, {&solid, 1}) {
    const Instance one{0, {Quat::Identity(), Vec3::Zero()}, {1.0f, 1.0f, 1.0f}, false};
    image = renderer.draw({&one, 1}, {Vec3(0, -0.001, 5), Vec3(0, 0, 0), 40.0});
  }
  const std::uint8_t* at(double x, double y) const {
    const double focal = 100.0 / std::tan(20.0 * 3.14159265358979 / 180.0);
    return image.pixel(static_cast<int>(100.0 + focal * x / 4.9), static_cast<int>(100.0 - focal * y / 4.9));
  }
  FrameRenderer renderer;
  Image image;
};

TEST(SurfacePicture, IsDrawnWhereItsCornersSay) {
  SurfacePicture four{16, 16, {}};
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) {
      const bool right = x >= 8, low = y >= 8;
      const auto on = [](bool lit) { return static_cast<std::uint8_t>(lit ? 255 : 0); };
      four.rgb.insert(four.rgb.end(), {on(right == low), on(right), on(low)});
    }
  const Solid solid = shownSlab({four});
  const Drawn drawn(solid);
  const std::uint8_t* red = drawn.at(-0.5, 0.5);  // The upper left.
  EXPECT_GT(red[0], 150);
  EXPECT_LT(red[1], 90) << "but for the air in between";
  const std::uint8_t* green = drawn.at(0.5, 0.5);
  EXPECT_GT(green[1], 150);
  EXPECT_LT(green[0], 90);
  const std::uint8_t* blue = drawn.at(-0.5, -0.5);
  EXPECT_GT(blue[2], 150);
  EXPECT_LT(blue[0], 90);
  const std::uint8_t* white = drawn.at(0.5, -0.5);
  EXPECT_GT(std::min({white[0], white[1], white[2]}), 150);
}

// Five hundred stripes a side are narrower than a pixel: no pattern of their own, but the mean of their
// light.
TEST(SurfacePicture, IsTheMeanOfItsLightFromAfar) {
  const SurfacePicture stripes{2, 1, {0, 0, 0, 255, 255, 255}};
  const Solid fine = shownSlab({stripes}, 0.0, 500.0), grey = shownSlab({{1, 1, {188, 188, 188}}});
  const Drawn of_stripes(fine), of_grey(grey);
  for (const double x : {-0.7, -0.2, 0.33, 0.8})
    EXPECT_NEAR(of_stripes.at(x, 0.1)[1], of_grey.at(x, 0.1)[1], 3) << x;
}

TEST(SurfaceImages, OfASmoothSurfaceAreThoseOfItsTriangles) {
  const Solid solid = shownSlab({}, 0.6);
  Drawn drawn(solid);
  const SurfaceImage& surfaces = drawn.renderer.surfaces();
  for (const int pixel : {100 * 200 + 100, 80 * 200 + 60, 130 * 200 + 120}) {
    EXPECT_NEAR(surfaces.depth.depth_m[static_cast<std::size_t>(pixel)], 4.9f, 1e-3f);
    EXPECT_NEAR(surfaces.normal_W[static_cast<std::size_t>(pixel)][2], 1.0f, 1e-5f);
    EXPECT_EQ(surfaces.instance[static_cast<std::size_t>(pixel)], 0);
  }
}

TEST(SurfaceImages, OfWhatLooksOtherwiseDoNotShowTheShape) {
  BoundingSurface look;
  look.mesh.vertices = {{-0.2, -0.2, 0}, {0.2, -0.2, 0}, {0, 0.2, 0}};
  look.mesh.triangles = {{0, 1, 2}};
  const Solid solid = Solid::ball(1.0).shownAs(std::move(look));
  Drawn drawn(solid);
  const SurfaceImage& surfaces = drawn.renderer.surfaces();
  EXPECT_NEAR(surfaces.depth.depth_m[100 * 200 + 100], 5.0f, 1e-3f);
  EXPECT_EQ(surfaces.instance[40 * 200 + 100], kSky) << "the ball is not drawn";
}

}  // namespace
}  // namespace carom::renderer
