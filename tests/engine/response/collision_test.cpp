// A collision: the paper's j, a ball's closed forms, momentum kept and energy never gained.

#include "engine/response/collision.h"

#include <gtest/gtest.h>

#include "tests/engine/response/sweeps/random_contact.h"

namespace carom {
namespace {

using oracle::Random;

TEST(Collide, AtOneFrictionlessPoint_IsThePapersImpulse) {
  const std::uint64_t seed = 111;
  Random random(seed);
  for (int i = 0; i < 1000; ++i) {
    Meeting m = randomMeeting(random, 1, 0.0, random.logUniform(1e-3, 1e3));
    const double e = random.uniform(0, 1);
    const double j =
        frictionlessImpulse(m.bodies[0], m.bodies[1], m.rows[0].r_a, m.rows[0].r_b, m.rows[0].n, e);
    const double approach = std::min(0.0, rowVelocity(m.rows[0], m.bodies).x());
    collide(m.rows, m.bodies, {{e}});
    ASSERT_NEAR(m.rows[0].impulse.x(), j, 1e-11 * (j + 1e-9)) << "seed " << seed << " case " << i;
    if (approach < 0) {
      ASSERT_NEAR(rowVelocity(m.rows[0], m.bodies).x(), -e * approach, 1e-11) << i;
    }
  }
}

// A ball on the floor, r = 0.3, spinless: it slides through the collision when mu (1 + e) |v_n| < 2/7 |v_t|,
// and loses that much; else its contact point comes to rest and v_t' = 5/7 v_t.
struct BallBounce {
  Vec3 velocity;
  Vec3 spin;
};
BallBounce bounceBall(const Vec3& velocity, const Vec3& spin, double mu, double e, const Quat& frame) {
  const double radius = 0.3;
  const Solid ball = Solid::ball(radius);
  const Inertia inertia = inertiaOf(1000.0, ball.volume(), ball.unitInertia());
  std::vector<ImpulseBody> bodies{
      immovable(), impulseBody(inertia, Quat::Identity(), Vec3::Zero(), {frame * velocity, frame * spin})};
  const Vec3 n = frame * Vec3::UnitZ();
  std::vector<ContactRow> rows{rowAt({.n = n, .p_W = -radius * n, .friction = {mu, mu}}, bodies)};
  collide(rows, bodies, {{e}});
  return {frame.conjugate() * bodies[1].velocity.linear, frame.conjugate() * bodies[1].velocity.angular};
}

TEST(Collide, OfAnObliqueBallThatSlides_LosesFrictionsShareOfTheNormalImpulse) {
  Random random(112);
  for (double e : {0.0, 0.4, 1.0})
    for (double heading : {0.0, 0.5, 2.0, 4.0}) {
      const Vec3 along(std::cos(heading), std::sin(heading), 0);
      const double mu = 0.1, vt = 5.0, vn = 2.0;  // mu (1 + e) vn <= 0.4 < 2/7 vt
      const BallBounce b = bounceBall(vt * along - Vec3(0, 0, vn), Vec3::Zero(), mu, e, random.rotation());
      EXPECT_LT((b.velocity - ((vt - mu * (1 + e) * vn) * along + Vec3(0, 0, e * vn))).norm(), 1e-10)
          << e << ' ' << heading;
      // I dw = r x J with I = 2/5 m r^2.
      EXPECT_NEAR(b.spin.norm(), 2.5 * mu * (1 + e) * vn / 0.3, 1e-9);
      EXPECT_GT(b.spin.dot(Vec3::UnitZ().cross(along)), 0.0) << "forward spin";
    }
}

TEST(Collide, OfAnObliqueBallThatGrips_LeavesFiveSeventhsOfItsSpeed) {
  Random random(113);
  for (double e : {0.0, 0.4, 1.0}) {
    const double vt = 1.0, vn = 2.0;
    const BallBounce b = bounceBall(Vec3(vt, 0, -vn), Vec3::Zero(), 0.8, e, random.rotation());
    EXPECT_LT((b.velocity - Vec3(5.0 / 7.0 * vt, 0, e * vn)).norm(), 1e-10) << e;
    EXPECT_NEAR(b.spin.y() * 0.3, 5.0 / 7.0 * vt, 1e-10) << "it rolls";
  }
}

TEST(Collide, OfABallWithBackspin_CanTurnItRound) {
  // Grips: v_t' = (5 v_t + 2 r w) / 7 with r w along the motion.
  const BallBounce b = bounceBall(Vec3(1, 0, -3), Vec3(0, -20, 0), 0.9, 0.5, Quat::Identity());
  EXPECT_NEAR(b.velocity.x(), (5.0 * 1.0 + 2.0 * 0.3 * -20.0) / 7.0, 1e-10);
  EXPECT_LT(b.velocity.x(), 0.0);
}

TEST(Collide, OfAFlatBox_LeavesAtTheRestitutionOnAllCorners) {
  for (double e : {0.0, 0.5, 1.0}) {
    std::vector<ImpulseBody> bodies{
        immovable(), impulseBody(boxInertia(3.0, {0.7, 0.3, 0.2}), Quat::Identity(), Vec3(0, 0, 0.1),
                                 {Vec3(0, 0, -2), Vec3::Zero()})};
    std::vector<ContactRow> rows;
    for (double x : {-0.35, 0.35})
      for (double y : {-0.15, 0.15})
        rows.push_back(rowAt({.p_W = Vec3(x, y, 0), .friction = {0.5, 0.5}}, bodies));
    const std::vector<double> restitution(4, e);
    collide(rows, bodies, restitution);
    EXPECT_LT((bodies[1].velocity.linear - Vec3(0, 0, 2 * e)).norm(), 1e-10) << e;
    EXPECT_LT(bodies[1].velocity.angular.norm(), 1e-9) << e;
  }
}

TEST(Collide, NeverGainsEnergyNorLosesMomentum) {
  const std::uint64_t seed = 114;
  Random random(seed);
  for (int i = 0; i < 100000; ++i) {
    const int points = random.integer(1, 4);
    Meeting m = randomMeeting(random, points, random.uniform(0, 2), random.logUniform(1e-6, 1e6));
    const std::vector<double> restitution(static_cast<std::size_t>(points),
                                          random.integer(0, 3) == 0 ? 1.0 : random.uniform(0, 1));
    const double before = kineticEnergy(m.bodies[0]) + kineticEnergy(m.bodies[1]);
    const Vec3 p = linearMomentum(m.bodies[0]) + linearMomentum(m.bodies[1]);
    const Vec3 L = angularMomentum(m.bodies[0]) + angularMomentum(m.bodies[1]);
    const double scale = linearMomentum(m.bodies[0]).norm() + linearMomentum(m.bodies[1]).norm();
    collide(m.rows, m.bodies, restitution, i % 2 == 0 ? 0.0 : random.uniform(0, 0.1));
    // The energies themselves are sums of squares of rounded velocities.
    ASSERT_LE(kineticEnergy(m.bodies[0]) + kineticEnergy(m.bodies[1]), before * (1 + 1e-11))
        << "seed " << seed << " case " << i << " points " << points;
    ASSERT_LT((linearMomentum(m.bodies[0]) + linearMomentum(m.bodies[1]) - p).norm(), 1e-12 * scale)
        << "seed " << seed << " case " << i;
    ASSERT_LT((angularMomentum(m.bodies[0]) + angularMomentum(m.bodies[1]) - L).norm(), 1e-12 * scale)
        << "seed " << seed << " case " << i;
  }
}

TEST(Collide, LeavesNoPointApproaching_ButForWhatIsEnough) {
  const std::uint64_t seed = 115;
  Random random(seed);
  for (int i = 0; i < 3000; ++i) {
    const int points = random.integer(1, 4);
    Meeting m = randomMeeting(random, points, random.uniform(0, 1), random.logUniform(1e-2, 1e2));
    const std::vector<double> restitution(static_cast<std::size_t>(points), random.uniform(0, 1));
    double approach = 0;
    for (const ContactRow& row : m.rows) approach = std::min(approach, rowVelocity(row, m.bodies).x());
    const double enough = i % 2 == 0 ? 0.0 : 0.1 * random.uniform(0, 1) * -approach;
    collide(m.rows, m.bodies, restitution, enough);
    for (const ContactRow& row : m.rows)
      ASSERT_GE(rowVelocity(row, m.bodies).x(), std::min(1e-6 * approach, -enough))
          << "seed " << seed << " case " << i << " points " << points;
  }
}

// A ball under one a million times as heavy, on the floor: what sweeps change of the heavy one is so little
// that it looks converged. What is solved at once is so to 1e-12 of the approach, times the ratio of masses.
TEST(Collide, OfAHeavyBodyOnALightOneOnTheFloor_StopsBothWithoutRestitution) {
  const auto ballAt = [](double density, double z_m) {
    const Solid ball = Solid::ball(0.5);
    const Inertia inertia = inertiaOf(density, ball.volume(), ball.unitInertia());
    return impulseBody(inertia, Quat::Identity(), Vec3(0, 0, z_m), {Vec3(0, 0, -1), Vec3::Zero()});
  };
  std::vector<ImpulseBody> bodies{immovable(), ballAt(1.0, 0.5), ballAt(1e6, 1.5)};
  std::vector<ContactRow> rows{rowAt({.a = 0, .b = 1, .p_W = Vec3::Zero()}, bodies),
                               rowAt({.a = 1, .b = 2, .p_W = Vec3::UnitZ()}, bodies)};
  collide(rows, bodies, {{0.0, 0.0}});
  EXPECT_NEAR(bodies[1].velocity.linear.z(), 0.0, 1e-6);
  EXPECT_NEAR(bodies[2].velocity.linear.z(), 0.0, 1e-6);
}

// Of a ball between a lid and what is driven towards it nothing is right: it must not be pressed without
// measure.
TEST(Collide, WithoutRoom_PressesNoMoreThanSweepsDo) {
  const Solid ball = Solid::ball(0.5);
  const Inertia inertia = inertiaOf(1.0, ball.volume(), ball.unitInertia());
  const double speed_mps = 4.0;
  std::vector<ImpulseBody> bodies{immovable(), immovable(),
                                  impulseBody(inertia, Quat::Identity(), Vec3::Zero(), {})};
  bodies[0].velocity.linear = Vec3(0, 0, speed_mps);
  std::vector<ContactRow> rows{
      rowAt({.a = 0, .b = 2, .p_W = Vec3(0, 0, -0.5), .friction = {0.5, 0.5}}, bodies),
      rowAt({.a = 2, .b = 1, .p_W = Vec3(0, 0, 0.5), .friction = {0.5, 0.5}}, bodies)};
  collide(rows, bodies, {{0.3, 0.3}});
  const double most_Ns = 200.0 * speed_mps / inertia.inverse_mass;  // three solves of sixty sweeps
  EXPECT_LT(bodies[2].velocity.linear.norm(), 2.0 * speed_mps);
  for (const ContactRow& row : rows) EXPECT_LT(row.impulse.norm(), most_Ns);
}

TEST(Collide, OfBodiesThatSeparate_ChangesNothing) {
  Random random(116);
  for (int i = 0; i < 100; ++i) {
    Meeting m = randomMeeting(random, 2, 0.5, 1.0);
    std::swap(m.bodies[0].velocity, m.bodies[1].velocity);
    if (rowVelocity(m.rows[0], m.bodies).x() < 0 || rowVelocity(m.rows[1], m.bodies).x() < 0) continue;
    const Velocity a = m.bodies[0].velocity;
    collide(m.rows, m.bodies, {{0.5, 0.5}});
    EXPECT_EQ(m.bodies[0].velocity.linear, a.linear);
    EXPECT_EQ(m.bodies[0].velocity.angular, a.angular);
  }
}

// Turn the whole collision: the answer is turned with it, though the tangents are not.
TEST(Collide, DoesNotDependOnTheFrameItIsDescribedIn) {
  Random random(117);
  for (int i = 0; i < 200; ++i) {
    const Meeting m = randomMeeting(random, 3, 0.4, 2.0);
    const Quat R = random.rotation();
    const Mat3 M = R.toRotationMatrix();
    Meeting turned = m;
    for (ImpulseBody& b : turned.bodies) {
      b.velocity = {R * b.velocity.linear, R * b.velocity.angular};
      b.center = R * b.center;
      b.inverse_tensor = M * b.inverse_tensor * M.transpose();
    }
    for (ContactRow& row : turned.rows) {
      row.n = R * row.n;
      row.r_a = R * row.r_a;
      row.r_b = R * row.r_b;
      prepareRow(row, turned.bodies);
    }
    Meeting plain = m;
    const std::vector<double> e(3, 0.4);
    collide(plain.rows, plain.bodies, e);
    collide(turned.rows, turned.bodies, e);
    EXPECT_LT((turned.bodies[1].velocity.linear - R * plain.bodies[1].velocity.linear).norm(), 1e-6) << i;
  }
}

}  // namespace
}  // namespace carom
