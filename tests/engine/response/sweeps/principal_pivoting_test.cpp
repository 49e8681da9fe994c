// Rows at once against the conditions that they must meet.

#include "engine/response/sweeps/principal_pivoting.h"

#include <gtest/gtest.h>

#include <vector>

#include "tests/oracle/test_shapes.h"

namespace carom {
namespace {

using oracle::Random;

// Rows between bodies of masses from 1e-4 to 1e4 kg: each row changes the velocities of two of them.
Eigen::MatrixXd randomRows(Random& random, Eigen::Index rows, Eigen::Index bodies) {
  Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(rows, bodies);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const auto a = static_cast<Eigen::Index>(random.uniform(0.0, static_cast<double>(bodies) - 1e-9));
    jacobian(i, a) = 1.0;
    if (a + 1 < bodies) jacobian(i, a + 1) = -random.uniform(0.2, 1.0);
  }
  return jacobian;
}

/// How many of `trials` problems have impulses; each is checked.
int solvedOf(int trials, double most_rows, Eigen::Index bodies) {
  Random random(5);
  int found = 0;
  for (int trial = 0; trial < trials; ++trial) {
    const auto rows = static_cast<Eigen::Index>(random.uniform(1.0, most_rows + 0.99));
    const Eigen::MatrixXd jacobian = randomRows(random, rows, bodies);
    Eigen::VectorXd inverse_mass(bodies);
    for (Eigen::Index i = 0; i < bodies; ++i) inverse_mass[i] = std::pow(10.0, random.uniform(-4.0, 4.0));
    const Eigen::MatrixXd response = jacobian * inverse_mass.asDiagonal() * jacobian.transpose();
    Eigen::VectorXd missing(rows);
    for (Eigen::Index i = 0; i < rows; ++i) missing[i] = random.uniform(-1.0, 1.0);
    const Eigen::VectorXd slack = Eigen::VectorXd::Constant(rows, 1e-3);
    const auto impulses = pivotImpulses(response, missing, slack);
    if (!impulses) continue;
    ++found;
    const Eigen::VectorXd short_of = missing - response * *impulses;
    for (Eigen::Index i = 0; i < rows; ++i) {
      EXPECT_GE((*impulses)[i], 0.0) << trial;
      EXPECT_LE(short_of[i], slack[i]) << trial;
      if ((*impulses)[i] > 0.0) {
        EXPECT_NEAR(short_of[i], 0.0, slack[i]) << trial;
      }
    }
  }
  return found;
}

TEST(PivotImpulses, PressOnlyWhereRowsAreNotFasterApartThanWanted) {
  EXPECT_GE(solvedOf(500, 12.0, 8), 490);
}

TEST(PivotImpulses, OfAHundredRowsPressOnlyWhereTheyMust) {
  EXPECT_GE(solvedOf(100, 100.0, 120), 98);
}

// A plate of 1 g between the ground and a ton that comes down: sweeps would take a million to hold both.
TEST(PivotImpulses, HoldALightBodyUnderAHeavyOne) {
  const double light = 1e3, heavy = 1e-3;  // 1 / kg
  Eigen::MatrixXd response(2, 2);
  response << light, -light, -light, light + heavy;
  const auto impulses = pivotImpulses(response, Eigen::Vector2d(0.0, 1.0), Eigen::Vector2d::Constant(1e-6));
  ASSERT_TRUE(impulses.has_value());
  EXPECT_NEAR((*impulses)[0], 1000.0, 2.0);
  EXPECT_NEAR((*impulses)[1], 1000.0, 2.0);
}

TEST(PivotImpulses, OfRowsThatContradictEachOther_AreNone) {
  // The same two bodies, to be parted and to be brought together.
  Eigen::MatrixXd response(2, 2);
  response << 1.0, -1.0, -1.0, 1.0;
  EXPECT_FALSE(
      pivotImpulses(response, Eigen::Vector2d(1.0, 1.0), Eigen::Vector2d::Constant(1e-3)).has_value());
}

// The same as rows of bodies: between the ground and a ton lies a plate of 1 g.
TEST(PivotRows, KeepALightBodyApartFromTheGroundAndAHeavyOne) {
  std::vector<ImpulseBody> bodies(3);  // the ground, the plate, the ton
  bodies[1].inverse_mass = 1e3;
  bodies[2].inverse_mass = 1e-3;
  bodies[2].velocity.linear.z() = -1.0;
  std::vector<ContactRow> rows(2);
  rows[0].a = 0;
  rows[0].b = 1;
  rows[1].a = 1;
  rows[1].b = 2;
  rows[1].lowest_speed = -0.25;
  ASSERT_TRUE(pivotRows(rows, bodies, Eigen::Vector2d::Constant(1e-6)));
  EXPECT_NEAR(bodies[1].velocity.linear.z(), 0.0, 1e-6);
  EXPECT_NEAR(bodies[2].velocity.linear.z(), -0.25, 1e-6);
  EXPECT_NEAR(rows[0].impulse.x(), 750.0, 1e-3);
  std::vector<ContactRow> many(33, rows[0]);
  EXPECT_FALSE(pivotRows(many, bodies, Eigen::VectorXd::Zero(33)));
}

}  // namespace
}  // namespace carom
