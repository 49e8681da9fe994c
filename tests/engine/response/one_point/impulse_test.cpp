// The paper's impulse at one point: closed forms, the collision matrix, and what an impulse keeps.

#include "engine/response/one_point/impulse.h"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "tests/engine/response/sweeps/random_contact.h"

namespace carom {
namespace {

using oracle::Random;

TEST(FrictionlessImpulse, OfTwoPointMasses_IsTheReducedMassTimesTheSpeedChange) {
  ImpulseBody a, b;
  a.inverse_mass = 1.0 / 3.0;
  b.inverse_mass = 1.0 / 5.0;
  a.velocity.linear = Vec3(2, 7, 0);
  b.velocity.linear = Vec3(-1, 0, 3);
  const double reduced = 15.0 / 8.0;
  for (double e : {0.0, 0.5, 1.0})
    EXPECT_NEAR(frictionlessImpulse(a, b, Vec3::Zero(), Vec3::Zero(), Vec3::UnitX(), e),
                (1 + e) * reduced * 3.0, 1e-14);
}

// A bar struck across its end by a fixed post answers with 1 / (1/m + (L/2)^2 / I), I = m (L^2 + w^2) / 12
// across it.
TEST(FrictionlessImpulse, OfABarStruckAtItsEnd_IsThatOfItsEffectiveMass) {
  Random random(91);
  const double mass = 2.0, L = 1.5, w = 0.1;
  const double effective = 1.0 / (1.0 / mass + 0.25 * L * L * 12.0 / (mass * (L * L + w * w)));
  for (int i = 0; i < 20; ++i) {
    const Quat R = random.rotation();
    ImpulseBody bar = impulseBody(boxInertia(mass, {L, w, w}), R, Vec3::Zero(), {});
    const Vec3 n = R * Vec3::UnitZ(), end = R * Vec3(L / 2, 0, 0);
    bar.velocity.linear = -4.0 * n;
    EXPECT_NEAR(frictionlessImpulse(immovable(), bar, Vec3::Zero(), end, n, 0.5), 1.5 * effective * 4.0,
                1e-12);
  }
}

TEST(FrictionlessImpulse, OfBodiesThatSeparate_IsZero) {
  Random random(92);
  for (int i = 0; i < 100; ++i) {
    Meeting m = randomMeeting(random, 1, 0.0, 3.0);
    const ContactRow& row = m.rows[0];
    std::swap(m.bodies[0].velocity, m.bodies[1].velocity);
    const double u = rowVelocity(row, m.bodies).x();
    const double j = frictionlessImpulse(m.bodies[0], m.bodies[1], row.r_a, row.r_b, row.n, 0.7);
    EXPECT_EQ(j > 0.0, u < 0.0) << i;
    EXPECT_GE(j, 0.0);
  }
}

TEST(FrictionlessImpulse, TurnsTheApproachRoundByTheRestitution_AndLosesTheClosedFormEnergy) {
  Random random(93);
  for (int i = 0; i < 1000; ++i) {
    const double e = random.uniform(0, 1);
    Meeting m = randomMeeting(random, 1, 0.0, random.logUniform(1e-3, 1e3));
    const ContactRow& row = m.rows[0];
    const double u = rowVelocity(row, m.bodies).x();
    if (u >= 0) continue;
    const double before = kineticEnergy(m.bodies[0]) + kineticEnergy(m.bodies[1]);
    const double j = frictionlessImpulse(m.bodies[0], m.bodies[1], row.r_a, row.r_b, row.n, e);
    m.bodies[0].apply(-j * row.n, row.r_a);
    m.bodies[1].apply(j * row.n, row.r_b);
    ASSERT_NEAR(rowVelocity(row, m.bodies).x(), -e * u, 1e-12 * std::abs(u)) << i;
    // (1 - e^2) u^2 / 2 K_nn with j = -(1 + e) u / K_nn.
    const double lost = 0.5 * (1 - e) * j * -u;
    ASSERT_NEAR(before - kineticEnergy(m.bodies[0]) - kineticEnergy(m.bodies[1]), lost, 1e-11 * before) << i;
  }
}

TEST(CollisionMatrix, IsSymmetricAndPositiveDefinite) {
  Random random(94);
  for (int i = 0; i < 1000; ++i) {
    const Meeting m = randomMeeting(random, 1, 0.0, random.logUniform(1e-6, 1e6));
    const Mat3 K = collisionMatrix(m.bodies[0], m.bodies[1], m.rows[0].r_a, m.rows[0].r_b);
    ASSERT_LT((K - K.transpose()).norm(), 1e-14 * K.norm()) << i;
    ASSERT_GT(Eigen::SelfAdjointEigenSolver<Mat3>(K).eigenvalues()[0], 0.0) << i;
  }
}

TEST(CollisionMatrix, IsTheChangeOfRelativeVelocityPerImpulse) {
  Random random(95);
  for (int i = 0; i < 100; ++i) {
    Meeting m = randomMeeting(random, 1, 0.0, random.logUniform(0.1, 10));
    const ContactRow& row = m.rows[0];
    const auto relative = [&] {
      return Vec3(m.bodies[1].velocity.at(row.r_b) - m.bodies[0].velocity.at(row.r_a));
    };
    const Vec3 before = relative(), impulse = random.direction();
    const Mat3 K = collisionMatrix(m.bodies[0], m.bodies[1], row.r_a, row.r_b);
    m.bodies[0].apply(-impulse, row.r_a);
    m.bodies[1].apply(impulse, row.r_b);
    EXPECT_LT((relative() - before - K * impulse).norm(), 1e-12 * (K * impulse).norm()) << i;
  }
}

TEST(CollisionMatrix, OfTwoImmovableBodiesIsZero) {
  EXPECT_EQ(collisionMatrix(immovable(), immovable(), Vec3(1, 2, 3), Vec3(3, 2, 1)), Mat3(Mat3::Zero()));
}

}  // namespace
}  // namespace carom
