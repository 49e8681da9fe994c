// The pairs of the active ones, from step to step, against comparing everything with everything.

#include "engine/broad_phase/pair_finder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "tests/oracle/every_pair.h"
#include "tests/oracle/test_shapes.h"

namespace carom {
namespace {

using oracle::everyPair;
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

std::vector<Proxy> many(Random& random, int things) {
  std::vector<Proxy> proxies;
  for (int i = 0; i < things; ++i) proxies.push_back(somewhere(random));
  return proxies;
}

std::vector<int> allOf(const std::vector<Proxy>& proxies) {
  std::vector<int> all(proxies.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

std::vector<IndexPair> pairsWith(const std::vector<int>& active, const std::vector<Proxy>& proxies) {
  std::vector<char> is_active(proxies.size(), 0);
  for (const int i : active) is_active[static_cast<std::size_t>(i)] = 1;
  std::vector<IndexPair> pairs = everyPair(proxies);
  std::erase_if(pairs, [&](const IndexPair& pair) {
    return is_active[static_cast<std::size_t>(pair.a)] == 0 &&
           is_active[static_cast<std::size_t>(pair.b)] == 0;
  });
  return pairs;
}

// A world of trembling things, of which some come to rest and others wake, and in some steps a few leap, or
// all that are awake, or things come or go.
TEST(PairFinder, FindsInEveryStepWhatStartingAgainFinds) {
  Random random(43);
  std::size_t found = 0, rested = 0;
  for (int world = 0; world < 20; ++world) {
    std::vector<Proxy> proxies = many(random, world % 2 == 0 ? 200 : 120);
    PairFinder finder;
    std::vector<int> active = allOf(proxies);
    for (int step = 0; step < 100; ++step) {
      const int event = random.integer(0, 9);
      const double tremble = event == 0 ? 1.0 : 3e-5;
      const auto any = [&]() -> Proxy& {
        const int k = random.integer(0, static_cast<int>(active.size()) - 1);
        return proxies[static_cast<std::size_t>(active[static_cast<std::size_t>(k)])];
      };
      for (const int i : active) {
        Proxy& proxy = proxies[static_cast<std::size_t>(i)];
        if (proxy.moves) shift(proxy, tremble * random.uniform(0, 1) * random.direction());
      }
      if (event == 1) shift(any(), random.direction());
      if (event == 2 || event == 3)
        for (int i = 0; i < 3; ++i) shift(any(), random.uniform(0, 3) * random.direction());
      if (event == 4 || event == 5) shift(any(), random.uniform(0, 0.2) * random.direction());
      if (event == 6) proxies.push_back(somewhere(random));
      if (event == 7) proxies.pop_back();
      if (event == 6 || event == 7) active = allOf(proxies);
      const std::vector<IndexPair> expected = pairsWith(active, proxies);
      ASSERT_EQ(finder.find(proxies, active), expected) << "world " << world << ", step " << step;
      found += expected.size();
      rested += proxies.size() - active.size();
      if (event == 8) std::erase_if(active, [&](int) { return random.integer(0, 2) == 0; });
      if (event == 9) {
        for (int i = 0; i < 10; ++i)
          active.push_back(random.integer(0, static_cast<int>(proxies.size()) - 1));
        std::sort(active.begin(), active.end());
        active.erase(std::unique(active.begin(), active.end()), active.end());
      }
      if (active.empty()) active = allOf(proxies);
    }
  }
  EXPECT_GT(found, 1000000u);
  EXPECT_GT(rested, 10000u);
}

// What an event has made grow is asked about within the step, and paired as it then is by the next.
TEST(PairFinder, KnowsWhatHasGrownWithinAStep) {
  Random random(44);
  std::vector<Proxy> proxies = many(random, 100);
  const std::vector<int> all = allOf(proxies);
  PairFinder finder;
  for (int step = 0; step < 50; ++step) {
    ASSERT_EQ(finder.find(proxies, all), everyPair(proxies)) << step;
    const std::vector<Proxy> before = proxies;
    for (int event = 0; event < 4; ++event) {
      const int thing = random.integer(0, all.back());
      Proxy& proxy = proxies[static_cast<std::size_t>(thing)];
      proxy.bounds = widened(proxy.bounds, random.logUniform(1e-3, 1));
      finder.grow(thing, proxy.bounds);
      std::vector<int> expected;
      for (const int other : all)
        if (other != thing && oracle::meet(proxy, proxies[static_cast<std::size_t>(other)]))
          expected.push_back(other);
      std::vector<int> partners{7, 8};  // what was there before does not matter
      finder.findPartners(proxies, thing, partners);
      ASSERT_EQ(partners, expected) << step;
    }
    if (step % 4 != 0) proxies = before;
  }
}

// Counted, not timed: of a world at rest nobody is paired anew, whatever its size.
TEST(PairFinder, PairsNobodyAnewBesideWhatIsActive) {
  for (const int rest : {100, 10000}) {
    std::vector<Proxy> proxies;
    for (int i = 0; i < rest; ++i) proxies.push_back({{Vec3(2 * i, 0, 0), Vec3(2 * i + 1, 1, 1)}, true});
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

// Two hundred million pairs would take gigabytes before anything is known about them.
TEST(PairFinder, OfMorePairsThanCanBeKeptThrows) {
  std::vector<Proxy> proxies(20000, Proxy{{Vec3::Zero(), Vec3::Ones()}, true});
  EXPECT_THROW(PairFinder().find(proxies, allOf(proxies)), TooManyPairs);
  proxies.resize(1414);  // the most whose pairs, 998 991, are fewer than a million
  EXPECT_EQ(PairFinder().find(proxies, allOf(proxies)).size(), 1414u * 1413u / 2u);
  proxies.resize(1415);
  EXPECT_THROW(PairFinder().find(proxies, allOf(proxies)), TooManyPairs);
}

}  // namespace
}  // namespace carom
