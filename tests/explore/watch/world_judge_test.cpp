// Every oracle of the judge is seen to fire on a fault planted in the states of an honest run, and none
// without one.

#include "tests/explore/watch/world_judge.h"

#include <gtest/gtest.h>

#include <functional>
#include <optional>

#include "demos/language/scene_file.h"
#include "demos/scene/scene_world.h"

namespace carom::explore {
namespace {

using Fault = std::function<void(std::vector<BodyState>&, StepCounters&)>;

/// What is found in a run whose states after step 5 carry the fault.
std::vector<Finding> judged(const std::string& text, const Fault& fault, int steps = 10) {
  const demos::Scene scene = demos::parseScene(text, "planted.json");
  World world = demos::makeSceneWorld(scene, {}).world;
  WorldJudge judge(scene, world);
  world.keepPaths(true);
  for (int step = 1; step <= steps; ++step) {
    world.step();
    judge.lookAlong([&world](double share, std::vector<BodyState>& at) { world.statesWithin(share, at); });
    std::vector<BodyState> states(world.states().begin(), world.states().end());
    StepCounters counters = world.audit().last_step;
    if (fault && step >= 5) fault(states, counters);
    if (!judge.look(states, counters, step)) break;
  }
  judge.conclude(steps);
  return judge.findings().list();
}

std::optional<Finding> of(const std::vector<Finding>& findings, const std::string& kind) {
  for (const Finding& finding : findings)
    if (finding.kind == kind) return finding;
  return std::nullopt;
}

// Two balls that fly past each other, turning.
const char* const kClosed = R"({"format": 1, "rate": 100, "gravity": [0, 0, 0], "bodies": [
  {"name": "a", "shape": {"sphere": {"radius": 0.5}}, "linearVelocity": [1, 0, 0], "angularVelocity": [0, 1, 2]},
  {"name": "b", "shape": {"sphere": {"radius": 0.3}}, "position": [0, 3, 1], "linearVelocity": [0, 0, -1]}]})";

// A ball that falls freely above a floor.
const char* const kFalling = R"({"format": 1, "rate": 100, "bodies": [
  {"name": "floor", "static": true, "shape": {"box": [9, 9, 1]}, "position": [0, 0, -0.5]},
  {"name": "ball", "shape": {"sphere": {"radius": 0.5}}, "position": [0, 0, 5], "angularVelocity": [0, 1, 2]}]})";

const char* const kThrownDown = R"({"format": 1, "rate": 100, "bodies": [
  {"name": "floor", "static": true, "shape": {"box": [9, 9, 1]}, "position": [0, 0, -0.5]},
  {"name": "ball", "shape": {"sphere": {"radius": 0.5}}, "position": [0, 0, 5], "linearVelocity": [0, 0, -3]}]})";

// A frictionless box in the middle of one tile, between two others.
const char* const kGliding = R"({"format": 1, "rate": 100, "description": "glide",
  "materials": {"ice": {"staticFriction": 0, "density": 1000}}, "bodies": [
  {"name": "t0", "static": true, "shape": {"box": [4, 4, 1]}, "position": [-4, 0, -0.5], "material": "ice"},
  {"name": "t1", "static": true, "shape": {"box": [4, 4, 1]}, "position": [0, 0, -0.5], "material": "ice"},
  {"name": "box", "shape": {"box": [0.5, 0.5, 0.5]}, "position": [-1, 0, 0.25], "linearVelocity": [1, 0, 0],
   "material": "ice"}]})";

// Two boxes in free flight, pushed past each other and turned, each by its own.
const char* const kPushed = R"({"format": 1, "rate": 100, "gravity": [0, 0, -9.81], "bodies": [
  {"name": "a", "shape": {"box": [0.5, 0.4, 0.3]}, "mass": 40, "force": [300, 0, 20], "linearVelocity": [0, 1, 0]},
  {"name": "b", "shape": {"box": [0.3, 0.4, 0.5]}, "mass": 70, "force": [-300, 10, 0], "position": [0, 3, 1],
   "torque": [0, 30, 0], "linearVelocity": [1, 0, 0], "angularVelocity": [1, 2, 0]}]})";

// The same where the loads are of the body's own axes.
const char* const kDriven = R"({"format": 1, "rate": 100, "gravity": [0, 0, 0], "bodies": [
  {"name": "a", "shape": {"box": [0.5, 0.4, 0.3]}, "bodyForce": [300, 0, 20], "angularVelocity": [1, 2, 0]},
  {"name": "b", "shape": {"box": [0.3, 0.4, 0.5]}, "bodyTorque": [30, 0, 0], "position": [0, 3, 1]}]})";

