// Solids that tumble and slide without friction over a floor, level or aslant: it pushes along its normal, so
// across that momentum changes by gravity alone, whatever the contacts' paths do. On a level floor the
// angular momentum about gravity is what it was, up to what a step in contact is off by as it turns.

#include "tests/physics/small_world.h"

namespace carom::physics {
namespace {

struct Ice {
  double restitution = 0.0;
  double slope = 0.0;  // of the floor, rad
};
class OnIce : public testing::TestWithParam<Ice> {};

TEST_P(OnIce, KeepsItsMomentumAcrossTheFloorAndItsAngularMomentumAboutGravity) {
  const auto [restitution, slope] = GetParam();
  const Vec3 gravity = kGravity * Vec3(std::sin(slope), 0.0, -std::cos(slope));
  oracle::Random random(1201);
  const std::vector<Solid> solids{Solid::box({0.5, 0.3, 0.02}), Solid::box({0.6, 0.02, 0.02}),
                                  Solid::polyhedron(oracle::randomHull(random, 20, Vec3(0.2, 0.3, 0.1))),
                                  Solid::polyhedron(oracle::randomHull(random, 60, Vec3(0.4, 0.4, 0.03)))};
  for (std::size_t k = 0; k < solids.size(); ++k) {
    SmallWorld w(240.0, gravity, false);
    w.addPlane(rubbing(0.0, restitution));
    const Vec3 velocity(0.1, -0.05, 0.0), spin = 4.0 * random.direction();
    const int body = w.add(
        {solids[k], {random.rotation(), Vec3(0.0, 0.0, 0.75)}, velocity, spin, rubbing(0.0, restitution)});
    w.start();
    const Inertia inertia = inertiaOf(1000.0, solids[k].volume(), solids[k].unitInertia());
    const auto aboutGravity = [&] {
      return angularMomentum(inertia, w.state(body).X_WB.rotation, w.spin(body)).z();
    };
    const double before = aboutGravity(),
                 most = angularMomentum(inertia, w.state(body).X_WB.rotation, spin).norm();
    w.run(3.0);
    const Vec3 wanted = velocity + w.time() * gravity;
    EXPECT_LT((w.velocity(body) - wanted).head<2>().norm(), slope == 0.0 ? 1e-13 : 1e-11) << k;
    if (slope != 0.0) continue;
    EXPECT_NEAR(aboutGravity(), before, 1e-5 * most) << k;
  }
}

INSTANTIATE_TEST_SUITE_P(Restitutions, OnIce, testing::Values(Ice{0.0, 0.0}, Ice{0.3, 0.0}));
INSTANTIATE_TEST_SUITE_P(Slopes, OnIce, testing::Values(Ice{0.0, 0.3}, Ice{0.3, 0.3}, Ice{0.0, 1.0}));

}  // namespace
}  // namespace carom::physics
