// What stands keeps its points of contact: a heap whose manifolds were chosen anew in every step would hand
// loads to and fro between choices that are as good.

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <tuple>

#include "engine/simulation/bodies/step_view.h"
#include "engine/simulation/world.h"
#include "tests/bench/bin_pile.h"

namespace carom {
namespace {

using PointName = std::tuple<int, int, std::uint64_t>;

std::set<PointName> pointsOf(const StepView& view) {
  std::set<PointName> points;
  for (const ContactView& contact : view.lasting) points.emplace(contact.body_a, contact.body_b, contact.id);
  return points;
}

TEST(StandingContacts, OfAHeapStayTheSameFromStepToStep) {
  bench::BinPile pile({.of = bench::PileOf::kBoxes, .bodies = 125, .resting_mode = false});
  World& world = pile.world();
  ASSERT_TRUE(world.start().empty());
  StepView view;
  for (int i = 0; i < 600; ++i) world.step();
  world.watch(&view);
  world.step();
  std::set<PointName> before = pointsOf(view);
  ASSERT_GT(before.size(), 500u);
  std::size_t came = 0;
  constexpr std::size_t kSteps = 60;
  for (std::size_t i = 0; i < kSteps; ++i) {
    world.step();
    const std::set<PointName> now = pointsOf(view);
    came += static_cast<std::size_t>(
        std::count_if(now.begin(), now.end(), [&](const PointName& p) { return !before.contains(p); }));
    before = now;
  }
  EXPECT_LT(came, kSteps / 4);
}

}  // namespace
}  // namespace carom