TEST(WorldJudge, FindsNothingInHonestRuns) {
  for (const char* scene : {kClosed, kFalling, kGliding, kPushed, kDriven})
    for (const Finding& finding : judged(scene, nullptr))
      ADD_FAILURE() << finding.kind << ' ' << finding.detail;
}

TEST(WorldJudge, SeesEnergyFromNothing) {
  const auto faster = [](std::vector<BodyState>& s, StepCounters&) { s[1].linear_velocity *= 1.0 + 1e-11; };
  EXPECT_TRUE(of(judged(kClosed, faster), "energy"));
  const auto higher = [](std::vector<BodyState>& s, StepCounters&) { s[1].X_WB.position.z() += 1e-9; };
  EXPECT_FALSE(of(judged(kFalling, higher), "energy")) << "less than opening a gap may lift it by";
  const auto much_higher = [](std::vector<BodyState>& s, StepCounters&) { s[1].X_WB.position.z() += 2e-3; };
  EXPECT_TRUE(of(judged(kFalling, much_higher), "energy"));
}

TEST(WorldJudge, SeesEnergyThatCreepsInByLessThanTheToleranceAStep) {
  double risen = 0.0;
  const auto creeping = [&risen](std::vector<BodyState>& s, StepCounters&) {
    s[1].X_WB.position.z() += risen += 4e-4;
  };
  EXPECT_TRUE(of(judged(kFalling, creeping), "energy"));
}

TEST(WorldJudge, GivesTheFigureOfAGainAsAShareOfWhatThereWas) {
  const auto twice = [](std::vector<BodyState>& s, StepCounters&) { s[0].linear_velocity *= 2.0; };
  const auto finding = of(judged(kClosed, twice), "energy");
  ASSERT_TRUE(finding);
  EXPECT_GT(finding->figure, 1.0);
  EXPECT_LT(finding->figure, 3.0);
  EXPECT_EQ(finding->step, 5);
}

TEST(WorldJudge, SeesABodyLeap) {
  const auto beside = [](std::vector<BodyState>& s, StepCounters&) { s[1].X_WB.position.y() += 0.3; };
  EXPECT_TRUE(of(judged(kFalling, beside), "leap"));
  const auto opened = [](std::vector<BodyState>& s, StepCounters&) { s[1].X_WB.position.y() += 1e-3; };
  EXPECT_FALSE(of(judged(kFalling, opened), "leap")) << "as far as a gap opens in a step";
  const auto landed = [](std::vector<BodyState>& s, StepCounters&) { s[1].linear_velocity.setZero(); };
  EXPECT_FALSE(of(judged(kThrownDown, landed, 5), "leap")) << "it fell all of the step";
}

TEST(WorldJudge, SeesMomentumOfAClosedSystemChange) {
  const auto pushed = [](std::vector<BodyState>& s, StepCounters&) { s[0].linear_velocity.y() += 1e-10; };
  EXPECT_TRUE(of(judged(kClosed, pushed), "momentum"));
  const auto turned = [](std::vector<BodyState>& s, StepCounters&) { s[0].angular_velocity.x() += 1e-8; };
  const std::vector<Finding> findings = judged(kClosed, turned);
  EXPECT_FALSE(of(findings, "momentum"));
  EXPECT_TRUE(of(findings, "angular"));
  const auto moved = [](std::vector<BodyState>& s, StepCounters&) { s[1].X_WB.position.x() += 1e-8; };
  EXPECT_TRUE(of(judged(kClosed, moved), "angular")) << "moved aside without momentum";
}

TEST(WorldJudge, SeesMomentumThatNoLoadHasGiven) {
  const auto pushed = [](std::vector<BodyState>& s, StepCounters&) { s[0].linear_velocity.y() += 1e-9; };
  EXPECT_TRUE(of(judged(kPushed, pushed), "momentum"));
  const auto turned = [](std::vector<BodyState>& s, StepCounters&) { s[0].angular_velocity.x() += 1e-6; };
  const std::vector<Finding> findings = judged(kPushed, turned);
  EXPECT_FALSE(of(findings, "momentum"));
  EXPECT_TRUE(of(findings, "angular"));
  const auto much = [](std::vector<BodyState>& s, StepCounters&) { s[0].linear_velocity.y() += 1.0; };
  EXPECT_TRUE(of(judged(kDriven, much), "momentum"));
}

