// The worlds of the seeds: the same again, all families, none that overlaps at the start; and their text,
// which reads back as what was written.

#include "tests/explore/random_world.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/explore/random_shapes.h"
#include "tests/explore/scene_text.h"
#include "tests/explore/trial/world_trial.h"

namespace carom::explore {
namespace {

TEST(RandomWorld, IsTheSameAgainAndItsTextReadsBack) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const std::string text = sceneText(randomWorld(seed).scene);
    EXPECT_TRUE(text == sceneText(randomWorld(seed).scene)) << seed;
    demos::Scene made = randomWorld(seed).scene, read = readBack(made);
    EXPECT_EQ(stepsOf(read), stepsOf(made)) << seed;
    for (std::size_t i = 0; i < made.bodies.size(); ++i) {
      EXPECT_LT((read.bodies[i].X_WS.rotation.coeffs() - made.bodies[i].X_WS.rotation.coeffs()).norm(),
                1e-15);
      read.bodies[i].X_WS.rotation = made.bodies[i].X_WS.rotation;  // is made unit when it is read
    }
    EXPECT_TRUE(sceneText(read) == sceneText(made)) << seed;
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

// Worlds of the seeds from `first` on, which are so many families.
void expectWorldsOf(std::uint64_t first, std::size_t families_there, std::uint64_t worlds = 60) {
  std::set<std::string> families;
  for (std::uint64_t seed = first; seed < first + worlds; ++seed) {
    const ExploredWorld world = randomWorld(seed);
    families.insert(world.family);
    const std::string text = sceneText(world.scene);
    EXPECT_TRUE(text == sceneText(randomWorld(seed).scene)) << seed;
    EXPECT_EQ(readBack(world.scene).bodies.size(), world.scene.bodies.size()) << seed;
    const std::optional<Meeting> meeting = overlapOfStart(world.scene);
    EXPECT_FALSE(meeting) << seed << ' ' << meeting->depth_m;
  }
  EXPECT_EQ(families.size(), families_there);
}

TEST(MovedWorld, IsTheSameAgainReadsBackAndDoesNotOverlapAtTheStart) {
  expectWorldsOf(kMovedWorlds, 3);
}

TEST(DrivenHeap, IsTheSameAgainReadsBackAndDoesNotOverlapAtTheStart) {
  expectWorldsOf(kDrivenHeaps, 3);
}

TEST(LoadedWorld, IsTheSameAgainReadsBackAndDoesNotOverlapAtTheStart) {
  expectWorldsOf(kLoadedWorlds, 1);
}

// Where nothing is static and no load turns along, what is left over of all forces but weights is a share.
TEST(LoadedWorld, HasLoadsThatCancelOrNearlyDo) {
  int floating = 0, cancel = 0;
  for (std::uint64_t seed = kLoadedWorlds; seed < kLoadedWorlds + 100; ++seed) {
    const demos::Scene scene = randomWorld(seed).scene;
    Vec3 sum = Vec3::Zero();
    double all = 0.0;
    bool known = true;
    for (const demos::Body& body : scene.bodies) {
      known = known && !body.is_static && !body.load.turnsAlong();
      if (!known) break;
      const Vec3 push = body.load.force_W + *body.mass_kg * scene.gravity;
      sum += push;
      all += push.norm();
    }
    if (!known) continue;
    ++floating;
    EXPECT_LE(sum.norm(), 0.06 * all) << seed;
    cancel += sum.norm() <= 1e-12 * all ? 1 : 0;
  }
  EXPECT_GT(floating, 50);
  EXPECT_GT(cancel, floating / 2);
}

TEST(CoarseWorld, IsTheSameAgainReadsBackAndDoesNotOverlapAtTheStart) {
  expectWorldsOf(kCoarseWorlds, 1);
}

// Half of them in long steps, half under a great weight; one body in six is hollow.
TEST(CoarseWorld, HasLongStepsOrGreatWeightAndConcaveBodies) {
  int long_steps = 0, bodies = 0, concave = 0;
  for (std::uint64_t seed = kCoarseWorlds; seed < kCoarseWorlds + 300; ++seed) {
    const demos::Scene scene = randomWorld(seed).scene;
    const double g = scene.gravity.norm(), rate = scene.rate_hz;
    const bool is_long = g < 10.0;
    long_steps += is_long;
    EXPECT_GE(rate, is_long ? 10.0 : 30.0) << seed;
    EXPECT_LE(rate, is_long ? 30.0 : 240.0) << seed;
    EXPECT_GE(g, is_long ? 9.81 : 29.0) << seed;
    EXPECT_LE(g, 1000.0) << seed;
    EXPECT_GE(stepsOf(scene), 10) << seed;
    EXPECT_LE(stepsOf(scene), 40) << seed;
    for (const demos::Body& body : scene.bodies) {
      if (body.is_static) continue;
      ++bodies;
      const auto* hull = std::get_if<demos::HullShape>(&body.shape.form);
      concave += hull != nullptr && !hull->as_hull;
      EXPECT_LE(reachOf(body.shape), 0.3) << seed;
    }
  }
  EXPECT_NEAR(long_steps, 150, 30);
  EXPECT_NEAR(concave, bodies / 6, bodies / 15);
}

TEST(HangingWorld, IsTheSameAgainReadsBackAndDoesNotOverlapAtTheStart) {
  expectWorldsOf(kHangingWorlds, 1, 20);
}

// Links hang in one another: none can be taken out along any straight line, so that a link that falls by its
// own height and more meets another. Their load is up to a thousand links.
TEST(HangingWorld, HasLinksThatHoldEachOtherAndALoadAtTheEnd) {
  int free = 0, nets = 0, weights = 0;
  for (std::uint64_t seed = kHangingWorlds; seed < kHangingWorlds + 100; ++seed) {
    demos::Scene scene = randomWorld(seed).scene;
    EXPECT_GE(scene.bodies.size(), 2u) << seed;
    EXPECT_LE(scene.bodies.size(), 17u) << seed;
    const demos::Body& load = scene.bodies.back();
    ASSERT_TRUE(load.mass_kg) << seed;
    weights += std::get<demos::CompoundShape>(load.shape.form).parts.size() == 5;
    free += !scene.bodies[0].is_static;
    const auto beside = [&load](const demos::Body& body) {
      return std::abs(body.X_WS.position.x()) > 0.1 * reachOf(load.shape);
    };
    nets += std::any_of(scene.bodies.begin(), scene.bodies.end(), beside);
    const auto& ring = std::get<demos::CompoundShape>(load.shape.form);
    const auto* side = std::get_if<demos::BoxShape>(&ring.parts[1].shape.form);
    scene.bodies.erase(scene.bodies.begin(), scene.bodies.end() - 2);  // but for one that it hangs in
    if (side == nullptr || std::holds_alternative<demos::HullShape>(scene.bodies[0].shape.form)) continue;
    bool meets = false;
    for (int i = 0; i < 25 && !meets; ++i) {
      scene.bodies.back().X_WS.position.z() -= 0.02 * side->size_m.z();
      meets = overlapOfStart(scene).has_value();
    }
    EXPECT_TRUE(meets) << seed;
  }
  EXPECT_NEAR(weights, 67, 20);
  EXPECT_NEAR(free, 17, 12);
  EXPECT_NEAR(nets, 33, 20);
}

TEST(IceWorld, IsTheSameAgainReadsBackAndDoesNotOverlapAtTheStart) {
  expectWorldsOf(kIceWorlds, 1);
}

// Nothing rubs on their floor; few of them are slopes.
TEST(IceWorld, HasAFloorWithoutFrictionAndGravityAlongItsNormal) {
  int level = 0, several = 0;
  for (std::uint64_t seed = kIceWorlds; seed < kIceWorlds + 200; ++seed) {
    const demos::Scene scene = randomWorld(seed).scene;
    const demos::Body& floor = scene.bodies[0];
    EXPECT_TRUE(floor.is_static) << seed;
    EXPECT_EQ(floor.material.static_friction, 0.0) << seed;
    const Vec3 n = floor.X_WS.rotation * Vec3::UnitZ();
    level += n.cross(scene.gravity).norm() < 1e-14 * scene.gravity.norm();
    several += scene.bodies.size() > 2;
    EXPECT_LT(n.dot(scene.gravity), 0.0) << seed;
    for (std::size_t i = 1; i < scene.bodies.size(); ++i) EXPECT_FALSE(scene.bodies[i].is_static) << seed;
  }
  EXPECT_NEAR(level, 175, 15);
  EXPECT_NEAR(several, 100, 30);
}

TEST(RandomWorld, DoesNotOverlapAtTheStart) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const auto meeting = overlapOfStart(randomWorld(seed).scene);
    EXPECT_FALSE(meeting) << seed << ' ' << randomWorld(seed).family << ' ' << meeting->depth_m;
  }
}

}  // namespace
}  // namespace carom::explore
