// Toppling: a block that cannot slide falls over exactly when the weight's line leaves its base, tan(angle) >
// b / h.

#include "tests/physics/small_world.h"

namespace carom::physics {
namespace {

double tiltAfter(double tangent, double seconds, double rate, bool& rests) {
  const Vec3 size(0.3, 0.4, 0.9);  // b / h = 1/3 along x
  const Quat tilt = oracle::turned(Vec3::UnitZ(), 0.5) * oracle::turned(Vec3::UnitY(), std::atan(tangent));
  SmallWorld w(rate);
  w.addPlane(rubbing(1.5), tilt);
  const Pose X = lyingBox(size, tilt, 0.0);
  const int block = w.add({Solid::box(size), X, Vec3::Zero(), Vec3::Zero(), rubbing(1.5)});
  w.start();
  w.run(seconds);
  rests = w.rests(block);
  return w.state(block).X_WB.rotation.angularDistance(X.rotation);
}

class Toppling : public testing::TestWithParam<double> {};

// A thousandth either side is decided.
TEST_P(Toppling, ABlockStandsWhenItsWeightFallsOnItsBase) {
  bool rests = false;
  EXPECT_LT(tiltAfter(0.999 / 3.0, 3.0, GetParam(), rests), 1e-3);
  EXPECT_TRUE(rests);
}

TEST_P(Toppling, ABlockFallsWhenItsWeightFallsBesideItsBase) {
  bool rests = false;
  EXPECT_GT(tiltAfter(1.001 / 3.0, 3.0, GetParam(), rests), 1.0);
}

TEST_P(Toppling, ACubeLiesOnAnEdgeBelowItsCentreOnly) {
  const Vec3 size(0.4, 0.4, 0.4);
  const double slack = tolerance::kRestBand * restGap(size.z());
  for (double beside : {-3.0, -0.2, 0.0, 0.2, 3.0}) {
    SmallWorld w(GetParam());
    const double edge = std::sqrt(0.5) * 0.3;
    w.add({Solid::box({1.0, 0.3, 0.3}),
           {oracle::turned(Vec3::UnitX(), 0.25 * std::numbers::pi), Vec3(0.0, 0.0, -edge)},
           Vec3::Zero(),
           Vec3::Zero(),
           rubbing(0.9),
           true});
    const Vec3 centre(0.0, beside * slack, 0.5 * size.z() + restGap(size.z()));
    const int cube =
        w.add({Solid::box(size), {Quat::Identity(), centre}, Vec3::Zero(), Vec3::Zero(), rubbing(0.9)});
    w.start();
    w.run(0.5);
    EXPECT_EQ(w.rests(cube), std::abs(beside) < 1.0) << beside;
    w.run(1.0);
    const double tilt = w.state(cube).X_WB.rotation.angularDistance(Quat::Identity());
    EXPECT_EQ(tilt > 0.3, std::abs(beside) > 1.0) << beside << ": " << tilt;
  }
}

INSTANTIATE_TEST_SUITE_P(Rates, Toppling, testing::Values(30.0, 60.0, 240.0));

}  // namespace
}  // namespace carom::physics
