#include "renderer/drawing/overlay_painter.h"

#include <array>
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace carom::renderer {
namespace {

constexpr int kWidth = 320, kHeight = 180;
constexpr Color kWhite = {1.0f, 1.0f, 1.0f}, kBlack = {0.0f, 0.0f, 0.0f};

// Looks along +y from 10 m: right is +x, up is +z, depth is y + 10.
const Camera kCamera{{0.0, -10.0, 0.0}, {0.0, 0.0, 0.0}, 40.0};

DepthImage flatDepth(double left_m, double right_m) {
  DepthImage depth{kWidth, kHeight, {}};
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      depth.depth_m.push_back(static_cast<float>(x < kWidth / 2 ? left_m : right_m));
  return depth;
}

double darkness(const Image& image, const Vec2& at) {
  const int x = static_cast<int>(std::floor(at.x())), y = static_cast<int>(std::floor(at.y()));
  return 1.0 - image.pixel(x, y)[0] / 255.0;
}

// The darkness of the darkest pixel near a point.
double darkest(const Image& image, const Vec2& at, int reach = 1) {
  double most = 0.0;
  for (int dy = -reach; dy <= reach; ++dy)
    for (int dx = -reach; dx <= reach; ++dx) most = std::max(most, darkness(image, at + Vec2(dx, dy)));
  return most;
}

struct Painted {
  explicit Painted(DepthImage of = {}, const Camera& camera = kCamera)
      : depth(std::move(of)), canvas(kWidth, kHeight, kWhite), painter(canvas, camera, depth) {}
  DepthImage depth;
  Canvas canvas;
  OverlayPainter painter;
};

TEST(OverlayPainter, PointsAreWhereTheProjectionSays) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> coordinate(-4.0, 4.0);
  for (int i = 0; i < 40; ++i) {
    const Camera camera{Vec3(coordinate(random), coordinate(random), 6.0), Vec3(0.1, 0.2, -1.0), 50.0};
    Painted painted({}, camera);
    const Vec3 p_W = 0.3 * Vec3(coordinate(random), coordinate(random), coordinate(random));
    const Vec2 expected = *projectToPixel(camera, kWidth, kHeight, p_W);
    ASSERT_LT((*painted.painter.pixel(p_W) - expected).norm(), 1e-9);
    painted.painter.dot(p_W, 3.0, {kBlack});
    if (expected.x() < 6 || expected.y() < 6 || expected.x() > kWidth - 6 || expected.y() > kHeight - 6)
      continue;
    const Image image = painted.canvas.image();
    EXPECT_GT(darkness(image, expected), 0.95);
    EXPECT_EQ(darkness(image, expected + Vec2(0.0, 5.0)), 0.0);
  }
}

TEST(OverlayPainter, WhatIsHiddenIsFaintAndDashed) {
  Painted painted(flatDepth(5.0, 20.0));  // a wall in front of the left half
  const Vec3 a(-2.0, 0.0, 0.0), b(2.0, 0.0, 0.0);
  painted.painter.line(a, b, {{kBlack}, 2.0});
  const Image image = painted.canvas.image();
  double left = 0.0, right = 0.0;
  int gaps_left = 0, gaps_right = 0, samples = 0;
  for (double x = 0.15; x < 1.9; x += 0.05) {
    const double hidden = darkest(image, *painted.painter.pixel({-x, 0.0, 0.0}), 0);
    const double visible = darkest(image, *painted.painter.pixel({x, 0.0, 0.0}), 0);
    left = std::max(left, hidden);
    right += visible;
    gaps_left += hidden < 0.05;
    gaps_right += visible < 0.9;
    ++samples;
  }
  EXPECT_NEAR(left, kHiddenOpacity, 0.06);
  EXPECT_GT(gaps_left, samples / 8);
  EXPECT_EQ(gaps_right, 0);
  EXPECT_GT(right / samples, 0.95);
}

TEST(OverlayPainter, MarksOnTheSurfaceAreVisibleAndJustBehindItAreNot) {
  Painted painted(flatDepth(10.0, 10.0));
  EXPECT_FALSE(painted.painter.isHidden({0.5, 0.0, 0.5}));
  EXPECT_FALSE(painted.painter.isHidden({0.5, -1.0, 0.5}));
  EXPECT_TRUE(painted.painter.isHidden({0.5, 0.05, 0.5}));
  painted.painter.setLift(0.5);
  EXPECT_FALSE(painted.painter.isHidden({0.5, 0.4, 0.5})) << "inside a body of that size";
  EXPECT_TRUE(painted.painter.isHidden({0.5, 0.6, 0.5}));
}

TEST(OverlayPainter, AnAreaIsFainterWhereItIsHidden) {
  Painted painted(flatDepth(20.0, 9.0));
  // It leans: in front of the wall on the right side's upper part only.
  const std::array<Vec3, 4> corners = {Vec3(-2, 3, -1.5), Vec3(2, 3, -1.5), Vec3(2, -3, 1.5),
                                       Vec3(-2, -3, 1.5)};
  painted.painter.area(corners, {kBlack, 0.8});
  const Image image = painted.canvas.image();
  const auto at = [&](double x, double share) {
    return darkness(image, *painted.painter.pixel({x, 3.0 - 6.0 * share, -1.5 + 3.0 * share}));
  };
  EXPECT_NEAR(at(-1.0, 0.2), 0.8, 0.02);
  EXPECT_NEAR(at(-1.0, 0.8), 0.8, 0.02);
  EXPECT_NEAR(at(1.0, 0.2), 0.8 * kHiddenOpacity, 0.02);
  EXPECT_NEAR(at(1.0, 0.6), 0.8 * kHiddenOpacity, 0.02) << "9.4 m away, behind 9 m";
  EXPECT_NEAR(at(1.0, 0.8), 0.8, 0.02) << "8.2 m away";
}

TEST(OverlayPainter, AnArrowLeadsFromItsFootToItsTipAndIsWidestAtTheHead) {
  Painted painted;
  const Vec3 foot(-1.0, 0.0, -0.5), tip(1.0, 0.0, 0.5);
  painted.painter.arrow(foot, tip, {{kBlack}, 3.0});
  const Image image = painted.canvas.image();
  const Vec2 from = *painted.painter.pixel(foot), to = *painted.painter.pixel(tip);
  const Vec2 along = (to - from).normalized(), across(-along.y(), along.x());
  EXPECT_GT(darkest(image, from), 0.9);
  EXPECT_GT(darkest(image, to - 2.0 * along), 0.9);
  EXPECT_EQ(darkest(image, to + 4.0 * along), 0.0);
  const auto width = [&](const Vec2& at) {
    int inked = 0;
    for (double s = -10.0; s <= 10.0; s += 0.5) inked += darkness(image, at + s * across) > 0.5;
    return 0.5 * inked;
  };
  EXPECT_NEAR(width(0.5 * (from + to)), 3.0, 1.1);
  EXPECT_GT(width(to - 14.0 * along), 7.0);
  EXPECT_LT(width(to - 3.0 * along), 5.0);
}

TEST(OverlayPainter, ALineThatPassesTheEyeIsCutThere) {
  Painted painted;
  painted.painter.line({0.3, -30.0, 0.2}, {0.3, 8.0, 0.2}, {{kBlack}, 2.0});
  const Image image = painted.canvas.image();
  EXPECT_GT(darkest(image, *painted.painter.pixel({0.3, 5.0, 0.2})), 0.9);
  EXPECT_GT(darkest(image, *painted.painter.pixel({0.3, -8.0, 0.2})), 0.9);
  EXPECT_EQ(darkest(image, *painted.painter.pixel({-0.3, -8.0, -0.2}), 0), 0.0) << "nothing mirrored";
  EXPECT_FALSE(painted.painter.pixel({0.3, -12.0, 0.2}).has_value());
}

TEST(OverlayPainter, LabelsStandBesideTheirPointsAndNeverOnEachOther) {
  Painted painted;
  painted.painter.reserve({{0.0, 0.0}, {kWidth, 0.4 * kHeight}});
  int written = 0;
  for (int i = 0; i < 30; ++i) {
    Canvas before(painted.canvas.image());
    const bool done = painted.painter.label({0.05 * (i % 5), 0.0, -0.02 * i}, "body " + std::to_string(i),
                                            {14.0, {kBlack}});
    const Image now = painted.canvas.image(), then = before.image();
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const bool changed = *now.pixel(x, y) != *then.pixel(x, y);
        ASSERT_FALSE(changed && (!done || y < static_cast<int>(0.4 * kHeight) - 1)) << i;
        ASSERT_FALSE(changed && *then.pixel(x, y) < 128) << "label " << i << " covers another";
      }
    written += done;
  }
  EXPECT_GT(written, 4);
  EXPECT_LT(written, 30) << "there is not room for all";
}

}  // namespace
}  // namespace carom::renderer
