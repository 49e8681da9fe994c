#include "demos/format/formatted.h"
#include "demos/overlay/overlays.h"

#include <fstream>

#include <gtest/gtest.h>

#include "demos/overlay/contact_overlays.h"
#include "demos/overlay/mode_colors.h"
#include "demos/overlay/motion_overlays.h"
#include "demos/overlay/panel_overlays.h"
#include "engine/contact/contact_manifold.h"
#include "tests/demos/support/shown_overlays.h"
#include "tests/support/temporary_folder.h"

namespace carom::demos {
namespace {

using namespace overlay_color;

// A block of 0.6 x 0.4 x 0.3 that lies on a plate, and a ball thrown past it.
class Block : public ::testing::Test {
 protected:
  static constexpr Vec3::Scalar kHalfX = 0.3, kHalfY = 0.2;
  std::filesystem::path file(const std::string& more = "") const {
    const std::filesystem::path path = folder_.path() / "block.json";
    std::ofstream(path) << R"({ "format": 1, "description": "a block", "rate": 240, "duration": 4,
      "materials": { "m": { "density": 1000 } },
      "bodies": [
        { "name": "plate", "shape": { "box": [6, 6, 1] }, "position": [0, 0, -0.5], "static": true, "material": "m" },
        { "name": "block", "shape": { "box": [0.6, 0.4, 0.3] }, "position": [0, 0, 0.151], "material": "m" })"
                        << more << R"( ],
      "cameras": { "main": { "eye": [1.6, -2.6, 1.5], "target": [0, 0, 0.3], "fovDegrees": 32 } } })";
    return path;
  }
  static constexpr const char* kBall =
      R"(, { "name": "ball", "shape": { "sphere": { "radius": 0.1 } }, "position": [-0.9, 0.5, 0.6],
          "linearVelocity": [2, 0.5, 1], "angularVelocity": [0, 0, 5], "material": "m" })";

 private:
  TemporaryFolder folder_;
};

TEST(ClosestOverlay, WitnessPointsAndFeaturesAreWhereTheProjectionSays) {
  const ShownOverlays run(findScene("contact-vertex-face"), "closest", 5);
  // The cube's lowest corner over the plate, whose top is at 0.4: both from the state alone.
  Vec3 lowest(0.0, 0.0, 1e9);
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 p_B(corner & 1 ? 0.35 : -0.35, corner & 2 ? 0.35 : -0.35, corner & 4 ? 0.35 : -0.35);
    const Vec3 p_W = run.state.bodies[2].X_WB * p_B;
    if (p_W.z() < lowest.z()) lowest = p_W;
  }
  EXPECT_TRUE(run.inked(lowest, kRed));
  EXPECT_TRUE(run.inked({lowest.x(), lowest.y(), 0.4}, kRed));
  EXPECT_TRUE(run.inked({lowest.x(), lowest.y(), 0.5 * (0.4 + lowest.z())}, kBlack))
      << "the line between them";
  for (const Vec2& side : {Vec2(1.2, 0.3), Vec2(-1.2, 0.3), Vec2(0.3, 1.2), Vec2(0.3, -1.2)})
    EXPECT_TRUE(run.inked({side.x(), side.y(), 0.4}, kSky)) << "the border of the plate's face";
  EXPECT_FALSE(run.inked({1.2, -1.2, 0.1}, kSky, 2)) << "an edge of another face";
}

TEST(RegionsOverlay, TintsTheVPlanesOfTheNearestPairsFeatures) {
  const ShownOverlays run(findScene("contact-edge-edge"), "regions", 3);
  ASSERT_EQ(run.shown.pairs.front().closest.features.a.kind, FeatureKind::kEdge);
  // The roof's ridge from (0, -1.2, 1) to (0, 1.2, 1); its faces' normals are (+-1, 0, 0.8) normalized.
  for (double side : {-1.0, 1.0}) {
    const Vec3 n = Vec3(side, 0.0, 0.8).normalized();
    for (double y : {-0.8, -0.3, 0.5}) {
      EXPECT_TRUE(run.changed(Vec3(0.0, y, 1.0) + 0.4 * n)) << side << ' ' << y;
      EXPECT_FALSE(run.inked(Vec3(0.0, y, 1.0) + 2.5 * n, kSky, 2)) << "beyond the reach";
    }
    for (double end : {-1.2, 1.2})
      EXPECT_TRUE(run.inked(Vec3(0.0, end, 1.0) + 0.8 * n, kSky, 1, 70))
          << "a V-plane's border at the ridge's end";
  }
}

