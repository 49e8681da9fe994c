// The partners a tree finds, against asking everybody.

#include "engine/broad_phase/bounds_tree.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/oracle/test_shapes.h"

namespace carom {
namespace {

using oracle::Random;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::vector<int> everyPartner(const std::vector<Proxy>& proxies, int i) {
  const Proxy& p = proxies[static_cast<std::size_t>(i)];
  std::vector<int> partners;
  for (int j = 0; j < static_cast<int>(proxies.size()); ++j) {
    const Proxy& q = proxies[static_cast<std::size_t>(j)];
    bool apart = p.group == q.group || (!p.moves && !q.moves);
    for (int axis = 0; axis < 3; ++axis)
      apart = apart || p.bounds.high[axis] < q.bounds.low[axis] || q.bounds.high[axis] < p.bounds.low[axis];
    if (!apart) partners.push_back(j);
  }
  return partners;
}

Vec3 randomVector(Random& random, double low, double high) {
  Vec3 v;
  for (int axis = 0; axis < 3; ++axis) v[axis] = random.uniform(low, high);
  return v;
}

// Crowds with a few floors and walls among them.
std::vector<Proxy> crowd(Random& random, int n) {
  std::vector<Proxy> proxies;
  const double spread = random.logUniform(0.1, 100.0);
  const double size = random.logUniform(0.1, 10.0);
  for (int i = 0; i < n; ++i) {
    Proxy p;
    p.bounds.low = spread * randomVector(random, -1, 1);
    p.bounds.high = p.bounds.low + size * randomVector(random, 0, 1);
    const int wide = random.integer(0, 50);
    if (wide < 3) p.bounds.high[wide] += 3.0 * spread;
    if (wide == 3) p.bounds.low.x() = p.bounds.low.y() = -kInfinity;
    if (wide == 3) p.bounds.high.x() = p.bounds.high.y() = kInfinity;
    p.group = random.integer(0, n / 2);
    p.moves = random.integer(0, 3) > 0;
    proxies.push_back(p);
  }
  return proxies;
}

std::vector<int> partnersOf(const BoundsTree& tree, const std::vector<Proxy>& proxies, int i) {
  std::vector<int> found{-1};  // what was there before does not matter
  tree.findPartners(proxies, i, found);
  return found;
}

// Grows one of them on some sides, mostly by little.
void growOne(Random& random, std::vector<Proxy>& proxies, BoundsTree& tree) {
  const int i = random.integer(0, static_cast<int>(proxies.size()) - 1);
  Bounds& bounds = proxies[static_cast<std::size_t>(i)].bounds;
  const double far = random.logUniform(1e-3, 30.0);
  const Bounds onwards{bounds.low + far * randomVector(random, -1, 1),
                       bounds.high + far * randomVector(random, -1, 1)};
  bounds.low = bounds.low.cwiseMin(onwards.low);
  bounds.high = bounds.high.cwiseMax(onwards.high);
  tree.grow(i, onwards);
}

TEST(BoundsTree, FindsThePartnersThatAskingEverybodyFinds_WhileTheyGrow) {
  Random random(43);
  BoundsTree tree;
  std::size_t partners = 0;
  for (int c = 0; c < 100; ++c) {
    std::vector<Proxy> proxies = crowd(random, random.integer(1, 200));
    tree.build(proxies);
    for (int growth = 0; growth < 30; ++growth) {
      const int i = random.integer(0, static_cast<int>(proxies.size()) - 1);
      const std::vector<int> expected = everyPartner(proxies, i);
      ASSERT_EQ(partnersOf(tree, proxies, i), expected) << "case " << c << " after " << growth;
      partners += expected.size();
      growOne(random, proxies, tree);
    }
  }
  EXPECT_GT(partners, 10000u);
}

// Equal coordinates everywhere, and as many proxies as fill the leaves or are one more or fewer.
TEST(BoundsTree, OfARowOfTouchingCubes_FindsBothNeighbours) {
  BoundsTree tree;
  for (int n : {1, 2, 7, 8, 9, 16, 17, 64, 65, 127, 128, 129}) {
    std::vector<Proxy> proxies;
    for (int x = 0; x < n; ++x) proxies.push_back({{Vec3(x, 0, 0), Vec3(x + 1, 1, 1)}, x, true});
    tree.build(proxies);
    for (int i = 0; i < n; ++i) ASSERT_EQ(partnersOf(tree, proxies, i), everyPartner(proxies, i)) << n;
  }
}

TEST(BoundsTree, OfIdenticalBounds_FindsAllOthers) {
  std::vector<Proxy> proxies(50, Proxy{{Vec3(1, 2, 3), Vec3(1, 2, 3)}, 0, true});
  for (int i = 0; i < 50; ++i) proxies[static_cast<std::size_t>(i)].group = i;
  BoundsTree tree;
  tree.build(proxies);
  for (int i = 0; i < 50; ++i) EXPECT_EQ(partnersOf(tree, proxies, i).size(), 49u);
}

TEST(BoundsTree, IsBuiltUntilItIsCleared) {
  BoundsTree tree;
  EXPECT_FALSE(tree.isBuilt());
  tree.build({});
  EXPECT_TRUE(tree.isBuilt());
  tree.clear();
  EXPECT_FALSE(tree.isBuilt());
}

}  // namespace
}  // namespace carom
