// A row that resists turning: within its limits it holds, at them it opposes the turning, whatever the
// bodies; momentum is kept, energy never gained.

#include "engine/response/sweeps/turning_resistance.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>

#include "engine/response/collision.h"
#include "engine/response/conjugate_sweeps.h"
#include "tests/engine/response/sweeps/random_contact.h"

namespace carom {
namespace {

using oracle::Random;
using Vec6 = Eigen::Matrix<double, 6, 1>;
using Mat6 = Eigen::Matrix<double, 6, 6>;

constexpr SolverSettings kThorough{100000, 1e-14, true};

Meeting resistedMeeting(Random& random, int points, double friction, double rolling_m, double spinning_m) {
  Meeting m = randomMeeting(random, points, friction, random.logUniform(0.1, 10));
  for (ContactRow& row : m.rows) {
    row.resistance = {rolling_m, spinning_m};
    prepareRow(row, m.bodies);
  }
  return m;
}

double totalEnergy(const Meeting& m) {
  return kineticEnergy(m.bodies[0]) + kineticEnergy(m.bodies[1]);
}

// Leaves the body some of its axes: of moving each or not, of turning all, one or none.
void lockAtRandom(Random& random, ImpulseBody& body) {
  const Mat3 inertia = body.inverse_tensor.inverse();
  const int turning = random.integer(0, 2);
  const Vec3 axis = Vec3::Unit(random.integer(0, 2));
  for (Eigen::Index i = 0; i < 3; ++i) body.free_axes[i] = random.integer(0, 1);
  if (turning == 1) body.inverse_tensor = axis * axis.transpose() / axis.dot(inertia * axis);
  if (turning == 2) body.inverse_tensor.setZero();
  body.has_locks = true;
  body.velocity.linear = body.free_axes.cwiseProduct(body.velocity.linear);
  if (turning == 1) body.velocity.angular = axis * axis.transpose() * body.velocity.angular;
  if (turning == 2) body.velocity.angular.setZero();
}

// Twice the work of all loads: on the mean of the velocities before and after.
double twiceWork(const Meeting& after, const std::vector<ImpulseBody>& before) {
  double work = 0.0;
  for (const ContactRow& row : after.rows) {
    work += row.impulse.dot(rowVelocity(row, before) + rowVelocity(row, after.bodies));
    work += row.torque.dot(rowSpin(row, before) + rowSpin(row, after.bodies));
  }
  return work;
}

TEST(TurningResistance, OfBodiesWithLockedAxes_TakesNoTorqueThatTheyDoNotAnswer) {
  Random random(609);
  for (int i = 0; i < 3000; ++i) {
    Meeting m =
        resistedMeeting(random, random.integer(1, 4), random.uniform(0, 1), random.logUniform(1e-3, 0.1),
                        random.integer(0, 2) == 0 ? 0.0 : random.logUniform(1e-3, 0.1));
    lockAtRandom(random, m.bodies[0]);
    if (i % 2 == 0) lockAtRandom(random, m.bodies[1]);
    for (ContactRow& row : m.rows) prepareRow(row, m.bodies);
    if (isUnanswered(m.bodies[0], m.bodies[1], m.rows[0].normal_response.x())) continue;
    const std::vector<ImpulseBody> before = m.bodies;
    solveContacts(m.rows, m.bodies, {300, 1e-12, true});
    for (std::size_t k = 0; k < 2; ++k) {
      ASSERT_TRUE(m.bodies[k].velocity.linear.allFinite() && m.bodies[k].velocity.angular.allFinite()) << i;
      const Vec3 locked = Vec3::Ones() - m.bodies[k].free_axes;
      EXPECT_EQ(locked.cwiseProduct(m.bodies[k].velocity.linear), Vec3::Zero());
    }
    double j = 0.0;
    for (const ContactRow& row : m.rows) {
      ASSERT_TRUE(row.impulse.allFinite() && row.torque.allFinite()) << i;
      EXPECT_LE(row.torque.tail<2>().norm(), 1.01 * row.resistance.rolling_m * row.impulse.x() + 1e-15) << i;
      j = std::max(j, row.impulse.norm());
    }
    EXPECT_LE(twiceWork(m, before), 1e-6 * j) << i;
  }
}

TEST(TurningResistance, RowSpinIsAboutTheRowsAxes) {
  Random random(601);
  for (int i = 0; i < 50; ++i) {
    Meeting m = resistedMeeting(random, 1, 0.5, 0.1, 0.1);
    const ContactRow& row = m.rows[0];
    const Vec3 before = rowSpin(row, m.bodies);
    m.bodies[1].velocity.angular += 2.0 * row.n + 3.0 * row.t1;
    m.bodies[0].velocity.angular += 5.0 * row.t2;
    EXPECT_LT((rowSpin(row, m.bodies) - before - Vec3(2, 3, -5)).norm(), 1e-13);
  }
}

TEST(TurningResistance, TorquesKeepMomentumAndTheCentresVelocities) {
  Random random(602);
  for (int i = 0; i < 50; ++i) {
    Meeting m = resistedMeeting(random, 1, 0.5, 0.1, 0.1);
    const Vec3 before = angularMomentum(m.bodies[0]) + angularMomentum(m.bodies[1]);
    const Vec3 linear = m.bodies[1].velocity.linear;
    const Vec3 own = angularMomentum(m.bodies[1]), torque = random.direction();
    applyTorqueToRow(m.rows[0], torque, m.bodies);
    EXPECT_LT((angularMomentum(m.bodies[0]) + angularMomentum(m.bodies[1]) - before).norm(), 1e-12);
    EXPECT_LT((angularMomentum(m.bodies[1]) - own - rowImpulse(m.rows[0], torque)).norm(), 1e-12);
    EXPECT_EQ(m.bodies[1].velocity.linear, linear);
  }
}

// Six unknowns at once, their matrix measured by unit impulses.
TEST(TurningResistance, HoldingIsTheSolutionOfTheSixEquations) {
  Random random(603);
  for (int i = 0; i < 200; ++i) {
    Meeting m = resistedMeeting(random, 1, 1e6, 1e6, 1e6);
    ContactRow& row = m.rows[0];
    row.resistance = {1e6, 1e6};  // as it was before it was cut
    Vec6 velocity;
    velocity << rowVelocity(row, m.bodies), rowSpin(row, m.bodies);
    Mat6 response;
    for (int k = 0; k < 6; ++k) {
      std::vector<ImpulseBody> tried = m.bodies;
      if (k < 3)
        applyToRow(row, Vec3::Unit(k), tried);
      else
        applyTorqueToRow(row, Vec3::Unit(k - 3), tried);
      response.col(k) << rowVelocity(row, tried), rowSpin(row, tried);
      response.col(k) -= velocity;
    }
    const Vec6 expected = response.fullPivLu().solve(-velocity);
    RowLoad load;
    const bool holds = holdsTurning(row, m.bodies, velocity.head<3>(), load);
    EXPECT_EQ(holds, expected(0) >= 0.0);
    EXPECT_LT((load.impulse - expected.head<3>()).norm() + (load.torque - expected.tail<3>()).norm(),
              1e-9 * expected.norm());
  }
}

// Within both limits; where it still turns, at them, and straight against the turning.
void expectResistance(const Meeting& m, double accuracy) {
  for (const ContactRow& row : m.rows) {
    const double j = row.impulse.x();
    const double rolling = row.resistance.rolling_m * j, spinning = row.resistance.spinning_m * j;
    const double slack = accuracy * (1.0 + j);
    EXPECT_LE(row.torque.tail<2>().norm(), rolling + slack);
    EXPECT_LE(std::abs(row.torque.x()), spinning + slack);
    const Vec3 spin = rowSpin(row, m.bodies);
    if (spin.tail<2>().norm() > 1e-3) {
      const Vec2 against = -rolling * spin.tail<2>().normalized();
      EXPECT_LT((row.torque.tail<2>() - against).norm(), 1e-4 * rolling + slack);
    }
    if (std::abs(spin.x()) > 1e-3) {
      EXPECT_NEAR(row.torque.x(), -std::copysign(spinning, spin.x()), slack);
    }
  }
}

TEST(TurningResistance, IsWithinItsLimitsAndAtThemOpposesTheTurning) {
  const std::uint64_t seed = 604;
  Random random(seed);
  int held = 0, turning = 0;
  for (int i = 0; i < 1000; ++i) {
    SCOPED_TRACE(testing::Message() << "seed " << seed << " case " << i);
    Meeting m = resistedMeeting(random, 1 + i % 2, random.uniform(0, 1), random.logUniform(1e-3, 1),
                                random.logUniform(1e-3, 1));
    for (ContactRow& row : m.rows) {
      if (i % 5 == 0) row.resistance.rolling_m = 0.0;
      if (i % 7 == 0) row.resistance.spinning_m = 0.0;
    }
    const SolverReport report = solveContacts(m.rows, m.bodies, kThorough);
    ASSERT_LT(report.sweeps, kThorough.sweeps);
    expectResistance(m, 1e-9);
    (rowSpin(m.rows[0], m.bodies).tail<2>().norm() < 1e-9 ? held : turning) += 1;
    if (HasFailure()) return;
  }
  EXPECT_GT(held, 50);
  EXPECT_GT(turning, 50);
}

TEST(TurningResistance, NeverGainsEnergyAndKeepsMomentum) {
  const std::uint64_t seed = 605;
  Random random(seed);
  for (int i = 0; i < 5000; ++i) {
    SCOPED_TRACE(testing::Message() << "seed " << seed << " case " << i);
    Meeting m = resistedMeeting(random, 1 + i % 4, random.uniform(0, 1), random.logUniform(1e-4, 10),
                                random.logUniform(1e-4, 10));
    const double before = totalEnergy(m);
    const Vec3 linear = linearMomentum(m.bodies[0]) + linearMomentum(m.bodies[1]);
    const Vec3 angular = angularMomentum(m.bodies[0]) + angularMomentum(m.bodies[1]);
    solveContactsFinely(m.rows, m.bodies, {1000, 1e-13, true});
    ASSERT_LE(totalEnergy(m), before * (1.0 + 1e-9));
    ASSERT_LT((linearMomentum(m.bodies[0]) + linearMomentum(m.bodies[1]) - linear).norm(), 1e-10);
    ASSERT_LT((angularMomentum(m.bodies[0]) + angularMomentum(m.bodies[1]) - angular).norm(), 1e-9);
  }
}

// With one point: what is held about two may be shared between them in many ways, and so their friction.
TEST(TurningResistance, ConjugateGradientsComeToTheSameVelocities) {
  Random random(606);
  for (int i = 0; i < 200; ++i) {
    Meeting m = resistedMeeting(random, 1, random.uniform(0, 1), random.logUniform(1e-2, 1),
                                random.logUniform(1e-2, 1));
    Meeting finely = m;
    solveContacts(m.rows, m.bodies, kThorough);
    const SolverReport report = solveContactsFinely(finely.rows, finely.bodies, kThorough);
    ASSERT_LT(report.sweeps, kThorough.sweeps) << i;
    for (std::size_t k = 0; k < 2; ++k) {
      EXPECT_LT((m.bodies[k].velocity.linear - finely.bodies[k].velocity.linear).norm(), 1e-6) << i;
      EXPECT_LT((m.bodies[k].velocity.angular - finely.bodies[k].velocity.angular).norm(), 1e-6) << i;
    }
  }
}

// Held down at a corner, a lever of ten metres would lift it faster than the impulse presses; a ball, which
// no torque lifts, keeps any.
TEST(TurningResistance, LeversThatWouldUndoTheirOwnNormalImpulseAreCut) {
  Random random(609);
  for (int i = 0; i < 200; ++i) {
    Meeting m = resistedMeeting(random, 1, 0.4, 10.0, 10.0);
    const ContactRow& row = m.rows[0];
    EXPECT_NEAR(row.resistance.rolling_m, row.resistance.spinning_m, 1e-12);
    for (int k = 0; k < 50; ++k) {
      const Vec3 axis = random.direction();
      std::vector<ImpulseBody> tried = m.bodies;
      const double along = axis.tail<2>().norm();
      applyTorqueToRow(
          row,
          {std::copysign(row.resistance.spinning_m, axis.x()), row.resistance.rolling_m * axis.y() / along,
           row.resistance.rolling_m * axis.z() / along},
          tried);
      const double lifted = rowVelocity(row, tried).x() - rowVelocity(row, m.bodies).x();
      ASSERT_LE(std::abs(lifted), (0.5 + 1e-12) * row.normal_response.x());
    }
  }
  Meeting ball;
  ball.bodies = {immovable(), {{}, Vec3(0, 0, 0.3), 1.0, 25.0 * Mat3::Identity()}};
  EXPECT_EQ(rowAt({.resistance = {10.0, 10.0}}, ball.bodies).resistance.rolling_m, 10.0);
}

TEST(TurningResistance, WhereTheSolveHasNoFriction_DoesNotAct) {
  Random random(607);
  Meeting m = resistedMeeting(random, 2, 0.6, 1.0, 1.0);
  Meeting bare = m;
  for (ContactRow& row : bare.rows) row.resistance = {};
  solveContacts(m.rows, m.bodies, {1000, 1e-12, false});
  solveContacts(bare.rows, bare.bodies, {1000, 1e-12, false});
  EXPECT_EQ(m.bodies[1].velocity.angular, bare.bodies[1].velocity.angular);
  EXPECT_TRUE(m.rows[0].torque.isZero(0.0));
}

TEST(TurningResistance, DoesNotActOnTheImpulseOfACollision) {
  Random random(608);
  for (int points : {1, 3}) {
    Meeting m = resistedMeeting(random, points, 0.4, 1.0, 1.0);
    Meeting bare = m;
    for (ContactRow& row : bare.rows) row.resistance = {};
    const std::vector<double> restitution(m.rows.size(), 0.5);
    collide(m.rows, m.bodies, restitution);
    collide(bare.rows, bare.bodies, restitution);
    EXPECT_EQ(m.bodies[1].velocity.angular, bare.bodies[1].velocity.angular) << points;
  }
}

// A resisted ball that rolls: its torque is its limit, and friction what keeps it rolling, 2/7 of what that
// would take of it.
TEST(TurningResistance, OfARollingBallTakesItsLimitAtOnce) {
  const double radius = 0.3, lever = 0.01, mass = 2.0, j = 0.7 * mass;
  const Solid solid = Solid::ball(radius);
  const Inertia inertia = inertiaOf(mass / solid.volume(), solid.volume(), solid.unitInertia());
  for (double heading : {0.0, 1.1, 4.0}) {
    const Vec3 along(std::cos(heading), std::sin(heading), 0);
    Meeting m;
    m.bodies = {immovable(),
                impulseBody(inertia, Quat::Identity(), Vec3(0, 0, radius),
                            {2.0 * along - Vec3(0, 0, j / mass), 2.0 / radius * Vec3::UnitZ().cross(along)})};
    m.rows = {rowAt({.friction = {0.5, 0.5}, .resistance = {lever, 0.0}}, m.bodies)};
    const SolverReport report = solveContactsFinely(m.rows, m.bodies, {100, 1e-15, true});
    EXPECT_LE(report.sweeps, 8);
    EXPECT_NEAR(m.rows[0].torque.norm(), lever * j, 1e-14);
    EXPECT_LT((m.bodies[1].velocity.linear - (2.0 - 5.0 / 7.0 * lever / radius * j / mass) * along).norm(),
              1e-14);
  }
}

// About an axis that does not resist there is no torque, and its equation falls away: five are left, or four.
TEST(TurningResistance, HoldingWithoutAnAxis_IsTheSolutionOfTheOtherEquations) {
  Random random(610);
  for (int i = 0; i < 200; ++i) {
    const bool rolling = i % 2 == 0;
    Meeting m = resistedMeeting(random, 1, 1e6, 1e6, 1e6);
    ContactRow& row = m.rows[0];
    row.resistance = rolling ? TurningResistance{1e6, 0.0} : TurningResistance{0.0, 1e6};
    const std::vector<Eigen::Index> kept =
        rolling ? std::vector<Eigen::Index>{0, 1, 2, 4, 5} : std::vector<Eigen::Index>{0, 1, 2, 3};
    const auto size = static_cast<Eigen::Index>(kept.size());
    Vec6 velocity;
    velocity << rowVelocity(row, m.bodies), rowSpin(row, m.bodies);
    Eigen::MatrixXd response(size, size);
    Eigen::VectorXd start(size);
    for (Eigen::Index c = 0; c < size; ++c) {
      const Eigen::Index k = kept[static_cast<std::size_t>(c)];
      std::vector<ImpulseBody> tried = m.bodies;
      if (k < 3)
        applyToRow(row, Vec3::Unit(k), tried);
      else
        applyTorqueToRow(row, Vec3::Unit(k - 3), tried);
      Vec6 change;
      change << rowVelocity(row, tried), rowSpin(row, tried);
      change -= velocity;
      for (Eigen::Index r = 0; r < size; ++r) response(r, c) = change(kept[static_cast<std::size_t>(r)]);
      start(c) = velocity(k);
    }
    const Eigen::VectorXd solved = response.fullPivLu().solve(-start);
    Vec6 expected = Vec6::Zero();
    for (Eigen::Index c = 0; c < size; ++c) expected(kept[static_cast<std::size_t>(c)]) = solved(c);
    RowLoad load;
    const bool holds = holdsTurning(row, m.bodies, velocity.head<3>(), load);
    EXPECT_EQ(holds, expected(0) >= 0.0) << i;
    EXPECT_LT((load.impulse - expected.head<3>()).norm() + (load.torque - expected.tail<3>()).norm(),
              1e-9 * expected.norm())
        << i;
  }
}

}  // namespace
}  // namespace carom