TEST(DistanceOverlay, WritesTheLengthBesideTheLine) {
  const ShownOverlays run(findScene("contact-vertex-face"), "distance", 3);
  const ClosestFeatures& closest = run.shown.pairs.front().closest;
  const Vec3 middle = 0.5 * (closest.p_A_W + closest.p_B_W);
  EXPECT_TRUE(run.inked(middle, kBlack));
  int ink = 0;
  const Vec2 at = run.pixel(middle);
  for (int x = 8; x < 80; ++x)
    for (int y = -22; y < 6; ++y) ink += inked(run.image, at + Vec2(x, y), kBlack, 0);
  EXPECT_GT(ink, 150);
  EXPECT_EQ(lengthText(0.64512), "0.645 m");
  EXPECT_EQ(lengthText(0.00100049), "1.00 mm");
  EXPECT_EQ(lengthText(-0.0123), "-12.30 mm");
}

TEST_F(Block, NormalsPointFromThePlateIntoTheBlock) {
  const ShownOverlays run(file(), "normals", 20);
  for (double x : {-kHalfX, kHalfX})
    for (double y : {-kHalfY, kHalfY}) {
      EXPECT_TRUE(run.inked({x, y, 0.06}, kBlue)) << x << ' ' << y;
      EXPECT_FALSE(run.inked({x, y, -0.1}, kBlue)) << x << ' ' << y;
    }
}

TEST_F(Block, ImpulsesAtRestShareTheWeight) {
  const ShownOverlays run(file(), "impulses", 60);
  ASSERT_EQ(run.state.bodies[1].mode, Mode::kResting);
  // Together they carry the weight; an arrow for all of it would be 0.7 radii long.
  const double radius = std::sqrt(0.3 * 0.3 + 0.2 * 0.2 + 0.15 * 0.15);
  const double weight = 1000.0 * 0.6 * 0.4 * 0.3 * 9.81 / 240.0;
  ASSERT_EQ(run.shown.step->lasting.size(), 4u);
  int shown = 0;
  double sum = 0.0;
  for (const ContactView& contact : run.shown.step->lasting) {
    const Vec3 p_W = run.state.bodies[1].X_WB * contact.p_B;
    EXPECT_NEAR(std::abs(p_W.x()), kHalfX, 1e-6);
    EXPECT_NEAR(std::abs(p_W.y()), kHalfY, 1e-6);
    const double length = 0.7 * radius * contact.impulse_W.norm() / weight;
    sum += length;
    if (length < 0.12 * radius) continue;
    const Vec3 along = contact.impulse_W.normalized();
    EXPECT_GT(along.z(), 0.8);
    ++shown;
    EXPECT_TRUE(run.inked(p_W + 0.5 * length * along, kOrange)) << p_W.transpose();
    EXPECT_FALSE(run.inked(p_W + 1.3 * length * along, kOrange)) << p_W.transpose();
    EXPECT_FALSE(run.inked(p_W - 0.5 * length * along, kOrange)) << p_W.transpose();
  }
  // Upright parts add up to the weight; each impulse is within its cone of friction, 0.5.
  EXPECT_GT(sum, 0.7 * radius * (1.0 - 1e-3));
  EXPECT_LT(sum, 0.7 * radius * std::hypot(1.0, 0.5) * (1.0 + 1e-3));
  EXPECT_GE(shown, 2);
}

TEST(ImpulsesOverlay, ACollisionIsShownInTheFrameAfterItAndOnlyThere) {
  int shown = 0;
  for (int frame = 8; frame < 16; ++frame) {
    const ShownOverlays run(findScene("contact-vertex-face"), "impulses", frame);
    if (run.shown.collisions.empty()) continue;
    ++shown;
    const ContactView& hit = run.shown.collisions.front();
    EXPECT_GT(hit.time_s, run.clock.time(frame - 1));
    EXPECT_LE(hit.time_s, run.clock.time(frame));
    const Vec3 p_W = 0.5 * (run.state.bodies[1].X_WB * hit.p_A + run.state.bodies[2].X_WB * hit.p_B);
    EXPECT_TRUE(run.inked(p_W + 0.12 * hit.impulse_W.normalized(), kRed)) << frame;
  }
  EXPECT_EQ(shown, 1) << "the cube takes a third of a second to come down, and longer to come back";
}

