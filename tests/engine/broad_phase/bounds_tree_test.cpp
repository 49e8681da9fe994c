// What a tree finds, against asking everybody.

#include "engine/broad_phase/bounds_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "tests/oracle/test_shapes.h"

namespace carom {
namespace {

using oracle::Random;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::vector<int> everyoneAt(const std::vector<Bounds>& all, const Bounds& where) {
  std::vector<int> found;
  for (std::size_t i = 0; i < all.size(); ++i) {
    bool apart = false;
    for (int axis = 0; axis < 3; ++axis)
      apart = apart || where.high[axis] < all[i].low[axis] || all[i].high[axis] < where.low[axis];
    if (!apart) found.push_back(static_cast<int>(i));
  }
  return found;
}

std::vector<int> foundAt(const BoundsTree& tree, const Bounds& where) {
  std::vector<int> found{-1};  // what was there before does not matter
  tree.find(where, found);
  std::sort(found.begin(), found.end());
  return found;
}

Vec3 randomVector(Random& random, double low, double high) {
  Vec3 v;
  for (int axis = 0; axis < 3; ++axis) v[axis] = random.uniform(low, high);
  return v;
}

// Of many bodies with a few floors and walls among them.
struct Place {
  double spread = 1.0;
  double size = 1.0;
};
Bounds anyBounds(Random& random, const Place& place) {
  Bounds bounds;
  bounds.low = place.spread * randomVector(random, -1, 1);
  bounds.high = bounds.low + place.size * randomVector(random, 0, 1);
  const int wide = random.integer(0, 50);
  if (wide < 3) bounds.high[wide] += 3.0 * place.spread;
  if (wide == 3) bounds.low.x() = bounds.low.y() = -kInfinity;
  if (wide == 3) bounds.high.x() = bounds.high.y() = kInfinity;
  return bounds;
}

TEST(BoundsTree, FindsWhatAskingEverybodyFinds_WhileThingsMoveAndGrow) {
  Random random(43);
  BoundsTree tree;
  std::size_t found = 0;
  for (int c = 0; c < 100; ++c) {
    const Place place{random.logUniform(0.1, 100.0), random.logUniform(0.1, 10.0)};
    std::vector<Bounds> all;
    for (int i = random.integer(1, 200); i > 0; --i) all.push_back(anyBounds(random, place));
    tree.build(all);
    ASSERT_EQ(tree.size(), static_cast<int>(all.size()));
    for (int change = 0; change < 200; ++change) {
      const int i = random.integer(0, static_cast<int>(all.size()) - 1);
      Bounds& bounds = all[static_cast<std::size_t>(i)];
      const std::vector<int> expected = everyoneAt(all, bounds);
      ASSERT_EQ(foundAt(tree, bounds), expected) << "case " << c << " after " << change;
      found += expected.size();
      if (change % 2 == 0) {
        bounds = anyBounds(random, place);
        tree.move(i, bounds);
        ASSERT_TRUE(tree.bounds(i).contains(bounds) && bounds.contains(tree.bounds(i)));
      } else {
        const Bounds more = anyBounds(random, place);
        bounds = {bounds.low.cwiseMin(more.low), bounds.high.cwiseMax(more.high)};
        tree.grow(i, more);
      }
    }
  }
  EXPECT_GT(found, 100000u);
}

// By little, so that the tree keeps its shape, and to anywhere, so that it is built anew.
TEST(BoundsTree, FindsWhatAskingEverybodyFinds_WhenAllMoveAtOnce) {
  Random random(45);
  BoundsTree tree;
  for (int c = 0; c < 50; ++c) {
    const Place place{random.logUniform(0.1, 100.0), random.logUniform(0.1, 10.0)};
    std::vector<Bounds> all(static_cast<std::size_t>(random.integer(1, 100)));
    for (int change = 0; change < 10; ++change) {
      for (Bounds& bounds : all) {
        if (change % 5 == 0) bounds = anyBounds(random, place);
        const Vec3 shift = 0.1 * place.size * random.direction();
        bounds = {bounds.low + shift, bounds.high + shift};
      }
      tree.moveAll(all);
      for (const Bounds& bounds : all) ASSERT_EQ(foundAt(tree, bounds), everyoneAt(all, bounds)) << c;
    }
  }
}

// A thousand boxes about the corners of a grid, numbered in any order, and what finding the neighbours of
// each costs.
class BoundsTreeOfAGrid : public testing::Test {
 protected:
  BoundsTreeOfAGrid() {
    for (int x = 0; x < 10; ++x)
      for (int y = 0; y < 10; ++y)
        for (int z = 0; z < 10; ++z) {
          const Vec3 low = Vec3(x, y, z) + 0.1 * random_.direction();
          all_.push_back({low, low + Vec3::Constant(0.7)});
        }
    BoundsTree tree;
    tree.build(all_);
    new_cost_ = cost(tree);
  }
  std::vector<Bounds> inAnyOrder() {
    std::vector<Bounds> shuffled = all_;
    for (int i = static_cast<int>(all_.size()) - 1; i > 0; --i)
      std::swap(shuffled[static_cast<std::size_t>(i)],
                shuffled[static_cast<std::size_t>(random_.integer(0, i))]);
    return shuffled;
  }
  long cost(const BoundsTree& tree) const {
    long visited = 0;
    std::vector<int> found;
    for (const Bounds& where : all_) visited += tree.find(where, found);
    return visited;
  }

