// The certificate of the long run: it passes right answers and refuses each way of being wrong.

#include <gtest/gtest.h>

#include "tests/bench/queries/linear_certificate.h"
#include "tests/oracle/test_shapes.h"

namespace carom::bench {
namespace {

const ConvexPart kCube{boxPolyhedron(Vec3::Ones()), 0.0};
const Pose kBeside{Quat::Identity(), Vec3(1.5, 0.1, 0.2)};
const Pose kWithin{Quat::Identity(), Vec3(0.8, 0.1, 0.2)};

ClosestFeatures apart() {
  ClosestFeatures c;
  c.distance_m = 0.5;
  c.p_A_W = Vec3(0.5, 0.1, 0.2);
  c.p_B_W = Vec3(1.0, 0.1, 0.2);
  c.n_W = Vec3::UnitX();
  return c;
}

ClosestFeatures overlapping() {
  ClosestFeatures c = apart();
  c.distance_m = -0.2;
  c.p_B_W = Vec3(0.3, 0.1, 0.2);
  return c;
}

double provenWithin(const Pose& X_WB, const ClosestFeatures& c) {
  return bench::provenWithin(kCube, Pose{}, kCube, X_WB, c);
}

TEST(LinearCertificate, ProvesARightDistanceAndDepth) {
  EXPECT_LE(provenWithin(kBeside, apart()), 1e-15);
  EXPECT_LE(provenWithin(kWithin, overlapping()), 1e-15);
}

TEST(LinearCertificate, RefusesAWrongDistanceNormalOrWitness) {
  ClosestFeatures c = apart();
  c.distance_m = 0.5 + 1e-9;
  EXPECT_GT(provenWithin(kBeside, c), 0.9e-9);
  c = apart();
  c.n_W = Vec3(1.0, 1e-6, 0.0).normalized();
  EXPECT_GT(provenWithin(kBeside, c), 0.9e-6);
  c = apart();
  c.p_A_W.y() = c.p_B_W.y() = 0.7;  // beside the face
  EXPECT_GT(provenWithin(kBeside, c), 0.09);
}

TEST(LinearCertificate, RefusesADepthThatDoesNotFreeOrHasNoCommonPoint) {
  ClosestFeatures c = overlapping();
  c.distance_m = -0.1;
  EXPECT_GT(provenWithin(kWithin, c), 0.09);
  c = overlapping();
  c.p_A_W.y() = c.p_B_W.y() = 0.7;
  EXPECT_GT(provenWithin(kWithin, c), 0.09);
}

}  // namespace
}  // namespace carom::bench