// The world stands at the end of the step that a frame falls into, and may have seen what the frame must not
// show.
TEST(ImpulsesOverlay, ACollisionLaterInTheFramesStepBelongsToTheNextFrame) {
  const ShownOverlays found(findScene("contact-vertex-face"), "impulses", 12);
  ASSERT_EQ(found.shown.collisions.size(), 1u);
  const double hit_s = found.shown.collisions.front().time_s;
  const double into_step_s = std::fmod(hit_s, 1.0 / 240.0);
  const double fps = 10.0 / (hit_s - 0.5 * into_step_s);  // frame 10 falls into the same step, before the hit
  const ShownOverlays before(findScene("contact-vertex-face"), "impulses", 10, "", fps);
  const ShownOverlays after(findScene("contact-vertex-face"), "impulses", 11, "", fps);
  EXPECT_TRUE(before.shown.collisions.empty());
  ASSERT_EQ(after.shown.collisions.size(), 1u);
  EXPECT_EQ(after.shown.collisions.front().time_s, hit_s);
}

TEST_F(Block, ManifoldsShowThePolygonAndItsPoints) {
  const ShownOverlays run(file(), "manifold", 20);
  for (double x : {-kHalfX, kHalfX})
    for (double y : {-kHalfY, kHalfY}) EXPECT_TRUE(run.inked({x, y, 0.0005}, kPurple)) << x << ' ' << y;
  EXPECT_TRUE(run.inked({0.1, kHalfY, 0.0005}, kOrange));
  EXPECT_TRUE(run.inked({0.1, -kHalfY, 0.0005}, kOrange));
  EXPECT_TRUE(run.inked({kHalfX, 0.05, 0.0005}, kOrange));
  EXPECT_TRUE(run.changed({0.05, 0.03, 0.0005})) << "the area";
  EXPECT_FALSE(run.changed({0.6, 0.1, 0.0005})) << "outside";
}

TEST_F(Block, TheGaugesZonesAreAsHighAsTheWindow) {
  const ShownOverlays run(file(), "window", 20);
  // The bar's column: red below, green, blue above; heights as epsilon1 : epsilon2 - epsilon1 : the rest.
  const auto over = [](const renderer::Color& c) {  // 0.75 over 0.82 white over grey
    const auto mix = [](float channel) { return 0.75f * channel + 0.25f * (0.82f + 0.18f * 0.5f); };
    return renderer::Color{mix(c.r), mix(c.g), mix(c.b)};
  };
  int best_red = 0, best_green = 0, best_blue = 0;
  for (int x = 0; x < run.image.width; ++x) {
    int red = 0, green = 0, blue = 0;
    for (int y = 0; y < run.image.height; ++y) {
      red += inked(run.image, Vec2(x, y), over(kRed), 0, 12);
      green += inked(run.image, Vec2(x, y), over(kGreen), 0, 12);
      blue += inked(run.image, Vec2(x, y), over(kSky), 0, 12);
    }
    if (green <= best_green) continue;
    best_red = red;
    best_green = green;
    best_blue = blue;
  }
  ASSERT_GT(best_green, 30);
  EXPECT_NEAR(best_red, best_green * 0.2 / 1.8, 1.6);
  EXPECT_NEAR(best_blue, best_green * 1.0 / 1.8, 2.0);
  const CollisionWindow& window = run.shown.pairs.front().window;
  EXPECT_EQ(gaugeHeight(0.0, window), 0.0);
  EXPECT_NEAR(gaugeHeight(window.ceiling, window), 1.0 / 1.5, 1e-12);
  EXPECT_EQ(gaugeHeight(1.0, window), 1.0);
}

TEST_F(Block, BoundsAreDrawnAlongTheirEdgesAndHoldTheBody) {
  const ShownOverlays run(file(), "bounds", 20);
  const Bounds& b = run.shown.step->swept.at(1);
  EXPECT_TRUE((b.low.array() <= Vec3(-0.3, -0.2, 0.001).array()).all());
  EXPECT_TRUE(run.inked({0.3 * b.low.x() + 0.7 * b.high.x(), b.low.y(), b.high.z()}, kSky));
  EXPECT_TRUE(run.inked({b.high.x(), 0.4 * b.low.y() + 0.6 * b.high.y(), b.high.z()}, kSky));
  EXPECT_TRUE(run.inked({b.low.x(), b.low.y(), 0.5 * (b.low.z() + b.high.z())}, kSky));
  EXPECT_FALSE(
      run.inked({0.6 * b.low.x() + 0.4 * b.high.x(), b.low.y(), 0.5 * (b.low.z() + b.high.z())}, kSky));
}

