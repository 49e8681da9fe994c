// Starting poses: overlaps are named with their depth and place; touching bodies are moved apart by as little
// as gives them their rest gaps, whatever their order; the rest is left alone.

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <utility>

#include "engine/foundation/contract.h"
#include "engine/simulation/world.h"
#include "tests/oracle/overlap_oracle.h"
#include "tests/oracle/test_shapes.h"

namespace carom {
namespace {

// Of cubes of a metre: their rest gap less what the solve may miss of it.
constexpr double kNearlyRest = 0.99e-3;

class Start : public testing::Test {
 protected:
  int box(const Vec3& size, const Vec3& position, bool is_static = false,
          const Quat& turn = Quat::Identity()) {
    BodyDescription d;
    d.solid = world_.addSolid(Solid::box(size));
    d.X_WB = {turn, position};
    d.is_static = is_static;
    return world_.addBody(d);
  }
  Vec3 position(int body) const { return world_.states()[static_cast<std::size_t>(body)].X_WB.position; }

  World world_{WorldSettings{}};
};

TEST_F(Start, NamesOverlappingBodiesDeepestFirst) {
  const int ground = box({10, 10, 1}, Vec3(0, 0, -0.5), true);
  const int shallow = box({1, 1, 1}, Vec3(-3, 0, 0.48));
  const int deep = box({1, 1, 1}, Vec3(3, 0, 0.2));
  box({1, 1, 1}, Vec3(0, 0, 0.6));
  const std::vector<Overlap> overlaps = world_.start();
  ASSERT_EQ(overlaps.size(), 2u);
  EXPECT_EQ(overlaps[0].body_a, ground);
  EXPECT_EQ(overlaps[0].body_b, deep);
  EXPECT_NEAR(overlaps[0].depth_m, 0.3, 1e-12);
  EXPECT_NEAR(overlaps[0].p_W.z(), -0.15, 1e-12) << "halfway between the floor's top and the cube's bottom";
  EXPECT_LE((overlaps[0].p_W - Vec3(3, 0, -0.15)).head<2>().lpNorm<Eigen::Infinity>(), 0.5 + 1e-12);
  EXPECT_EQ(overlaps[1].body_b, shallow);
  EXPECT_NEAR(overlaps[1].depth_m, 0.02, 1e-12);
}

TEST_F(Start, NamesABodyInsideAnother) {
  box({10, 10, 10}, Vec3::Zero(), true);
  box({1, 1, 1}, Vec3(1, 2, 3));
  const std::vector<Overlap> overlaps = world_.start();
  ASSERT_EQ(overlaps.size(), 1u);
  EXPECT_NEAR(overlaps[0].depth_m, 2.5, 1e-12);
}

TEST_F(Start, LetsStaticBodiesOverlapEachOther) {
  box({10, 10, 1}, Vec3::Zero(), true);
  box({1, 10, 10}, Vec3(5, 0, 0), true);
  box({1, 1, 1}, Vec3(0, 0, 3));
  EXPECT_TRUE(world_.start().empty());
}

TEST_F(Start, LeavesBodiesApartWhereTheyAre) {
  box({10, 10, 1}, Vec3(0, 0, -0.5), true);
  const int b = box({1, 1, 1}, Vec3(0.1, 0.2, 0.50095), false, oracle::turned(Vec3::UnitZ(), 0.3));
  EXPECT_TRUE(world_.start().empty());
  EXPECT_EQ(position(b), Vec3(0.1, 0.2, 0.50095)) << "0.95 mm is within the band that contacts hold";
}

TEST_F(Start, OpensExactTouchUpwards) {
  box({10, 10, 1}, Vec3(0, 0, -0.5), true);
  std::vector<int> tower;
  for (int i = 0; i < 5; ++i)
    tower.push_back(box({1, 1, 1}, Vec3(0, 0, 0.5 + i), false, oracle::turned(Vec3::UnitZ(), 0.2 * i)));
  ASSERT_TRUE(world_.start().empty());
  EXPECT_GT(oracle::smallestGap(world_).gap_m, kNearlyRest);
  for (int i = 0; i < 5; ++i) {
    const Vec3 moved = position(tower[static_cast<std::size_t>(i)]) - Vec3(0, 0, 0.5 + i);
    EXPECT_GT(moved.z(), 0.0);
    EXPECT_LT(moved.z(), (i + 1) * 1e-3 + 1e-9);
    EXPECT_LT(moved.head<2>().norm(), 1e-9);
  }
  for (int i = 0; i < 100; ++i) {
    world_.step();
    ASSERT_GT(world_.audit().smallest_gap_m, 0.0) << i;
  }
}

TEST_F(Start, OpensTouchSideBySideToo) {
  box({10, 10, 1}, Vec3(0, 0, -0.5), true);
  box({1, 10, 10}, Vec3(-5.5, 0, 5), true);
  const int in_corner = box({1, 1, 1}, Vec3(-4.5, 0, 0.5));
  const int beside = box({1, 1, 1}, Vec3(-3.5, 0, 0.5));
  ASSERT_TRUE(world_.start().empty());
  EXPECT_GT(oracle::smallestGap(world_).gap_m, kNearlyRest);
  EXPECT_LT((position(in_corner) - Vec3(-4.5, 0, 0.5)).norm(), 2e-3);
  EXPECT_LT((position(beside) - Vec3(-3.5, 0, 0.5)).norm(), 4e-3);
}

TEST_F(Start, TakesRoundingForTouchButNotAMicrometre) {
  box({10, 10, 1}, Vec3(0, 0, -0.5), true);
  box({1, 1, 1}, Vec3(0, 0, 0.5 - 1e-12));
  EXPECT_TRUE(world_.start().empty());
  World deeper{WorldSettings{}};
  const int solid = deeper.addSolid(Solid::box({1, 1, 1}));
  deeper.addBody({solid, {Quat::Identity(), Vec3(0, 0, 0)}, Vec3::Zero(), Vec3::Zero(), {}, true});
  deeper.addBody({solid, {Quat::Identity(), Vec3(0, 0, 1 - 1e-6)}, Vec3::Zero(), Vec3::Zero(), {}, false});
  EXPECT_EQ(deeper.start().size(), 1u);
}

/// What is at a start, one after the other, in any order.
struct Placed {
  Solid solid;
  Pose X_WB;
  bool is_static = false;
};

Placed placedBox(const Vec3& size, const Vec3& position, bool is_static = false) {
  return {Solid::box(size), {Quat::Identity(), position}, is_static};
}

World worldOf(const std::vector<Placed>& all, const std::vector<std::size_t>& order,
              const Vec3& gravity = Vec3(0, 0, -9.81)) {
  WorldSettings settings;
  settings.gravity = gravity;
  World world(settings);
  for (const std::size_t i : order) {
    BodyDescription d;
    d.solid = world.addSolid(all[i].solid);
    d.X_WB = all[i].X_WB;
    d.is_static = all[i].is_static;
    world.addBody(d);
  }
  return world;
}

std::vector<std::size_t> orderGiven(const std::vector<Placed>& all) {
  std::vector<std::size_t> order(all.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  return order;
}

// Whatever the order, all are accepted, each gap is at least this one, and each body ends where it does in
// the order given, to `same_m`; nothing moves farther than `farthest_m`.
void expectOpens(const std::vector<Placed>& all, double gap_m, double farthest_m,
                 const Vec3& gravity = Vec3(0, 0, -9.81)) {
  constexpr double same_m = 1e-12;
  std::vector<std::size_t> order = orderGiven(all);
  std::vector<Vec3> first(all.size());
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    oracle::Random random(seed);
    World world = worldOf(all, order, gravity);
    ASSERT_EQ(world.start().size(), 0u) << "order " << seed;
    EXPECT_GE(oracle::smallestGap(world).gap_m, gap_m) << "order " << seed;
    for (std::size_t i = 0; i < order.size(); ++i) {
      const Vec3& p_W = world.states()[i].X_WB.position;
      EXPECT_LE((p_W - all[order[i]].X_WB.position).norm(), farthest_m);
      if (seed == 0)
        first[order[i]] = p_W;
      else
        EXPECT_LE((p_W - first[order[i]]).norm(), same_m) << "body " << order[i] << ", order " << seed;
    }
    for (std::size_t i = order.size() - 1; i > 0; --i)
      std::swap(order[i], order[static_cast<std::size_t>(random.integer(0, static_cast<int>(i)))]);
  }
}

Placed ground() {
  return placedBox({200, 200, 2}, {0, 0, -1}, true);
}

TEST(StartOfTouchingBodies, RowsOfWholeAndHalfBricks_OpenInAnyOrder) {
  std::vector<Placed> all{ground()};
  for (int i = 0; i < 30; ++i) all.push_back(placedBox({1, 0.5, 0.5}, Vec3(i - 15, 0, 0.25)));
  for (const double end : {-15.25, 14.25}) all.push_back(placedBox({0.5, 0.5, 0.5}, Vec3(end, 0, 0.75)));
  for (int i = 0; i < 29; ++i) all.push_back(placedBox({1, 0.5, 0.5}, Vec3(i - 14.5, 0, 0.75)));
  expectOpens(all, 0.495e-3, std::hypot(15 * 0.5e-3, 1.001e-3));
}

TEST(StartOfTouchingBodies, AGridOfCubesThatTouchOnSixSides_OpensInAnyOrder) {
  std::vector<Placed> all{ground()};
  for (int i = 0; i < 64; ++i) all.push_back(placedBox({1, 1, 1}, Vec3(i % 4, i / 4 % 4, 0.5 + i / 16)));
  expectOpens(all, kNearlyRest, std::sqrt(1.5 * 1.5 + 1.5 * 1.5 + 4.0 * 4.0) * 1.001e-3);
}

TEST(StartOfTouchingBodies, ATowerInAnyOrder_IsLiftedByItsGaps) {
  std::vector<Placed> all{ground()};
  for (int i = 0; i < 20; ++i) all.push_back(placedBox({1, 1, 1}, Vec3(0, 0, 0.5 + i)));
  expectOpens(all, kNearlyRest, 20.001e-3);
}

TEST(StartOfTouchingBodies, APyramidOpensInAnyOrder) {
  std::vector<Placed> all{ground()};
  for (int row = 0; row < 7; ++row)
    for (int i = 0; i < 7 - row; ++i)
      all.push_back(placedBox({0.5, 0.5, 0.3}, Vec3(0.5 * (i - 0.5 * (6 - row)), 0, 0.15 + 0.3 * row)));
  expectOpens(all, 0.297e-3, 7 * 0.3e-3);
}

TEST(StartOfTouchingBodies, WithoutGravityEachGivesWayByHalf) {
  const std::vector<Placed> all{placedBox({1, 1, 1}, Vec3(0, 0, 0)), placedBox({1, 1, 1}, Vec3(1, 0.25, 0))};
  expectOpens(all, kNearlyRest, 0.5e-3 + 1e-9, Vec3::Zero());
}

TEST(StartOfTouchingBodies, BallsOpenInAnyOrder) {
  std::vector<Placed> all{ground()};
  const double r = 0.3;
  for (int i = 0; i < 36; ++i)
    all.push_back({Solid::ball(r), {Quat::Identity(), Vec3(2 * r * (i % 6), 2 * r * (i / 6), r)}});
  for (int i = 0; i < 25; ++i)
    all.push_back(
        {Solid::ball(r),
         {Quat::Identity(), Vec3(r + 2 * r * (i % 5), r + 2 * r * (i / 5), r + r * std::sqrt(2.0) + 1e-15)}});
  expectOpens(all, 0.59e-3, 6 * 0.6e-3);
}

TEST(StartOfTouchingBodies, SmallOnesOpenBesideOnesAThousandTimesAsLarge) {
  std::vector<Placed> all{ground(), placedBox({10, 10, 10}, Vec3(0, 0, 5))};
  for (int i = 0; i < 10; ++i) {
    all.push_back(placedBox(Vec3::Constant(0.01), Vec3(0.01 * i, 0, 10.005)));
    all.push_back(placedBox(Vec3::Constant(0.01), Vec3(5.005, 0.01 * i, 0.005)));
  }
  expectOpens(all, 0.0099e-3, 1.2e-3);
}

TEST(StartOfTouchingBodies, CompoundsThatTouchWithSeveralPartsOpenInAnyOrder) {
  const auto part = [](const Vec3& size, const Vec3& middle) {
    std::vector<Vec3> corners;
    for (int c = 0; c < 8; ++c)
      corners.push_back(middle + 0.5 * Vec3(c & 1 ? size.x() : -size.x(), c & 2 ? size.y() : -size.y(),
                                            c & 4 ? size.z() : -size.z()));
    return ConvexPart{convexHull(corners).polyhedron, 0.0};
  };
  // A table's top lies on its legs; a block stands between them and touches both, another on top.
  const Solid table(
      {part({3, 1, 0.5}, {0, 0, 1.25}), part({1, 1, 1}, {-1, 0, 0.5}), part({1, 1, 1}, {1, 0, 0.5})});
  const std::vector<Placed> all{ground(),
                                {table, {Quat::Identity(), -table.origin_B()}},
                                placedBox({1, 1, 0.8}, Vec3(0, 1.0, 0.4)),
                                placedBox({1, 1, 1}, Vec3(0.2, 0, 2.0))};
  expectOpens(all, 0.49e-3, 3e-3);
}

TEST(StartOfTouchingBodies, PostsBeyondTheReachOfPairsAreMetOnTheWay) {
  // The row would grow by 20 mm at either end. Posts there are 18 mm off, and bricks are paired to 15 mm.
  std::vector<Placed> all{ground()};
  for (int i = 0; i < 80; ++i) all.push_back(placedBox({0.5, 1, 1}, Vec3(0.5 * i, 0, 0.5)));
  all.push_back(placedBox({1, 1, 4}, Vec3(-0.75 - 0.018, 0, 2), true));
  all.push_back(placedBox({1, 1, 4}, Vec3(40.25 + 0.018, 0, 2), true));
  expectOpens(all, 0.99 * 36e-3 / 81, 20e-3);
}

TEST(StartOfTouchingBodies, WithLessRoomThanRestGapsTheyShareIt) {
  for (const double room_m : {1e-3, 1e-6, 1e-8}) {
    std::vector<Placed> all{placedBox({1, 4, 4}, Vec3(-1, 0, 0), true),
                            placedBox({1, 4, 4}, Vec3(3 + room_m, 0, 0), true)};
    for (int i = 0; i < 3; ++i) all.push_back(placedBox({1, 1, 1}, Vec3(i, 0.1 * i, 0)));
    SCOPED_TRACE(room_m);
    expectOpens(all, 0.24 * room_m, room_m);
  }
}

TEST(StartOfTouchingBodies, WithoutAnyRoomButRoundingBothNeighboursAreNamed) {
  for (const double room_m : {0.0, 1e-15, -1e-15, 1e-12}) {
    const std::vector<Placed> all{placedBox({1, 4, 4}, Vec3(-1, 0, 0), true),
                                  placedBox({1, 1, 1}, Vec3(0, 0.1, 0)),
                                  placedBox({1, 4, 4}, Vec3(1 + room_m, 0, 0), true)};
    World world = worldOf(all, orderGiven(all));
    const std::vector<Overlap> overlaps = world.start();
    ASSERT_EQ(overlaps.size(), 2u) << room_m;
    EXPECT_EQ(overlaps[0].body_a + overlaps[0].body_b + overlaps[1].body_a + overlaps[1].body_b,
              0 + 1 + 1 + 2);
    for (const Overlap& pair : overlaps) {
      EXPECT_EQ(pair.depth_m, 0.0) << room_m;
      EXPECT_NEAR(pair.p_W.x(), pair.body_a == 0 ? -0.5 : 0.5, 1e-12) << room_m;
    }
  }
}

TEST(StartOfTouchingBodies, AMirrorImageStaysOne) {
  // Fifteen balls of pool; their triangle's axis is x.
  const double r = 0.028575;
  for (const double apart_m : {0.0, 1e-5}) {
    const double pitch = 2 * r + apart_m;
    std::vector<Placed> all{ground()};
    std::vector<std::size_t> image{0};
    for (int row = 0; row < 5; ++row)
      for (int k = 0; k <= row; ++k) {
        image.push_back(all.size() + static_cast<std::size_t>(row - 2 * k));
        all.push_back({Solid::ball(r),
                       {Quat::Identity(), Vec3(std::sqrt(0.75) * pitch * row, pitch * (k - 0.5 * row), r)}});
      }
    World world = worldOf(all, orderGiven(all));
    ASSERT_TRUE(world.start().empty());
    EXPECT_GT(oracle::smallestGap(world).gap_m, 0.99e-3 * 2 * r);
    for (std::size_t i = 1; i < all.size(); ++i) {
      const Vec3& p_W = world.states()[i].X_WB.position;
      const Vec3& q_W = world.states()[image[i]].X_WB.position;
      EXPECT_LE((p_W - Vec3(q_W.x(), -q_W.y(), q_W.z())).norm(), 1e-15) << i;
    }
  }
}

TEST(StartOfTouchingBodies, AWallOf610BricksStartsQuietly) {
  std::vector<Placed> all{ground()};
  const Vec3 size(0.6, 0.3, 0.25);
  for (int row = 0; row < 20; ++row)
    for (int k = 0; k < 31 - row % 2; ++k)
      all.push_back(placedBox(size, Vec3(size.x() * (k - 0.5 * (30 - row % 2)), 0, size.z() * (row + 0.5))));
  WorldSettings settings;
  settings.step_s = 1.0 / 60.0;
  settings.resting_mode = false;
  World world(settings);
  for (const Placed& placed : all) {
    BodyDescription d;
    d.solid = world.addSolid(placed.solid);
    d.X_WB = placed.X_WB;
    d.is_static = placed.is_static;
    world.addBody(d);
  }
  ASSERT_TRUE(world.start().empty());
  EXPECT_GE(world.audit().smallest_gap_m, 0.2475e-3);
  int stopped = 0;
  for (int i = 0; i < 10; ++i) {
    world.step();
    stopped += world.audit().last_step.stopped_bodies;
    ASSERT_GT(world.audit().smallest_gap_m, 0.0);
  }
  EXPECT_EQ(stopped, 0);
  for (const BodyState& state : world.states()) EXPECT_LT(state.linear_velocity.norm(), 1e-3);
}

/// A body that may not move along the axes of which `free_axes` has 0.
struct OnRails {
  Vec3 position;
  Vec3 free_axes;
  Vec3 size = Vec3(1, 1, 1);
};

class StartOnRails : public testing::Test {
 protected:
  void add(const OnRails& body, bool is_static = false) {
    BodyDescription d;
    d.solid = world_.addSolid(Solid::box(body.size));
    d.X_WB.position = body.position;
    d.locks.free_axes = body.free_axes;
    d.is_static = is_static;
    world_.addBody(d);
  }
  void addGuide(const Vec3& size, const Vec3& position) { add({position, Vec3::Ones(), size}, true); }
  Vec3 moved(std::size_t body) const {
    return world_.states()[body].X_WB.position - world_.bodies()[body].X_WB.position;
  }
  World world_{WorldSettings{}};
};

TEST_F(StartOnRails, OfATouchingPairOnlyTheFreeBodyGivesWay) {
  add({Vec3(0, 0, 0), Vec3(0, 1, 1)});
  add({Vec3(1, 0, 0), Vec3::Ones()});
  ASSERT_TRUE(world_.start().empty());
  EXPECT_EQ(moved(0), Vec3::Zero());
  EXPECT_NEAR(moved(1).x(), 1e-3, 1e-8);
  EXPECT_GT(oracle::smallestGap(world_).gap_m, kNearlyRest);
}

TEST_F(StartOnRails, ABallOnASlopeIsPushedAlongItsRailAlone) {
  // It goes along x, farther than it would if it were free.
  const Quat slope = oracle::turned(Vec3::UnitY(), -0.5);
  BodyDescription wedge;
  wedge.solid = world_.addSolid(Solid::box({4, 4, 1}));
  wedge.X_WB = {slope, Vec3::Zero()};
  wedge.is_static = true;
  world_.addBody(wedge);
  BodyDescription ball;
  ball.solid = world_.addSolid(Solid::ball(0.5));
  const Vec3 normal = slope * Vec3::UnitZ();
  ball.X_WB.position = 1.0 * normal;
  ball.locks.free_axes = Vec3(1, 0, 0);
  world_.addBody(ball);
  ASSERT_TRUE(world_.start().empty());
  EXPECT_NEAR(moved(1).x(), 1e-3 / normal.x(), 1e-6);
  EXPECT_EQ(moved(1).tail<2>(), Eigen::Vector2d::Zero());
}

TEST_F(StartOnRails, ThroughALockedBodyNothingIsPassedOn) {
  add({Vec3(0, 0, 0), Vec3::Ones()});
  add({Vec3(1, 0, 0), Vec3(0, 1, 1)});
  add({Vec3(2, 0, 0), Vec3::Ones()});
  ASSERT_TRUE(world_.start().empty());
  EXPECT_NEAR(moved(0).x(), -1e-3, 1e-8);
  EXPECT_EQ(moved(1), Vec3::Zero());
  EXPECT_NEAR(moved(2).x(), 1e-3, 1e-8);
}

TEST_F(StartOnRails, ASliderThatTouchesItsGuideIsNamedWithIt) {
  addGuide({4, 4, 1}, Vec3(0, 0, -0.5));
  add({Vec3(0.5, 0, 0.5), Vec3(1, 0, 0)});
  const std::vector<Overlap> touching = world_.start();
  ASSERT_EQ(touching.size(), 1u);
  EXPECT_EQ(touching[0].body_a + touching[0].body_b, 1);
  EXPECT_EQ(touching[0].depth_m, 0.0);
  EXPECT_NEAR(touching[0].p_W.z(), 0.0, 1e-12);
  EXPECT_EQ(moved(1), Vec3::Zero());
}

// A way along which it would be parted by a hundredth of that is none.
TEST_F(StartOnRails, ASliderIsNotShiftedFarAlongAGuideThatIsHardlyTilted) {
  BodyDescription guide;
  guide.solid = world_.addSolid(Solid::box({4, 4, 1}));
  guide.X_WB.rotation = oracle::turned(Vec3::UnitY(), 0.01);
  guide.is_static = true;
  world_.addBody(guide);
  BodyDescription ball;
  ball.solid = world_.addSolid(Solid::ball(0.5));
  ball.X_WB.position = guide.X_WB.rotation * Vec3(0, 0, 1);
  ball.locks.free_axes = Vec3(1, 0, 0);
  world_.addBody(ball);
  EXPECT_EQ(world_.start().size(), 1u);
  EXPECT_EQ(moved(1), Vec3::Zero());
}

TEST_F(StartOnRails, ASliderAHairOffItsGuideKeepsThatGapAndSlides) {
  for (const double gap_m : {1e-4, 1e-6, 1e-8}) {
    SCOPED_TRACE(gap_m);
    world_ = World{WorldSettings{}};
    addGuide({40, 4, 1}, Vec3(0, 0, -0.5));
    BodyDescription slider;
    slider.solid = world_.addSolid(Solid::box({1, 1, 1}));
    slider.X_WB.position = Vec3(0, 0, 0.5 + gap_m);
    slider.locks.free_axes = Vec3(1, 0, 0);
    slider.locks.turning = AxisLocks::Turning::kLocked;
    slider.linear_velocity = Vec3(1, 0, 0);
    world_.addBody(slider);
    add({Vec3(-1.5, 0, 0.5), Vec3::Ones()});
    ASSERT_TRUE(world_.start().empty());
    EXPECT_EQ(moved(1), Vec3::Zero());
    EXPECT_NEAR(moved(2).z(), 1e-3, 1e-8) << "others have their gaps as ever";
    for (int i = 0; i < 60; ++i) {
      world_.step();
      ASSERT_GT(world_.audit().smallest_gap_m, 0.0) << i;
    }
    EXPECT_EQ(moved(1).z(), 0.0);
    EXPECT_GT(moved(1).x(), 0.0);
  }
}

TEST_F(Start, IsNeededBeforeTheFirstStepAndOnlyOnce) {
  box({1, 1, 1}, Vec3::Zero());
  EXPECT_THROW(world_.step(), ContractViolation);
  EXPECT_TRUE(world_.start().empty());
  EXPECT_THROW(world_.start(), ContractViolation);
  EXPECT_THROW(world_.addSolid(Solid::ball(1)), ContractViolation);
}

}  // namespace
}  // namespace carom
