// Solids that tumble and slide on ice: all forces are along gravity, so the momentum across it and the
// angular momentum about it are what they were, whatever the contacts' paths do; the latter up to what a step
// in contact is off by as it turns.

#include "tests/physics/small_world.h"

namespace carom::physics {
namespace {

class OnIce : public testing::TestWithParam<double> {};  // restitution

TEST_P(OnIce, KeepsItsMomentumAcrossGravityAndItsAngularMomentumAboutIt) {
  oracle::Random random(1201);
  const std::vector<Solid> solids{Solid::box({0.5, 0.3, 0.02}), Solid::box({0.6, 0.02, 0.02}),
                                  Solid::polyhedron(oracle::randomHull(random, 20, Vec3(0.2, 0.3, 0.1))),
                                  Solid::polyhedron(oracle::randomHull(random, 60, Vec3(0.4, 0.4, 0.03)))};
  for (std::size_t k = 0; k < solids.size(); ++k) {
    SmallWorld w(240.0, Vec3(0.0, 0.0, -kGravity), false);
    w.addPlane(rubbing(0.0, GetParam()));
    const Vec3 velocity(0.1, -0.05, 0.0), spin = 4.0 * random.direction();
    const int body = w.add(
        {solids[k], {random.rotation(), Vec3(0.0, 0.0, 0.75)}, velocity, spin, rubbing(0.0, GetParam())});
    w.start();
    const Inertia inertia = inertiaOf(1000.0, solids[k].volume(), solids[k].unitInertia());
    const auto aboutGravity = [&] {
      return angularMomentum(inertia, w.state(body).X_WB.rotation, w.spin(body)).z();
    };
    const double before = aboutGravity(),
                 most = angularMomentum(inertia, w.state(body).X_WB.rotation, spin).norm();
    w.run(3.0);
    EXPECT_LT((w.velocity(body) - velocity).head<2>().norm(), 1e-13) << k;
    EXPECT_NEAR(aboutGravity(), before, 1e-5 * most) << k;
  }
}

INSTANTIATE_TEST_SUITE_P(Restitutions, OnIce, testing::Values(0.0, 0.3));

}  // namespace
}  // namespace carom::physics