TEST_F(Block, CandidatePairsMeetWhereTheirBoundsDo) {
  const ShownOverlays run(file(kBall), "pairs", 1);
  const auto& candidates = run.shown.step->candidates;
  ASSERT_EQ(candidates.size(), 1u) << "the ball is in the air";
  EXPECT_EQ(candidates[0].body_b, 1);
  // The overlap of block and plate is a thin slab at the plate's top, under the block's middle.
  EXPECT_TRUE(run.inked({0.0, 0.0, 0.003}, kPurple, 2));
  EXPECT_TRUE(run.inked({0.0, 0.0, 0.08}, kPurple)) << "the line down from the block's centre";
  EXPECT_FALSE(run.inked(run.state.bodies[2].X_WB.position, kPurple, 3));
}

TEST_F(Block, TheSupportPolygonHoldsTheProjectedCentre) {
  const ShownOverlays run(file(), "support", 60);
  EXPECT_TRUE(run.inked({0.0, 0.0, 0.0005}, kGreen)) << "the foot";
  EXPECT_TRUE(run.inked({kHalfX, 0.05, 0.0005}, kGreen));
  EXPECT_TRUE(run.inked({0.1, -kHalfY, 0.0005}, kGreen));
  EXPECT_TRUE(run.inked({0.0, 0.0, 0.1505}, kBlack)) << "the centre";
}

TEST_F(Block, ACentreBesideItsSupportIsShownInRed) {
  const std::string leaning =
      R"(, { "name": "leaning", "shape": { "box": [0.2, 0.2, 0.8] }, "position": [0.9, 0, 0.4585], "material": "m",
          "rotation": { "axis": [0, 1, 0], "degrees": 35 } })";
  const ShownOverlays run(file(leaning), "support", 10, "leaning");
  const auto support = shownSupport(run.shown, 2, Vec3(0.0, 0.0, -9.81));
  ASSERT_TRUE(support.has_value());
  const Vec3 center = run.state.bodies[2].X_WB.position;
  EXPECT_LT((support->foot_W - Vec3(center.x(), center.y(), support->foot_W.z())).norm(), 1e-12);
  EXPECT_FALSE(support->holds);
  EXPECT_TRUE(run.inked(support->foot_W, kRed));
}

TEST_F(Block, VelocitiesPointWhereTheBodyGoes) {
  const ShownOverlays run(file(kBall), "velocities", 3);
  const BodyState& ball = run.state.bodies[2];
  const Vec3 v(2.0, 0.5, 1.0 - 9.81 * 0.1);
  const Vec3 center = Vec3(-0.9, 0.5, 0.6) + 0.1 * Vec3(2.0, 0.5, 1.0) - 0.5 * 9.81 * 0.01 * Vec3::UnitZ();
  ASSERT_LT((ball.linear_velocity - v).norm(), 1e-9);
  EXPECT_TRUE(run.inked(center + 0.6 * kVelocityTime_s * v, kGreen));
  EXPECT_TRUE(run.inked(center + 0.96 * kVelocityTime_s * v, kGreen));
  EXPECT_FALSE(run.inked(center - 0.3 * kVelocityTime_s * v, kGreen));
  EXPECT_FALSE(run.inked(center + 1.15 * kVelocityTime_s * v, kGreen));
  EXPECT_TRUE(run.inked(center + Vec3(0.0, 0.0, 0.04), kPurple)) << "the angular velocity, upwards";
}

// An arrow within a gem of 2.4 m that is drawn in place of the ball of 20 cm is as clear as one before it.
TEST_F(Block, VelocitiesAreSeenThroughWhatIsDrawnInPlaceOfTheBody) {
  ShownOverlays run(file(std::string(kBall).substr(0, std::string(kBall).rfind('}')) +
                         R"(, "visual": { "file": "meshes/gem.obj", "fit": 2.4 } })"),
                    "velocities", 3);
  const BodyState& ball = run.state.bodies[2];
  const Vec3 p = ball.X_WB.position + 0.6 * kVelocityTime_s * ball.linear_velocity;
  renderer::FrameRenderer pictures({ShownOverlays::kWidth, ShownOverlays::kHeight}, run.made.drawnSolids());
  const renderer::Image image = run.overlays.draw(pictures, run.state, 3, run.camera, {});
  EXPECT_TRUE(inked(image, run.pixel(p), kGreen, 1, 20));
}

