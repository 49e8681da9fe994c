// What MomentumWatch sees on ice, and where it has nothing to say: a fault is planted in the states of an
// honest run, or the floor is no ice.

#include "tests/explore/watch/momentum_watch.h"

#include <gtest/gtest.h>

#include <functional>

#include "tests/oracle/test_shapes.h"

namespace carom::explore {
namespace {

using Fault = std::function<void(std::vector<BodyState>&)>;

// A box and a ball that slide over a floor, whose normal and gravity are turned by R, and meet nothing else.
struct Slide {
  Quat R = oracle::turned(Vec3(1, 2, -1), 0.7);
  Vec3 gravity = Vec3(0, 0, -9.81);
  Material floor{0.0, 0.0, 0.0, 1000.0};
  double floor_width = 40.0;
  std::function<void(BodyDescription&)> change = [](BodyDescription&) {};  ///< Of the box.
  std::function<void(WorldSettings&)> surround = [](WorldSettings&) {};
  std::function<void(World&)> addOthers = [](World&) {};
  bool asks_rest = false;  ///< In every step.

  void add(World& world, const Solid& solid, BodyDescription d) const {
    d.solid = world.addSolid(solid);
    d.X_WB = Pose{R, Vec3::Zero()} * d.X_WB;
    d.linear_velocity = R * d.linear_velocity;
    world.addBody(d);
  }
  World made() const {
    WorldSettings settings;
    settings.step_s = 0.01;
    settings.gravity = R * gravity;
    surround(settings);
    World world(settings);
    BodyDescription ground, box, ball;
    ground.is_static = true;
    ground.material = floor;
    ground.X_WB.position = Vec3(0, 0, -0.5);
    add(world, Solid::box({floor_width, 40, 1}), ground);
    box.X_WB.position = Vec3(0, 0, 0.151);
    box.linear_velocity = Vec3(1, 0.3, 0);
    change(box);
    add(world, Solid::box({0.5, 0.4, 0.3}), box);
    ball.X_WB.position = Vec3(0, 3, 0.3);
    ball.linear_velocity = Vec3(-0.2, 0.5, 0);
    add(world, Solid::ball(0.2), ball);
    addOthers(world);
    world.start();
    return world;
  }
};

struct Judged {
  bool is_on_ice = false;  ///< To the end.
  std::vector<Finding> findings;

