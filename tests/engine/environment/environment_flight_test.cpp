// Flight through air and fluids, where it must be flight without them.

#include "engine/environment/environment_flight.h"

#include <gtest/gtest.h>

#include "engine/solid/solid.h"
#include "tests/oracle/test_shapes.h"

namespace carom {
namespace {

// The path of a body that tumbles through next to no air is the free rotation, all the way.
TEST(EnvironmentFlight, ThroughNextToNoAir_TumblesAsInAVacuum) {
  const Solid solid = Solid::box(Vec3(0.5, 0.3, 0.1));
  const SolidSurface surface = surfaceOf(solid);
  const Inertia inertia = inertiaOf(600.0, solid.volume(), solid.unitInertia());
  Environment environment;
  environment.air.density_kgpm3 = 1e-12;
  const EnvironmentBody body{&surface, &inertia, {}};
  const ContactLoad contacts;
  ForceScratch scratch;
  const Pose X_WB{oracle::turned(Vec3(1.0, 2.0, 0.7), 0.9), Vec3(0.3, 0.2, 1.0)};
  const Velocity velocity{Vec3(1.0, -2.0, 0.5), Vec3(3.0, 25.0, 8.0)};
  const double dt_s = 1.0 / 60.0;
  const EnvironmentFlight flight =
      flyThroughEnvironment({environment, body, contacts}, X_WB, velocity, 0.0, dt_s, scratch);
  const Quat free = torqueFreeRotation(inertia, X_WB.rotation, velocity.angular, dt_s);
  EXPECT_LT((flight.X_end.position - X_WB.position - dt_s * velocity.linear).norm(), 1e-12);
  EXPECT_LT(flight.X_end.rotation.angularDistance(free), 1e-9);
  ASSERT_FALSE(flight.tumbling.empty());
  for (const double share : {0.25, 0.5, 1.0}) {
    const Quat there = torqueFreeRotation(inertia, X_WB.rotation, velocity.angular, share * dt_s);
    EXPECT_LT(flight.tumbling.after(share * dt_s).angularDistance(there), 1e-9) << share;
  }
}

}  // namespace
}  // namespace carom
