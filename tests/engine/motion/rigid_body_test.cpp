// Mass and velocity of a rigid body against sums over its points.

#include "engine/motion/rigid_body.h"

#include <gtest/gtest.h>

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

// A spin, and where a contact has led the body meanwhile: some degrees beside where the spin leads it.
struct Led {
  Led(const Inertia& inertia, oracle::Random& random) {
    const Quat before = random.rotation();
    const Vec3 spin = random.uniform(1.0, 100.0) * random.direction();
    momentum = angularMomentum(inertia, before, spin);
    energy_J = 0.5 * spin.dot(momentum);
    after = Quat(Eigen::AngleAxisd(random.uniform(0.0, 0.1), random.direction())) * before;
  }
  Vec3 momentum;
  double energy_J;
  Quat after;
};

// A needle whose orientation is a few degrees beside its angular momentum's: with the same momentum it would
// have a hundred times its energy.
TEST(SpinOfEnergy, HasTheEnergyAndTheNearestAngularMomentum) {
  const Solid needle = Solid::box({0.3, 0.004, 0.002});
  const Inertia inertia = inertiaOf(1000.0, needle.volume(), needle.unitInertia());
  oracle::Random random(5);
  for (int i = 0; i < 200; ++i) {
    const auto& [momentum, energy, after] = Led(inertia, random);
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

// Of the spins of that energy and that angular momentum about the axis, the one of the nearest momentum.
TEST(SpinOfEnergy, KeepsTheAngularMomentumAboutAnAxis) {
  const Solid plate = Solid::box({0.4, 0.3, 0.02});
  const Inertia inertia = inertiaOf(1000.0, plate.volume(), plate.unitInertia());
  oracle::Random random(6);
  int met = 0;
  for (int i = 0; i < 200; ++i) {
    const auto& [momentum, energy, after] = Led(inertia, random);
    const Vec3 axis = random.direction();
    const Vec3 found = spinOfEnergy(inertia, after, momentum, energy, 9.8 * axis);
    const Vec3 kept = angularMomentum(inertia, after, found);
    EXPECT_LE(0.5 * found.dot(kept), energy * (1.0 + 1e-14)) << i;
    if (0.5 * found.dot(kept) < energy * (1.0 - 1e-12)) continue;
    const Vec3 change = kept - momentum;
    if (std::abs(axis.dot(change)) > 1e-12 * momentum.norm()) continue;  // no room for the energy
    ++met;
    // The change is along the gradient of the energy among those.
    const Vec3 gradient = found - axis.dot(found) * axis;
    EXPECT_LE(change.cross(gradient).norm(), 1e-9 * momentum.norm() * found.norm()) << i;
  }
  EXPECT_GT(met, 180);
}

}  // namespace
}  // namespace carom
