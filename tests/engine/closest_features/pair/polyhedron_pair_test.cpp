// The rotation that forgives drift, and the maps between the frames of two bodies, against Eigen in long
// double.

#include "engine/closest_features/pair/polyhedron_pair.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/oracle/test_shapes.h"

namespace carom {
namespace {

using oracle::Random;
using Real = long double;
using Mat3R = Eigen::Matrix<Real, 3, 3>;
using Vec3R = Eigen::Matrix<Real, 3, 1>;

constexpr double kUlp = std::numeric_limits<double>::epsilon();  // of one
// An entry of the matrix is a sum of at most three products of five rounded factors, all at most 2.
constexpr double kRounding = 8 * kUlp;
// There and back is twice that, by a transpose that is the inverse to within twice the entries' errors.
constexpr double kRoundTrip = 4 * kRounding;

Mat3R exactMatrix(const Quat& q) {
  return q.cast<Real>().normalized().toRotationMatrix();
}

double largestError(const Mat3& got, const Mat3R& want) {
  return static_cast<double>((got.cast<Real>() - want).cwiseAbs().maxCoeff());
}

double error(const Vec3& got, const Vec3R& want) {
  return static_cast<double>((got.cast<Real>() - want).norm());
}

Quat stretched(const Quat& q, double length) {
  return Quat(length * q.coeffs());
}

TEST(Rotation, OfAnyLengthFromAHalfToTwo_IsTheUnitQuaternions) {
  Random random(7100);
  for (int i = 0; i < 20000; ++i) {
    const Quat q = stretched(random.rotation(), random.uniform(0.5, 2.0));
    const Mat3R want = exactMatrix(q);
    const Vec3 v = random.uniform(0.1, 10.0) * random.direction();
    const Rotation rotation(q);
    ASSERT_LT(largestError(rotation.matrix(), want), kRounding) << i;
    ASSERT_LT(error(rotation * v, want * v.cast<Real>()), kRounding * v.norm()) << i;
    ASSERT_LT(error(rotation.back(v), want.transpose() * v.cast<Real>()), kRounding * v.norm()) << i;
  }
}

TEST(Rotation, OfAPowerOfTwoTimesTheQuaternion_HasTheSameBits) {
  Random random(7101);
  for (int i = 0; i < 2000; ++i) {
    // Away from length one the division scales exactly; near it the series answers in its place.
    const Quat q = stretched(random.rotation(), random.uniform(1.1, 1.9));
    const Mat3 want = Rotation(q).matrix();
    for (const double scale : {0.25, 0.5, 2.0, 4.0})
      ASSERT_EQ(Rotation(stretched(q, scale)).matrix(), want) << i << " times " << scale;
  }
}

// On both sides of the border between the branches, 2^-27 from a squared length of one, and closer: there the
// series leaves out e^2 < 2^-54, less than half an ulp of one.
TEST(Rotation, OfAlmostUnitLength_IsTheUnitQuaternionsOnBothSidesOfTheSeriesBorder) {
  Random random(7102);
  int by_series = 0, by_division = 0;
  for (int i = 0; i < 50000; ++i) {
    const double drift = (i % 2 == 0 ? 1.0 : -1.0) * random.logUniform(1e-17, 1e-7);
    const Quat q = stretched(random.rotation(), 1.0 + drift);
    ++(std::abs(q.squaredNorm() - 1.0) < 0x1p-27 ? by_series : by_division);
    ASSERT_LT(largestError(Rotation(q).matrix(), exactMatrix(q)), 4 * kUlp) << i << " drift " << drift;
  }
  EXPECT_GT(by_series, 10000);
  EXPECT_GT(by_division, 1000);
}

// q = (1 + d, 0, 0, 0) turned by a quarter about x: the entries are 0 and +-1, whatever d.
TEST(Rotation, ByAQuarterTurn_IsExactToAnUlpAcrossTheSeriesBorder) {
  const double root_half = std::sqrt(0.5);
  Mat3 want;
  want << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  for (int step = -400; step <= 400; ++step) {
    const double length = 1.0 + step * 0x1p-36;  // the border is at 2^-28, step 256
    const Mat3 got = Rotation(Quat(length * root_half, length * root_half, 0, 0)).matrix();
    ASSERT_LE((got - want).cwiseAbs().maxCoeff(), kUlp) << step;
  }
}

TEST(Rotation, Between_TakesTheFrameOfOneToThatOfTheOther) {
  Random random(7103);
  for (int i = 0; i < 20000; ++i) {
    const Quat a = stretched(random.rotation(), i % 2 == 0 ? 1.0 : random.uniform(0.5, 2.0));
    const Quat b = stretched(random.rotation(), i % 4 < 2 ? 1.0 : random.uniform(0.5, 2.0));
    const Mat3R want = exactMatrix(a).transpose() * exactMatrix(b);
    const Rotation between = Rotation::between(a, b);
    const Vec3 v = random.direction();
    ASSERT_LT(largestError(between.matrix(), want), kRounding) << i;
    ASSERT_LT(error(between * v, want * v.cast<Real>()), kRounding) << i;
    ASSERT_LT(error(between.back(v), want.transpose() * v.cast<Real>()), kRounding) << i;
  }
}

TEST(Rotation, BetweenAQuaternionAndItself_IsTheIdentity) {
  Random random(7104);
  for (int i = 0; i < 2000; ++i) {
    const Quat q = stretched(random.rotation(), random.uniform(0.5, 2.0));
    ASSERT_LT(largestError(Rotation::between(q, q).matrix(), Mat3R::Identity()), kRounding) << i;
  }
}

TEST(Rotation, Back_UndoesTheRotation) {
  Random random(7105);
  for (int i = 0; i < 20000; ++i) {
    const Rotation rotation(stretched(random.rotation(), random.uniform(0.5, 2.0)));
    const Vec3 v = random.logUniform(1e-3, 1e3) * random.direction();
    ASSERT_LT((rotation.back(rotation * v) - v).norm(), kRounding * v.norm()) << i;
    ASSERT_LT((rotation * rotation.back(v) - v).norm(), kRounding * v.norm()) << i;
  }
}

// ---- the pair ----

const ConvexPolyhedron& box() {
  static const ConvexPolyhedron the_box = boxPolyhedron({1, 2, 3});
  return the_box;
}

struct DriftedPoses {
  DriftedPoses(Random& random, double far_m) : X_WA(random.pose(2.0)), X_WB(random.pose(2.0)) {
    const Vec3 away = far_m * random.direction();
    X_WA = {stretched(X_WA.rotation, random.uniform(0.5, 2.0)), X_WA.position + away};
    X_WB = {stretched(X_WB.rotation, random.uniform(0.5, 2.0)), X_WB.position + away};
  }
  PolyhedronPair pair() const { return {box(), X_WA, box(), X_WB}; }