  bool has(const std::string& kind) const {
    return std::any_of(findings.begin(), findings.end(),
                       [&kind](const Finding& finding) { return finding.kind == kind; });
  }
};

/// A run whose states from step 5 on carry the fault.
Judged judged(const Slide& slide, const Fault& fault = nullptr, int steps = 10) {
  World world = slide.made();
  const std::vector<OwnBody> bodies = ownBodies(world);
  const Vec3& gravity = world.settings().gravity;
  MomentumWatch watch(world, bodies, mechanicsOf(bodies, world.states(), gravity));
  LoadWatch loads(world, bodies);
  world.keepPaths(true);
  Findings findings;
  for (int step = 1; step <= steps; ++step) {
    world.step();
    loads.after([&world](double share, std::vector<BodyState>& at) { world.statesWithin(share, at); });
    std::vector<BodyState> states(world.states().begin(), world.states().end());
    if (fault && step >= 5) fault(states);
    const bool asks_rest = slide.asks_rest || world.audit().last_step.rest_test_rows > 0;
    watch.after(mechanicsOf(bodies, states, gravity), states, {step, asks_rest, loads.sum()}, findings);
  }
  return {watch.isOnIce(), findings.list()};
}

TEST(MomentumWatch, IsSilentInAnHonestRunOnIce) {
  const Judged slid = judged({}, nullptr, 60);
  EXPECT_TRUE(slid.is_on_ice);
  for (const Finding& finding : slid.findings) ADD_FAILURE() << finding.kind << ' ' << finding.figure;
  Slide pushed;  // along the floor, about its normal, and into it
  pushed.change = [&pushed](BodyDescription& box) {
    box.load.force_W = pushed.R * Vec3(300, -20, -50);
    box.load.torque_W = pushed.R * Vec3(0, 0, 7);
  };
  const Judged driven = judged(pushed);
  EXPECT_TRUE(driven.is_on_ice);
  for (const Finding& finding : driven.findings) ADD_FAILURE() << finding.kind << ' ' << finding.figure;
}

TEST(MomentumWatch, SeesMomentumAcrossTheNormalChangeAndNotAlongIt) {
  const Slide slide;
  const auto faster = [&slide](const Vec3& by) {
    return [&slide, by](std::vector<BodyState>& s) { s[1].linear_velocity += slide.R * by; };
  };
  EXPECT_TRUE(judged(slide, faster({0, 1e-9, 0})).has("ice-momentum"));
  EXPECT_TRUE(judged(slide, faster({1e-9, 0, 0})).has("ice-momentum"));
  EXPECT_FALSE(judged(slide, faster({0, 0, 1e-3})).has("ice-momentum"));
}

TEST(MomentumWatch, SeesAngularMomentumAboutTheNormalChangeAndNotAcrossIt) {
  const Slide slide;
  const auto turning = [&slide](const Vec3& by) {
    return [&slide, by](std::vector<BodyState>& s) { s[1].angular_velocity += slide.R * by; };
  };
  const Judged about = judged(slide, turning({0, 0, 1e-7}));
  EXPECT_TRUE(about.has("ice-angular"));
  EXPECT_FALSE(about.has("ice-momentum"));
  EXPECT_FALSE(judged(slide, turning({1e-3, 1e-3, 0})).has("ice-angular"));
}

TEST(MomentumWatch, SeesTheCenterOfMassGoWhereNoMomentumTakesIt) {
  const Slide slide;
  const auto beside = [&slide](const Vec3& by) {
    return [&slide, by](std::vector<BodyState>& s) { s[1].X_WB.position += slide.R * by; };
  };
  EXPECT_TRUE(judged(slide, beside({1e-8, 0, 0})).has("ice-drift"));
  EXPECT_FALSE(judged(slide, beside({0, 0, 1e-3})).has("ice-drift"));
}

TEST(MomentumWatch, KnowsWhatGravityGivesOnASlope) {
  Slide slope;
  slope.gravity = Vec3(1.0, 2.0, -9.5);
  const Judged slid = judged(slope, nullptr, 20);
  EXPECT_TRUE(slid.is_on_ice);
  for (const Finding& finding : slid.findings) ADD_FAILURE() << finding.kind << ' ' << finding.figure;
  const auto faster = [&slope](std::vector<BodyState>& s) {
    s[1].linear_velocity += slope.R * Vec3(0, 1e-9, 0);
  };
  EXPECT_TRUE(judged(slope, faster).has("slope-momentum"));
}

// In each of these worlds the same fault is none that it could know of.
TEST(MomentumWatch, HasNothingToSayWhereTheFloorIsNoIceOrNotAll) {
  std::vector<Slide> others(9);
  others[0].floor.static_friction = 0.1;
  others[1].floor.spinning_resistance_m = 0.1;
  others[2].floor_width = 0.6;  // the box is over an edge of it soon
  others[3].change = [](BodyDescription& box) { box.locks.turning = AxisLocks::Turning::kLocked; };
  others[4].change = [](BodyDescription& box) { box.is_kinematic = true; };
  others[5].surround = [](WorldSettings& settings) { settings.air.density_kgpm3 = 1.2; };
  others[6].surround = [](WorldSettings& settings) { settings.fluids.emplace_back(); };
  others[7].addOthers = [](World& world) {
    BodyDescription wall;
    wall.is_static = true;
    wall.solid = world.addSolid(Solid::box({1, 1, 1}));
    wall.X_WB.position = Vec3(0, 0, 60);
    world.addBody(wall);
  };
  others[8].change = [](BodyDescription& box) { box.X_WB.position.x() = 30.0; };  // beside it
  const auto faster = [](std::vector<BodyState>& s) { s[1].linear_velocity *= 1.5; };
  for (std::size_t i = 0; i < others.size(); ++i) {
    const Judged other = judged(others[i], faster);
    EXPECT_FALSE(other.is_on_ice) << i;
    EXPECT_TRUE(other.findings.empty()) << i << ' ' << other.findings[0].kind;
  }
}

TEST(MomentumWatch, ReckonsAnewWhenSomethingSlowIsPutToRest) {
  Slide slow;
  slow.change = [](BodyDescription& box) { box.linear_velocity = Vec3(0.01, 0, 0); };
  const Judged rested = judged(slow, nullptr, 60);
  EXPECT_TRUE(rested.is_on_ice);
  for (const Finding& finding : rested.findings) ADD_FAILURE() << finding.kind << ' ' << finding.figure;
  const auto stopped = [](std::vector<BodyState>& s) {
    s[1].linear_velocity.setZero();
    s[1].mode = Mode::kResting;
  };
  EXPECT_TRUE(judged({}, stopped).has("ice-rest")) << "it was fast";
  const auto slower = [](std::vector<BodyState>& s) { s[1].linear_velocity *= 0.5; };
  EXPECT_TRUE(judged(slow, slower).has("ice-momentum"));
  slow.asks_rest = true;
  EXPECT_FALSE(judged(slow, slower).has("ice-momentum")) << "it may have rested and been woken";
  Slide fast;
  fast.asks_rest = true;
  EXPECT_TRUE(judged(fast, slower).has("ice-momentum"));
}

}  // namespace
}  // namespace carom::explore
