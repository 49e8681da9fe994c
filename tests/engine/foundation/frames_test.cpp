// Pose algebra and tangent bases, with general rotations.

#include "engine/foundation/frames.h"

#include <gtest/gtest.h>

#include "tests/oracle/test_shapes.h"

namespace carom {
namespace {

using oracle::Random;

TEST(Pose, RotatesFirstAndThenMoves) {
  const Pose X_WB{oracle::turned(Vec3::UnitZ(), std::numbers::pi / 2), Vec3(10, 20, 30)};
  EXPECT_LT((X_WB * Vec3(1, 2, 3) - Vec3(8, 21, 33)).norm(), 1e-14);
}

TEST(Pose, ProductsApplyFromTheRight) {
  Random random(1);
  for (int i = 0; i < 100; ++i) {
    const Pose X_WA = random.pose(5), X_AB = random.pose(5);
    const Vec3 p_B = random.direction();
    EXPECT_LT(((X_WA * X_AB) * p_B - X_WA * (X_AB * p_B)).norm(), 1e-14);
  }
}

TEST(Pose, InverseUndoesItFromBothSides) {
  Random random(2);
  for (int i = 0; i < 100; ++i) {
    const Pose X = random.pose(5);
    const Vec3 p = random.direction();
    EXPECT_LT((X.inverse() * (X * p) - p).norm(), 1e-14);
    EXPECT_LT((X * (X.inverse() * p) - p).norm(), 1e-14);
  }
}

TEST(Pose, KeepsDistancesAndHandedness) {
  Random random(3);
  for (int i = 0; i < 100; ++i) {
    const Pose X = random.pose(5);
    const Vec3 a = random.direction(), b = random.direction();
    EXPECT_NEAR((X * a - X * b).norm(), (a - b).norm(), 1e-14);
    EXPECT_LT((X.rotation * a.cross(b) - (X.rotation * a).cross(X.rotation * b)).norm(), 1e-14);
  }
}

TEST(CrossMatrix, MultipliesAsTheCrossProduct) {
  Random random(4);
  const Vec3 a = random.direction(), b = random.direction();
  EXPECT_LT((crossMatrix(a) * b - a.cross(b)).norm(), 1e-15);
}

void expectRightHanded(const Vec3& n) {
  const auto [t1, t2] = tangentBasis(n);
  Mat3 basis;
  basis << n, t1, t2;
  EXPECT_LT((basis.transpose() * basis - Mat3::Identity()).norm(), 1e-15) << n.transpose();
  EXPECT_NEAR(basis.determinant(), 1.0, 1e-15) << n.transpose();
}

TEST(TangentBasis, IsRightHandedForEveryDirection) {
  Random random(5);
  for (int i = 0; i < 1000; ++i) expectRightHanded(random.direction());
}

TEST(TangentBasis, HoldsOnAxesDiagonalsAndTheirNeighbours) {
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z) {
        if (x == 0 && y == 0 && z == 0) continue;
        for (double nudge : {0.0, 1e-16, -1e-16, 1e-9})
          expectRightHanded(Vec3(x + nudge, y - nudge, z + 2 * nudge).normalized());
      }
}

}  // namespace
}  // namespace carom