  Pose X_WA, X_WB;
};

// The poses are as given, however they were rounded before: far away costs only the rounding of one
// difference of positions.
TEST(PolyhedronPair, MapsBetweenTheFramesAsThePosesDo) {
  Random random(7110);
  for (int i = 0; i < 20000; ++i) {
    const DriftedPoses at(random, i % 2 == 0 ? 0.0 : 1e4);
    const PolyhedronPair pair = at.pair();
    const Mat3R R_WA = exactMatrix(at.X_WA.rotation), R_WB = exactMatrix(at.X_WB.rotation);
    const Vec3R t = at.X_WB.position.cast<Real>() - at.X_WA.position.cast<Real>();
    const Vec3 p = random.uniform(0.0, 3.0) * random.direction();
    const Vec3R p_R = p.cast<Real>();
    const double size = p.norm() + static_cast<double>(t.norm());
    ASSERT_LT(error(pair.toA(p), R_WA.transpose() * (R_WB * p_R + t)), kRounding * size) << i;
    ASSERT_LT(error(pair.toB(p), R_WB.transpose() * (R_WA * p_R - t)), kRounding * size) << i;
    ASSERT_LT(error(pair.directionToA(p), R_WA.transpose() * (R_WB * p_R)), kRounding * size) << i;
    ASSERT_LT(error(pair.directionToB(p), R_WB.transpose() * (R_WA * p_R)), kRounding * size) << i;
  }
}

TEST(PolyhedronPair, ToBUndoesToA) {
  Random random(7111);
  for (int i = 0; i < 20000; ++i) {
    const PolyhedronPair pair = DriftedPoses(random, 0.0).pair();
    const Vec3 p = random.logUniform(1e-3, 1e2) * random.direction();
    const double size = p.norm() + pair.t_AB.norm();
    ASSERT_LT((pair.toB(pair.toA(p)) - p).norm(), kRoundTrip * size) << i;
    ASSERT_LT((pair.toA(pair.toB(p)) - p).norm(), kRoundTrip * size) << i;
    ASSERT_LT((pair.directionToB(pair.directionToA(p)) - p).norm(), kRoundTrip * size) << i;
  }
}

TEST(PolyhedronPair, Swapped_ExchangesTheBodiesAndTheMaps) {
  const ConvexPolyhedron other = boxPolyhedron({1, 1, 1});
  Random random(7112);
  for (int i = 0; i < 2000; ++i) {
    const DriftedPoses at(random, 0.0);
    const PolyhedronPair pair(box(), at.X_WA, other, at.X_WB);
    const PolyhedronPair swapped = pair.swapped();
    EXPECT_EQ(&swapped.a, &other);
    EXPECT_EQ(&swapped.b, &box());
    const Vec3 p = random.uniform(0.0, 3.0) * random.direction();
    const double size = p.norm() + pair.t_AB.norm();
    ASSERT_LT((swapped.toA(p) - pair.toB(p)).norm(), kRoundTrip * size) << i;
    ASSERT_LT((swapped.toB(p) - pair.toA(p)).norm(), kRoundTrip * size) << i;
    ASSERT_EQ(swapped.directionToA(p), pair.directionToB(p)) << i;
    const PolyhedronPair made(other, at.X_WB, box(), at.X_WA);
    ASSERT_LT((swapped.R_AB - made.R_AB).cwiseAbs().maxCoeff(), kRounding) << i;
    ASSERT_LT((swapped.t_AB - made.t_AB).norm(), kRoundTrip * size) << i;
  }
}

TEST(PolyhedronPair, SwappedTwice_IsThePairToRounding) {
  Random random(7113);
  for (int i = 0; i < 2000; ++i) {
    const PolyhedronPair pair = DriftedPoses(random, 0.0).pair();
    const PolyhedronPair twice = pair.swapped().swapped();
    ASSERT_EQ(twice.R_AB, pair.R_AB) << i;
    ASSERT_LT((twice.t_AB - pair.t_AB).norm(), kRoundTrip * pair.t_AB.norm()) << i;
  }
}

}  // namespace
}  // namespace carom
