// The collision time search against closed forms and against looking at d(t) very often.

#include "engine/contact/time_of_impact.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <numbers>

#include "tests/oracle/brute_force_distance.h"
#include "tests/oracle/test_shapes.h"

namespace carom {
namespace {

using oracle::Random;
using oracle::turned;
using Outcome = TimeOfImpact::Outcome;

constexpr double kGravity = 9.81;

struct Mover {
  ConvexPart part;
  Trajectory path;

  static Mover of(const Solid& solid, const Pose& X, const Vec3& velocity = Vec3::Zero(),
                  const Vec3& spin = Vec3::Zero(), const Vec3& acceleration = Vec3::Zero()) {
    return {solid.parts()[0], {0.0, X, velocity, acceleration, spin}};
  }
  MovingPart moving() const { return {&part, &path, part.core.radiusAbout(Vec3::Zero())}; }
};

ClosestFeatures closestAt(const Mover& a, const Mover& b, double t) {
  FeaturePair cold;
  return closestFeatures(a.part, a.path.at(t), b.part, b.path.at(t), cold);
}

ImpactSearch searchOf(const Mover& a, const Mover& b, double end_s, double begin_s = 0.0) {
  const CollisionWindow window = collisionWindow(a.part, b.part);
  return {window, std::sqrt(2 * kGravity * window.ceiling), begin_s, end_s};
}

TimeOfImpact find(const Mover& a, const Mover& b, const ImpactSearch& search) {
  FeaturePair tracked;
  const ClosestFeatures at_begin =
      closestFeatures(a.part, a.path.at(search.begin_s), b.part, b.path.at(search.begin_s), tracked);
  return timeOfImpact(a.moving(), b.moving(), search, at_begin, tracked);
}
TimeOfImpact find(const Mover& a, const Mover& b, double end_s) {
  return find(a, b, searchOf(a, b, end_s));
}

Mover floorBox() {
  return Mover::of(Solid::box({20, 20, 1}), {Quat::Identity(), Vec3(0, 0, -0.5)});
}

double speedAt(const Mover& a, const Mover& b, const TimeOfImpact& found) {
  const auto at = [&](const Trajectory& path, const Vec3& p) {
    return Vec3(path.velocityAt(found.time_s) + path.spin.cross(p - path.at(found.time_s).position));
  };
  return found.closest.n_W.dot(at(b.path, found.closest.p_B_W) - at(a.path, found.closest.p_A_W));
}

// Free fall through a gap h: the gap is g at sqrt(2 (h - g) / gravity), so the time lies between those of the
// window.
TEST(TimeOfImpact, OfAFallIsTheClosedFormTime) {
  const Mover ground = floorBox();
  for (double h : {0.01, 0.3, 2.0, 50.0})
    for (const auto& [solid, lowest] :
         {std::pair{Solid::ball(0.4), 0.4}, std::pair{Solid::box({0.6, 0.8, 0.5}), 0.25}}) {
      const Mover body = Mover::of(solid, {turned(Vec3::UnitZ(), 0.4), Vec3(1.3, -2.1, lowest + h)},
                                   Vec3(0.3, 0.2, 0), Vec3::Zero(), Vec3(0, 0, -kGravity));
      const ImpactSearch search = searchOf(ground, body, 5.0);
      const TimeOfImpact found = find(ground, body, search);
      ASSERT_EQ(found.outcome, Outcome::kImpact) << h;
      EXPECT_GE(found.time_s, std::sqrt(2 * (h - search.window.ceiling) / kGravity) - 1e-12) << h;
      EXPECT_LE(found.time_s, std::sqrt(2 * (h - search.window.floor) / kGravity)) << h;
      EXPECT_NEAR(found.closest.distance_m, h - 0.5 * kGravity * found.time_s * found.time_s, 1e-12);
    }
}

// Newton with its guard: within a step of the world an impact takes a handful of queries, one or two of them
// to follow it to the floor.
TEST(TimeOfImpact, WithinAStep_IsFoundInFewQueries) {
  const Mover ground = floorBox();
  const double step = 1.0 / 60;
  for (double h : {0.01, 0.3, 2.0, 50.0})
    for (double share : {0.1, 0.5, 0.9}) {
      const Mover ball = Mover::of(Solid::ball(0.4), {Quat::Identity(), Vec3(0, 0, 0.4 + h)}, Vec3(1, 0, 0),
                                   Vec3(3, 2, 1), Vec3(0, 0, -kGravity));
      const double begin = std::sqrt(2 * h / kGravity) - share * step;
      const TimeOfImpact found = find(ground, ball, searchOf(ground, ball, begin + step, begin));
      EXPECT_EQ(found.outcome, Outcome::kImpact) << h << ' ' << share;
      EXPECT_LE(found.queries, 6) << h << ' ' << share;
      EXPECT_GE(found.states, found.queries) << "each query visits one pair of features at least";
    }
}

TEST(TimeOfImpact, IsTheSameForBothOrdersOfTheBodies) {
  Random random(71);
  for (int i = 0; i < 100; ++i) {
    const Mover a = Mover::of(Solid::box({1, 0.6, 0.4}), random.pose(0.2), Vec3::Zero(), random.direction());
    const Mover b = Mover::of(Solid::box({0.5, 0.6, 0.7}), {random.rotation(), Vec3(3, 0.1, 0.2)},
                              Vec3(-4, 0, 0), 3 * random.direction());
    const TimeOfImpact ab = find(a, b, 2.0), ba = find(b, a, 2.0);
    EXPECT_EQ(ab.outcome, ba.outcome) << i;
    // Both ends lie in the window; the two searches may stop at different gaps in it.
    if (ab.outcome == Outcome::kImpact && ba.outcome == Outcome::kImpact) {
      EXPECT_NEAR(ab.time_s, ba.time_s, 4e-3) << i;
    }
  }
}

// Fig. 6: a rod that turns as it nears a wall; its distance dips with every half turn. With half length L and
// half width w, d(t) = x_wall - v t - L |cos| - w |sin|.
TEST(TimeOfImpact, OfATurningRod_IsTheEarliestDip) {
  const double L = 0.5, w = 0.02;
  for (double spin : {2.0, 7.0, 12.566, 40.0})
    for (double v : {0.05, 0.2, 0.5}) {
      const double start = 0.9;
      const Mover wall = Mover::of(Solid::box({1, 10, 10}), {Quat::Identity(), Vec3(start + 0.5, 0, 0)});
      const Mover rod = Mover::of(Solid::box({2 * L, 2 * w, 0.1}), {turned(Vec3::UnitZ(), 1.2), Vec3::Zero()},
                                  Vec3(v, 0, 0), Vec3(0, 0, spin));
      const auto gap = [&](double t) {
        const double angle = 1.2 + spin * t;
        return start - v * t - L * std::abs(std::cos(angle)) - w * std::abs(std::sin(angle));
      };
      const ImpactSearch search = searchOf(rod, wall, 20.0);
      const TimeOfImpact found = find(rod, wall, search);
      double below_floor = 20.0;
      for (double t = 0.0; t < 20.0; t += 1e-5)
        if (gap(t) < search.window.floor) {
          below_floor = t;
          break;
        }
      SCOPED_TRACE(testing::Message() << "spin " << spin << " v " << v);
      ASSERT_EQ(found.outcome, Outcome::kImpact);
      EXPECT_LE(found.time_s, below_floor) << "a dip was passed over";
      EXPECT_NEAR(gap(found.time_s), found.closest.distance_m, 1e-12);
      EXPECT_LE(found.closest.distance_m, search.window.ceiling);
      EXPECT_GE(found.closest.distance_m, search.window.floor);
      for (double t = 0.0; t < found.time_s; t += 1e-5) ASSERT_GE(gap(t), search.window.floor);
    }
}

// What the search claims, checked by looking at the pair at many instants.
void expectClaimsHold(const Mover& a, const Mover& b, double end_s, int looks, int (&seen)[3]) {
  const ImpactSearch search = searchOf(a, b, end_s);
  const TimeOfImpact found = find(a, b, search);
  ++seen[static_cast<int>(found.outcome)];
  double least = std::numeric_limits<double>::infinity(), least_at = 0.0;
  for (int k = 0; k <= looks; ++k) {
    const double t = found.time_s * k / looks;
    if (const double d = closestAt(a, b, t).distance_m; d < least) {
      least = d;
      least_at = t;
    }
  }
  const double truth = static_cast<double>(oracle::signedGap(oracle::place(a.part, a.path.at(least_at)),
                                                             oracle::place(b.part, b.path.at(least_at))));
  ASSERT_NEAR(truth, least, 1e-12) << "the looks themselves";
  ASSERT_GE(truth, search.window.floor * (1 - 1e-6)) << "below the floor before the returned time";
  ASSERT_NEAR(found.closest.distance_m,
              closestAt(a, b, found.outcome == Outcome::kClear ? 0.0 : found.time_s).distance_m,
              found.outcome == Outcome::kClear ? 1e300 : 1e-12);
  switch (found.outcome) {
    case Outcome::kClear:
      ASSERT_EQ(found.time_s, end_s);
      break;
    case Outcome::kImpact:
      ASSERT_LE(found.closest.distance_m, search.window.ceiling);
      ASSERT_LT(speedAt(a, b, found), -search.collision_speed_mps);
      break;
    case Outcome::kStopped:
      ASSERT_LE(found.closest.distance_m, search.window.ceiling)
          << "stopped for want of iterations, far from anything";
      break;
    case Outcome::kPending:
      FAIL() << "the whole search leaves nothing pending";
  }
}

TEST(TimeOfImpact, NeverPassesAContact_TurningUpToAFullTurn) {
  const std::uint64_t seed = 72;
  Random random(seed);
  int seen[3] = {};
  for (int i = 0; i < 3000; ++i) {
    SCOPED_TRACE(testing::Message() << "seed " << seed << " case " << i);
    const Solid solid_a = Solid::polyhedron(oracle::randomHull(
        random, random.integer(4, 14), Vec3(1, random.uniform(0.05, 1), random.uniform(0.05, 1))));
    const Solid solid_b = Solid::polyhedron(
        oracle::randomHull(random, random.integer(4, 14), Vec3(random.uniform(0.05, 1), 1, 0.5)));
    const double turn = 2 * std::numbers::pi;  // over the second that is searched
    const Vec3 away = random.uniform(2.1, 3) * random.direction();
    const Vec3 aim = (-away + 1.2 * random.direction()) * random.logUniform(0.3, 30);
    const Mover a = Mover::of(solid_a, {random.rotation(), Vec3::Zero()}, Vec3::Zero(),
                              random.uniform(0, turn) * random.direction());
    const Mover b =
        Mover::of(solid_b, {random.rotation(), away}, aim, random.uniform(0, turn) * random.direction(),
                  random.uniform(0, 10) * random.direction());
    expectClaimsHold(a, b, 1.0, 60, seen);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(seen[static_cast<int>(Outcome::kClear)], 300);
  EXPECT_GT(seen[static_cast<int>(Outcome::kImpact)], 1000);
  EXPECT_LT(seen[static_cast<int>(Outcome::kStopped)], 30);
}

TEST(TimeOfImpact, NeverPassesAContact_OfBallsAndCapsules) {
  const std::uint64_t seed = 73;
  Random random(seed);
  int seen[3] = {};
  for (int i = 0; i < 1000; ++i) {
    SCOPED_TRACE(testing::Message() << "seed " << seed << " case " << i);
    const Solid a_solid = Solid::capsule(random.uniform(0.05, 0.3), random.uniform(0.5, 2));
    const Solid b_solid = i % 2 ? Solid::ball(0.3) : Solid::box({1, 0.3, 0.4});
    const Vec3 away = random.uniform(2.3, 3) * random.direction();
    const Mover a =
        Mover::of(a_solid, {random.rotation(), Vec3::Zero()}, Vec3::Zero(), 6 * random.direction());
    const Mover b =
        Mover::of(b_solid, {random.rotation(), away},
                  (-away + 0.7 * random.direction()) * random.logUniform(0.5, 30), 6 * random.direction());
    expectClaimsHold(a, b, 1.0, 60, seen);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(seen[static_cast<int>(Outcome::kImpact)], 300);
}

TEST(TimeOfImpact, OfASmallBoxAgainstAThinWall_IsFoundAtAnySpeed) {
  const Mover wall = Mover::of(Solid::box({0.02, 5, 5}), Pose{});
  for (double speed : {1.0, 10.0, 100.0, 1e3, 1e4})
    for (double spin : {0.0, 30.0, 300.0}) {
      const Mover bullet =
          Mover::of(Solid::box({0.1, 0.1, 0.1}), {turned({1, 2, 3}, 0.6), Vec3(-1.0, 0.1, 0.2)},
                    Vec3(speed, 0, 0), spin * Vec3(0.6, 0, 0.8));
      const TimeOfImpact found = find(bullet, wall, 2.0);
      ASSERT_EQ(found.outcome, Outcome::kImpact) << speed << " m/s, spin " << spin;
      // Between 0.99 less half the diagonal and 0.99 less half a side: the wall's surface is met by whatever
      // is in front.
      EXPECT_LE(found.time_s * speed, 0.99 - 0.05 + 1e-9);
      EXPECT_GE(found.time_s * speed, 0.99 - 0.05 * std::sqrt(3.0) - 1e-3);
    }
}

TEST(TimeOfImpact, InsideTheWindowAndFast_IsAtOnce) {
  const Mover ground = floorBox();
  const Mover box =
      Mover::of(Solid::box({1, 1, 1}), {Quat::Identity(), Vec3(0, 0, 0.5 + 1e-3)}, Vec3(0, 0, -5));
  const TimeOfImpact found = find(ground, box, 1.0);
  EXPECT_EQ(found.outcome, Outcome::kImpact);
  EXPECT_EQ(found.time_s, 0.0);
  EXPECT_EQ(found.queries, 1);  // where the floor would be reached
}

// A box that slides towards a slab beside it, whose top is as far below the box's base as the gap says:
// obliquely it comes into the window fast.
TEST(TimeOfImpact, OfWhatPassesAnEdge_IsNone_AndOfWhatHitsIt_IsAnImpact) {
  const Mover slab = Mover::of(Solid::box({1, 1, 1}), {Quat::Identity(), Vec3(0, 0, -0.5)});
  const CollisionWindow window = collisionWindow(1.0);
  for (const bool lands : {false, true})
    for (const double gap : {1.5 * window.floor, window.rest, 1.5 * window.rest})
      for (const double speed : {1.0, 30.0, 1000.0}) {
        const Mover box = Mover::of(Solid::box({1, 1, 1}), {Quat::Identity(), Vec3(-1.01, 0, 0.5 + gap)},
                                    Vec3(speed, 0, 0));
        ImpactSearch search = searchOf(slab, box, 0.5 / speed);
        search.lands = lands;
        EXPECT_EQ(find(slab, box, search).outcome, Outcome::kClear) << gap << ' ' << speed;
        const Mover lower =
            Mover::of(Solid::box({1, 1, 1}), {Quat::Identity(), Vec3(-1.01, 0, 0.5 + 0.5 * window.floor)},
                      Vec3(speed, 0, 0));
        EXPECT_EQ(find(slab, lower, search).outcome, Outcome::kImpact) << speed;
      }
}

TEST(TimeOfImpact, InsideTheWindowAndLeaving_IsClear) {
  const Mover ground = floorBox();
  for (double gap : {0.3e-3, 1e-3, 1.9e-3}) {
    const Mover box = Mover::of(Solid::box({1, 1, 1}), {Quat::Identity(), Vec3(0, 0, 0.5 + gap)},
                                Vec3(1, 0, 0.5), Vec3(0, 0, 1));
    const TimeOfImpact found = find(ground, box, 1.0);
    EXPECT_EQ(found.outcome, Outcome::kClear) << gap;
    EXPECT_EQ(found.time_s, 1.0);
  }
}

TEST(TimeOfImpact, BelowTheFloor_MayLeaveButNotComeCloser) {
  const Mover ground = floorBox();
  const Pose X{Quat::Identity(), Vec3(0, 0, 0.5 + 1e-4)};
  EXPECT_EQ(find(ground, Mover::of(Solid::box({1, 1, 1}), X, Vec3(0, 0, 0.2)), 1.0).outcome, Outcome::kClear);
  EXPECT_EQ(find(ground, Mover::of(Solid::box({1, 1, 1}), X, Vec3(0.3, 0, 0)), 1.0).outcome, Outcome::kClear);
  const TimeOfImpact slow = find(ground, Mover::of(Solid::box({1, 1, 1}), X, Vec3(0, 0, -0.01)), 1.0);
  EXPECT_EQ(slow.outcome, Outcome::kStopped);
  EXPECT_EQ(slow.time_s, 0.0);
  const TimeOfImpact fast = find(ground, Mover::of(Solid::box({1, 1, 1}), X, Vec3(0, 0, -3)), 1.0);
  EXPECT_EQ(fast.outcome, Outcome::kImpact);
  EXPECT_EQ(fast.time_s, 0.0);
}

// Looks at d(t) a thousand times up to where the search says that it is proven.
void expectProven(const Mover& a, const Mover& b, const TimeOfImpact& found) {
  for (int i = 0; i <= 1000; ++i)
    ASSERT_GE(closestAt(a, b, found.time_s * i / 1000).distance_m, found.floor) << i;
}

// Two edges that cross at the floor. One turns about the other, so that along every direction that stands
// still or turns with one body some end of an edge comes down at once, though the edges part.
TEST(TimeOfImpact, OfEdgesThatCrossAtTheFloorAndPart_IsClear) {
  const double half_diagonal = std::sqrt(0.5);
  for (const double spin : {0.1, 1.0, 10.0}) {
    const Mover a =
        Mover::of(Solid::box({1, 1, 1}), {turned(Vec3::UnitX(), 0.25 * std::numbers::pi), Vec3::Zero()},
                  Vec3::Zero(), spin * Vec3::UnitY());
    Mover b =
        Mover::of(Solid::box({1, 1, 1}), {turned(Vec3::UnitY(), 0.25 * std::numbers::pi), Vec3::Zero()});
    const ImpactSearch search = searchOf(a, b, 1.0 / 240);
    b.path.X_WB.position.z() = 2.0 * half_diagonal + search.window.floor;
    // The ridge rises by h (1 / cos(w t) - 1) below the other edge.
    b.path.velocity.z() = half_diagonal * spin * spin * search.end_s;
    const TimeOfImpact found = find(a, b, search);
    EXPECT_EQ(found.outcome, Outcome::kClear) << spin;
    EXPECT_LT(found.looks, 20) << spin;
    expectProven(a, b, found);
  }
}

// A box just past standing on its edge turns away from the ground, and comes down on the next edge 89 degrees
// later: that it parts at first must not be taken for nothing because it ends below.
TEST(TimeOfImpact, OfWhatPartsAndComesBack_IsFoundWhereItComesBack) {
  const Mover ground = floorBox();
  const auto extent = [](double angle) {
    return 0.5 * (std::abs(std::cos(angle)) + std::abs(std::sin(angle)));
  };
  const double begin = 46.0 * std::numbers::pi / 180, spin = 20.0, sinking = 0.1;
  Mover box = Mover::of(Solid::box({1, 1, 1}), {turned(Vec3::UnitY(), begin), Vec3::Zero()},
                        Vec3(0, 0, -sinking), spin * Vec3::UnitY());
  const ImpactSearch search = searchOf(ground, box, 0.1);
  box.path.X_WB.position.z() = extent(begin) + search.window.floor;
  const auto gap = [&](double t) { return box.path.at(t).position.z() - extent(begin + spin * t); };
  double back = 0.02;  // when it is at the floor again
  while (gap(back) > search.window.floor) back += 1e-6;
  const TimeOfImpact found = find(ground, box, search);
  EXPECT_EQ(found.outcome, Outcome::kImpact);
  EXPECT_LE(found.time_s, back);
  EXPECT_GE(gap(found.time_s), search.window.floor);
  EXPECT_LE(gap(found.time_s), search.window.ceiling);
  EXPECT_GT(found.time_s, 0.9 * back);
  expectProven(ground, box, found);
}

TEST(TimeOfImpact, OfASlowApproach_StopsAtTheFloor) {
  const Mover ground = floorBox();
  const double gap = 1.8e-3, speed = 0.01;
  const Mover box =
      Mover::of(Solid::box({1, 1, 1}), {Quat::Identity(), Vec3(0, 0, 0.5 + gap)}, Vec3(0, 0, -speed));
  const ImpactSearch search = searchOf(ground, box, 1.0);
  const TimeOfImpact found = find(ground, box, search);
  EXPECT_EQ(found.outcome, Outcome::kStopped);
  EXPECT_GE(found.closest.distance_m, search.window.floor);
  EXPECT_LE(found.closest.distance_m, 1.1 * search.window.floor);
  EXPECT_LE(found.time_s, (gap - search.window.floor) / speed);
}

TEST(TimeOfImpact, OfAGrazingPass_IsClear) {
  const Mover ground = floorBox();
  const Mover ball = Mover::of(Solid::ball(0.5), {Quat::Identity(), Vec3(-5, 0, 0.5 + 2.2e-3)},
                               Vec3(10, 0, 0), Vec3(0, 30, 0));
  const TimeOfImpact over = find(ground, ball, 1.0);
  EXPECT_EQ(over.outcome, Outcome::kClear);
  EXPECT_EQ(over.time_s, 1.0);
  // Two balls pass each other at a hair's breadth, beside the window.
  const Mover still = Mover::of(Solid::ball(0.5), Pose{});
  const Mover passing =
      Mover::of(Solid::ball(0.5), {Quat::Identity(), Vec3(-5, 0, 1.0 + 2.1e-3)}, Vec3(10, 0, 0));
  EXPECT_EQ(find(still, passing, 1.0).outcome, Outcome::kClear);
  const Mover striking =
      Mover::of(Solid::ball(0.5), {Quat::Identity(), Vec3(-5, 0, 1.0 - 0.02)}, Vec3(10, 0, 0));
  EXPECT_EQ(find(still, striking, 1.0).outcome, Outcome::kImpact);
}

TEST(TimeOfImpact, OfTwoThatTravelTogether_IsClearWithoutAQuery) {
  const Mover a =
      Mover::of(Solid::box({1, 1, 1}), Pose{}, Vec3(100, 20, 3), Vec3::Zero(), Vec3(0, 0, -kGravity));
  const Mover b = Mover::of(Solid::box({1, 1, 1}), {Quat::Identity(), Vec3(0.2, 1.5, 0)}, Vec3(100, 20, 3),
                            Vec3::Zero(), Vec3(0, 0, -kGravity));
  const TimeOfImpact found = find(a, b, 1.0);
  EXPECT_EQ(found.outcome, Outcome::kClear);
  EXPECT_EQ(found.queries, 0);
}

// A box stands with a corner, an edge or a face near another's face and slides over it while both
// turn, each as it likes, but so that the contact neither opens nor closes. What turns with the contact sees
// the gap stay; in directions that stand still, faces would seem to sweep through each other at once.
TEST(TimeOfImpact, OfTwoThatSlideAndTurnInContact_NeedsFewQueries) {
  Random random(83);
  const auto within = [&random](double most) {
    const Vec3 direction = random.direction();
    return Vec3(random.uniform(0, most) * direction);
  };
  const Solid box = Solid::box(Vec3::Constant(0.5));
  constexpr int kPairs = 400;
  int queries = 0, unclear = 0;
  for (int i = 0; i < kPairs; ++i) {
    const Quat R_WA = random.rotation();
    const Quat R_WB = i % 4 == 0 ? R_WA : random.rotation();
    const Vec3 n = R_WA * Vec3::UnitZ();
    const double x = random.uniform(-0.2, 0.2);
    const double y = random.uniform(-0.2, 0.2);
    const Vec3 r_a = R_WA * Vec3(x, y, 0.25);  // of the contact, on A
    const Velocity of_a{within(1.0), within(2.0)};
    const Mover a = Mover::of(box, {R_WA, Vec3(1, 2, 3)}, of_a.linear, of_a.angular);
    Mover b = Mover::of(box, {R_WB, Vec3::Zero()}, Vec3::Zero(), within(2.0));
    const Vec3 r_b = R_WB * b.part.core.vertex(b.part.core.support(R_WB.conjugate() * -n, 0));
    const double gap = random.uniform(0.8, 1.1) * collisionWindow(a.part, b.part).rest;
    b.path.X_WB.position = a.path.X_WB.position + r_a + gap * n - r_b;
    b.path.velocity = of_a.at(r_a + gap * n) + n.cross(within(0.3)) - b.path.spin.cross(r_b);
    const ImpactSearch search = searchOf(a, b, 1.0 / 60.0);
    const TimeOfImpact found = find(a, b, search);
    queries += found.queries;
    unclear += found.outcome != Outcome::kClear;
    for (int k = 0; k <= 50; ++k)
      ASSERT_GE(closestAt(a, b, k * found.time_s / 50).distance_m, search.window.floor * (1 - 1e-9)) << i;
  }
  EXPECT_LT(queries, 2 * kPairs);
  EXPECT_LT(unclear, kPairs / 4) << "few turn so that another corner comes down";
}

// Bodies keep time on their own: paths that started earlier, searched from a later instant.
// A pin that rolls: its spin is along it, so that the gap hardly changes, and Newton's tries, each a tenth
// shorter than the last, end while their bounds prove nothing yet. What is left then was the least that any
// motion could do.
TEST(TimeOfImpact, OfAPinThatRollsFast_NeedsFewQueries) {
  const Mover ground = floorBox();
  const double radius = 1.13e-4;
  for (double gap : {6e-7, 2e-7})
    for (double tilt : {0.0, 1e-5}) {
      const Mover pin = Mover::of(
          Solid::capsule(radius, 9.06e-3),
          {turned(Vec3::UnitY(), 0.5 * std::numbers::pi + tilt), Vec3(0, 0, radius + gap + 4.53e-3 * tilt)},
          Vec3(0, 0.1, 0), Vec3(6700.0, 0, 0));
      const TimeOfImpact found = find(ground, pin, 5e-4);
      EXPECT_LE(found.looks, 400) << gap << ' ' << tilt;
      EXPECT_GE(found.closest.distance_m, searchOf(ground, pin, 5e-4).window.floor);
    }
}

TEST(TimeOfImpact, WithPathsOfDifferentStarts_IsTheSameInstant) {
  const Mover ground = floorBox();
  Mover whole = Mover::of(Solid::ball(0.4), {Quat::Identity(), Vec3(0, 0, 3.4)}, Vec3(0.3, 0, 1),
                          Vec3(1, 0, 0), Vec3(0, 0, -kGravity));
  const TimeOfImpact from_zero = find(ground, whole, 3.0);
  Mover later = whole;
  later.path.start_s = 0.3;
  later.path.X_WB = whole.path.at(0.3);
  later.path.velocity = whole.path.velocityAt(0.3);
  ImpactSearch search = searchOf(ground, later, 3.0, 0.5);
  const TimeOfImpact from_half = find(ground, later, search);
  ASSERT_EQ(from_half.outcome, Outcome::kImpact);
  const double speed = 1.0 - kGravity * from_zero.time_s;
  EXPECT_NEAR(from_half.time_s, from_zero.time_s, search.window.ceiling / std::abs(speed));
}

// A box of unequal sides that tumbles torque-free, 2 to 60 rad/s, past a post: wherever one looks on the way
// that the search calls proven, the gap is above the floor.
TEST(TimeOfImpact, OfATumblingBody_IsProvenAllTheWay) {
  Random random(79);
  const Mover post = Mover::of(Solid::box({0.2, 0.2, 3}), {turned(Vec3(1, 2, 3), 0.5), Vec3::Zero()});
  int impacts = 0;
  for (int i = 0; i < 300; ++i) {
    // In braces, so that every compiler draws them in this order.
    const Vec3 size{1.0, random.uniform(0.1, 0.5), random.uniform(0.5, 0.9)};
    const Solid solid = Solid::box(size);
    const Inertia inertia = inertiaOf(500.0, solid.volume(), solid.unitInertia());
    const Pose X{random.rotation(), Vec3{0.75 + random.uniform(0, 0.3), 0.0, random.uniform(-1, 1)}};
    const Vec3 velocity(random.uniform(-2, 1), 0, 0);
    Mover body = Mover::of(solid, X, velocity);
    const double end = 0.1;
    const double speed = random.logUniform(2, 60);
    const Vec3 w = speed * random.direction();
    body.path.spin = torqueFreeSpin(inertia, X.rotation, w, end);
    body.path.tumbling = FreeRotation(inertia, X.rotation, w);
    if (closestAt(post, body, 0.0).distance_m < 0.01) continue;
    const ImpactSearch search = searchOf(post, body, end);
    const TimeOfImpact found = find(post, body, search);
    impacts += found.outcome == Outcome::kImpact;
    for (int k = 0; k <= 200; ++k)
      ASSERT_GE(closestAt(post, body, k * found.time_s / 200).distance_m, search.window.floor * (1 - 1e-9))
          << i << " at " << k << " of 200, outcome " << static_cast<int>(found.outcome);
    if (found.outcome == Outcome::kImpact) {
      EXPECT_LE(found.closest.distance_m, search.window.ceiling) << i;
    }
  }
  EXPECT_GT(impacts, 30);
}

}  // namespace
}  // namespace carom
