// The sweep oracle against closed forms: it proves up to the contact and never beyond.

#include "tests/oracle/sweep_oracle.h"

#include <gtest/gtest.h>

#include "tests/oracle/test_shapes.h"

namespace carom::oracle {
namespace {

TEST(SweepOracle, ProvesUpToTheTimeOfAFallAndNotBeyond) {
  const Solid box = Solid::box({1, 0.6, 0.8});
  const Solid ground = Solid::box({9, 9, 1});
  const Trajectory still{0.0, {Quat::Identity(), Vec3(0, 0, -0.5)}, Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  for (double h : {0.01, 1.0, 20.0}) {
    const Trajectory fall{0.0,
                          {turned(Vec3::UnitZ(), 0.3), Vec3(0.2, 0.1, 0.4 + h)},
                          Vec3::Zero(),
                          Vec3(0, 0, -9.81),
                          Vec3::Zero()};
    const double contact_s = std::sqrt(2.0 * (h - 1e-3) / 9.81);  // where 1 mm is left
    const SweepProof all =
        provenApart({&ground.parts()[0], &still}, {&box.parts()[0], &fall}, 0.0, contact_s + 1.0, 1e-3);
    EXPECT_TRUE(all.touched) << h;
    EXPECT_LE(all.proven_s, contact_s * (1.0 + 1e-12)) << h;
    EXPECT_NEAR(all.proven_s, contact_s, 1e-6 * contact_s) << h;
    const SweepProof before =
        provenApart({&ground.parts()[0], &still}, {&box.parts()[0], &fall}, 0.0, 0.999 * contact_s, 1e-3);
    EXPECT_EQ(before.proven_s, 0.999 * contact_s);
    EXPECT_FALSE(before.touched);
  }
}

// A rod of half length L sweeps past a plane at distance c < L: contact where L |cos| = c.
TEST(SweepOracle, FindsTheDipOfATurningRod) {
  const double L = 0.5, w = 0.01, c = 0.45;
  const Solid rod = Solid::box({2 * L, 2 * w, 0.1}), wall = Solid::box({1, 4, 4});
  const Trajectory still{
      0.0, {Quat::Identity(), Vec3(c + 0.5, 0, 0)}, Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  const Trajectory turn{
      0.0, {turned(Vec3::UnitZ(), 1.2), Vec3::Zero()}, Vec3::Zero(), Vec3::Zero(), Vec3(0, 0, 6)};
  const SweepProof proof = provenApart({&rod.parts()[0], &turn}, {&wall.parts()[0], &still}, 0.0, 1.0, 1e-9);
  const double angle = 1.2 + 6.0 * proof.proven_s;
  EXPECT_NEAR(c - L * std::abs(std::cos(angle)) - w * std::abs(std::sin(angle)), 0.0, 1e-5);
  EXPECT_GT(angle, 2.0);  // not yet at the start, where the other end points away
  EXPECT_LT(proof.proven_s, 1.0);
}

}  // namespace
}  // namespace carom::oracle
