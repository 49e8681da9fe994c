// The collision at one point with friction, followed through: closed forms (balls, rods in the plane), the
// equations it integrates solved again by very small steps, and energy that never grows.

#include "engine/response/one_point/point_collision.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "tests/engine/response/sweeps/random_contact.h"

namespace carom {
namespace {

using oracle::Random;

double energyChange(const PointCollision& c, const Vec3& J) {
  return J.dot(c.velocity) + 0.5 * J.dot(c.response * J);
}

// The same by explicit steps of the normal impulse so small that the slip's direction is as good as constant,
// the work summed by trapezoids; sticking when friction turns the slip round within a step.
Vec3 integrated(const PointCollision& c, double share) {
  const Mat3& K = c.response;
  const double mu = c.friction.dynamic_coefficient;
  const Vec2 holding = -K.bottomRightCorner<2, 2>().inverse() * K.bottomLeftCorner<2, 1>();
  const bool holds = holding.norm() <= c.friction.static_coefficient;
  Vec3 J = Vec3::Zero(), u = c.velocity;
  double work = 0.0, least = 0.0;
  const double dp = share * -c.velocity.x() / K(0, 0);
  for (long i = 0; i < 400'000'000; ++i) {
    const Vec2 slip = u.tail<2>();
    Vec3 xi(1.0, 0.0, 0.0);
    if (slip.norm() > 0.0) xi.tail<2>() = -mu * slip.normalized();
    Vec3 next = u + dp * (K * xi);
    if (holds && (slip.norm() == 0.0 || next.tail<2>().dot(slip) <= 0.0)) {
      xi.tail<2>() = holding;
      next = u + dp * (K * xi);
      next.tail<2>().setZero();
    }
    work += 0.5 * dp * (u.x() + next.x());
    J += dp * xi;
    u = next;
    if (u.x() < 0.0) least = std::min(least, work);
    if (u.x() >= 0.0 && work >= (1.0 - c.restitution * c.restitution) * least) return J;
  }
  return Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
}

Mat3 randomResponse(Random& random, double smallest) {
  const Mat3 axes = random.rotation().toRotationMatrix();
  const Vec3 values(1.0, random.logUniform(smallest, 1), random.logUniform(smallest, 1));
  return axes * values.asDiagonal() * axes.transpose();
}

Vec3 randomApproach(Random& random) {
  return {-random.uniform(0.1, 2), random.uniform(-2, 2), random.uniform(-2, 2)};
}

TEST(PointCollision, WithCurvedSlip_IsWhatVerySmallStepsFind) {
  Random random(211);
  for (int i = 0; i < 60; ++i) {
    const double mu = random.uniform(0.05, 1.2);
    const PointCollision c{
        randomResponse(random, 0.1), randomApproach(random), {mu, mu}, random.uniform(0, 1)};
    const Vec3 J = pointCollisionImpulse(c);
    EXPECT_LT((J - integrated(c, 1e-6)).norm(), 2e-4 * J.norm()) << i << " mu " << mu;
  }
}

// A slip that friction cannot hold begins anew in the one direction in which it stays.
TEST(PointCollision, WithoutSlipAndTooLittleFriction_DepartsInTheDirectionThatStays) {
  Random random(212);
  int departed = 0;
  for (int i = 0; i < 2000; ++i) {
    const double mu = random.uniform(0.0, 0.3);
    const PointCollision c{randomResponse(random, 0.02), Vec3(-1, 0, 0), {mu, mu}, random.uniform(0, 1)};
    const Vec3 J = pointCollisionImpulse(c);
    const Vec2 slip = (c.response * J).tail<2>();
    if (slip.norm() < 1e-9) continue;
    ++departed;
    const Vec2 friction = J.tail<2>() / J.x();
    EXPECT_NEAR(friction.norm(), mu, 1e-12) << i;
    EXPECT_LT((friction + mu * slip.normalized()).norm(), 1e-9) << i << " friction opposes the slip";
  }
  EXPECT_GT(departed, 500);
}

TEST(PointCollision, NeverGainsEnergy_AndNeverLeavesApproaching) {
  Random random(213);
  for (int i = 0; i < 20000; ++i) {
    const double mu = random.uniform(0, 2);
    const PointCollision c{randomResponse(random, 1e-3),
                           randomApproach(random),
                           {mu * random.uniform(1, 1.5), mu},
                           random.integer(0, 3) == 0 ? 1.0 : random.uniform(0, 1)};
    const Vec3 J = pointCollisionImpulse(c);
    const Vec3 after = c.velocity + c.response * J;
    // The least energy that a collision at the point deals with: that of its velocity.
    const double scale = 0.5 * c.velocity.dot(c.response.inverse() * c.velocity);
    ASSERT_LE(energyChange(c, J), 1e-13 * scale) << i;
    ASSERT_GE(after.x(), -1e-12 * c.velocity.norm()) << i;
    ASSERT_LE(J.tail<2>().norm(), (1 + 1e-9) * std::max(c.friction.static_coefficient, mu) * J.x()) << i;
  }
}

TEST(PointCollision, GivesBackTheSquareOfTheRestitutionOfTheNormalWork) {
  Random random(214);
  for (int i = 0; i < 2000; ++i) {
    const double e = random.uniform(0, 1);
    const PointCollision c{randomResponse(random, 0.05), randomApproach(random), {0.0, 0.0}, e};
    const Vec3 J = pointCollisionImpulse(c);
    EXPECT_NEAR((c.velocity + c.response * J).x(), -e * c.velocity.x(), 1e-12) << i;
    EXPECT_EQ(J.y(), 0.0);
    EXPECT_EQ(J.z(), 0.0);
  }
}

// A slender rod strikes rough ground, leaning by theta from the upright, its end slipping forward. In the
// plane the slip keeps its line, so the course is piecewise linear in the normal impulse p (Stronge 1990):
//   K_nn = (1 + 3 sin^2) / m, K_tt = (1 + 3 cos^2) / m, K_nt = 3 sin cos / m (lean towards the slip).
struct Rod {
  double knn, ktt, knt;
  Rod(double theta, double mass)
      : knn((1 + 3 * std::sin(theta) * std::sin(theta)) / mass),
        ktt((1 + 3 * std::cos(theta) * std::cos(theta)) / mass),
        knt(3 * std::sin(theta) * std::cos(theta) / mass) {}
  PointCollision striking(double down, double slip, double mu, double e, double heading) const {
    const double c = std::cos(heading), s = std::sin(heading);
    Mat3 K = Mat3::Identity();
    K(0, 0) = knn;
    K(0, 1) = K(1, 0) = knt * c;
    K(0, 2) = K(2, 0) = knt * s;
    const double across = 1.0;  // any: nothing happens across the plane
    K(1, 1) = ktt * c * c + across * s * s;
    K(2, 2) = ktt * s * s + across * c * c;
    K(1, 2) = K(2, 1) = (ktt - across) * c * s;
    return {K, Vec3(-down, slip * c, slip * s), {mu, mu}, e};
  }
};

// Painleve's rod: where mu K_nt > K_nn, friction drives the slipping end further into the ground (jamming)
// until the slip stops; then it holds, and the ground throws the rod up. Finite, and without gain.
TEST(PointCollision, OfPainlevesRod_JamsUntilTheSlipStopsAndThenIsThrownUp) {
  const double mu = 1.6, down = 0.01, slip = 0.5;
  for (double theta : {0.5, 0.6, 0.7})
    for (double e : {0.0, 0.5, 1.0})
      for (double heading : {0.0, 1.0, 2.5, 5.0}) {
        const Rod rod(theta, 2.0);
        ASSERT_LT(rod.knn, mu * rod.knt) << "this lean does not jam";
        const PointCollision c = rod.striking(down, slip, mu, e, heading);
        const Vec3 J = pointCollisionImpulse(c);
        // Slipping: u_n and s change at the rates K_nn - mu K_nt < 0 and K_nt - mu K_tt < 0.
        const double stop = slip / (mu * rod.ktt - rod.knt);
        const double deepest = -down + (rod.knn - mu * rod.knt) * stop;
        double work = 0.5 * (-down + deepest) * stop;
        // Holding, if friction can: the rate is K_nn - K_nt^2 / K_tt.
        ASSERT_LE(rod.knt / rod.ktt, mu);
        const double rate = rod.knn - rod.knt * rod.knt / rod.ktt;
        work -= 0.5 * deepest * deepest / rate;
        const double up = std::sqrt(2.0 * rate * e * e * -work);
        const double normal = stop + (up - deepest) / rate;
        EXPECT_NEAR(J.x(), normal, 1e-11 * normal) << theta << ' ' << e << ' ' << heading;
        EXPECT_NEAR((c.velocity + c.response * J).x(), up, 1e-11);
        EXPECT_LT((c.velocity + c.response * J).tail<2>().norm(), 1e-11) << "the slip has stopped";
        EXPECT_LE(energyChange(c, J), 0.0);
      }
}

// The other way: the slip turns round when friction cannot hold it.
TEST(PointCollision, OfARodOnSlipperyGround_TurnsTheSlipRound) {
  const double theta = 0.7, mu = 0.3, down = 1.0, slip = 0.02;
  const Rod rod(theta, 2.0);
  ASSERT_GT(rod.knt / rod.ktt, mu) << "friction would hold";
  for (double e : {0.0, 0.6, 1.0})
    for (double heading : {0.0, 2.0, 4.0}) {
      const PointCollision c = rod.striking(down, -slip, mu, e, heading);
      const Vec3 J = pointCollisionImpulse(c);
      const double stop = slip / (rod.knt + mu * rod.ktt);
      const double u1 = -down + (rod.knn + mu * rod.knt) * stop;
      double work = 0.5 * (-down + u1) * stop;
      const double rate = rod.knn - mu * rod.knt;
      work -= 0.5 * u1 * u1 / rate;
      const double up = std::sqrt(2.0 * rate * e * e * -work);
      const double normal = stop + (up - u1) / rate;
      EXPECT_NEAR(J.x(), normal, 1e-9) << e << ' ' << heading;
      EXPECT_NEAR(J.tail<2>().dot(Vec2(std::cos(heading), std::sin(heading))),
                  mu * stop - mu * (normal - stop), 1e-9);
    }
}

// Where nothing couples the axes, d s_i / dp = -mu K_ii s_i / |s| along both tangents: s_2 is a power of s_1.
TEST(PointCollision, WithoutCoupling_TurnsItsSlipByAPowerLaw) {
  for (const double ratio : {10.0, 30.0, 100.0})
    for (const double angle : {0.01, 0.03, 0.1}) {
      const Vec3 before(-1.0, 0.3 * std::cos(angle), 0.3 * std::sin(angle));
      const PointCollision c{Vec3(1.0, 1.0 / ratio, 1.0).asDiagonal(), before, {1.0, 1.0}, 0.0};
      const Vec3 after = before + c.response * pointCollisionImpulse(c);
      EXPECT_NEAR(after.z(), before.z() * std::pow(after.y() / before.y(), ratio), 0.01 * before.z())
          << ratio << ' ' << angle;
    }
}

TEST(PointCollision, ScaledInMassOrSpeed_ScalesItsImpulse) {
  Random random(215);
  for (int i = 0; i < 200; ++i) {
    const double mu = random.uniform(0, 1.5);
    const PointCollision c{
        randomResponse(random, 0.05), randomApproach(random), {mu, mu}, random.uniform(0, 1)};
    const Vec3 J = pointCollisionImpulse(c);
    PointCollision other = c;
    other.response *= 0x1p-20;
    EXPECT_EQ(pointCollisionImpulse(other), Vec3(J * 0x1p20)) << i;
    other = c;
    other.velocity *= 0x1p-12;
    EXPECT_EQ(pointCollisionImpulse(other), Vec3(J * 0x1p-12)) << i;
  }
}

TEST(PointCollision, OfWhatSeparates_IsNothing) {
  EXPECT_EQ(pointCollisionImpulse({Mat3::Identity(), Vec3(0, 1, 1), {1, 1}, 1}), Vec3::Zero());
  EXPECT_EQ(pointCollisionImpulse({Mat3::Identity(), Vec3(0.1, 1, 1), {1, 1}, 1}), Vec3::Zero());
}

}  // namespace
}  // namespace carom
