// A chain lets down a load that is many times as heavy as a link. In steps so coarse that the searches for
// its times of impact spend their work, what is not proven from then on stands, and nothing overlaps.

#include "tests/physics/small_world.h"

namespace carom::physics {
namespace {

struct Chain {
  int links = 0;
  double density = 0.0;  // of the load; a link has 500
  double rate_hz = 0.0;
};
class LoadedChain : public testing::TestWithParam<Chain> {};

ConvexPart boxAt(const Vec3& size, const Vec3& middle) {
  return {Solid::box(size).parts()[0].core.translated(middle), 0.0};
}

std::vector<ConvexPart> link() {
  return {boxAt({0.03, 0.03, 0.3}, {0.065, 0.0, 0.0}), boxAt({0.03, 0.03, 0.3}, {-0.065, 0.0, 0.0}),
          boxAt({0.1, 0.03, 0.03}, {0.0, 0.0, 0.135}), boxAt({0.1, 0.03, 0.03}, {0.0, 0.0, -0.135})};
}

void hang(const Chain& chain, SmallWorld& w) {
  const auto add = [&](int k, const std::vector<ConvexPart>& parts, double density) {
    const Solid solid(parts);
    const Quat turn = oracle::turned(Vec3::UnitZ(), 0.5 * std::numbers::pi * (k % 2));
    const Vec3 place(0.0, 0.0, -0.236 * k);
    w.add({solid,
           {turn, place - turn * solid.origin_B()},
           Vec3::Zero(),
           Vec3::Zero(),
           {0.4, 0.4, 0.0, density},
           k == 0});
  };
  for (int k = 0; k < chain.links; ++k) add(k, link(), 500.0);
  std::vector<ConvexPart> load = link();
  load.push_back(boxAt({0.4, 0.4, 0.4}, {0.0, 0.0, -0.35}));
  add(chain.links, load, chain.density);
  w.start();
}

TEST_P(LoadedChain, NeverOverlaps) {
  const Chain& chain = GetParam();
  SmallWorld w(chain.rate_hz);
  hang(chain, w);
  for (int i = 0; i < static_cast<int>(0.5 * chain.rate_hz); ++i) {
    w.step();
    ASSERT_GT(w.world().audit().smallest_gap_m, 0.0) << "step " << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Loads, LoadedChain, testing::Values(Chain{12, 5000.0, 20}));

// Once it has come down, a long chain is carried by what is above each link: nothing has to be led apart on
// its way, step by step.
TEST(LoadedChains, HangWithoutBeingLedApart) {
  SmallWorld w(240);
  hang({25, 500.0, 240}, w);
  w.run(0.75);
  for (int i = 0; i < 60; ++i) {
    w.step();
    const StepCounters step = w.world().audit().last_step;
    ASSERT_EQ(step.cleared_paths, 0) << "step " << i;
    ASSERT_EQ(step.stopped_bodies, 0) << "step " << i;
  }
}

}  // namespace
}  // namespace carom::physics
