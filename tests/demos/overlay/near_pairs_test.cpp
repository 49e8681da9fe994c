#include "demos/overlay/near_pairs.h"

#include <gtest/gtest.h>

#include "demos/asset/asset_path.h"
#include "demos/language/scene_file.h"
#include "demos/system/exit_code.h"
#include "tests/support/thrown_message.h"

namespace carom::demos {
namespace {

SceneWorld worldOf(const char* name) {
  return makeSceneWorld(readSceneFile(findScene(name)), std::nullopt);
}

// All pairs of all bodies by brute force, nearest first.
std::vector<double> allDistances(const World& world, std::span<const BodyState> states) {
  std::vector<double> distances;
  for (std::size_t a = 0; a < states.size(); ++a)
    for (std::size_t b = a + 1; b < states.size(); ++b) {
      if (world.bodies()[a].is_static && world.bodies()[b].is_static) continue;
      for (const ConvexPart& p : world.solids()[static_cast<std::size_t>(world.bodies()[a].solid)].parts())
        for (const ConvexPart& q :
             world.solids()[static_cast<std::size_t>(world.bodies()[b].solid)].parts()) {
          FeaturePair cold;
          distances.push_back(closestFeatures(p, states[a].X_WB, q, states[b].X_WB, cold).distance_m);
        }
    }
  std::sort(distances.begin(), distances.end());
  return distances;
}

TEST(NearPairs, AreTheNearestOfAllPairs) {
  for (const char* name : {"resting", "fifty-bodies", "contact-edge-edge", "bouncing-ball"}) {
    SceneWorld made = worldOf(name);
    for (int i = 0; i < 30; ++i) made.world.step();
    const std::vector<NearPair> pairs = nearPairs(made.world, made.world.states());
    const std::vector<double> all = allDistances(made.world, made.world.states());
    ASSERT_FALSE(pairs.empty()) << name;
    for (std::size_t i = 0; i < pairs.size(); ++i)
      EXPECT_EQ(pairs[i].closest.distance_m, all[i]) << name << ' ' << i;
  }
}

TEST(NearPairs, AFocusKeepsItsOwnPairsAndFindsTheNearestOfThoseFarOff) {
  const SceneWorld made = worldOf("resting");
  const BodyFocus gem("gem", made.names);
  const std::vector<NearPair> of_gem = nearPairs(made.world, made.world.states(), gem);
  ASSERT_FALSE(of_gem.empty());
  for (const NearPair& pair : of_gem)
    EXPECT_TRUE(made.names[static_cast<std::size_t>(pair.body_a)] == "gem" ||
                made.names[static_cast<std::size_t>(pair.body_b)] == "gem");
  const std::vector<NearPair> between =
      nearPairs(made.world, made.world.states(), BodyFocus("pyramid,tower 5", made.names));
  ASSERT_EQ(between.size(), 1u);
  EXPECT_GT(between[0].closest.distance_m, 2.0);
}

TEST(BodyFocus, NamesCopiesTogetherAndRefusesUnknownNames) {
  const std::vector<std::string> names = {"floor", "crate[0]", "crate[1]", "ball"};
  const BodyFocus crates("crate", names);
  EXPECT_TRUE(crates.has(1) && crates.has(2));
  EXPECT_FALSE(crates.has(0) || crates.has(3));
  EXPECT_TRUE(crates.hasPair(0, 2));
  EXPECT_FALSE(BodyFocus("crate,ball", names).hasPair(0, 2));
  EXPECT_TRUE(BodyFocus("crate,ball", names).hasPair(3, 2));
  const std::string message = thrownMessage<UsageError>([&] { BodyFocus("bal", names); });
  EXPECT_NE(message.find("did you mean \"ball\"?"), std::string::npos) << message;
}

}  // namespace
}  // namespace carom::demos
