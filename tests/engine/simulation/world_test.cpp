// The world as its users see it: what it refuses, what it reports, and that modes and audit tell the truth.

#include "engine/simulation/world.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "engine/foundation/contract.h"
#include "tests/oracle/overlap_oracle.h"
#include "tests/oracle/test_shapes.h"

namespace carom {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

int addBox(World& w, const Vec3& size, const Pose& X, const Vec3& velocity = Vec3::Zero(),
           const Material& material = {}, bool is_static = false) {
  return w.addBody({w.addSolid(Solid::box(size)), X, velocity, Vec3::Zero(), material, is_static});
}
int addGround(World& w, const Material& material = {}) {
  return addBox(w, {40, 40, 1}, {Quat::Identity(), Vec3(0, 0, -0.5)}, Vec3::Zero(), material, true);
}
const BodyState& state(const World& w, int body) {
  return w.states()[static_cast<std::size_t>(body)];
}
void run(World& w, int steps) {
  for (int i = 0; i < steps; ++i) w.step();
}

TEST(World, CountsItsStepsAndTime) {
  World w({1.0 / 75, Vec3(0, 0, -9.81), true});
  addBox(w, {1, 1, 1}, Pose{});
  ASSERT_TRUE(w.start().empty());
  run(w, 225);
  EXPECT_EQ(w.stepCount(), 225);
  EXPECT_NEAR(w.time(), 3.0, 1e-14);
  EXPECT_EQ(w.settings().step_s, 1.0 / 75);
}

TEST(World, WithoutBodiesSteps) {
  World w{WorldSettings{}};
  EXPECT_TRUE(w.start().empty());
  w.step();
  EXPECT_TRUE(w.states().empty());
  EXPECT_TRUE(std::isinf(w.audit().smallest_gap_m));
}

TEST(World, RefusesDescriptionsThatNoBodyCanHave) {
  World w{WorldSettings{}};
  const int solid = w.addSolid(Solid::ball(1));
  const auto refuses = [&](auto&& spoil) {
    BodyDescription d;
    d.solid = solid;
    spoil(d);
    EXPECT_THROW(w.addBody(d), ContractViolation);
  };
  refuses([](BodyDescription& d) { d.solid = 7; });
  refuses([](BodyDescription& d) { d.X_WB.position.y() = kNan; });
  refuses([](BodyDescription& d) { d.X_WB.rotation = Quat(2, 0, 0, 0); });
  refuses([](BodyDescription& d) { d.linear_velocity.x() = kNan; });
  refuses([](BodyDescription& d) { d.angular_velocity.z() = std::numeric_limits<double>::infinity(); });
  refuses([](BodyDescription& d) { d.material.density_kgpm3 = 0.0; });
  refuses([](BodyDescription& d) { d.material.restitution = 1.5; });
  refuses([](BodyDescription& d) { d.material.dynamic_friction = -0.1; });
  EXPECT_THROW(World(WorldSettings{0.0}), ContractViolation);
  EXPECT_THROW(World(WorldSettings{0.01, Vec3(0, kNan, 0)}), ContractViolation);
}

TEST(World, KnowsTheMassesOfItsBodies) {
  World w{WorldSettings{}};
  Material heavy;
  heavy.density_kgpm3 = 7800;
  const int b = addBox(w, {0.1, 0.2, 0.3}, Pose{}, Vec3::Zero(), heavy);
  const int g = addGround(w);
  EXPECT_NEAR(w.mass(b), 46.8, 1e-12);
  EXPECT_TRUE(std::isinf(w.mass(g)));
}

TEST(World, NeverMovesAStaticBody) {
  World w{WorldSettings{}};
  const int g = addGround(w);
  addBox(w, {0.5, 0.5, 0.5}, {oracle::turned({1, 2, 3}, 0.5), Vec3(0, 0, 2)}, Vec3(0, 0, -10));
  ASSERT_TRUE(w.start().empty());
  run(w, 240);
  EXPECT_EQ(state(w, g).X_WB.position, Vec3(0, 0, -0.5));
  EXPECT_EQ(state(w, g).mode, Mode::kStatic);
  EXPECT_EQ(state(w, g).linear_velocity, Vec3::Zero());
}

TEST(World, NamesTheModesThatABodyGoesThrough) {
  World w{WorldSettings{}};
  Material m;
  m.static_friction = m.dynamic_friction = 0.3;
  addGround(w, m);
  const int b = addBox(w, {0.6, 0.6, 0.2}, {Quat::Identity(), Vec3(0, 0, 0.5)}, Vec3(2, 0, 0), m);
  ASSERT_TRUE(w.start().empty());
  EXPECT_EQ(state(w, b).mode, Mode::kFree);
  std::string modes;
  Mode last = Mode::kStatic;
  for (int i = 0; i < 480; ++i) {
    w.step();
    if (const Mode now = state(w, b).mode; now != last) modes += std::string(modeName(now)) + ' ';
    last = state(w, b).mode;
  }
  EXPECT_EQ(modes.find("free "), 0u) << modes;
  EXPECT_LT(modes.find("colliding"), modes.find("sliding")) << modes;
  EXPECT_LT(modes.find("sliding"), modes.find("resting")) << modes;
  EXPECT_EQ(last, Mode::kResting);
  EXPECT_EQ(w.audit().resting_bodies, 1);
}

TEST(World, WithoutRestingModeLetsNothingRest) {
  World w({1.0 / 120, Vec3(0, 0, -9.81), false});
  addGround(w);
  const int b = addBox(w, {0.6, 0.6, 0.2}, {Quat::Identity(), Vec3(0, 0, 0.1006)});
  ASSERT_TRUE(w.start().empty());
  run(w, 600);
  EXPECT_EQ(state(w, b).mode, Mode::kContact);
  EXPECT_LT(state(w, b).linear_velocity.norm(), 1e-6);
  EXPECT_NEAR(state(w, b).X_WB.position.z(), 0.1002, 1e-4) << "it neither creeps nor sinks";
}

TEST(World, AuditsTheSumsOverItsBodies) {
  World w({1.0 / 240, Vec3(0, 0, -2), true});
  const int solid = w.addSolid(Solid::ball(0.5));
  Material m;
  m.density_kgpm3 = 6 / std::numbers::pi;  // a ball of 1 kg: I = 0.1 kg m^2
  w.addBody({solid, {Quat::Identity(), Vec3(3, 0, 5)}, Vec3(0, 2, 0), Vec3(0, 0, 4), m, false});
  w.addBody({solid, {Quat::Identity(), Vec3(-3, 0, 1)}, Vec3(0, 0, 1), Vec3::Zero(), m, false});
  ASSERT_TRUE(w.start().empty());
  const Audit audit = w.audit();
  EXPECT_NEAR(audit.kinetic_energy_J, 2.0 + 0.8 + 0.5, 1e-12);
  EXPECT_NEAR(audit.potential_energy_J, 2 * 5 + 2 * 1, 1e-12);
  EXPECT_LT((audit.linear_momentum - Vec3(0, 2, 1)).norm(), 1e-12);
  // (3,0,5) x (0,2,0) + 0.1 (0,0,4) + (-3,0,1) x (0,0,1)
  EXPECT_LT((audit.angular_momentum - (Vec3(-10, 0, 6) + Vec3(0, 0, 0.4) + Vec3(0, 3, 0))).norm(), 1e-12);
  EXPECT_EQ(audit.resting_bodies, 0);
}

TEST(World, SmallestGapIsThatOfTheOracle) {
  World w{WorldSettings{}};
  addGround(w);
  const int b = addBox(w, {0.5, 0.4, 0.3}, {oracle::turned({1, 2, 3}, 0.5), Vec3(0, 0, 1)}, Vec3(1, 0, 0));
  ASSERT_TRUE(w.start().empty());
  int compared = 0;
  for (int i = 0; i < 240; ++i) {
    w.step();
    if (!std::isfinite(w.audit().smallest_gap_m)) continue;
    ++compared;
    ASSERT_NEAR(w.audit().smallest_gap_m, oracle::smallestGap(w).gap_m, 1e-12) << i << " body " << b;
  }
  EXPECT_GT(compared, 100);
}

TEST(World, CarriesCompoundBodiesAsOne) {
  World w{WorldSettings{}};
  addGround(w);
  // A dumb-bell of two boxes: it lies on both.
  const Solid bell({{boxPolyhedron({0.4, 0.4, 0.4}).translated({-0.6, 0, 0}), 0.0},
                    {boxPolyhedron({0.4, 0.4, 0.4}).translated({0.6, 0, 0}), 0.0}});
  const int b = w.addBody({w.addSolid(bell),
                           {oracle::turned(Vec3::UnitZ(), 0.3), Vec3(0, 0, 0.5)},
                           Vec3::Zero(),
                           Vec3::Zero(),
                           {},
                           false});
  ASSERT_TRUE(w.start().empty());
  run(w, 480);
  EXPECT_EQ(state(w, b).mode, Mode::kResting);
  EXPECT_NEAR(state(w, b).X_WB.position.z(), 0.2, 1e-3);
  EXPECT_GT(oracle::smallestGap(w).gap_m, 0.0);
}

TEST(World, CanBeMovedAndSteppedOn) {
  World first{WorldSettings{}};
  addGround(first);
  addBox(first, {0.5, 0.4, 0.3}, {oracle::turned({1, 2, 3}, 0.5), Vec3(0, 0, 1)});
  World second{WorldSettings{}};
  addGround(second);
  addBox(second, {0.5, 0.4, 0.3}, {oracle::turned({1, 2, 3}, 0.5), Vec3(0, 0, 1)});
  ASSERT_TRUE(first.start().empty() && second.start().empty());
  run(first, 100);
  run(second, 60);
  World moved = std::move(second);
  run(moved, 40);
  EXPECT_EQ(moved.stateHash(), first.stateHash());
}

TEST(Mode, HasADistinctNameEach) {
  EXPECT_STREQ(modeName(Mode::kStatic), "static");
  EXPECT_STREQ(modeName(Mode::kFree), "free");
  EXPECT_STREQ(modeName(Mode::kColliding), "colliding");
  EXPECT_STREQ(modeName(Mode::kSliding), "sliding");
  EXPECT_STREQ(modeName(Mode::kContact), "contact");
  EXPECT_STREQ(modeName(Mode::kResting), "resting");
}

// A query visits one pair of features at least, and nothing is counted backwards.
TEST(World, CountsTheWorkOfItsQueries) {
  World w({1.0 / 60, Vec3(0, 0, -9.81), true});
  addGround(w);
  Material bouncing;
  bouncing.restitution = 0.5;
  w.addBody({w.addSolid(Solid::ball(0.2)),
             {Quat::Identity(), Vec3(0, 0, 1)},
             Vec3::Zero(),
             Vec3::Zero(),
             bouncing,
             false});
  addBox(w, {0.5, 0.4, 0.3}, {oracle::turned({1, 2, 3}, 0.5), Vec3(3, 0, 1)});
  ASSERT_TRUE(w.start().empty());
  long newton_steps = 0, queries = 0;
  for (int i = 0; i < 120; ++i) {
    w.step();
    const StepCounters counters = w.audit().last_step;
    EXPECT_GE(counters.newton_steps, 0) << i;
    EXPECT_GE(counters.states_walked, counters.distance_queries) << i;
    newton_steps += counters.newton_steps;
    queries += counters.distance_queries;
  }
  EXPECT_GT(newton_steps, 0);
  EXPECT_GT(queries, 0);
}

}  // namespace
}  // namespace carom
