// Every pile of `piles` begins with its bodies apart or touching, all above its floor, and each row is named
// once.

#include "tests/bench/piles/pile_rows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/physics/experiments/carom_simulation.h"

namespace carom::bench {
namespace {

TEST(PileRows, AreNamedOnce) {
  std::set<std::string> names;
  for (const PileRow& row : dropRows()) EXPECT_TRUE(names.insert(row.name).second) << row.name;
}

TEST(PileRows, BeginApartOrTouching) {
  for (const PileRow& row : dropRows()) {
    if (row.is_long) continue;
    const physics::Experiment pile = row.describe();
    const auto moving = std::count_if(pile.bodies.begin(), pile.bodies.end(),
                                      [](const physics::ExperimentBody& body) { return !body.is_static; });
    if (row.size > 0) {
      EXPECT_EQ(moving, row.size) << row.name;
    }
    EXPECT_GE(moving, 10) << row.name;
    for (const physics::ExperimentBody& body : pile.bodies)
      EXPECT_TRUE(body.is_static || body.X_WB.position.z() > 0.0) << row.name;
    // It refuses what overlaps.
    EXPECT_NO_THROW(physics::startCarom(pile)) << row.name;
  }
}

TEST(PileRows, WallHasSixHundredAndTenBricks) {
  for (const PileRow& row : dropRows())
    if (row.name == "wall-610") {
      EXPECT_EQ(row.describe().bodies.size(), 611U);
    }
}

}  // namespace
}  // namespace carom::bench