TEST(WorldJudge, SeesWorkThatNoForceHasDone) {
  const char* const pulled = R"({"format": 1, "rate": 100, "gravity": [0, 0, 0], "bodies": [
    {"name": "a", "shape": {"sphere": {"radius": 0.5}}, "force": [300, 0, 0]}]})";
  const auto told = [](std::vector<BodyState>&, StepCounters& c) { c.work_J *= 1.0 + 1e-6; };
  const std::vector<Finding> findings = judged(pulled, told);
  EXPECT_TRUE(of(findings, "work"));
  EXPECT_FALSE(of(findings, "energy")) << "what is told is not believed";
  const auto faster = [](std::vector<BodyState>& s, StepCounters&) { s[0].linear_velocity *= 1.0 + 1e-9; };
  EXPECT_TRUE(of(judged(pulled, faster), "energy"));
}

TEST(WorldJudge, SeesSpinGrowInFreeFlight) {
  // Of a box whose angular momentum stays and whose turning energy grows: it is turned by itself.
  const char* const box = R"({"format": 1, "rate": 100, "gravity": [0, 0, 0], "bodies": [
    {"name": "a", "shape": {"box": [1, 1, 2]}, "angularVelocity": [0, 0, 3]}]})";
  const auto tilted = [](std::vector<BodyState>& s, StepCounters&) {
    const Solid solid = Solid::box({1, 1, 2});
    const Mat3 I = solid.unitInertia();
    const Mat3 R0 = s[0].X_WB.rotation.toRotationMatrix();
    const Vec3 L = R0 * I * R0.transpose() * s[0].angular_velocity;
    s[0].X_WB.rotation = Quat(Eigen::AngleAxisd(-1e-4, Vec3::UnitX())) * s[0].X_WB.rotation;
    const Mat3 R = s[0].X_WB.rotation.toRotationMatrix();
    s[0].angular_velocity = R * I.inverse() * R.transpose() * L;
  };
  const auto once = of(judged(box, tilted, 5), "flight");
  // About the axis of least inertia a tilt loses energy and its loss is no fault: about another it gains.
  const char* const across = R"({"format": 1, "rate": 100, "gravity": [0, 0, 0], "bodies": [
    {"name": "a", "shape": {"box": [1, 1, 2]}, "angularVelocity": [0, 3, 0]}]})";
  const auto gaining = of(judged(across, tilted, 5), "flight");
  EXPECT_FALSE(once);
  EXPECT_TRUE(gaining);
}

TEST(WorldJudge, SeesOverlapsAndNoNumbers) {
  const auto sunk = [](std::vector<BodyState>& s, StepCounters&) { s[1].X_WB.position.z() = 0.5 - 1e-9; };
  const auto overlap = of(judged(kFalling, sunk), "overlap");
  ASSERT_TRUE(overlap);
  EXPECT_NEAR(overlap->figure, 1e-9, 1e-12);
  const demos::Scene scene = demos::parseScene(kFalling, "planted.json");
  const World world = std::move(demos::makeSceneWorld(scene, {}).world);
  WorldJudge judge(scene, world);
  std::vector<BodyState> within(world.states().begin(), world.states().end());
  judge.lookBetween(within, 1);
  EXPECT_TRUE(judge.findings().list().empty());
  within[1].X_WB.position.z() = 0.4;
  judge.lookBetween(within, 1);
  EXPECT_TRUE(of(judge.findings().list(), "overlap-between"));
  const auto none = [](std::vector<BodyState>& s, StepCounters&) {
    s[1].linear_velocity.x() = std::numeric_limits<double>::quiet_NaN();
  };
  EXPECT_TRUE(of(judged(kFalling, none), "nan"));
}

TEST(WorldJudge, SeesFrozenBodiesAndRunsOfEvents) {
  const auto frozen = [](std::vector<BodyState>&, StepCounters& c) { c.stopped_bodies = 1; };
  const auto finding = of(judged(kFalling, frozen), "frozen");
  ASSERT_TRUE(finding);
  EXPECT_DOUBLE_EQ(finding->figure, 0.6);
  const auto busy = [](std::vector<BodyState>&, StepCounters& c) { c.events = 1153; };
  EXPECT_TRUE(of(judged(kFalling, busy), "events"));
}

TEST(WorldJudge, SeesAGhostCollision) {
  const auto slowed = [](std::vector<BodyState>& s, StepCounters&) {
    s[2].linear_velocity.x() *= 1.0 - 1e-5;
  };
  EXPECT_TRUE(of(judged(kGliding, slowed), "ghost"));
  const auto lifted = [](std::vector<BodyState>& s, StepCounters&) { s[2].X_WB.position.z() += 1e-3; };
  EXPECT_TRUE(of(judged(kGliding, lifted), "ghost-lift"));
  const auto away = [](std::vector<BodyState>& s, StepCounters&) {
    s[2].X_WB.position.x() = 2.0;  // over the edge of the last tile
    s[2].linear_velocity.x() = 0.5;
  };
  EXPECT_FALSE(of(judged(kGliding, away), "ghost"));
}

}  // namespace
}  // namespace carom::explore
