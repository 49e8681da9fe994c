#include "engine/environment/drag.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "engine/solid/solid.h"
#include "tests/oracle/test_shapes.h"

namespace carom {
namespace {

Vec6 randomVelocity(oracle::Random& random) {
  Vec6 v;
  for (Eigen::Index i = 0; i < 6; ++i) v[i] = random.uniform(-2.0, 2.0);
  return v;
}

FacetList facetsOf(const ConvexPolyhedron& polyhedron) {
  FacetList list;
  CutScratch scratch;
  cutPolyhedron(polyhedron, {}, scratch, &list, nullptr);
  return list;
}

StreamDrag pressureOn(const ConvexPolyhedron& polyhedron, const Vec6& velocity) {
  StreamDrag drag;
  drag.velocity = velocity;
  CutScratch scratch;
  const FacetList list = facetsOf(polyhedron);
  for (const Facet& f : list.facets) addPressure(list.cornersOf(f), f.normal, 0.5, {}, scratch, drag);
  return drag;
}

Vec6 wrenchOf(const StreamDrag& drag) {
  return -(drag.quadratic + drag.linear) * drag.velocity;
}

TEST(Drag, AFaceAcrossTheStreamFeelsHalfRhoCdAVSquared) {
  Vec6 v = Vec6::Zero();
  v.head<3>() = Vec3(0.0, 0.0, -3.0);
  const Vec6 wrench = wrenchOf(pressureOn(boxPolyhedron(Vec3(0.5, 0.4, 0.3)), v));
  EXPECT_LT((wrench.head<3>() - Vec3(0.0, 0.0, 0.5 * 0.2 * 9.0)).norm(), 1e-15);
  EXPECT_LT(wrench.tail<3>().norm(), 1e-15);
}

// Half of each face meets the air with u = omega x: the torque is 2 (1/2 rho C_d) b omega^2 (a/2)^4 / 4.
TEST(Drag, ASpinningPlateIsBrakedByTheClosedForm) {
  const double a = 0.8, b = 0.3, omega = 5.0;
  Vec6 v = Vec6::Zero();
  v[4] = omega;
  const Vec6 wrench = wrenchOf(pressureOn(boxPolyhedron(Vec3(a, b, 1e-5)), v));
  const double expected = 2.0 * 0.5 * b * omega * omega * std::pow(0.5 * a, 4) / 4.0;
  EXPECT_NEAR(wrench[4] / -expected, 1.0, 1e-4);
  EXPECT_LT(wrench.head<3>().norm(), 1e-4);
}

// The same law summed over many small triangles, without clipping.
TEST(Drag, APureSpinAgreesWithManySmallPieces) {
  oracle::Random random(21);
  CutScratch scratch;
  for (int k = 0; k < 20; ++k) {
    // In braces, so that every compiler draws them in one order; counterclockwise, as a facet's corners are.
    Vec3 corner[3] = {Vec3{random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), 0.3},
                      Vec3{random.uniform(1.0, 2.0), random.uniform(-1.0, 1.0), 0.3},
                      Vec3{random.uniform(-1.0, 1.0), random.uniform(1.0, 2.0), 0.3}};
    if ((corner[1] - corner[0]).cross(corner[2] - corner[0]).z() < 0.0) std::swap(corner[1], corner[2]);
    StreamDrag drag;
    drag.velocity << 0.0, 0.0, random.uniform(-1.0, 1.0), random.uniform(-2.0, 2.0),
        random.uniform(-2.0, 2.0), 0.0;
    // No way along the facet at its middle: the pressure is that of the normal speed alone.
    const Vec3 middle = (corner[0] + corner[1] + corner[2]) / 3.0;
    const Vec3 slip = drag.velocity.head<3>() + drag.velocity.tail<3>().cross(middle);
    drag.velocity.head<2>() -= slip.head<2>();
    addPressure(corner, Vec3::UnitZ(), 0.5, {}, scratch, drag);
    const int n = 400;
    Vec6 sum = Vec6::Zero();
    const double area = 0.5 * (corner[1] - corner[0]).cross(corner[2] - corner[0]).norm() / (n * n);
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < 2 * (n - i) - 1; ++j) {
        const double third = j % 2 == 0 ? 1.0 / 3.0 : 2.0 / 3.0;
        const double s = (i + third) / n, t = (j / 2 + third) / n;
        const Vec3 p = corner[0] + s * (corner[1] - corner[0]) + t * (corner[2] - corner[0]);
        const double u = drag.velocity[2] + drag.velocity.tail<3>().cross(p).z();
        if (u <= 0.0) continue;
        const Vec3 force = -0.5 * u * u * area * Vec3::UnitZ();
        sum.head<3>() += force;
        sum.tail<3>() += p.cross(force);
      }
    EXPECT_LT((wrenchOf(drag) - sum).norm(), 2e-5 * (1.0 + sum.norm())) << k;
  }
}

