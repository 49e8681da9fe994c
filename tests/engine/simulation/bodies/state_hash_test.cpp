// The state hash: FNV-1a over the bits, so every bit counts, in its place.

#include "engine/simulation/bodies/state_hash.h"

#include <gtest/gtest.h>

#include <limits>

#include "engine/simulation/world.h"

namespace carom {
namespace {

template <typename... Values>
std::uint64_t hashOf(const Values&... values) {
  StateHash hash;
  (hash.add(values), ...);
  return hash.value();
}

// Worked out by a separate implementation, bytes in little-endian order.
TEST(StateHash, IsFnv1a) {
  EXPECT_EQ(hashOf(), 0xcbf29ce484222325ull);
  EXPECT_EQ(hashOf(std::uint64_t{0}), 0xa8c7f832281a39c5ull);
  EXPECT_EQ(hashOf(std::uint64_t{0x0102030405060708}), 0x0c6d4496e17859d5ull);
  EXPECT_EQ(hashOf(1.5), 0xaa95e93229a27c80ull);
  EXPECT_EQ(hashOf(std::uint64_t{0x0000726162'6f6f66}),
            0x74c8e7eb4f245c28ull);  // "foobar" and two zero bytes
}

TEST(StateHash, TellsNeighbouringNumbersApart) {
  EXPECT_NE(hashOf(1.0), hashOf(1.0 + std::numeric_limits<double>::epsilon()));
  EXPECT_NE(hashOf(0.0), hashOf(std::numeric_limits<double>::denorm_min()));
  EXPECT_NE(hashOf(1.0), hashOf(-1.0));
}

TEST(StateHash, TakesBothZerosForOneState) {
  EXPECT_EQ(hashOf(0.0), hashOf(-0.0));
}

TEST(StateHash, DependsOnTheOrder) {
  EXPECT_NE(hashOf(1.0, 2.0), hashOf(2.0, 1.0));
  EXPECT_NE(hashOf(Vec3(1, 2, 3)), hashOf(Vec3(1, 3, 2)));
  EXPECT_EQ(hashOf(Vec3(1, 2, 3)), hashOf(1.0, 2.0, 3.0));
  EXPECT_EQ(hashOf(Quat(1, 2, 3, 4)), hashOf(1.0, 2.0, 3.0, 4.0));
}

// What of a body the world's hash covers: everything that can be seen of it.
TEST(WorldHash, ChangesWithEveryPartOfTheState) {
  const auto hashOfBody = [](auto&& change) {
    World w{WorldSettings{}};
    BodyDescription d;
    d.solid = w.addSolid(Solid::ball(0.5));
    change(d);
    w.addBody(d);
    EXPECT_TRUE(w.start().empty());
    return w.stateHash();
  };
  const std::uint64_t plain = hashOfBody([](BodyDescription&) {});
  EXPECT_EQ(plain, hashOfBody([](BodyDescription&) {}));
  EXPECT_NE(plain, hashOfBody([](BodyDescription& d) { d.X_WB.position.z() = 1e-300; }));
  EXPECT_NE(plain, hashOfBody([](BodyDescription& d) { d.X_WB.rotation = Quat(0, 1, 0, 0); }));
  EXPECT_NE(plain, hashOfBody([](BodyDescription& d) { d.linear_velocity.y() = 1e-300; }));
  EXPECT_NE(plain, hashOfBody([](BodyDescription& d) { d.angular_velocity.x() = 1e-300; }));
  EXPECT_NE(plain, hashOfBody([](BodyDescription& d) { d.is_static = true; }));
}

TEST(WorldHash, ChangesWithTime) {
  World w{WorldSettings{1.0 / 60, Vec3::Zero(), true}};
  BodyDescription d;
  d.solid = w.addSolid(Solid::ball(0.5));
  w.addBody(d);
  ASSERT_TRUE(w.start().empty());
  const std::uint64_t before = w.stateHash();
  w.step();
  EXPECT_NE(w.stateHash(), before) << "the body floats still, only time went on";
}

}  // namespace
}  // namespace carom
