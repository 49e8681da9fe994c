// A crowd divided into halves, those again: equal ones, cut across where they are longest.

#include "engine/response/sweeps/dissection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

#include "tests/oracle/test_shapes.h"

namespace carom {
namespace {

const std::vector<Vec3> kLevel{Vec3::UnitX(), Vec3::UnitY()};

std::vector<ImpulseBody> scattered(int count, const Vec3& size) {
  oracle::Random random(5);
  std::vector<ImpulseBody> bodies(static_cast<std::size_t>(count));
  for (ImpulseBody& body : bodies)
    body.center = Vec3(random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1)).cwiseProduct(size);
  return bodies;
}

std::vector<int> allOf(const std::vector<ImpulseBody>& bodies) {
  std::vector<int> members(bodies.size());
  std::iota(members.begin(), members.end(), 0);
  return members;
}

std::vector<int> partsOf(const std::vector<ImpulseBody>& bodies, const std::vector<Vec3>& directions,
                         int levels) {
  std::vector<int> members = allOf(bodies), part_of(bodies.size(), kNoPart);
  dissect({bodies, directions, levels}, members, part_of);
  return part_of;
}

TEST(Dissection, MakesPartsOfOneSize) {
  for (const int count : {0, 1, 7, 64, 1001}) {
    const std::vector<int> parts = partsOf(scattered(count, Vec3(4, 3, 2)), kLevel, 3);
    for (const int part : parts) EXPECT_EQ(depthOf(part), 3);
    for (int part = 8; part < 16; ++part)
      EXPECT_NEAR(static_cast<double>(std::count(parts.begin(), parts.end(), part)), count / 8.0, 1.0);
  }
}

TEST(Dissection, CutsAcrossWhereACrowdIsLongest_OfTheDirectionsThatMayBeCut) {
  const std::vector<ImpulseBody> bodies = scattered(500, Vec3(3, 5, 20));
  const std::vector<int> parts = partsOf(bodies, kLevel, 1);
  double first = 0.0, second = 5.0;  // where the one ends and the other begins, along y
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const double y = bodies[i].center.y();
    if (parts[i] == 2)
      first = std::max(first, y);
    else
      second = std::min(second, y);
  }
  EXPECT_LT(first, second);
}

TEST(Dissection, LeavesOthersAlone) {
  const std::vector<ImpulseBody> bodies = scattered(20, Vec3::Ones());
  std::vector<int> members{3, 4, 5, 11}, part_of(20, kNoPart);
  dissect({bodies, kLevel, 1}, members, part_of);
  EXPECT_EQ(std::count(part_of.begin(), part_of.end(), kNoPart), 16);
  for (const int i : {3, 4, 5, 11}) EXPECT_NE(part_of[static_cast<std::size_t>(i)], kNoPart);
}

// Also of bodies at one place, between which only their indices tell.
TEST(Dissection, DoesNotDependOnTheOrderOfItsMembers) {
  std::vector<ImpulseBody> bodies = scattered(101, Vec3(3, 2, 1));
  for (std::size_t i = 0; i < 50; ++i) bodies[i].center = Vec3::Ones();
  const std::vector<int> parts = partsOf(bodies, kLevel, 3);
  std::vector<int> members = allOf(bodies);
  oracle::Random random(9);
  for (int round = 0; round < 20; ++round) {
    for (std::size_t i = members.size() - 1; i > 0; --i)
      std::swap(members[i], members[static_cast<std::size_t>(random.integer(0, static_cast<int>(i)))]);
    std::vector<int> part_of(bodies.size(), kNoPart);
    dissect({bodies, kLevel, 3}, members, part_of);
    EXPECT_EQ(part_of, parts);
  }
}

std::set<int> partsAbove(int part) {
  std::set<int> above;
  for (; part != kNoPart; part /= 2) above.insert(part);
  return above;
}

TEST(CommonPart, IsTheSmallestThatHasBoth) {
  for (int a = 8; a < 16; ++a)
    for (int b = 8; b < 16; ++b) {
      int largest_number = kWhole;  // parts of parts have larger ones
      for (const int part : partsAbove(a))
        if (partsAbove(b).contains(part)) largest_number = std::max(largest_number, part);
      EXPECT_EQ(commonPart(a, b), largest_number) << a << " " << b;
    }
  EXPECT_EQ(commonPart(9, kNoPart), 9);
  EXPECT_EQ(commonPart(kNoPart, 9), 9);
}

}  // namespace
}  // namespace carom
