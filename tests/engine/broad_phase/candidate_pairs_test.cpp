// Candidate pairs against comparing everything with everything.

#include "engine/broad_phase/candidate_pairs.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/oracle/test_shapes.h"

namespace carom {
namespace {

using oracle::Random;

std::vector<IndexPair> everyPair(const std::vector<Proxy>& proxies) {
  std::vector<IndexPair> pairs;
  for (int i = 0; i < static_cast<int>(proxies.size()); ++i)
    for (int j = i + 1; j < static_cast<int>(proxies.size()); ++j) {
      const Proxy& p = proxies[static_cast<std::size_t>(i)];
      const Proxy& q = proxies[static_cast<std::size_t>(j)];
      bool apart = p.group == q.group || (!p.moves && !q.moves);
      for (int axis = 0; axis < 3; ++axis)
        apart = apart || p.bounds.high[axis] < q.bounds.low[axis] || q.bounds.high[axis] < p.bounds.low[axis];
      if (!apart) pairs.push_back({i, j});
    }
  return pairs;
}

std::vector<Proxy> scattered(Random& random, int n, double spread, double size) {
  std::vector<Proxy> proxies;
  for (int i = 0; i < n; ++i) {
    Proxy p;
    p.bounds.low = spread * Vec3(random.uniform(-1, 1), random.uniform(-0.3, 0.3), random.uniform(-1, 1));
    p.bounds.high =
        p.bounds.low + size * Vec3(random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1));
    p.group = random.integer(0, n / 2);
    p.moves = random.integer(0, 2) > 0;
    proxies.push_back(p);
  }
  return proxies;
}

TEST(CandidatePairs, AreThoseThatComparingEverythingFinds) {
  Random random(41);
  std::size_t found = 0;
  for (int i = 0; i < 300; ++i) {
    const std::vector<Proxy> proxies =
        scattered(random, random.integer(0, 60), random.logUniform(0.1, 100), random.logUniform(0.1, 10));
    const std::vector<IndexPair> pairs = candidatePairs(proxies);
    ASSERT_EQ(pairs, everyPair(proxies)) << "case " << i;
    found += pairs.size();
  }
  EXPECT_GT(found, 1000u);
}

// Equal coordinates everywhere: ties in the sweep must neither lose nor double a pair.
TEST(CandidatePairs, OnALatticeOfTouchingCubes_IncludeEveryTouch) {
  std::vector<Proxy> proxies;
  for (int x = 0; x < 4; ++x)
    for (int y = 0; y < 4; ++y)
      for (int z = 0; z < 4; ++z)
        proxies.push_back(
            {{Vec3(x, y, z), Vec3(x + 1, y + 1, z + 1)}, static_cast<int>(proxies.size()), true});
  EXPECT_EQ(candidatePairs(proxies), everyPair(proxies));
}

TEST(CandidatePairs, OfIdenticalBoundsAreAllOfThem) {
  std::vector<Proxy> proxies(10, Proxy{{Vec3(1, 2, 3), Vec3(1, 2, 3)}, 0, true});
  for (int i = 0; i < 10; ++i) proxies[static_cast<std::size_t>(i)].group = i;
  EXPECT_EQ(candidatePairs(proxies).size(), 45u);
}

TEST(CandidatePairs, LeaveOutOneGroupAndWhatDoesNotMove) {
  const Bounds here{Vec3::Zero(), Vec3::Ones()};
  EXPECT_TRUE(candidatePairs(std::vector<Proxy>{{here, 1, true}, {here, 1, true}}).empty());
  EXPECT_TRUE(candidatePairs(std::vector<Proxy>{{here, 1, false}, {here, 2, false}}).empty());
  EXPECT_EQ(candidatePairs(std::vector<Proxy>{{here, 1, false}, {here, 2, true}}).size(), 1u);
  EXPECT_TRUE(candidatePairs({}).empty());
}

TEST(CandidatePairs, DoNotDependOnTheOrderOfTheProxies) {
  Random random(42);
  const std::vector<Proxy> proxies = scattered(random, 50, 3, 2);
  std::vector<Proxy> reversed(proxies.rbegin(), proxies.rend());
  std::vector<IndexPair> back;
  for (const IndexPair& p : candidatePairs(reversed)) back.push_back({49 - p.b, 49 - p.a});
  std::sort(back.begin(), back.end());
  EXPECT_EQ(back, candidatePairs(proxies));
}

TEST(CandidatePairs, AreSoughtAlongTheAxisOfARow_WhereverItLies) {
  for (int axis = 0; axis < 3; ++axis)
    for (const Vec3& begin : {Vec3(0, 0, 0), Vec3(100, -30, 70), Vec3(-40, 200, 5), Vec3(3, 8, -500)}) {
      std::vector<Proxy> row;
      for (int i = 0; i < 20; ++i) {
        const Vec3 low = begin + 2.0 * i * Vec3::Unit(axis) + 0.3 * (i % 2) * Vec3::Ones();
        row.push_back({{low, low + Vec3::Ones()}, i, true});
      }
      EXPECT_EQ(sweepAxis(row), axis) << "from " << begin.transpose();
    }
}

// Two hundred million pairs would take gigabytes before anything is known about them.
TEST(CandidatePairs, MoreThanCanBeKeptAreRefusedBeforeTheyAreCollected) {
  std::vector<Proxy> proxies(20000);
  for (std::size_t i = 0; i < proxies.size(); ++i)
    proxies[i] = {{Vec3::Zero(), Vec3::Ones()}, static_cast<int>(i), true};
  EXPECT_THROW(candidatePairs(proxies), TooManyPairs);
  proxies.resize(1414);  // the most whose pairs, 998 991, are fewer than a million
  EXPECT_EQ(candidatePairs(proxies).size(), 1414u * 1413u / 2u);
}

TEST(OverlapsBetween, AreThoseThatComparingEverythingFinds_NoMoreThanAsked) {
  Random random(50);
  for (int c = 0; c < 200; ++c) {
    const auto someBounds = [&](const Vec3& from) {
      std::vector<Bounds> bounds;
      for (int i = random.integer(0, 30); i > 0; --i) {
        const Vec3 low = from + random.uniform(0.0, 3.0) * random.direction();
        bounds.push_back({low, low + Vec3::Constant(random.uniform(0.1, 1.0))});
      }
      return bounds;
    };
    const std::vector<Bounds> a = someBounds(Vec3::Zero()),
                              b = someBounds(random.uniform(0.0, 6.0) * Vec3::UnitX());
    std::vector<IndexPair> expected, found;
    for (int i = 0; i < static_cast<int>(a.size()); ++i)
      for (int j = 0; j < static_cast<int>(b.size()); ++j)
        if (a[static_cast<std::size_t>(i)].overlaps(b[static_cast<std::size_t>(j)]))
          expected.push_back({i, j});
    overlapsBetween(a, b, 1000, found);
    ASSERT_EQ(found, expected) << c;
    overlapsBetween(a, b, 3, found);
    ASSERT_EQ(found.size(), std::min<std::size_t>(3, expected.size())) << c;
  }
}

TEST(Bounds, ContainThemselvesAndWhatLiesWithin) {
  const Bounds outer{Vec3(-1, -2, -3), Vec3(1, 2, 3)};
  EXPECT_TRUE(outer.contains(outer));
  EXPECT_TRUE(outer.contains({Vec3(-1, 0, 0), Vec3(0.5, 2, 1)}));
  for (int axis = 0; axis < 3; ++axis) {
    Bounds beyond = outer;
    beyond.high[axis] += 1e-9;
    EXPECT_FALSE(outer.contains(beyond));
    EXPECT_TRUE(beyond.contains(outer));
    EXPECT_TRUE(outer.overlaps(beyond));
  }
}

}  // namespace
}  // namespace carom
