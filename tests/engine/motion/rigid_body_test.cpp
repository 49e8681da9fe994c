// Mass and velocity of a rigid body against sums over its points, and torque-free rotation: angular momentum
// exact, energy bounded and of second order, whatever the body's shape.

#include "engine/motion/rigid_body.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "engine/foundation/elementary.h"
#include "tests/oracle/test_shapes.h"

namespace carom {
namespace {

using oracle::Random;

// Two-point Gauss quadrature per axis integrates squares over a box exactly: eight points of equal mass.
std::vector<Vec3> gaussPoints(const Vec3& size) {
  std::vector<Vec3> points;
  for (double x : {-1.0, 1.0})
    for (double y : {-1.0, 1.0})
      for (double z : {-1.0, 1.0}) points.push_back(0.5 / std::sqrt(3.0) * Vec3(x, y, z).cwiseProduct(size));
  return points;
}

struct Box {
  Vec3 size;
  Inertia inertia;
  explicit Box(const Vec3& s)
      : size(s), inertia(inertiaOf(700.0, Solid::box(s).volume(), Solid::box(s).unitInertia())) {}
};

TEST(RigidBody, EnergyAndAngularMomentumAreTheSumsOverItsPoints) {
  Random random(31);
  const Box box({0.3, 0.7, 1.9});
  const double point_mass = box.inertia.mass_kg / 8;
  for (int i = 0; i < 100; ++i) {
    const Quat R = random.rotation();
    const Velocity v{3 * random.direction(), 5 * random.direction()};
    double energy = 0.0;
    Vec3 momentum = Vec3::Zero();
    for (const Vec3& p_B : gaussPoints(box.size)) {
      const Vec3 r = R * p_B;
      energy += 0.5 * point_mass * v.at(r).squaredNorm();
      momentum += point_mass * r.cross(v.at(r));
    }
    EXPECT_NEAR(kineticEnergy(box.inertia, R, v), energy, 1e-12 * energy);
    EXPECT_LT((angularMomentum(box.inertia, R, v.angular) - momentum).norm(), 1e-12 * momentum.norm());
  }
}

TEST(RigidBody, APointAheadOfACounterClockwiseSpinMovesToTheLeft) {
  const Velocity v{Vec3(10, 0, 0), Vec3(0, 0, 2)};
  EXPECT_EQ(v.at(Vec3(3, 0, 0)), Vec3(10, 6, 0));
}

TEST(RigidBody, AngularVelocityAndMomentumAreInverse) {
  Random random(32);
  const Box box({0.1, 1.0, 0.4});
  for (int i = 0; i < 100; ++i) {
    const Quat R = random.rotation();
    const Vec3 w = random.direction();
    EXPECT_LT((angularVelocity(box.inertia, R, angularMomentum(box.inertia, R, w)) - w).norm(), 1e-13);
    EXPECT_LT((inverseTensorInWorld(box.inertia, R) * angularMomentum(box.inertia, R, w) - w).norm(), 1e-13);
  }
}

// A free body carried for a while as the world does it: the path turns by the constant spin, and the velocity
// is recomputed from the momentum.
struct FreeRotation {
  const Inertia& inertia;
  Quat R;
  Vec3 w;

