// Bounds, and which of two sets overlap, against comparing everything with everything.

#include "engine/broad_phase/candidate_pairs.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/oracle/test_shapes.h"

namespace carom {
namespace {

using oracle::Random;

TEST(CanPair, TellsWhatOverlapsAndOfWhichOneMoves) {
  const Bounds here{Vec3::Zero(), Vec3::Ones()}, beside{Vec3(1, 0, 0), Vec3(2, 1, 1)},
      apart{Vec3(1.001, 0, 0), Vec3(2, 1, 1)};
  EXPECT_TRUE(canPair({here, true}, {here, false}));
  EXPECT_TRUE(canPair({here, false}, {beside, true})) << "they touch";
  EXPECT_FALSE(canPair({here, false}, {here, false}));
  EXPECT_FALSE(canPair({here, true}, {apart, true}));
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

TEST(Bounds, TogetherHoldBothAndNoMore) {
  const Bounds a{Vec3(0, -1, 2), Vec3(1, 5, 3)}, b{Vec3(-2, 0, 2), Vec3(0.5, 4, 7)};
  for (const Bounds& both : {together(a, b), together(b, a)}) {
    EXPECT_EQ(both.low, Vec3(-2, -1, 2));
    EXPECT_EQ(both.high, Vec3(1, 5, 7));
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
