// Whatever is borne comes after what bears it: upwards in towers, downwards in chains.

#include "engine/response/sweeps/bearing_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "tests/oracle/test_shapes.h"

namespace carom {
namespace {

using oracle::Random;

ImpulseBody bodyAt(const Vec3& center) {
  ImpulseBody body;
  body.center = center;
  body.inverse_mass = 1.0;
  return body;
}

// Of a contact at which `bearer` bears `borne`, along `up`; either may be the row's first.
ContactRow bearing(int bearer, int borne, const Vec3& up, bool turned) {
  ContactRow row;
  row.a = turned ? borne : bearer;
  row.b = turned ? bearer : borne;
  row.n = turned ? Vec3(-up) : up;
  return row;
}

// Bodies hang one on the other's lower end, in no order of their numbers, and the first on body 0, which
// cannot move; what holds each sideways says nothing.
struct Chain {
  std::vector<ImpulseBody> bodies{ImpulseBody{}};
  std::vector<ContactRow> rows;
  std::vector<int> links;  // from above
};
Chain randomChain(Random& random, int length) {
  Chain chain;
  chain.links.resize(static_cast<std::size_t>(length));
  std::iota(chain.links.begin(), chain.links.end(), 1);
  for (std::size_t i = chain.links.size(); i > 1; --i)
    std::swap(chain.links[i - 1],
              chain.links[static_cast<std::size_t>(random.integer(0, static_cast<int>(i) - 1))]);
  chain.bodies.resize(chain.links.size() + 1);
  int above = 0;
  for (std::size_t k = 0; k < chain.links.size(); ++k) {
    const int link = chain.links[k];
    chain.bodies[static_cast<std::size_t>(link)] = bodyAt({0.0, 0.0, -static_cast<double>(k)});
    const auto turned = [&] { return random.uniform(0.0, 1.0) < 0.5; };
    chain.rows.push_back(bearing(above, link, Vec3::UnitZ(), turned()));
    for (const double x : {-1.0, 1.0})
      chain.rows.push_back(bearing(above, link, Vec3(x, 0.0, -0.3).normalized(), turned()));
    above = link;
  }
  return chain;
}

TEST(BearingOrder, FollowsAChainFromItsHook) {
  Random random(82);
  BearingOrder order;
  for (int length = 1; length <= 30; ++length) {
    const Chain chain = randomChain(random, length);
    order.find(chain.rows, chain.bodies, Vec3(0.0, 0.0, 9.81));
    EXPECT_TRUE(std::ranges::equal(order.bodies(), chain.links));
    EXPECT_EQ(order.placeOf(0), -1);
    for (const ContactRow& row : chain.rows)
      EXPECT_EQ(order.borneBy(row), order.placeOf(row.a) > order.placeOf(row.b) ? row.a : row.b);
  }
}

TEST(BearingOrder, FollowsATowerUpwards) {
  Random random(83);
  Chain tower = randomChain(random, 20);
  for (ContactRow& row : tower.rows) row.n = -row.n;  // each link bears the one above it
  BearingOrder order;
  order.find(tower.rows, tower.bodies, Vec3::UnitZ());
  std::ranges::reverse(tower.links);
  EXPECT_TRUE(std::ranges::equal(order.bodies(), tower.links));
}

// Two chains and a bar across their ends, on which a cube stands: the bar comes after both, the cube last.
TEST(BearingOrder, JoinsWhatHangsAndWhatStands) {
  std::vector<ImpulseBody> bodies{ImpulseBody{}};
  for (const Vec3& p :
       {Vec3(-1, 0, -1), Vec3(-1, 0, -2), Vec3(1, 0, -1), Vec3(1, 0, -2), Vec3(0, 0, -3), Vec3(0, 0, -2.5)})
    bodies.push_back(bodyAt(p));
  std::vector<ContactRow> rows;
  for (const auto& [bearer, borne] :
       std::vector<std::pair<int, int>>{{5, 6}, {2, 5}, {4, 5}, {1, 2}, {3, 4}, {0, 1}, {0, 3}})
    rows.push_back(bearing(bearer, borne, Vec3::UnitZ(), bearer % 2 == 0));
  BearingOrder order;
  order.find(rows, bodies, Vec3::UnitZ());
  for (const ContactRow& row : rows)
    EXPECT_EQ(row.n.z() > 0.0 ? row.b : row.a, order.borneBy(row)) << row.a << " " << row.b;
  EXPECT_EQ(order.bodies().back(), 6);
}

// Three that bear each other all round, as no heights allow: each has its place, the lowest the first.
TEST(BearingOrder, BeginsARingAtItsLowest) {
  const std::vector<ImpulseBody> bodies{bodyAt({0, 0, 2}), bodyAt({0, 0, 1}), bodyAt({0, 0, 3})};
  const std::vector<ContactRow> rows{bearing(0, 1, Vec3::UnitZ(), false), bearing(1, 2, Vec3::UnitZ(), true),
                                     bearing(2, 0, Vec3::UnitZ(), false)};
  BearingOrder order;
  order.find(rows, bodies, Vec3::UnitZ());
  EXPECT_TRUE(std::ranges::equal(order.bodies(), std::vector<int>{1, 2, 0}));
}

}  // namespace
}  // namespace carom
