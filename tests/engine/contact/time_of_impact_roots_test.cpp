// Distances with several roots in one search, or with none by a hair (paper §2.3, fig. 6): the impact
// returned is before the first root, and a pass that stays out of the window is clear. All distances are
// closed forms.

#include <gtest/gtest.h>

#include <functional>

#include "engine/contact/time_of_impact.h"
#include "tests/oracle/test_shapes.h"

namespace carom {
namespace {

using oracle::turned;
using Outcome = TimeOfImpact::Outcome;
constexpr double kGravity = 9.81;

struct Flight {
  ConvexPart part;
  Trajectory path;

  Flight(const Solid& solid, const Trajectory& along) : part(solid.parts()[0]), path(along) {}
  MovingPart moving() const { return {&part, &path, part.core.radiusAbout(Vec3::Zero())}; }
};

Trajectory still(const Vec3& position) {
  return {0.0, {Quat::Identity(), position}, Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
}

struct Search {
  CollisionWindow window;
  TimeOfImpact found;

  Search(const Flight& a, const Flight& b, double end_s) : window(collisionWindow(a.part, b.part)) {
    const ImpactSearch search{window, std::sqrt(2.0 * kGravity * window.ceiling), 0.0, end_s};
    FeaturePair tracked;
    const ClosestFeatures begin = closestFeatures(a.part, a.path.at(0.0), b.part, b.path.at(0.0), tracked);
    found = timeOfImpact(a.moving(), b.moving(), search, begin, tracked);
  }
};

// The first of `looks` instants at which a distance is below a bound; the end where there is none.
double firstBelow(const std::function<double(double)>& distance, double bound, double end_s,
                  int looks = 200000) {
  for (int i = 0; i <= looks; ++i)
    if (const double t = end_s * i / looks; distance(t) < bound) return t;
  return end_s;
}

class Throw : public testing::TestWithParam<double> {};  // how much of a 4 m throw's height is missing, m

// A ball thrown up at a ceiling: d = h - v t + g t^2 / 2 has two roots or, by a hair, none.
TEST_P(Throw, UpAtACeiling_MeetsTheFirstRootOrNone) {
  const double v = std::sqrt(2.0 * kGravity * 4.0), h = 4.0 + GetParam();
  const Flight ceiling(Solid::box({20, 20, 1}), still({0, 0, 0.5}));
  for (double radius : {0.05, 0.4}) {
    SCOPED_TRACE(testing::Message() << "radius " << radius);
    const Flight ball(Solid::ball(radius), {0.0,
                                            {Quat::Identity(), Vec3(0, 0, -h - radius)},
                                            Vec3(0.7, 0, v),
                                            Vec3(0, 0, -kGravity),
                                            Vec3(1, 2, 3)});
    const double end_s = 2.0 * v / kGravity;
    const Search s(ceiling, ball, end_s);
    if (GetParam() > s.window.ceiling) {
      EXPECT_EQ(s.found.outcome, Outcome::kClear);
      EXPECT_EQ(s.found.time_s, end_s);
    } else if (GetParam() < s.window.floor) {
      const double drop = 4.0 + GetParam() - s.window.floor;
      EXPECT_NE(s.found.outcome, Outcome::kClear);
      EXPECT_LE(s.found.time_s, (v - std::sqrt(v * v - 2.0 * kGravity * drop)) / kGravity);
      EXPECT_LE(s.found.closest.distance_m, s.window.ceiling);
      EXPECT_GE(s.found.closest.distance_m, s.window.floor * (1.0 - 1e-9));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Clearances, Throw,
                         testing::Values(-1.0, -0.1, -1e-3, -1e-6, -1e-9, 0.0, 1e-6, 1.01e-3, 2.01e-3, 0.1));

// A ball passes a post of the same radius: d = sqrt(b^2 + (x0 + v t)^2) - 2 r, nearest b - 2 r, at any speed.
TEST(Roots, OfAGrazingPass_AreMetOrLeftAloneByTheWindow) {
  const double r = 0.5;
  const Flight post(Solid::ball(r), still(Vec3::Zero()));
  for (double speed : {1.0, 100.0, 1e4})
    for (double clearance : {-0.2, -1e-3, -1e-6, 0.0, 0.9e-4, 2.0001e-3, 2.1e-3, 0.1}) {
      SCOPED_TRACE(testing::Message() << "speed " << speed << " clearance " << clearance);
      const double b = 2.0 * r + clearance;
      const Flight ball(
          Solid::ball(r),
          {0.0, {Quat::Identity(), Vec3(-5, b, 0)}, Vec3(speed, 0, 0), Vec3::Zero(), Vec3(0, 0, 9)});
      const Search s(post, ball, 10.0 / speed);
      if (clearance > s.window.ceiling) {
        EXPECT_EQ(s.found.outcome, Outcome::kClear);
        continue;
      }
      const double at_floor = 2.0 * r + s.window.floor;
      ASSERT_NE(s.found.outcome, Outcome::kClear);
      EXPECT_LE(s.found.time_s * speed, 5.0 - std::sqrt(at_floor * at_floor - b * b) + 1e-9);
      EXPECT_LE(s.found.closest.distance_m, s.window.ceiling);
    }
}

// A rod that turns many times in one search while it drifts at a wall: d = x - v t - L |cos| - w |sin| dips
// twice a turn. The first dips miss by more than the window, and a later one is the first to go below.
TEST(Roots, OfAFastRod_AreCountedByTheirDips) {
  const double L = 0.5, w = 0.02;
  for (double spin : {50.0, 500.0})
    for (int dip : {1, 2, 5, 9}) {
      SCOPED_TRACE(testing::Message() << "spin " << spin << " dip " << dip);
      const double half_turn = std::numbers::pi / spin;
      const double v = 0.02 / half_turn;  // two centimetres between dips
      // Dips come at (k + 1/2) half turns; number `dip`, counted from 0, goes 1 cm too deep.
      const double start = L + v * half_turn * (dip + 0.5) - 0.01;
      const Flight wall(Solid::box({1, 10, 10}), still({start + 0.5, 0, 0}));
      const Flight rod(Solid::box({2 * L, 2 * w, 0.1}),
                       {0.0,
                        {turned(Vec3::UnitZ(), 0.5 * std::numbers::pi), Vec3::Zero()},
                        Vec3(v, 0, 0),
                        Vec3::Zero(),
                        Vec3(0, 0, spin)});
      const auto gap = [&](double t) {
        const double angle = 0.5 * std::numbers::pi + spin * t;
        return start - v * t - L * std::abs(std::cos(angle)) - w * std::abs(std::sin(angle));
      };
      const double end_s = half_turn * (dip + 3);
      const Search s(rod, wall, end_s);
      ASSERT_EQ(s.found.outcome, Outcome::kImpact);
      EXPECT_LE(s.found.time_s, firstBelow(gap, s.window.floor, end_s)) << "a dip was passed over";
      EXPECT_GE(s.found.time_s, firstBelow(gap, s.window.ceiling, end_s) - end_s / 200000) << "too early";
      EXPECT_NEAR(gap(s.found.time_s), s.found.closest.distance_m, 1e-12);
    }
}

// The dip before misses the window's ceiling by 1 %, and is not taken for the one that follows.
TEST(Roots, OfTwoDipsWhereTheFirstJustMisses_AreTheSecond) {
  const double L = 0.5, w = 0.02, spin = 7.0, v = 0.05;
  const auto dip = [&](double start, double t) {
    const double angle = 1.2 + spin * t;
    return start - v * t - L * std::abs(std::cos(angle)) - w * std::abs(std::sin(angle));
  };
  const double first_end_s =
      (1.5 * std::numbers::pi - 1.2) / spin;  // the rod stands upright between the dips
  double least = 1.0;
  for (int i = 0; i <= 1000000; ++i) least = std::min(least, dip(0.0, first_end_s * i * 1e-6));
  const Flight shape(Solid::box({2 * L, 2 * w, 0.1}), still(Vec3::Zero()));
  const Flight slab(Solid::box({1, 10, 10}), still(Vec3::Zero()));
  const CollisionWindow window = collisionWindow(shape.part, slab.part);
  const double start = 1.01 * window.ceiling - least;
  const Flight wall(Solid::box({1, 10, 10}), still({start + 0.5, 0, 0}));
  const Flight rod(
      Solid::box({2 * L, 2 * w, 0.1}),
      {0.0, {turned(Vec3::UnitZ(), 1.2), Vec3::Zero()}, Vec3(v, 0, 0), Vec3::Zero(), Vec3(0, 0, spin)});
  const Search s(rod, wall, 5.0);
  ASSERT_EQ(s.found.outcome, Outcome::kImpact);
  EXPECT_GT(s.found.time_s, first_end_s);
  EXPECT_LE(s.found.time_s, firstBelow([&](double t) { return dip(start, t); }, window.floor, 5.0));
}

}  // namespace
}  // namespace carom
