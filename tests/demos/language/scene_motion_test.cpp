// The shipped scenes in motion: the invariant of the engine, watched in every frame by an oracle that shares
// no code with V-Clip; the same bits in every run; and scenes that say they settle do come to rest.
#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "demos/asset/asset_path.h"
#include "demos/language/scene_file.h"
#include "demos/motion/frame_clock.h"
#include "demos/scene/scene_world.h"
#include "tests/oracle/overlap_oracle.h"

namespace carom::demos {
namespace {

constexpr double kFramesPerSecond = 30.0;
constexpr double kInTheWindow =
    3e-4;  // m: below the margin by which the smallest shipped parts (0.1 m) are paired

// Steps a scene to its end and shows `look` the world at every frame.
template <typename Look>
void play(World& world, const Scene& scene, Look&& look) {
  const int steps_per_frame = static_cast<int>(scene.rate_hz / kFramesPerSecond);
  const int steps = static_cast<int>(std::lround(scene.duration_s * scene.rate_hz));
  for (int step = 1; step <= steps; ++step) {
    world.step();
    if (step % steps_per_frame == 0) look(world);
  }
}

class EveryShippedScene : public testing::TestWithParam<std::filesystem::path> {};

TEST_P(EveryShippedScene, NeverOverlapsInAnyFrame) {
  const Scene scene = readSceneFile(GetParam());
  SceneWorld made = makeSceneWorld(scene, std::nullopt);
  double smallest = std::numeric_limits<double>::infinity();
  // The oracle looks at every pair of parts: at threads of hundreds only now and then.
  std::size_t parts = 0;
  for (const Solid& solid : made.world.solids()) parts += solid.parts().size();
  const int stride = parts > 200 ? 20 : 1;
  play(made.world, scene, [&](const World& world) {
    if (world.stepCount() % stride != 0) return;
    const oracle::SmallestGap gap = oracle::smallestGap(world);
    smallest = std::min(smallest, gap.gap_m);
    ASSERT_GT(gap.gap_m, 0.0) << made.names[static_cast<std::size_t>(gap.body_a)] << " and "
                              << made.names[static_cast<std::size_t>(gap.body_b)] << " at " << world.time()
                              << " s";
    // The engine speaks of candidate pairs only: it may not see the closest pair of a loose scene, but it may
    // not see it closer either, and within the collision window it must see it (poses in metres: rounding far
    // below 1e-9).
    ASSERT_GT(world.audit().smallest_gap_m, gap.gap_m - 1e-9) << world.time();
    if (gap.gap_m < kInTheWindow) {
      ASSERT_NEAR(world.audit().smallest_gap_m, gap.gap_m, 1e-9) << world.time();
    }
    ASSERT_EQ(world.audit().last_step.iteration_limits, 0) << world.time();
  });
  // Those that float or spin freely touch nothing, by design.
  static const std::set<std::string> apart = {"archimedes", "dzhanibekov", "iceberg"};
  EXPECT_EQ(smallest < 0.01, apart.count(scene.name) == 0) << "the closest: " << smallest << " m";
}

TEST_P(EveryShippedScene, HasTheSameStateInEveryRun) {
  const Scene scene = readSceneFile(GetParam());
  std::uint64_t hashes[2] = {};
  for (std::uint64_t& hash : hashes) {
    SceneWorld made = makeSceneWorld(scene, std::nullopt);
    play(made.world, scene, [](const World&) {});
    hash = made.world.stateHash();
  }
  EXPECT_EQ(hashes[0], hashes[1]);
}

INSTANTIATE_TEST_SUITE_P(Scenes, EveryShippedScene, testing::ValuesIn(shippedScenes()),
                         [](const auto& scene) {
                           std::string name = scene.param.stem().string();
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

TEST(RestingScene, EndsWithEveryBodyExactlyAtRest) {
  const Scene scene = readSceneFile(findScene("resting"));
  SceneWorld made = makeSceneWorld(scene, std::nullopt);
  play(made.world, scene, [](const World&) {});
  for (std::size_t i = 0; i < made.names.size(); ++i) {
    if (made.world.bodies()[i].is_static) continue;
    EXPECT_EQ(made.world.states()[i].mode, Mode::kResting) << made.names[i];
    EXPECT_TRUE(made.world.states()[i].linear_velocity.isZero(0.0)) << made.names[i];
    EXPECT_TRUE(made.world.states()[i].angular_velocity.isZero(0.0)) << made.names[i];
  }
}

}  // namespace
}  // namespace carom::demos
