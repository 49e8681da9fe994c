// A free body that spins about its middle axis turns over again and again (Dzhanibekov). Angular momentum and
// energy are kept, and the time between two flips is the closed form of Euler's equations (Landau, Lifshitz:
// Mechanics, §37): half the period 4 K(k) / rate of the Jacobi elliptic functions.

#include "tests/physics/experiments/gyroscope.h"
#include "tests/physics/small_world.h"

namespace carom::physics {
namespace {

// A box of sides a > b > c: x has the least moment, z the largest, so y is the middle axis.
constexpr double kSides[3] = {0.9, 0.6, 0.2};

class Gyroscope : public testing::TestWithParam<double> {  // rad/s
 protected:
  Gyroscope() {
    body_ = world_.add({Solid::box({kSides[0], kSides[1], kSides[2]}),
                        {attitude_, Vec3::Zero()},
                        Vec3::Zero(),
                        attitude_ * (GetParam() * Vec3(0.02, 1.0, 0.03))});
    world_.start();
    const double mass = world_.world().mass(body_);
    const Vec3 squared(kSides[0] * kSides[0], kSides[1] * kSides[1], kSides[2] * kSides[2]);
    top_.moments = mass / 12.0 * (Vec3::Constant(squared.sum()) - squared);
    const Vec3 spin_B = GetParam() * Vec3(0.02, 1.0, 0.03);
    top_.energy = 0.5 * spin_B.dot(top_.moments.cwiseProduct(spin_B));
    top_.momentum_squared = top_.moments.cwiseProduct(spin_B).squaredNorm();
  }
  double spinAboutMiddle() const {
    return (world_.state(body_).X_WB.rotation.conjugate() * world_.spin(body_)).y();
  }

  const Quat attitude_ = oracle::turned({3, -1, 2}, 1.1);
  SmallWorld world_{60.0, Vec3::Zero()};
  int body_ = -1;
  Top top_;
};

constexpr int kSteps = 3600;  // a minute

TEST_P(Gyroscope, KeepsItsAngularMomentumForAMinute) {
  const Vec3 before = world_.world().audit().angular_momentum;
  EXPECT_NEAR(before.squaredNorm(), top_.momentum_squared, 1e-12 * top_.momentum_squared);
  double worst = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    world_.step();
    worst = std::max(worst, (world_.world().audit().angular_momentum - before).norm());
  }
  EXPECT_LE(worst, 1e-12 * before.norm());
}

TEST_P(Gyroscope, KeepsItsEnergyForAMinute) {
  EXPECT_NEAR(world_.world().audit().kinetic_energy_J, top_.energy, 1e-12 * top_.energy);
  double worst = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    world_.step();
    worst = std::max(worst, std::abs(world_.world().audit().kinetic_energy_J - top_.energy));
  }
  EXPECT_LE(worst, 1e-6 * top_.energy);
}

// The spin about the middle axis passes zero along a straight line (sn has no second derivative there), so
// that a chord of a step finds the instant to third order.
TEST_P(Gyroscope, FlipsAtTheClosedFormPeriod) {
  double first = 0.0, last = 0.0, before = spinAboutMiddle();
  int flips = 0;
  for (int i = 0; i < kSteps; ++i) {
    world_.step();
    const double now = spinAboutMiddle();
    if (before * now < 0.0) {
      last = world_.time() - world_.world().settings().step_s * now / (now - before);
      if (flips++ == 0) first = last;
    }
    before = now;
  }
  ASSERT_GE(flips, 3) << "it should turn over";
  const double period = closedFormFlipPeriod(top_);
  EXPECT_NEAR((last - first) / (flips - 1), period, 1e-4 * period);
}

INSTANTIATE_TEST_SUITE_P(Spins, Gyroscope, testing::Values(2.0, 5.0, 10.0, 25.0));

}  // namespace
}  // namespace carom::physics
