// Where the search begins does not matter: from every pair of features of a cube, a dodecahedron, a 60-gon
// prism and a grid of coplanar faces, in general and axis-aligned poses, the class and the distance are those
// of a cold start, to 4 units in the last place of the pair's size.

#include <gtest/gtest.h>

#include <span>

#include "engine/closest_features/vclip.h"
#include "tests/oracle/test_shapes.h"
#include "tests/support/build_effort.h"
#include "tests/support/features.h"

namespace carom {
namespace {

using oracle::turned;

constexpr int kStride = inThisBuild(1, 61);

struct NamedSolid {
  const char* name;
  ConvexPart part;
};

std::vector<NamedSolid> fourSolids() {
  return {{"cube", {boxPolyhedron(Vec3::Ones()), 0.0}},
          {"dodecahedron", {oracle::dodecahedron(), 0.0}},
          {"prism", {oracle::prism(60, 1.0, 1.0), 0.0}},
          {"grid", {oracle::coplanarGrid(3, {1.0, 1.5, 0.75}), 0.0}}};
}

// How far one must be moved along x, y or z to touch the other in axis-aligned poses.
double extentAlong(const ConvexPolyhedron& p, const Vec3& direction) {
  return direction.dot(p.vertex(p.support(direction)));
}

struct NamedPose {
  const char* name;
  Pose X_WB;
  Separation meant;
};

// B about A, which stands at the origin: apart, touching and overlapping, in general and aligned with the
// axes.
std::vector<NamedPose> posesOf(const ConvexPart& a, const ConvexPart& b) {
  const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
  const Quat level = Quat::Identity(), q = turned({1, 2, 3}, 0.7), q2 = turned({-2, 0.5, 1}, 2.1);
  const double over_x = extentAlong(a.core, x) + extentAlong(b.core, -x);
  const double over_y = extentAlong(a.core, y) + extentAlong(b.core, -y);
  const double over_z = extentAlong(a.core, z) + extentAlong(b.core, -z);
  const double reach = a.core.radius() + b.core.radius();
  std::vector<NamedPose> poses{
      {"general, apart", {q, Vec3(0.8, 0.5, 0.4) * reach}, Separation::kSeparated},
      {"general, far apart", {q2, Vec3(-3, 2, 5) * reach}, Separation::kSeparated},
      {"aligned, one over the other", {level, Vec3(0.25, 0.125, over_z + 0.5)}, Separation::kSeparated},
      {"aligned, over an edge", {level, Vec3(over_x + 0.25, 0.125, over_z + 0.5)}, Separation::kSeparated},
      {"aligned, over a corner",
       {level, Vec3(over_x + 0.25, over_y + 0.5, over_z + 0.25)},
       Separation::kSeparated},
      {"aligned, one on the other", {level, Vec3(0.0, 0.125, over_z)}, Separation::kTouching},
      {"aligned, sunk in", {level, Vec3(0.0, 0.125, over_z - 0.125)}, Separation::kPenetrating},
      {"general, deep inside", {q, Vec3(0.11, 0.07, 0.05)}, Separation::kPenetrating}};
  // Along the normal of the first, until they touch, and a little farther.
  FeaturePair none;
  const ClosestFeatures apart = closestFeatures(a, Pose{}, b, poses[0].X_WB, none);
  const auto nearer = [&](double by_m) { return Pose{q, poses[0].X_WB.position - by_m * apart.n_W}; };
  poses.push_back({"general, touching", nearer(apart.distance_m), Separation::kTouching});
  poses.push_back({"general, almost touching", nearer(apart.distance_m - 1e-7), Separation::kSeparated});
  poses.push_back({"general, sunk in", nearer(apart.distance_m + 0.05), Separation::kPenetrating});
  return poses;
}

double sizeOf(const ConvexPart& a, const ConvexPart& b, const Pose& X_WB) {
  return X_WB.position.norm() + a.core.radiusAbout(Vec3::Zero()) + b.core.radiusAbout(Vec3::Zero());
}

void expectEverySeedAgrees(const ConvexPart& a, const ConvexPart& b, const NamedPose& pose) {
  constexpr double kFourUlp = 4.0 * 0x1p-52;
  FeaturePair none;
  const ClosestFeatures want = closestFeatures(a, Pose{}, b, pose.X_WB, none);
  ASSERT_EQ(want.status, pose.meant);
  const double most = kFourUlp * sizeOf(a, b, pose.X_WB);
  const std::vector<Feature> of_a = allFeatures(a.core), of_b = allFeatures(b.core);
  int wrong = 0, count = 0;
  for (const Feature& fa : of_a)
    for (const Feature& fb : of_b) {
      if (count++ % kStride != 0) continue;
      FeaturePair tracked{fa, fb};
      const ClosestFeatures got = closestFeatures(a, Pose{}, b, pose.X_WB, tracked);
      ASSERT_FALSE(got.reached_limit) << count;
      const bool agrees = got.status == want.status && std::abs(got.distance_m - want.distance_m) <= most;
      if (!agrees && wrong++ == 0)
        ADD_FAILURE() << "kinds " << int(fa.kind) << int(fb.kind) << ", indices " << fa.index << " and "
                      << fb.index << ": class " << int(got.status) << ", distance " << got.distance_m
                      << ", by " << (got.distance_m - want.distance_m) << " (" << most << " allowed)";
    }
  EXPECT_EQ(wrong, 0) << "of " << count;
}

class AnySeed : public testing::TestWithParam<int> {};

TEST_P(AnySeed, GivesTheSameClassAndTheSameDistance) {
  const std::vector<NamedSolid> solids = fourSolids();
  const NamedSolid& a = solids[static_cast<std::size_t>(GetParam())];
  for (const NamedSolid& b : std::span(solids).subspan(static_cast<std::size_t>(GetParam())))
    for (const NamedPose& pose : posesOf(a.part, b.part)) {
      SCOPED_TRACE(testing::Message() << a.name << " and " << b.name << ", " << pose.name);
      ASSERT_NO_FATAL_FAILURE(expectEverySeedAgrees(a.part, b.part, pose));
    }
}

INSTANTIATE_TEST_SUITE_P(ClosestFeatures, AnySeed, testing::Range(0, 4), [](const auto& solid) {
  return fourSolids()[static_cast<std::size_t>(solid.param)].name;
});

// The grid is what it says: nothing merged, neighbours in one plane.
TEST(AnySeed, TheGridHasFlatEdgesAndVerticesAmidFaces) {
  const ConvexPolyhedron grid = oracle::coplanarGrid(3, {1.0, 1.5, 0.75});
  EXPECT_EQ(grid.vertexCount(), 56);
  EXPECT_EQ(grid.faceCount(), 6 * (5 + 2 * 4));
  int flat = 0;
  for (int e = 0; e < grid.edgeCount(); ++e)
    flat += grid.plane(grid.edge(e).left).normal.dot(grid.plane(grid.edge(e).right).normal) > 0.5;
  EXPECT_EQ(grid.edgeCount() - flat, 12 * 3) << "the box's edges, each in three";
}

}  // namespace
}  // namespace carom
