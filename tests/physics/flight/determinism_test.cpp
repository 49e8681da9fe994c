// The same scene, the same bits; and what must not depend on the order in which bodies were added does not.

#include "tests/physics/small_world.h"

namespace carom::physics {
namespace {

std::vector<std::uint64_t> hashesOfAPile() {
  oracle::Random random(3);
  SmallWorld w(120.0);
  w.addPlane(rubbing(0.5, 0.3), Quat::Identity(), 5.0);
  for (int i = 0; i < 12; ++i)
    w.add({Solid::polyhedron(oracle::randomHull(random, 12, Vec3(0.3, 0.25, 0.2))),
           {random.rotation(), Vec3(0.5 * (i % 2), 0.5 * (i / 2 % 2), 0.6 + 0.6 * (i / 4))},
           Vec3::Zero(),
           random.direction(),
           rubbing(0.4, 0.2)});
  w.start();
  std::vector<std::uint64_t> hashes;
  for (int i = 0; i < 240; ++i) {
    w.step();
    hashes.push_back(w.world().stateHash());
  }
  return hashes;
}

TEST(Determinism, TheSameSceneGivesTheSameHashAtEveryStep) {
  const std::vector<std::uint64_t> first = hashesOfAPile();
  EXPECT_EQ(first, hashesOfAPile());
  EXPECT_NE(first.front(), first.back());
}

TEST(Determinism, ReadingTheWorldDoesNotChangeIt) {
  const auto run = [](bool watched) {
    SmallWorld w;
    w.addPlane(rubbing(0.5, 0.3));
    w.add({Solid::box({0.3, 0.2, 0.4}),
           {oracle::turned({1, 2, 3}, 0.6), Vec3(0, 0, 1)},
           Vec3(1, 0, 0),
           Vec3(1, 2, 3),
           rubbing(0.4, 0.2)});
    w.start();
    for (int i = 0; i < 480; ++i) {
      w.step();
      if (watched) {
        EXPECT_TRUE(std::isfinite(w.world().audit().kinetic_energy_J) && w.world().stateHash() != 0);
      }
    }
    return w.world().stateHash();
  };
  EXPECT_EQ(run(true), run(false));
}

TEST(Determinism, BodiesThatNeverMeetDoNotFeelTheOrderInWhichTheyWereAdded) {
  const auto run = [](bool reversed) {
    SmallWorld w;
    w.addPlane(rubbing(0.5, 0.3));
    std::vector<Pose> ends;
    std::vector<int> bodies(4);
    for (int k = 0; k < 4; ++k) {
      const int i = reversed ? 3 - k : k;
      bodies[static_cast<std::size_t>(i)] = w.add({Solid::box({0.3, 0.2, 0.4}),
                                                   {oracle::turned({1, 2, 3}, 0.6 * i), Vec3(3.0 * i, 0, 1)},
                                                   Vec3(0, 0.2 * i, 0),
                                                   Vec3(i, 2, 3),
                                                   rubbing(0.4, 0.2)});
    }
    w.start();
    w.run(0.4);
    for (int b : bodies) ends.push_back(w.state(b).X_WB);
    return ends;
  };
  const std::vector<Pose> forward = run(false), backward = run(true);
  for (std::size_t i = 0; i < forward.size(); ++i) {
    EXPECT_EQ(forward[i].position, backward[i].position) << i;
    EXPECT_EQ(forward[i].rotation.coeffs(), backward[i].rotation.coeffs()) << i;
  }
}

}  // namespace
}  // namespace carom::physics