TEST(Drag, NoDragEverDrives) {
  oracle::Random random(23);
  CutScratch scratch;
  const FacetList list = facetsOf(oracle::randomHull(random, 30, Vec3(1.0, 0.5, 0.2)));
  for (int i = 0; i < 500; ++i) {
    StreamDrag drag;
    drag.velocity = randomVelocity(random);
    for (const Facet& f : list.facets) {
      const Hold hold{{Vec3(0.6, 0.0, 0.8), 0.05}, 5.0};
      addPressure(list.cornersOf(f), f.normal, 0.5, hold, scratch, drag);
      addSkinFriction(list.cornersOf(f), f.normal, 0.01, drag);
      addLinear(list.cornersOf(f), f.normal, 0.2, hold, scratch, drag);
    }
    addPointDrag(Vec3(0.2, 0.1, -0.3), 0.4, Vec3(0.0, 0.6, 0.8), drag);
    addPointLinear(Vec3(0.2, 0.1, -0.3), 0.4, 0.1, drag);
    for (const Mat6& m : {drag.quadratic, drag.linear}) {
      ASSERT_LT((m - m.transpose()).norm(), 1e-13);
      ASSERT_GT(Eigen::SelfAdjointEigenSolver<Mat6>(m).eigenvalues().minCoeff(), -1e-13);
    }
  }
}

// Speeds whose squares are no numbers any more, of what comes to rest: found by the explorer's seed 736035.
TEST(Drag, OfNextToNoSpeedIsNextToNone) {
  oracle::Random random(24);
  for (int exponent = -150; exponent >= -323; --exponent)
    for (int k = 0; k < 20; ++k) {
      Vec6 v = Vec6::Zero();
      for (Eigen::Index i = 0; i < 6; ++i)
        v[i] = std::pow(10.0, exponent + (k % 4) * random.uniform(-15.0, 0.0)) * random.uniform(-1.0, 1.0);
      StreamDrag drag = pressureOn(boxPolyhedron(Vec3(3e-3, 2e-3, 4e-3)), v);
      addPointDrag(Vec3(1e-3, 2e-3, 0.0), 1.0, Vec3::UnitZ(), drag);
      ASSERT_TRUE(drag.quadratic.allFinite()) << v.transpose();
      EXPECT_LT(drag.quadratic.norm(), 1e-140) << v.transpose();
    }
}

TEST(Drag, GrowsWithTheSquareOfTheSpeed) {
  oracle::Random random(25);
  const ConvexPolyhedron hull = oracle::randomHull(random, 20);
  for (int i = 0; i < 50; ++i) {
    const Vec6 v = randomVelocity(random);
    const Vec6 once = wrenchOf(pressureOn(hull, v)), thrice = wrenchOf(pressureOn(hull, 3.0 * v));
    ASSERT_LT((thrice - 9.0 * once).norm(), 1e-12 * (1.0 + thrice.norm()));
  }
}

// A plate that glides with its edge ahead is turned broadside; the sum of the pressure is not changed.
TEST(Drag, ThePressureOfAnAskewStreamLeansToTheLeadingEdge) {
  Vec6 v = Vec6::Zero();
  v.head<3>() = Vec3(2.0, 0.0, -1.0);
  const Vec6 wrench = wrenchOf(pressureOn(boxPolyhedron(Vec3(1.0, 0.5, 1e-4)), v));
  EXPECT_NEAR(wrench[2], 0.5 * 0.5, 1e-12);
  const double lever = 1.0 / 6.0 * 2.0 / std::sqrt(5.0);  // forwards: a torque -x F about y
  EXPECT_NEAR(wrench[4], -lever * 0.25, 1e-3);
}

TEST(Drag, ABallFeelsKappaUU) {
  StreamDrag drag;
  drag.velocity << 3.0, -4.0, 12.0, 0.0, 0.0, 0.0;
  addPointDrag(Vec3::Zero(), 0.2, Vec3::Zero(), drag);
  EXPECT_LT((wrenchOf(drag).head<3>() + 0.2 * 13.0 * Vec3(3.0, -4.0, 12.0)).norm(), 1e-12);
}

TEST(Drag, LinearDragOfAFacetIsItsIntegral) {
  const Vec3 facet[4] = {Vec3(0, 0, 1), Vec3(2, 0, 1), Vec3(2, 1, 1), Vec3(0, 1, 1)};
  StreamDrag drag;
  drag.velocity << 0.5, 0.0, 0.0, 0.0, 0.0, 2.0;
  CutScratch scratch;
  addLinear(facet, Vec3::UnitZ(), 3.0, {}, scratch, drag);
  // u = (0.5 - 2 y, 2 x, 0) over 0..2 x 0..1: mean (-0.5, 2, 0); moments of z: x u_y - y u_x.
  const Vec6 wrench = wrenchOf(drag);
  EXPECT_LT((wrench.head<3>() - Vec3(3.0, -12.0, 0.0)).norm(), 1e-12);
  const double mean = 2.0 * 4.0 / 3.0 - (0.25 - 2.0 / 3.0);
  EXPECT_NEAR(wrench[5], -3.0 * 2.0 * mean, 1e-12);
}

}  // namespace
}  // namespace carom
