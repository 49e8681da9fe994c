// The worlds of the seeds: the same again, all families, none that overlaps at the start; and their text,
// which reads back as what was written.

#include "tests/explore/random_world.h"

#include <gtest/gtest.h>

#include <set>

#include "demos/scene_file.h"
#include "tests/explore/scene_text.h"
#include "tests/explore/world_trial.h"

namespace carom::explore {
namespace {

TEST(RandomWorld, IsTheSameAgainAndItsTextReadsBack) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const std::string text = sceneText(randomWorld(seed).scene);
    EXPECT_EQ(text, sceneText(randomWorld(seed).scene)) << seed;
    const demos::Scene read = demos::parseScene(text, "explored.json");
    EXPECT_EQ(sceneText(demos::parseScene(sceneText(read), "again.json")), sceneText(read)) << seed;
    EXPECT_EQ(stepsOf(read), stepsOf(randomWorld(seed).scene)) << seed;
  }
}

TEST(RandomWorld, ComesInAllFamiliesAndKeepsItsLimits) {
  std::set<std::string> families;
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    const ExploredWorld world = randomWorld(seed);
    families.insert(world.family);
    EXPECT_GE(stepsOf(world.scene), 30) << seed;
    EXPECT_LE(stepsOf(world.scene), 120) << seed;
    EXPECT_LE(world.scene.bodies.size(), 61u) << seed;
    for (const demos::Body& body : world.scene.bodies) EXPECT_LE(body.linear_velocity.norm(), 1.03e4) << seed;
  }
  EXPECT_EQ(families.size(), 13u);
}

TEST(RandomWorld, DoesNotOverlapAtTheStart) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const auto meeting = overlapOfStart(randomWorld(seed).scene);
    EXPECT_FALSE(meeting) << seed << ' ' << randomWorld(seed).family << ' ' << meeting->depth_m;
  }
}

}  // namespace
}  // namespace carom::explore