  void step(double dt) {
    const Vec3 L = angularMomentum(inertia, R, w);
    const Vec3 spin = torqueFreeSpin(inertia, R, w, dt);
    R = (rotationBy(dt * spin) * R).normalized();
    w = angularVelocity(inertia, R, L);
  }
  Vec3 momentum() const { return angularMomentum(inertia, R, w); }
  double energy() const { return kineticEnergy(inertia, R, {Vec3::Zero(), w}); }
};

TEST(TorqueFreeRotation, KeepsTheAngularMomentumToRounding) {
  const Box box({0.2, 0.6, 1.0});
  FreeRotation body{box.inertia, oracle::turned({1, 2, 3}, 0.7), Vec3(1.0, -6.0, 2.0)};
  const Vec3 before = body.momentum();
  const int steps = 10000;
  for (int i = 0; i < steps; ++i) body.step(1.0 / 240);
  // A handful of roundings a step, at worst all in one direction.
  EXPECT_LT((body.momentum() - before).norm(), 16.0 * steps * 0x1p-53 * before.norm());
}

double largestEnergyError(const Inertia& inertia, const Vec3& w, double dt, double seconds) {
  FreeRotation body{inertia, oracle::turned({1, 2, 3}, 0.7), w};
  const double before = body.energy();
  double worst = 0.0;
  for (double t = 0.0; t < seconds; t += dt) {
    body.step(dt);
    worst = std::max(worst, std::abs(body.energy() / before - 1.0));
  }
  return worst;
}

TEST(TorqueFreeRotation, EnergyErrorFallsWithTheFourthPowerOfTheStep) {
  const Box box({0.2, 0.6, 1.0});
  const Vec3 w(1.0, -6.0, 2.0);
  const double coarse = largestEnergyError(box.inertia, w, 1.0 / 120, 10.0);
  const double fine = largestEnergyError(box.inertia, w, 1.0 / 240, 10.0);
  EXPECT_LT(coarse, 2e-6);
  EXPECT_NEAR(coarse / fine, 16.0, 0.4);
}

TEST(TorqueFreeRotation, EnergyErrorDoesNotGrowWithTime) {
  const Box box({0.2, 0.6, 1.0});
  const Vec3 w(1.0, -6.0, 2.0);
  EXPECT_LT(largestEnergyError(box.inertia, w, 1.0 / 120, 600.0),
            1.2 * largestEnergyError(box.inertia, w, 1.0 / 120, 20.0));
}

// The axis of a symmetric body circles round the angular momentum at |L| / I_1, at a constant angle.
TEST(TorqueFreeRotation, OfASymmetricBodyPrecessesAtTheClosedFormRate) {
  const Box box({0.4, 0.4, 1.2});
  const Quat R0 = oracle::turned({2, -1, 1}, 0.9);
  FreeRotation body{box.inertia, R0, R0 * Vec3(2.0, 0.0, 9.0)};
  const Vec3 L = body.momentum();
  const double dt = 1.0 / 480, seconds = 2.0;
  for (int i = 0; i < 960; ++i) body.step(dt);
  const double angle = L.norm() / box.inertia.tensor_B(0, 0) * seconds;
  const Vec3 expected = Eigen::AngleAxisd(angle, L.normalized()) * (R0 * Vec3::UnitZ());
  EXPECT_LT((body.R * Vec3::UnitZ() - expected).norm(), 2e-3);  // (L dt / I)^2 / 12 of some 14 radians
}

TEST(TorqueFreeRotation, OfABallIsItsSpin) {
  const Inertia ball = inertiaOf(1000.0, Solid::ball(0.3).volume(), Solid::ball(0.3).unitInertia());
  const Vec3 w(3, -50, 20);
  EXPECT_LT((torqueFreeSpin(ball, oracle::turned({1, 2, 3}, 0.7), w, 1.0 / 60) - w).norm(), 1e-12);
}

// About a principal axis the spin is constant. Rounding must not grow along the slender axis, whose inertia
// is a small share of the others'.
TEST(TorqueFreeRotation, ASlenderRodAcrossItsLengthGoesOnAsItSpins) {
  for (double width : {0.2, 0.04, 0.01, 0.001})
    for (double speed : {1.0, 10.0, 30.0, 100.0}) {
      const Box rod({2.0, width, width});
      const Quat R = oracle::turned({1, 2, 3}, 0.7);
      FreeRotation body{rod.inertia, R, R * Vec3(0, 0, speed)};
      const double energy = body.energy();
      for (int i = 0; i < 60; ++i) body.step(1.0 / 60);
      ASSERT_NEAR(body.energy() / energy, 1.0, 1e-6) << "width " << width << " spin " << speed;
    }
}

// Tumbling about a general axis: however coarse the step, energy stays of the order it was.
TEST(TorqueFreeRotation, OfFlatAndLongBodiesKeepsTheEnergyBounded) {
  Random random(33);
  const std::array<Vec3, 4> sizes{Vec3(1, 0.1, 0.1), Vec3(1, 1, 0.02), Vec3(1, 0.3, 0.02),
                                  Vec3(2, 0.04, 0.04)};
  for (const Vec3& size : sizes)
    for (double turn_per_step : {0.05, 0.2}) {
      const Box body_shape(size);
      const Quat R = random.rotation();
      const double dt = 1.0 / 60;
      FreeRotation body{body_shape.inertia, R, turn_per_step / dt * random.direction()};
      const double energy = body.energy();
      for (int i = 0; i < 600; ++i) {
        body.step(dt);
        ASSERT_NEAR(body.energy() / energy, 1.0, 0.5)
            << size.transpose() << " turning " << turn_per_step << " a step, step " << i;
      }
    }
}

TEST(TorqueFreeRotation, RunsBackwardsToWhereItCameFrom) {
  const Box box({0.2, 0.6, 1.0});
  const Quat R0 = oracle::turned({1, 2, 3}, 0.7);
  FreeRotation body{box.inertia, R0, Vec3(1.0, -6.0, 2.0)};
  for (int i = 0; i < 100; ++i) body.step(1.0 / 120);
  for (int i = 0; i < 100; ++i) body.step(-1.0 / 120);
  EXPECT_LT(body.R.angularDistance(R0), 1e-7);
}

// Euler's equations by small steps of the classical fourth-order Runge-Kutta method: dR/dt = omega R with
// omega = I^-1 L, the quaternion as four numbers.
Quat turnedByEuler(const Inertia& inertia, const Quat& R_WB, const Vec3& momentum, double dt_s) {
  using Vec4 = Eigen::Vector4d;
  const auto slope = [&](const Vec4& q) -> Vec4 {
    const Quat R = Quat(q).normalized();
    const Vec3 w = angularVelocity(inertia, R, momentum);
    return 0.5 * (Quat(0.0, w.x(), w.y(), w.z()) * Quat(q)).coeffs();
  };
  const int steps = 2000;
  const double h = dt_s / steps;
  Vec4 q = R_WB.coeffs();
  for (int i = 0; i < steps; ++i) {
    const Vec4 k1 = slope(q), k2 = slope(q + 0.5 * h * k1), k3 = slope(q + 0.5 * h * k2),
               k4 = slope(q + h * k3);
    q += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
  }
  return Quat(q).normalized();
}

TEST(Tumbling, IsTheSolutionOfEulersEquationsAtEveryInstant) {
  Random random(34);
  const double longest = 1.0 / 30;
  for (int i = 0; i < 60; ++i) {
    const Box box({random.uniform(0.1, 1), random.uniform(0.1, 1), random.uniform(0.1, 1)});
    const Quat R = random.rotation();
    const Vec3 w = random.uniform(1, 40) * random.direction();
    const Tumbling free = tumbling(box.inertia, R, w, longest);
    for (double share : {0.25, 0.7, 1.0}) {
      const Quat expected = turnedByEuler(box.inertia, R, free.momentum, share * longest);
      ASSERT_LT((rotationAfter(free, R, share * longest).toRotationMatrix() - expected.toRotationMatrix())
                    .lpNorm<Eigen::Infinity>(),
                2e-9)
          << box.size.transpose() << " spin " << w.norm();
    }
  }
}

TEST(Tumbling, OfASymmetricBodyPrecessesExactly_HoweverFast) {
  const Box box({0.4, 0.4, 1.2});
  const Quat R = oracle::turned({2, -1, 1}, 0.9);
  for (double speed : {1.0, 30.0, 500.0}) {
    const Tumbling free = tumbling(box.inertia, R, speed * (R * Vec3(0.2, 0.0, 0.9)), 1.0 / 30);
    const Vec3& L = free.momentum;
    const Vec3 axis =
        Eigen::AngleAxisd(L.norm() / box.inertia.tensor_B(0, 0) / 30.0, L.normalized()) * (R * Vec3::UnitZ());
    EXPECT_LT((rotationAfter(free, R, 1.0 / 30) * Vec3::UnitZ() - axis).norm(), 1e-12 * (1 + speed));
    EXPECT_LE(free.parts, 2);
  }
}

TEST(Tumbling, NeverSpinsFasterThanItsBound_AndConstantSpinMissesItByNoMoreThanSaid) {
  Random random(35);
  const double dt = 1.0 / 60;
  for (int i = 0; i < 300; ++i) {
    const Box box({random.uniform(0.05, 1), random.uniform(0.05, 1), random.uniform(0.05, 1)});
    const Quat R = random.rotation();
    const Vec3 w = random.uniform(0.5, 12) * random.direction();
    const Tumbling free = tumbling(box.inertia, R, w, dt);
    const Vec3 spin = torqueFreeSpin(box.inertia, R, w, dt);
    double miss = 0.0;
    for (int k = 0; k <= 20; ++k) {
      const Quat now = rotationAfter(free, R, k * dt / 20);
      EXPECT_LE(angularVelocity(box.inertia, now, free.momentum).norm(), (1 + 1e-9) * free.fastest_spin);
      miss = std::max(miss, rotationOf(now * (rotationBy(k * dt / 20 * spin) * R).conjugate()).norm());
    }
    // The estimate is of the first order in the turn of a step, some 0.2 rad.
    EXPECT_LE(miss, 1.5 * tumblingMiss(box.inertia, R, w, dt) + 1e-12) << i;
  }
}

// A needle whose orientation is a few degrees beside its angular momentum's: with the same momentum it would
// have a hundred times its energy.
TEST(SpinOfEnergy, HasTheEnergyAndTheNearestAngularMomentum) {
  const Solid needle = Solid::box({0.3, 0.004, 0.002});
  const Inertia inertia = inertiaOf(1000.0, needle.volume(), needle.unitInertia());
  oracle::Random random(5);
  for (int i = 0; i < 200; ++i) {
    const Quat before = random.rotation();
    const Vec3 spin = random.uniform(1.0, 100.0) * random.direction();
    const Vec3 momentum = angularMomentum(inertia, before, spin);
    const double energy = 0.5 * spin.dot(momentum);
    const Quat after = Quat(Eigen::AngleAxisd(random.uniform(0.0, 0.1), random.direction())) * before;
    const Vec3 found = spinOfEnergy(inertia, after, momentum, energy);
    const Vec3 kept = angularMomentum(inertia, after, found);
    const double found_energy = 0.5 * found.dot(kept);
    EXPECT_LE(found_energy, energy * (1.0 + 1e-14)) << i;
    if (found_energy < energy * (1.0 - 1e-12)) continue;  // beyond what a small difference explains
    // Nearest: the change is along the gradient of the energy, which is the spin.
    const Vec3 change = kept - momentum;
    EXPECT_LE(change.cross(found).norm(), 1e-9 * momentum.norm() * found.norm()) << i;
  }
  const Quat same = random.rotation();
  const Vec3 spin(3.0, -2.0, 5.0);
  const Vec3 momentum = angularMomentum(inertia, same, spin);
  EXPECT_LT((spinOfEnergy(inertia, same, momentum, 0.5 * spin.dot(momentum)) - spin).norm(), 1e-9);
}

}  // namespace
}  // namespace carom
