// Steps longer than 1/240 s, made in substeps while few bodies move in contact.

#include <utility>

#include <gtest/gtest.h>

#include "engine/foundation/tolerances.h"
#include "engine/simulation/world.h"
#include "tests/oracle/overlap_oracle.h"

namespace carom {
namespace {

constexpr double kG = 9.81;

// Boxes on a floor. `coarsening` steps of 1/240 s are one of the world's.
struct Floor {
  World world;
  int floor = -1;

  explicit Floor(int coarsening) : world({coarsening / 240.0, Vec3(0.0, 0.0, -kG), true}) {
    floor = world.addBody({world.addSolid(Solid::box({80, 80, 1})),
                           {Quat::Identity(), Vec3(0, 0, -0.5)},
                           Vec3::Zero(),
                           Vec3::Zero(),
                           Material{},
                           true});
  }
  int add(const Solid& solid, const Pose& X, const Vec3& v = Vec3::Zero(), const Material& material = {}) {
    return world.addBody({world.addSolid(solid), X, v, Vec3::Zero(), material, false});
  }
  const BodyState& state(int body) const { return world.states()[static_cast<std::size_t>(body)]; }
  int substeps() const { return world.audit().last_step.substeps; }
};

// A block that tips over its edge, and a box that slides.
Floor tippedAndThrown(int coarsening) {
  Floor f(coarsening);
  const Quat tipped(Eigen::AngleAxisd(0.4, Vec3::UnitY()));
  f.add(Solid::box({0.4, 0.4, 1.2}),
        {tipped, Vec3(0.0, 0.0, 0.2 * std::sin(0.4) + 0.6 * std::cos(0.4) + 0.0005)});
  f.add(Solid::box({0.5, 0.4, 0.3}), {Quat::Identity(), Vec3(0.0, 3.0, 0.1503)}, Vec3(3.0, 1.0, 0.0));
  EXPECT_TRUE(f.world.start().empty());
  return f;
}

class Substeps : public testing::TestWithParam<int> {};

TEST_P(Substeps, GiveTheBitsOfStepsOfTheirLength) {
  Floor coarse = tippedAndThrown(GetParam()), fine = tippedAndThrown(1);
  for (int i = 0; i < 60 / GetParam(); ++i) {
    coarse.world.step();
    EXPECT_EQ(coarse.substeps(), GetParam());
    for (int k = 0; k < GetParam(); ++k) fine.world.step();
    EXPECT_EQ(fine.substeps(), 1);
    for (int body : {1, 2}) {
      EXPECT_EQ(coarse.state(body).X_WB.position, fine.state(body).X_WB.position) << i;
      EXPECT_EQ(coarse.state(body).X_WB.rotation.coeffs(), fine.state(body).X_WB.rotation.coeffs()) << i;
      EXPECT_EQ(coarse.state(body).linear_velocity, fine.state(body).linear_velocity) << i;
      EXPECT_EQ(coarse.state(body).angular_velocity, fine.state(body).angular_velocity) << i;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Steps, Substeps, testing::Values(2, 4, 8));

TEST(SubstepCount, IsOneForWhatHasStoodForAWhile_AndForWhatFlies) {
  Floor f(4);
  const int box = f.add(Solid::box({0.5, 0.5, 0.5}), {Quat::Identity(), Vec3(0, 0, 0.2505)});
  ASSERT_TRUE(f.world.start().empty());
  while (f.world.time() <= tolerance::kRestTime) f.world.step();  // it is not yet known that it stands
  while (f.world.time() < 0.5) {
    f.world.step();
    EXPECT_EQ(f.substeps(), 1);
  }
  EXPECT_EQ(f.state(box).mode, Mode::kResting);

  Floor g(4);
  const int ball = g.add(Solid::ball(0.2), {Quat::Identity(), Vec3(20, 0, 30)}, Vec3(1, 2, 3));
  ASSERT_TRUE(g.world.start().empty());
  while (g.world.time() < 0.5) {
    g.world.step();
    EXPECT_EQ(g.substeps(), 1);
  }
  EXPECT_EQ(g.state(ball).mode, Mode::kFree);
}

TEST(SubstepCount, FallsInCrowds) {
  int last = 8;
  for (const auto& [side, substeps] : {std::pair{6, 4}, std::pair{9, 2}, std::pair{13, 1}}) {
    Floor f(4);
    const Solid ball = Solid::ball(0.2);
    for (int i = 0; i < side * side; ++i)
      f.add(ball, {Quat::Identity(), Vec3(1.0 * (i % side), 1.0 * (i / side), 0.2002)}, Vec3(1, 0, 0));
    ASSERT_TRUE(f.world.start().empty());
    f.world.step();
    EXPECT_EQ(f.substeps(), substeps) << side * side << " balls roll";
    EXPECT_LT(f.substeps(), last);
    last = f.substeps();
  }
}

// A slab of 200 cubes has as many pairs with the floor that it slides over.
TEST(SubstepCount, OfABodyOfManyPartsIsThatOfABodyOfOne) {
  std::vector<ConvexPart> cubes;
  for (int x = 0; x < 20; ++x)
    for (int y = 0; y < 10; ++y)
      cubes.push_back({boxPolyhedron(Vec3::Constant(0.1)).translated({0.1 * x, 0.1 * y, 0.0}), 0.0});
  for (const Solid& slab : {Solid::box(Vec3(2.0, 1.0, 0.1)), Solid(cubes)}) {
    Floor f(4);
    f.add(slab, {Quat::Identity(), Vec3(0, 0, 0.0505)}, Vec3(1, 0, 0));
    ASSERT_TRUE(f.world.start().empty());
    f.world.step();
    EXPECT_EQ(f.substeps(), 4) << slab.parts().size() << " parts";
  }
}

// Boxes come to lie on each other and are woken by a late one: the loads that are kept from steps of one
// length start steps of another.
TEST(SubstepCount, MayChangeAtAnyTimeWithoutAJerk) {
  Floor f(4);
  const Solid cube = Solid::box(Vec3::Constant(0.5));
  std::vector<int> stack;
  for (int i = 0; i < 5; ++i)
    stack.push_back(f.add(cube, {Quat::Identity(), Vec3(0, 0, 0.2505 + 0.5005 * i)}));
  const int late = f.add(Solid::box({0.3, 0.3, 0.3}), {Quat::Identity(), Vec3(0.02, 0.01, 8.0)});
  ASSERT_TRUE(f.world.start().empty());
  int divided = 0, whole = 0;
  for (int i = 0; i < 180; ++i) {
    f.world.step();
    (f.substeps() > 1 ? divided : whole) += 1;
    EXPECT_GT(oracle::smallestGap(f.world).gap_m, 0.0) << i;
    for (std::size_t k = 0; k < stack.size(); ++k)
      EXPECT_LT(
          (f.state(stack[k]).X_WB.position - Vec3(0, 0, 0.2505 + 0.5005 * static_cast<double>(k))).norm(),
          2e-3)
          << k << " at " << f.world.time();
  }
  EXPECT_GT(divided, 5);
  EXPECT_GT(whole, 5);
  EXPECT_EQ(f.state(late).mode, Mode::kResting);
}

// A ball meets the floor in the first substep of some step; at its end that is long past.
TEST(SubstepModes, ACollisionInAnySubstepCounts) {
  Floor f(8);
  Material elastic;
  elastic.restitution = 1.0;
  const int ball = f.add(Solid::ball(0.2), {Quat::Identity(), Vec3(0, 0, 0.3)}, Vec3::Zero(), elastic);
  ASSERT_TRUE(f.world.start().empty());
  double upward = 0.0;
  int bounces = 0;
  for (int i = 0; i < 60; ++i) {
    f.world.step();
    const double before = std::exchange(upward, f.state(ball).linear_velocity.z());
    if (before >= 0.0 || upward <= 0.0) continue;
    ++bounces;
    EXPECT_EQ(f.state(ball).mode, Mode::kColliding) << f.world.time();
  }
  EXPECT_GT(bounces, 3);
}

}  // namespace
}  // namespace carom
