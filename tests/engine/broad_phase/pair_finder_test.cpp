// The pairs of the active ones, from step to step, against sorting and sweeping all.

#include "engine/broad_phase/pair_finder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "tests/oracle/test_shapes.h"

namespace carom {
namespace {

using oracle::Random;

Proxy somewhere(Random& random) {
  Proxy p;
  p.bounds.low = 3.0 * Vec3(random.uniform(-1, 1), random.uniform(-0.3, 0.3), random.uniform(-1, 1));
  p.bounds.high = p.bounds.low + 2.0 * Vec3(random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1));
  p.moves = random.integer(0, 2) > 0;
  return p;
}

void shift(Proxy& proxy, const Vec3& by) {
  proxy.bounds.low += by;
  proxy.bounds.high += by;
}

// Groups of one to `most` proxies near each other.
std::vector<Proxy> manyGroups(Random& random, int groups, int most) {
  std::vector<Proxy> proxies;
  for (int group = 0; group < groups; ++group) {
    const Proxy first = somewhere(random);
    for (int i = random.integer(1, most); i > 0; --i) {
      proxies.push_back(first);
      proxies.back().group = group;
      shift(proxies.back(), random.uniform(0, 1) * random.direction());
    }
  }
  return proxies;
}

std::vector<int> allOf(const std::vector<Proxy>& proxies) {
  std::vector<int> all(static_cast<std::size_t>(proxies.back().group + 1));
  std::iota(all.begin(), all.end(), 0);
  return all;
}

std::vector<IndexPair> pairsWith(const std::vector<int>& active, const std::vector<Proxy>& proxies) {
  std::vector<IndexPair> pairs = candidatePairs(proxies);
  const auto isActive = [&](int i) {
    return std::binary_search(active.begin(), active.end(), proxies[static_cast<std::size_t>(i)].group);
  };
  std::erase_if(pairs, [&](const IndexPair& pair) { return !isActive(pair.a) && !isActive(pair.b); });
  return pairs;
}

// A world of trembling groups, of which some come to rest and others wake, and in some steps a few leap, or
// all that are awake, or one changes whether it can move, or proxies come or go.
TEST(PairFinder, FindsInEveryStepWhatStartingAgainFinds) {
  Random random(43);
  std::size_t found = 0, rested = 0;
  for (int world = 0; world < 20; ++world) {
    std::vector<Proxy> proxies = manyGroups(random, world % 2 == 0 ? 200 : 60, world % 2 == 0 ? 1 : 6);
    PairFinder finder;
    std::vector<int> active = allOf(proxies);
    for (int step = 0; step < 100; ++step) {
      const int event = random.integer(0, 9);
      const double tremble = event == 0 ? 1.0 : 3e-5;
      const auto isActive = [&](const Proxy& proxy) {
        return std::binary_search(active.begin(), active.end(), proxy.group);
      };
      const auto any = [&]() -> Proxy& {
        for (;;) {
          Proxy& proxy =
              proxies[static_cast<std::size_t>(random.integer(0, static_cast<int>(proxies.size()) - 1))];
          if (isActive(proxy)) return proxy;
        }
      };
      for (Proxy& proxy : proxies)
        if (isActive(proxy) && proxy.moves) shift(proxy, tremble * random.uniform(0, 1) * random.direction());
      if (event == 1) shift(any(), random.direction());
      if (event == 2 || event == 3)
        for (int i = 0; i < 3; ++i) shift(any(), random.uniform(0, 3) * random.direction());
      if (event == 4 || event == 5) any().moves = random.integer(0, 1) > 0;
      if (event == 6) {
        Proxy one_more = any();
        one_more.group = proxies.back().group + random.integer(0, 1);
        proxies.push_back(one_more);
      }
      if (event == 7) proxies.pop_back();
      if (event == 6 || event == 7) active = allOf(proxies);
      const std::vector<IndexPair> expected = pairsWith(active, proxies);
      ASSERT_EQ(finder.find(proxies, active), expected) << "world " << world << ", step " << step;
      found += expected.size();
      const std::vector<int> all = allOf(proxies);
      rested += all.size() - active.size();
      if (event == 8) std::erase_if(active, [&](int) { return random.integer(0, 2) == 0; });
      if (event == 9) {
        for (int i = 0; i < 10; ++i) active.push_back(random.integer(0, all.back()));
        std::sort(active.begin(), active.end());
        active.erase(std::unique(active.begin(), active.end()), active.end());
      }
      if (active.empty()) active = all;
    }
  }
  EXPECT_GT(found, 1000000u);
  EXPECT_GT(rested, 10000u);
}

// What an event has made grow is asked about within the step, and paired as it then is by the next.
TEST(PairFinder, KnowsWhatHasGrownWithinAStep) {
  Random random(44);
  std::vector<Proxy> proxies = manyGroups(random, 40, 4);
  const std::vector<int> all = allOf(proxies);
  PairFinder finder;
  for (int step = 0; step < 50; ++step) {
    ASSERT_EQ(finder.find(proxies, all), candidatePairs(proxies)) << step;
    const int group = random.integer(0, all.back());
    const std::vector<Proxy> before = proxies;
    std::vector<int> grown;
    std::vector<IndexPair> expected;
    for (int i = 0; i < static_cast<int>(proxies.size()); ++i) {
      Proxy& proxy = proxies[static_cast<std::size_t>(i)];
      if (proxy.group != group || random.integer(0, 3) == 0) continue;
      proxy.bounds = widened(proxy.bounds, random.uniform(0, 2));
      finder.grow(group, proxy.bounds);
      grown.push_back(i);
      for (int j = 0; j < static_cast<int>(proxies.size()); ++j)
        if (canPair(proxy, proxies[static_cast<std::size_t>(j)])) expected.push_back({i, j});
    }
    std::vector<IndexPair> partners{{7, 8}};  // what was there before does not matter
    finder.findPartners(proxies, grown, partners);
    ASSERT_EQ(partners, expected) << step;
    if (step % 2 == 0) proxies = before;
  }
}

// Counted, not timed: of a world at rest nobody is paired anew, whatever its size.
TEST(PairFinder, PairsNobodyAnewBesideWhatIsActive) {
  for (const int rest : {100, 10000}) {
    std::vector<Proxy> proxies;
    for (int i = 0; i < rest; ++i) proxies.push_back({{Vec3(2 * i, 0, 0), Vec3(2 * i + 1, 1, 1)}, i, true});
    PairFinder finder;
    finder.find(proxies, allOf(proxies));
    EXPECT_EQ(finder.pairedAnew(), proxies.size());
    for (int step = 1; step < 10; ++step) {
      for (Proxy& proxy : std::span(proxies).first(3)) shift(proxy, Vec3(0, 1, 0));
      EXPECT_TRUE(finder.find(proxies, std::vector<int>{0, 1, 2}).empty());
      EXPECT_EQ(finder.pairedAnew(), 3u) << rest;
    }
  }
}

TEST(PairFinder, OfMorePairsThanCanBeKeptThrows) {
  std::vector<Proxy> proxies(20000);
  for (std::size_t i = 0; i < proxies.size(); ++i)
    proxies[i] = {{Vec3::Zero(), Vec3::Ones()}, static_cast<int>(i), true};
  EXPECT_THROW(PairFinder().find(proxies, allOf(proxies)), TooManyPairs);
  proxies.resize(1414);  // the most whose pairs, 998 991, are fewer than a million
  EXPECT_EQ(PairFinder().find(proxies, allOf(proxies)).size(), 1414u * 1413u / 2u);
}

}  // namespace
}  // namespace carom