  Random random_{47};
  std::vector<Bounds> all_;
  long new_cost_ = 0;
};

TEST_F(BoundsTreeOfAGrid, VisitsFewNodes) {
  EXPECT_LT(new_cost_, 50 * static_cast<long>(all_.size()));
}

TEST_F(BoundsTreeOfAGrid, CostsLittleMoreThanANewOneWhenAllHaveMovedFar) {
  BoundsTree tree;
  tree.build(inAnyOrder());
  for (int i = 0; i < 5; ++i) tree.moveAll(inAnyOrder());
  EXPECT_LT(static_cast<double>(cost(tree)), 1.5 * static_cast<double>(new_cost_));
}

TEST_F(BoundsTreeOfAGrid, CostsLittleMoreThanANewOneWhenEachHasMovedFar) {
  for (const bool apart : {true, false}) {
    BoundsTree tree;
    tree.build(apart ? inAnyOrder() : std::vector<Bounds>(all_.size(), all_[0]));
    const std::vector<Bounds> after = inAnyOrder();
    for (std::size_t i = 0; i < after.size(); ++i) tree.move(static_cast<int>(i), after[i]);
    EXPECT_LT(static_cast<double>(cost(tree)), 2.0 * static_cast<double>(new_cost_))
        << (apart ? "from elsewhere on the grid" : "from one place");
  }
}

// Equal coordinates everywhere.
TEST(BoundsTree, OfARowOfTouchingCubes_FindsBothNeighbours) {
  BoundsTree tree;
  for (int n : {1, 2, 3, 7, 8, 9, 64, 65, 127, 128, 129}) {
    std::vector<Bounds> all;
    for (int x = 0; x < n; ++x) all.push_back({Vec3(x, 0, 0), Vec3(x + 1, 1, 1)});
    tree.build(all);
    for (const bool moved : {false, true}) {
      for (std::size_t i = 0; i < all.size(); ++i) ASSERT_EQ(foundAt(tree, all[i]), everyoneAt(all, all[i]));
      for (int i = 0; i < n && !moved; ++i) tree.move(i, all[static_cast<std::size_t>(i)]);
    }
  }
}

TEST(BoundsTree, OfIdenticalBounds_FindsAll) {
  const std::vector<Bounds> all(50, Bounds{Vec3(1, 2, 3), Vec3(1, 2, 3)});
  BoundsTree tree;
  tree.build(all);
  for (int i = 0; i < 50; ++i) tree.move(i, all[0]);
  EXPECT_EQ(foundAt(tree, all[0]).size(), 50u);
}

TEST(BoundsTree, OfNothing_FindsNothing) {
  BoundsTree tree;
  EXPECT_TRUE(foundAt(tree, {Vec3::Zero(), Vec3::Ones()}).empty());
  tree.build({});
  EXPECT_TRUE(foundAt(tree, {Vec3::Zero(), Vec3::Ones()}).empty());
}

}  // namespace
}  // namespace carom
