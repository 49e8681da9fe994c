// Torque-free rotation against Euler's equations by small steps and against what it conserves, whatever the
// body's shape and however fast it turns.

#include "engine/motion/free_rotation.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "engine/foundation/elementary.h"
#include "tests/oracle/test_shapes.h"

namespace carom {
namespace {

using oracle::Random;

struct Box {
  Vec3 size;
  Inertia inertia;
  explicit Box(const Vec3& s)
      : size(s), inertia(inertiaOf(700.0, Solid::box(s).volume(), Solid::box(s).unitInertia())) {}
};

// A free body carried for a while as the world does it: the path turns by the constant spin, and the velocity
// is recomputed from the momentum.
struct FreeBody {
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
  FreeBody body{box.inertia, oracle::turned({1, 2, 3}, 0.7), Vec3(1.0, -6.0, 2.0)};
  const Vec3 before = body.momentum();
  const int steps = 10000;
  for (int i = 0; i < steps; ++i) body.step(1.0 / 240);
  // A handful of roundings a step, at worst all in one direction.
  EXPECT_LT((body.momentum() - before).norm(), 16.0 * steps * 0x1p-53 * before.norm());
}

TEST(TorqueFreeRotation, KeepsTheEnergyToRounding_HoweverCoarseTheStep) {
  const Box box({0.2, 0.6, 1.0});
  for (double dt : {1.0 / 240, 1.0 / 30}) {
    FreeBody body{box.inertia, oracle::turned({1, 2, 3}, 0.7), Vec3(1.0, -6.0, 2.0)};
    const double before = body.energy();
    const int steps = 10000;
    for (int i = 0; i < steps; ++i) {
      body.step(dt);
      ASSERT_NEAR(body.energy() / before, 1.0, 64.0 * steps * 0x1p-53);
    }
  }
}

// The axis of a symmetric body circles round the angular momentum at |L| / I_1, at a constant angle.
TEST(TorqueFreeRotation, OfASymmetricBodyPrecessesAtTheClosedFormRate) {
  const Box box({0.4, 0.4, 1.2});
  const Quat R0 = oracle::turned({2, -1, 1}, 0.9);
  FreeBody body{box.inertia, R0, R0 * Vec3(2.0, 0.0, 9.0)};
  const Vec3 L = body.momentum();
  const double dt = 1.0 / 480, seconds = 2.0;
  for (int i = 0; i < 960; ++i) body.step(dt);
  const double angle = L.norm() / box.inertia.tensor_B(0, 0) * seconds;
  const Vec3 expected = Eigen::AngleAxisd(angle, L.normalized()) * (R0 * Vec3::UnitZ());
  EXPECT_LT((body.R * Vec3::UnitZ() - expected).norm(), 1e-11);
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
      FreeBody body{rod.inertia, R, R * Vec3(0, 0, speed)};
      const double energy = body.energy();
      for (int i = 0; i < 60; ++i) body.step(1.0 / 60);
      ASSERT_NEAR(body.energy() / energy, 1.0, 1e-9) << "width " << width << " spin " << speed;
    }
}

TEST(TorqueFreeRotation, OfFlatAndLongBodiesKeepsTheEnergy) {
  Random random(33);
  const std::array<Vec3, 4> sizes{Vec3(1, 0.1, 0.1), Vec3(1, 1, 0.02), Vec3(1, 0.3, 0.02),
                                  Vec3(2, 0.04, 0.04)};
  for (const Vec3& size : sizes)
    for (double turn_per_step : {0.05, 0.2, 1.0}) {
      const Box body_shape(size);
      const Quat R = random.rotation();
      const double dt = 1.0 / 60;
      FreeBody body{body_shape.inertia, R, turn_per_step / dt * random.direction()};
      const double energy = body.energy();
      for (int i = 0; i < 600; ++i) body.step(dt);
      // An error of the orientation by one rounding is of the energy the moments' ratio times that.
      const Vec3& moments = body_shape.inertia.principal_moments;
      EXPECT_NEAR(body.energy() / energy, 1.0, 600 * 0x1p-50 * moments[2] / moments[0])
          << size.transpose() << " turning " << turn_per_step << " a step";
    }
}

TEST(TorqueFreeRotation, RunsBackwardsToWhereItCameFrom) {
  const Box box({0.2, 0.6, 1.0});
  const Quat R0 = oracle::turned({1, 2, 3}, 0.7);
  FreeBody body{box.inertia, R0, Vec3(1.0, -6.0, 2.0)};
  for (int i = 0; i < 100; ++i) body.step(1.0 / 120);
  for (int i = 0; i < 100; ++i) body.step(-1.0 / 120);
  EXPECT_LT((body.R * R0.conjugate()).vec().norm(), 1e-12);
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

void expectEuler(const Box& box, const Quat& R, const Vec3& w, double time_s, double within) {
  const FreeRotation free(box.inertia, R, w);
  for (double share : {-1.0, 0.25, 0.7, 1.0}) {
    const Quat expected = turnedByEuler(box.inertia, R, free.angularMomentum(), share * time_s);
    ASSERT_LT((free.after(share * time_s).toRotationMatrix() - expected.toRotationMatrix())
                  .lpNorm<Eigen::Infinity>(),
              within)
        << box.size.transpose() << " spin " << w.transpose() << " share " << share;
  }
}

TEST(FreeRotation, IsTheSolutionOfEulersEquationsAtEveryInstant) {
  Random random(34);
  for (int i = 0; i < 60; ++i) {
    const Box box({random.uniform(0.1, 1), random.uniform(0.1, 1), random.uniform(0.1, 1)});
    const Quat R = random.rotation();
    const Vec3 w = random.uniform(1, 40) * random.direction();
    // The error is the reference's: (2 rad / 2000)^4 times the moments' ratio.
    expectEuler(box, R, w, 2.0 / w.norm(), 2e-9);
  }
}

// Where two moments are equal, or nearly; about each axis, or nearly; along the separatrix, where the period
// is infinite; there and on both sides of it.
TEST(FreeRotation, IsTheSolutionWhereItsFunctionsDegenerate) {
  Random random(36);
  const Vec3 sizes[] = {Vec3(0.4, 0.4, 0.4),         Vec3(0.4, 0.4, 1.2),         Vec3(1.2, 0.4, 0.4),
                        Vec3(0.4, 0.4 + 1e-12, 1.2), Vec3(1.2, 0.4, 0.4 + 1e-15), Vec3(0.3, 0.6, 1.0),
                        Vec3(1.0, 1.0, 0.01)};
  for (const Vec3& size : sizes) {
    const Box box(size);
    const Vec3& moments = box.inertia.principal_moments;
    const Mat3& axes = box.inertia.principal_axes_B;
    const double round_low = moments[0] * (moments[1] - moments[0]),
                 round_high = moments[2] * (moments[2] - moments[1]);
    for (double beside : {0.0, 1e-300, 1e-160, 1e-16, 1e-12, 1e-8, 1e-4}) {
      std::vector<Vec3> spins;
      for (int axis = 0; axis < 3; ++axis)
        for (double sign : {-1.0, 1.0})
          spins.push_back(Vec3(beside, beside, beside) + sign * Vec3::Unit(axis));
      // On the separatrix I_1 (I_2 - I_1) w_1^2 = I_3 (I_3 - I_2) w_3^2.
      spins.push_back(Vec3(std::sqrt(round_high) + beside, 0.3, std::sqrt(round_low)).normalized());
      for (const Vec3& w : spins) {
        const Quat R = random.rotation();
        expectEuler(box, R, R * (axes * w), 3.0, 2e-9);
      }
    }
  }
}

TEST(FreeRotation, OfASymmetricBodyPrecessesExactly_HoweverFast) {
  const Box box({0.4, 0.4, 1.2});
  const Quat R = oracle::turned({2, -1, 1}, 0.9);
  for (double speed : {1.0, 30.0, 500.0, 1e5}) {
    const FreeRotation free(box.inertia, R, speed * (R * Vec3(0.2, 0.0, 0.9)));
    const Vec3& L = free.angularMomentum();
    const Vec3 axis =
        Eigen::AngleAxisd(L.norm() / box.inertia.tensor_B(0, 0) / 30.0, L.normalized()) * (R * Vec3::UnitZ());
    EXPECT_LT((free.after(1.0 / 30) * Vec3::UnitZ() - axis).norm(), 1e-14 * (10 + speed));
  }
}

TEST(FreeRotation, OfTheSlowestSpinsGoesOnAsItSpins) {
  const Box box({0.2, 0.6, 1.0});
  const Quat R = oracle::turned({1, 2, 3}, 0.7);
  for (double speed : {1e-300, 1e-170, 1e-100}) {
    const Vec3 w = speed * Vec3(1.0, -0.5, 0.2);
    EXPECT_LT((FreeRotation(box.inertia, R, w).after(1.0).coeffs() - R.coeffs()).norm(), 1e-15) << speed;
    EXPECT_TRUE(torqueFreeSpin(box.inertia, R, w, 1.0 / 60).allFinite()) << speed;
  }
}

// Splinters that a blow has set turning hundreds of times in a step.
TEST(FreeRotation, KeepsTheEnergyThroughThousandsOfTurns) {
  Random random(37);
  for (int i = 0; i < 200; ++i) {
    const Box box({random.uniform(0.01, 1), random.uniform(0.01, 1), random.uniform(0.01, 1)});
    const Quat R = random.rotation();
    const Vec3 w = 1e5 * random.direction();
    const FreeRotation free(box.inertia, R, w);
    const double before = w.dot(free.angularMomentum());
    const Vec3& moments = box.inertia.principal_moments;
    const double after =
        free.angularVelocityIn(free.after(random.uniform(-0.1, 0.1))).dot(free.angularMomentum());
    EXPECT_NEAR(after / before, 1.0, 0x1p-46 * moments[2] / moments[0]) << box.size.transpose();
  }
}

TEST(FreeRotation, NeverSpinsFasterThanItsBound_AndConstantSpinMissesItByNoMoreThanSaid) {
  Random random(35);
  const double dt = 1.0 / 60;
  for (int i = 0; i < 300; ++i) {
    const Box box({random.uniform(0.05, 1), random.uniform(0.05, 1), random.uniform(0.05, 1)});
    const Quat R = random.rotation();
    const Vec3 w = random.uniform(0.5, 12) * random.direction();
    const FreeRotation free(box.inertia, R, w);
    const Vec3 spin = torqueFreeSpin(box.inertia, R, w, dt);
    double miss = 0.0;
    for (int k = 0; k <= 20; ++k) {
      const Quat now = free.after(k * dt / 20);
      EXPECT_LE(free.angularVelocityIn(now).norm(), (1 + 1e-9) * free.fastestSpin());
      miss = std::max(miss, rotationOf(now * (rotationBy(k * dt / 20 * spin) * R).conjugate()).norm());
    }
    // The estimate is of the first order in the turn of a step, some 0.2 rad.
    EXPECT_LE(miss, 1.5 * tumblingMiss(box.inertia, R, w, dt) + 1e-12) << i;
  }
}

}  // namespace
}  // namespace carom
