#include "demos/figure/figures.h"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "demos/figure/figure_contacts.h"
#include "demos/figure/figure_distance.h"
#include "demos/figure/figure_manifold.h"
#include "demos/figure/figure_regions.h"
#include "demos/figure/figure_support.h"
#include "demos/figure/figure_window.h"
#include "engine/closest_features/pair/v_region.h"
#include "engine/modes/support_polygon.h"
#include "tests/demos/support/shown_overlays.h"

namespace carom::demos {
namespace {

using namespace figure_color;
constexpr PageSize kPage{1280, 720};

Vec2 pixelOf(const renderer::Camera& camera, const Vec3& p_W) {
  return *renderer::projectToPixel(camera, kPage.width, kPage.height, p_W);
}

// A colour laid over white paper.
renderer::Color overPaper(const renderer::Color& c, float opacity) {
  const auto mix = [&](float channel) { return opacity * channel + 1.0f - opacity; };
  return {mix(c.r), mix(c.g), mix(c.b)};
}

TEST(Figures, AreTheSameBytesEachTimeAndCaptionedOnWhitePaper) {
  for (int number = 1; number <= kFigures; ++number) {
    const renderer::Image image = drawFigure(number, {640, 360});
    EXPECT_EQ(image.rgb, drawFigure(number, {640, 360}).rgb) << number;
    const PageSize size{640, 360};
    int ink = 0, white = 0;
    for (int y = static_cast<int>(captionTop(size)) + 4; y < 360; ++y)
      for (int x = 0; x < 640; ++x) {
        ink += image.pixel(x, y)[0] < 100;
        white += image.pixel(x, y)[0] == 255;
      }
    EXPECT_GT(ink, 400) << number;
    EXPECT_GT(white, ink) << number;
    for (int y = 0; y < 360; ++y) EXPECT_EQ(image.pixel(0, y)[0] & image.pixel(639, y)[2], 255) << number;
    for (int y = static_cast<int>(captionTop(size)) + 4; y < 360; ++y)
      for (int x = 628; x < 640; ++x)
        EXPECT_EQ(image.pixel(x, y)[0], 255) << number << ": a caption is cut off";
  }
}

// The oracle: a point lies in a region when no way off its feature climbs towards it.
TEST(Figure1, EverySampleIsDrawnInTheColourOfTheRegionItLiesIn) {
  const RegionFigure figure = regionFigure(kPage);
  const renderer::Image image = drawRegionFigure(figure, kPage);
  const ConvexPolyhedron& core = figure.solid.parts()[0].core;
  std::array<int, 3> counts{};
  int drawn = 0;
  for (const RegionFigure::Sample& sample : figure.samples) {
    const Feature feature = figure.features[sample.feature];
    Vec3 on_feature = Vec3::Zero();
    if (feature.kind == FeatureKind::kVertex) on_feature = core.vertex(feature.index);
    if (feature.kind == FeatureKind::kEdge) on_feature = core.vertex(core.edge(feature.index).tail);
    if (feature.kind == FeatureKind::kFace) {
      for (const Plane& side : core.faceSides(feature.index)) EXPECT_GE(side.signedDistance(sample.p_W), 0.0);
      EXPECT_GT(core.plane(feature.index).signedDistance(sample.p_W), 0.0);
    } else {
      EXPECT_LE(steepestWayOff(core, feature, sample.p_W - on_feature).slope, 1e-12);
    }
    ++counts[sample.feature];
    drawn += inked(image, pixelOf(figure.camera, sample.p_W), regionColor(sample.feature), 1, 60);
  }
  for (int count : counts) EXPECT_GE(count, 5);
  EXPECT_GT(drawn, static_cast<int>(0.8 * static_cast<double>(figure.samples.size()))) << "names cover some";
}

class ContactFigures : public ::testing::TestWithParam<int> {};

TEST_P(ContactFigures, ShowTheirStateWithPointAndNormalInPlace) {
  const ContactFigure figure = contactFigure(GetParam(), kPage);
  const renderer::Image image = drawContactFigure(figure, kPage);
  const ContactState states[] = {ContactState::kVertexFace, ContactState::kVertexVertex,
                                 ContactState::kVertexEdge, ContactState::kEdgeEdge};
  EXPECT_EQ(contactStateOf(figure.closest.features), states[GetParam() - 2]);
  // The normal by itself: it runs along the witnesses, and the point is halfway.
  const Vec3 between = figure.closest.p_B_W - figure.closest.p_A_W;
  EXPECT_LT((figure.contact.n_W - between.normalized()).norm(), 1e-6);
  EXPECT_LT((figure.contact.p_W - 0.5 * (figure.closest.p_A_W + figure.closest.p_B_W)).norm(), 1e-9);
  const Vec3 p = figure.contact.p_W, n = figure.contact.n_W;
  EXPECT_TRUE(inked(image, pixelOf(figure.camera, p), kRed, 0));
  for (double share : {0.3, 0.5, 0.7, 0.93})
    EXPECT_TRUE(inked(image, pixelOf(figure.camera, p + share * kFigureNormal_m * n), kRed)) << share;
  EXPECT_FALSE(inked(image, pixelOf(figure.camera, p - 0.4 * kFigureNormal_m * n), kRed, 2));
  EXPECT_FALSE(inked(image, pixelOf(figure.camera, p + 1.12 * kFigureNormal_m * n), kRed, 2));
}

// What of each body is closest, in its colour: a point on the border of the feature, known from the scene.
TEST(Figure2, TheFaceIsOutlinedInBlue) {
  const ContactFigure figure = contactFigure(2, kPage);
  const renderer::Image image = drawContactFigure(figure, kPage);
  EXPECT_TRUE(inked(image, pixelOf(figure.camera, {0.4, -1.2, 0.4}), kBlue));
  EXPECT_TRUE(inked(image, pixelOf(figure.camera, {1.2, 0.2, 0.4}), kBlue));
}

TEST(Figure3, BothVerticesAreMarked) {
  const ContactFigure figure = contactFigure(3, kPage);
  const renderer::Image image = drawContactFigure(figure, kPage);
  EXPECT_TRUE(inked(image, pixelOf(figure.camera, {0.0, 0.0, 1.0}), kBlue, 3)) << "the pyramid's apex";
  EXPECT_TRUE(inked(image, pixelOf(figure.camera, figure.closest.p_B_W), kOrange, 4));
}

TEST(Figure4, XStandsOnTheEdge) {
  const ContactFigure figure = contactFigure(4, kPage);
  const renderer::Image image = drawContactFigure(figure, kPage);
  const Vec3 x = figure.closest.p_A_W;
  EXPECT_NEAR(x.x(), 0.0, 1e-9);
  EXPECT_NEAR(x.z(), 1.0, 1e-9);
  EXPECT_TRUE(inked(image, pixelOf(figure.camera, x), kBlue));
  EXPECT_TRUE(inked(image, pixelOf(figure.camera, {0.0, -0.9, 1.0}), kBlue)) << "the ridge";
}

TEST(Figure5, TheNormalIsTheProductOfTheEdgesDirections) {
  const ContactFigure figure = contactFigure(5, kPage);
  const renderer::Image image = drawContactFigure(figure, kPage);
  const Vec3 e1 = figure.X_WA.rotation * figure.part_a->core.edge(figure.closest.features.a.index).direction;
  const Vec3 e2 = figure.X_WB.rotation * figure.part_b->core.edge(figure.closest.features.b.index).direction;
  EXPECT_LT(figure.contact.n_W.cross(e1.cross(e2).normalized()).norm(), 1e-9);
  EXPECT_TRUE(inked(image, pixelOf(figure.camera, figure.closest.p_A_W + 0.5 * kFigureNormal_m * e1), kBlue));
  EXPECT_TRUE(
      inked(image, pixelOf(figure.camera, figure.closest.p_B_W + 0.5 * kFigureNormal_m * e2), kOrange));
}

INSTANTIATE_TEST_SUITE_P(Numbers, ContactFigures, ::testing::Values(2, 3, 4, 5));

// The rod's lowest point in closed form: the parabola of its centre less the reach of a turned rectangle.
double rodHeight(double t) {
  const double centre = 0.82 + 1.75 * t - 0.5 * 9.81 * t * t, angle = 0.5 + 24.0 * t;
  return centre - 0.8 * std::abs(std::sin(angle)) - 0.11 * std::abs(std::cos(angle));
}

TEST(Plot, RunsRightAndUpBetweenItsCorners) {
  const Plot plot({Vec2(100.0, 50.0), Vec2(300.0, 150.0)}, {0.0, 2.0}, {-1.0, 1.0});
  EXPECT_LT((plot.pixel(0.0, -1.0) - Vec2(100.0, 150.0)).norm(), 1e-12);
  EXPECT_LT((plot.pixel(2.0, 1.0) - Vec2(300.0, 50.0)).norm(), 1e-12);
  EXPECT_LT((plot.pixel(0.5, 0.5) - Vec2(150.0, 75.0)).norm(), 1e-12);
}

TEST(Figure6, TheCurvePassesWhereTheClosedFormSaysAndZeroAtTheEnginesRoots) {
  const DistanceFigure figure = distanceFigure();
  const renderer::Image image = drawDistanceFigure(figure, kPage);
  const Plot plot = figure.plot(kPage);
  for (double t = 0.013; t < 0.4; t += 0.0171) {
    EXPECT_NEAR(figure.freeDistance(t), rodHeight(t), 1e-9) << t;
    EXPECT_TRUE(inked(image, plot.pixel(t, rodHeight(t)), kBlue)) << t;
  }
  ASSERT_GE(figure.roots_s.size(), 3u);
  for (std::size_t i = 0; i < figure.roots_s.size(); ++i) {
    const double root = figure.roots_s[i], way = i % 2 == 0 ? 1.0 : -1.0;  // in, then out
    EXPECT_GT(way * rodHeight(root - 2e-4), 0.0) << root;
    EXPECT_LT(way * rodHeight(root + 2e-4), 0.0) << root;
    EXPECT_TRUE(inked(image, plot.pixel(root, 0.0), kRed, 0));
  }
  // No other root: the sign of the closed form changes only there.
  std::size_t changes = 0;
  for (double t = 0.0; t + 1e-4 < figure.duration_s; t += 1e-4)
    changes += rodHeight(t) * rodHeight(t + 1e-4) < 0.0;
  EXPECT_EQ(changes, figure.roots_s.size());
  EXPECT_NEAR(figure.collision_s, figure.roots_s[0], 1e-4);
  for (const Vec2& p : figure.run_curve) EXPECT_GT(p.y(), 0.0) << "the run never gets below zero";
  const double inside = 0.5 * (figure.roots_s[0] + figure.roots_s[1]);
  EXPECT_LT(figure.freeDistance(inside), 0.0);
}

TEST(Figure7, TheImpulseActsInsideTheWindowAndTheCurveIsTheFall) {
  const WindowFigure figure = windowFigure();
  const renderer::Image image = drawWindowFigure(figure, kPage);
  const Plot plot = figure.plot(kPage);
  const CollisionWindow& w = figure.window;
  EXPECT_GT(figure.impulse_gap_m, w.floor);
  EXPECT_LE(figure.impulse_gap_m, w.ceiling * (1.0 + 1e-9));
  for (const WindowFigure::Instant& i : figure.run) EXPECT_GE(i.gap_m, w.floor);
  const auto fall = [](double t) { return 4.2e-3 - 0.5 * t - 0.5 * 9.81 * t * t; };
  EXPECT_NEAR(figure.impulse_gap_m, fall(figure.impulse_s), 1e-9);
  for (double t = 0.0005; t < figure.impulse_s - 3e-4; t += 3.7e-4)
    EXPECT_TRUE(inked(image, plot.pixel(1000.0 * t, 1000.0 * fall(t)), kBlue)) << t;
  EXPECT_TRUE(inked(image, plot.pixel(1000.0 * figure.impulse_s, 1000.0 * figure.impulse_gap_m), kRed, 0));
  EXPECT_TRUE(inked(image, plot.pixel(11.3, 1000.0 * w.floor), kRed));
  EXPECT_TRUE(inked(image, plot.pixel(11.3, 1000.0 * w.ceiling), kGreen));
  EXPECT_TRUE(
      inked(image, plot.pixel(11.3, 500.0 * (w.floor + w.ceiling) + 0.11), overPaper(kGreen, 0.14f), 0, 8));
  // The cut beside it has the same levels, and the cube's edge at the impulse's height.
  const Plot cut = figure.cut(kPage);
  EXPECT_TRUE(inked(image, cut.pixel(1.0, 1000.0 * w.floor), kRed, 1, 75));
  EXPECT_TRUE(inked(image, cut.pixel(-1.3, 1000.0 * w.ceiling), kGreen, 1, 75));
  EXPECT_TRUE(inked(image, cut.pixel(0.0, 1000.0 * figure.impulse_gap_m), kBlue, 2));
  EXPECT_TRUE(inked(image, cut.pixel(-1.0, 0.0), kInk)) << "the plate's surface";
}

TEST(Figure8, TheCornersAreThoseOfTheClippedFaceAndDrawnInPlace) {
  const ManifoldFigure figure = manifoldFigure(kPage);
  const renderer::Image image = drawManifoldFigure(figure, kPage);
  // The oracle: a fine grid of the upper slab's lower face; what of it is over F and not higher than k.
  Vec2 low(1e9, 1e9), high(-1e9, -1e9);
  const double top = 0.3, step = 1.0 / 400.0;
  for (double u = -1.0; u <= 1.0 + 1e-9; u += step)
    for (double v = -1.0; v <= 1.0 + 1e-9; v += step) {
      const Vec3 p = figure.X_WAbove * Vec3(0.65 * u, 0.31 * v, -0.15);
      if (std::abs(p.x()) > 0.75 || std::abs(p.y()) > 0.6 || p.z() - top > figure.window.manifold) continue;
      low = low.cwiseMin(Vec2(p.x(), p.y()));
      high = high.cwiseMax(Vec2(p.x(), p.y()));
    }
  Vec2 corner_low(1e9, 1e9), corner_high(-1e9, -1e9);
  ASSERT_GE(figure.polygon.corners.size(), 5u);
  for (const PolygonCorner& corner : figure.polygon.corners) {
    corner_low = corner_low.cwiseMin(Vec2(corner.p_W.x(), corner.p_W.y()));
    corner_high = corner_high.cwiseMax(Vec2(corner.p_W.x(), corner.p_W.y()));
    EXPECT_LE(corner.gap_m, figure.window.manifold * (1.0 + 1e-6));
    const Vec2 at = pixelOf(figure.camera, corner.p_W);
    EXPECT_TRUE(inked(image, at, kOrange, 2) || inked(image, at, kRed, 2));
  }
  int drawn_sides = 0;
  const std::size_t count = figure.polygon.corners.size();
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 middle = 0.5 * (figure.polygon.corners[i].p_W + figure.polygon.corners[(i + 1) % count].p_W);
    drawn_sides += inked(image, pixelOf(figure.camera, middle), kOrange, 1, 30);
  }
  EXPECT_GE(drawn_sides, static_cast<int>(count) - 2) << "names cover some";
  EXPECT_LT((corner_low - low).norm(), 5e-3);
  EXPECT_LT((corner_high - high).norm(), 5e-3);
  const Plot side = figure.side(kPage);
  for (const PolygonCorner& corner : figure.polygon.corners)
    EXPECT_TRUE(inked(image, side.pixel(figure.inSide(corner.p_W).x(), 1000.0 * corner.gap_m), kOrange));
  EXPECT_TRUE(inked(image, side.pixel(-0.4, 1000.0 * figure.window.manifold), kGreen));
  EXPECT_TRUE(inked(image, side.pixel(-0.4, 1000.0 * (3e-4 + 1.6e-3 * 1.05)), kBlue)) << "the tilted face";
  for (const ManifoldPoint& point : figure.manifold.view())
    EXPECT_TRUE(inked(image, pixelOf(figure.camera, point.p_W), kRed, 0));
}

TEST(Figure9And10, TheCoverHoldsAllPointsAndTheProjectionIsUnderTheCentre) {
  const SupportFigure figure = supportFigure(kPage);
  const renderer::Image image = drawSupportFigure(figure, kPage), plan = drawSupportPlan(figure, kPage);
  const Plot axes = figure.plan(kPage);
  ASSERT_EQ(figure.points_W.size(), 12u) << "three legs of four corners";
  std::vector<Vec2> cover;
  for (const Vec3& p : figure.cover_W) cover.emplace_back(p.x(), p.y());
  for (const Vec3& p : figure.points_W) {
    // The legs' corners, known from the table; each inside all half planes of the cover (clockwise or not).
    bool is_corner = false;
    for (const Vec2& leg : {Vec2(-0.52, -0.34), Vec2(0.56, -0.2), Vec2(-0.1, 0.36)})
      is_corner = is_corner ||
                  ((Vec2(p.x(), p.y()) - leg).cwiseAbs() - Vec2(0.06, 0.06)).cwiseAbs().maxCoeff() < 2e-3;
    EXPECT_TRUE(is_corner) << p.transpose();
    double least = 1e9, most = -1e9;
    for (std::size_t i = 0; i < cover.size(); ++i) {
      const Vec2 a = cover[i], d = cover[(i + 1) % cover.size()] - a, r = Vec2(p.x(), p.y()) - a;
      least = std::min(least, d.x() * r.y() - d.y() * r.x());
      most = std::max(most, d.x() * r.y() - d.y() * r.x());
    }
    EXPECT_TRUE(least > -1e-9 || most < 1e-9);
    EXPECT_TRUE(inked(plan, axes.pixel(p.x(), p.y()), kOrange, 0));
  }
  EXPECT_EQ(figure.outside_m, 0.0);
  EXPECT_LT(
      (Vec2(figure.foot_W.x(), figure.foot_W.y()) - Vec2(figure.center_W.x(), figure.center_W.y())).norm(),
      1e-12);
  EXPECT_TRUE(inked(plan, axes.pixel(figure.center_W.x(), figure.center_W.y()), kRed, 0));
  EXPECT_TRUE(inked(image, pixelOf(figure.camera, figure.center_W), kRed, 0));
  EXPECT_TRUE(inked(image, pixelOf(figure.camera, figure.foot_W), kRed, 1));
  EXPECT_TRUE(inked(image, pixelOf(figure.camera, 0.5 * (figure.center_W + figure.foot_W)), kRed));
  const Vec2 inside = axes.pixel(0.07, 0.13);
  EXPECT_TRUE(inked(plan, inside, overPaper(kGreen, 0.25f), 0, 10));
  EXPECT_TRUE(inked(plan, axes.pixel(-0.5, 0.33), kPaper, 0, 8)) << "outside the cover";
}

}  // namespace
}  // namespace carom::demos