TEST_F(Block, TrailsPassWhereTheBodyWas) {
  const ShownOverlays run(file(kBall), "trails", 9);
  for (int frame = 1; frame < 9; ++frame) {
    const double t = frame / 30.0;
    const Vec3 was(-0.9 + 2.0 * t, 0.5 + 0.5 * t, 0.6 + t - 0.5 * 9.81 * t * t);
    EXPECT_TRUE(run.changed(was)) << frame;
    EXPECT_FALSE(run.changed(was + Vec3(0.0, 0.0, 0.08))) << frame;
  }
  const double late = 8.5 / 30.0;
  EXPECT_TRUE(
      run.inked({-0.9 + 2.0 * late, 0.5 + 0.5 * late, 0.6 + late - 0.5 * 9.81 * late * late}, kBlue, 2));
}

TEST(TrailsOverlay, KeepTwoSeconds) {
  const ShownOverlays run(findScene("bouncing-ball"), "trails", 75);
  EXPECT_EQ(run.shown.trails[1].size(), 61u);
}

TEST_F(Block, ModesColourTheBodiesAndTheLegendNamesTheSameColours) {
  const ShownOverlays run(file(kBall), "modes", 3);
  std::vector<renderer::Instance> instances = drawnInstances(run.made, run.state.bodies);
  run.overlays.recolor(run.state.bodies, instances);
  EXPECT_EQ(run.state.bodies[2].mode, Mode::kFree);
  for (std::size_t i = 0; i < instances.size(); ++i)
    EXPECT_EQ(instances[i].color.g, modeColor(run.state.bodies[i].mode).g) << i;
  // Swatches one below the other, in the order of the modes, each the whole colour.
  const Pen pen(ShownOverlays::kHeight);
  int from = 0;
  for (std::size_t mode = 0; mode < kModes; ++mode) {
    if (static_cast<Mode>(mode) == Mode::kKinematic) continue;  // shown only where there is such a body
    int found = -1;
    for (int y = from; y < run.image.height / 2 && found < 0; ++y)
      if (inked(run.image, Vec2(1.7 * pen.text_px, y), modeColor(static_cast<Mode>(mode)), 0, 2)) found = y;
    ASSERT_GE(found, from) << mode;
    from = found + static_cast<int>(0.8 * pen.text_px);
  }
  const Panel legend = legendPanel(run.shown);
  EXPECT_EQ(legend[static_cast<std::size_t>(Mode::kFree)].text, "free  1");
  EXPECT_EQ(legend[static_cast<std::size_t>(Mode::kStatic)].text, "static  1");
}

TEST_F(Block, StatisticsAreTheWorldsOwn) {
  const ShownOverlays run(file(kBall), "statistics", 6);  // frame 6 at 30 fps is step 48
  const Panel rows = statisticsPanel(run.shown);
  EXPECT_EQ(rows[0].text, "t = 0.200 s   frame 6");
  EXPECT_NE(rows[1].text.find("1 static"), std::string::npos);
  const Audit audit = run.made.world.audit();
  EXPECT_EQ(rows[2].text, "smallest gap " + lengthText(audit.smallest_gap_m));
  const ShownEnergy energy = shownEnergy(run.made.world, run.state.bodies);
  EXPECT_NEAR(energy.kinetic_J, audit.kinetic_energy_J, 1e-9 * audit.kinetic_energy_J);
  EXPECT_NEAR(energy.potential_J, audit.potential_energy_J, 1e-9 * std::abs(audit.potential_energy_J));
  EXPECT_NE(rows[3].text.find(formatted("= %.4g J kinetic", audit.kinetic_energy_J)), std::string::npos)
      << rows[3].text;
  // The panel: white, with dark letters.
  const Pen pen(ShownOverlays::kHeight);
  int dark = 0;
  for (int x = 12; x < 150; ++x)
    for (int y = 12; y < 40; ++y) dark += inked(run.image, Vec2(x, y), kBlack, 0);
  EXPECT_GT(dark, 100);
  EXPECT_TRUE(inked(run.image, Vec2(0.8 * pen.text_px, 0.8 * pen.text_px), {0.91f, 0.91f, 0.91f}, 0, 6));
}

