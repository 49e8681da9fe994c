// The oracle's masses, inertias and energies against closed forms.

#include "tests/explore/watch/own_mechanics.h"

#include <gtest/gtest.h>

#include "tests/oracle/test_shapes.h"

namespace carom::explore {
namespace {

TEST(OwnMechanics, ABoxHasTheInertiaOfTheTextbook) {
  const OwnBody box = ownBody(0, Solid::box({0.3, 0.5, 0.7}), 800.0L);
  const double m = 800.0 * 0.3 * 0.5 * 0.7;
  EXPECT_NEAR(static_cast<double>(box.mass), m, 1e-13 * m);
  const Vec3 squares(0.09, 0.25, 0.49);
  for (int i = 0; i < 3; ++i)
    EXPECT_NEAR(static_cast<double>(box.inertia_B(i, i)), m / 12 * (squares.sum() - squares[i]), 1e-13 * m)
        << i;
  EXPECT_LT(static_cast<double>(box.center_B.norm()), 1e-16);
}

TEST(OwnMechanics, ACapsuleOfNoLengthIsABall) {
  const Moments ball = ballMoments({1, 2, 3}, 0.5L),
                capsule = capsuleMoments({1, 2, 3}, {1, 2, 3 + 1e-12L}, 0.5L);
  EXPECT_NEAR(static_cast<double>(ball.volume), static_cast<double>(capsule.volume), 1e-11);
  EXPECT_LT(static_cast<double>((ball.second - capsule.second).norm()), 1e-10);
}

// A prism of many sides is nearly a cylinder, a fine polyhedron of a capsule's points nearly a capsule: its
// second moments agree to the square of the angle between neighbouring points.
TEST(OwnMechanics, ACapsuleIsThePolyhedronOfItsPoints) {
  std::vector<Vec3> points;
  const int n = 48;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j <= n / 2; ++j) {
      const double a = 2 * std::numbers::pi * i / n, b = std::numbers::pi * j / n;  // half a ball each
      const Vec3 p(0.3 * std::sin(b) * std::cos(a), 0.3 * std::sin(b) * std::sin(a), 0.3 * std::cos(b));
      points.emplace_back(p + Vec3(0, 0, 0.4));
      points.emplace_back(-p - Vec3(0, 0, 0.4));
    }
  const Moments fine = polyhedronMoments(convexHull(points).polyhedron);
  const Moments capsule = capsuleMoments({0, 0, -0.4L}, {0, 0, 0.4L}, 0.3L);
  EXPECT_NEAR(static_cast<double>(fine.volume / capsule.volume), 1.0, 0.01);
  for (int i = 0; i < 3; ++i)
    EXPECT_NEAR(static_cast<double>(fine.second(i, i) / capsule.second(i, i)), 1.0, 0.015) << i;
}

TEST(OwnMechanics, PartsOfACompoundAddUpAboutTheirCommonCentre) {
  std::vector<Vec3> shifted;
  const ConvexPolyhedron cube = boxPolyhedron({1, 1, 1});
  for (const Vec3& v : cube.vertices()) shifted.emplace_back(v + Vec3(1, 0, 0));
  const Solid bar({{cube, 0.0}, {convexHull(shifted).polyhedron, 0.0}});
  const OwnBody two = ownBody(0, bar, 1.0L), one = ownBody(0, Solid::box({2, 1, 1}), 1.0L);
  EXPECT_LT(static_cast<double>((two.inertia_B - one.inertia_B).norm()), 1e-13);
  EXPECT_LT(static_cast<double>(two.center_B.norm()), 1e-15);
}

TEST(OwnMechanics, ATurnedSpinningBodyHasTheSameEnergyAndTurnedMomentum) {
  const std::vector<OwnBody> bodies{ownBody(0, Solid::box({0.3, 0.5, 0.7}), 800.0L)};
  BodyState state;
  state.linear_velocity = Vec3(1, 2, 3);
  state.angular_velocity = Vec3(4, -5, 6);
  const Mechanics upright = mechanicsOf(bodies, {&state, 1}, Vec3::Zero());
  const Quat R = oracle::turned({1, 2, -1}, 0.7);
  BodyState turned = state;
  turned.X_WB.rotation = R;
  turned.angular_velocity = R * state.angular_velocity;
  const Mechanics after = mechanicsOf(bodies, {&turned, 1}, Vec3::Zero());
  EXPECT_NEAR(static_cast<double>(after.kinetic_J / upright.kinetic_J), 1.0, 1e-15);
  EXPECT_LT(
      static_cast<double>((after.angular - R.cast<Real>() * upright.angular).norm() / upright.angular.norm()),
      1e-15);
  const double m = 800 * 0.3 * 0.5 * 0.7;
  const double spin = m / 24 * ((0.25 + 0.49) * 16 + (0.09 + 0.49) * 25 + (0.09 + 0.25) * 36);
  EXPECT_NEAR(static_cast<double>(upright.kinetic_J), 7 * m + spin, 1e-10);
}

}  // namespace
}  // namespace carom::explore