TEST_F(Block, TimingsNameThePhasesOfThisFrame) {
  ShownOverlays run(file(), "timings", 6);
  ASSERT_NE(run.overlays.phases(), nullptr);
  OverlayFrame frame = run.shown;
  frame.cost.phase_ms[static_cast<std::size_t>(FramePhase::kImpulses)] = 1.25;
  frame.cost.total_ms = 3.5;
  const Panel rows = timingsPanel(frame);
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].text, "1.25 ms  impulses");
  EXPECT_EQ(rows[1].text, "3.50 ms  in all");
  EXPECT_EQ(ShownOverlays(file(), "statistics", 6).overlays.phases(), nullptr) << "no clock unless asked";
}

TEST_F(Block, LabelsStandAtTheBodies) {
  const ShownOverlays run(file(kBall), "labels", 3);
  for (int body : {1, 2}) {
    int dark = 0;
    const Vec2 at = run.pixel(run.state.bodies[static_cast<std::size_t>(body)].X_WB.position);
    for (int x = -20; x < 80; ++x)
      for (int y = -30; y < 30; ++y) dark += inked(run.image, at + Vec2(x, y), kBlack, 0);
    EXPECT_GT(dark, 25) << body;
  }
}

TEST_F(Block, FocusLeavesOutWhatItDoesNotName) {
  const ShownOverlays run(file(kBall), "velocities,labels", 3, "block");
  EXPECT_FALSE(run.changed(run.state.bodies[2].X_WB.position + Vec3(0.05, 0.0, 0.0)));
  for (const NearPair& pair : run.shown.pairs) EXPECT_TRUE(pair.body_a == 1 || pair.body_b == 1);
}

TEST_F(Block, BodiesOfTheFrameHideWhatIsBehindThem) {
  const ShownOverlays run(file(), "closest", 20);
  renderer::FrameRenderer pictures({ShownOverlays::kWidth, ShownOverlays::kHeight}, run.made.world.solids());
  const renderer::Image picture = pictures.draw(drawnInstances(run.made, run.state.bodies), run.camera);
  renderer::Canvas canvas(picture);
  const renderer::DepthImage& depth = pictures.depth();
  renderer::OverlayPainter painter(canvas, run.camera, depth);
  // Behind the block, level with its middle, from far left to far right.
  painter.line({-0.9, 0.35, 0.1}, {0.9, 0.35, 0.1}, {{kRed}, 3.0});
  const renderer::Image image = canvas.image();
  EXPECT_TRUE(inked(image, run.pixel({-0.8, 0.35, 0.1}), kRed));
  int behind = 0;
  for (double x = -0.35; x < -0.05; x += 0.01) {
    EXPECT_FALSE(inked(image, run.pixel({x, 0.35, 0.1}), kRed, 0)) << x;
    const Vec2 at = run.pixel({x, 0.35, 0.1});
    behind += image.pixel(static_cast<int>(at.x()), static_cast<int>(at.y()))[0] !=
              picture.pixel(static_cast<int>(at.x()), static_cast<int>(at.y()))[0];
  }
  EXPECT_GT(behind, 8) << "faint, not absent";
}

// Between two steps the poses shown are none that a step ended with: the witnesses must be of those.
TEST(ClosestOverlay, FollowsThePosesShownBetweenTwoSteps) {
  const ShownOverlays run(findScene("contact-vertex-face"), "closest", 7, "", 37.0);
  ASSERT_GT(run.clock.instant(7).fraction, 0.0);
  Vec3 lowest(0.0, 0.0, 1e9);
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 p_W = run.state.bodies[2].X_WB *
                     Vec3(corner & 1 ? 0.35 : -0.35, corner & 2 ? 0.35 : -0.35, corner & 4 ? 0.35 : -0.35);
    if (p_W.z() < lowest.z()) lowest = p_W;
  }
  EXPECT_LT((run.shown.pairs.front().closest.p_B_W - lowest).norm(), 1e-9);
  EXPECT_TRUE(run.inked(lowest, kRed));
}

}  // namespace
}  // namespace carom::demos
