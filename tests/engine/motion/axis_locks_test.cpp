// Locked axes against the constraint's own equations.

#include "engine/motion/axis_locks.h"

#include <gtest/gtest.h>

#include "engine/response/one_point/impulse.h"

namespace carom {
namespace {

const Mat3 kUnit = (Mat3() << 0.4, 0.05, -0.02, 0.05, 0.3, 0.04, -0.02, 0.04, 0.2).finished();

TEST(LockedInertia, OfOneAxisHasItsMoment) {
  const Inertia inertia = inertiaOf(3.0, 2.0, kUnit);
  const Quat R(0.5, 0.1, -0.4, 0.7);
  const AxisLocks locks{Vec3::Ones(), AxisLocks::Turning::kOneAxis, Vec3(1, -2, 0.5).normalized()};
  const Inertia locked = lockedInertia(inertia, locks, R.normalized());
  const Vec3 spin = 1.7 * locks.axis_W;
  EXPECT_NEAR(kineticEnergy(locked, R.normalized(), {Vec3::Zero(), spin}),
              kineticEnergy(inertia, R.normalized(), {Vec3::Zero(), spin}), 1e-14);
  const Vec3 torque(0.3, 0.4, -1.0);
  const Vec3 turned = turningResponse(locked, locks) * torque;
  EXPECT_LT((turned - inverseTensorInWorld(locked, R.normalized()) * torque).norm(), 1e-14);
  EXPECT_LT(turned.cross(locks.axis_W).norm(), 1e-15);
  const double moment = locks.axis_W.dot(angularMomentum(inertia, R.normalized(), locks.axis_W));
  EXPECT_NEAR(turned.dot(locks.axis_W), torque.dot(locks.axis_W) / moment, 1e-14);
}

// However far it turns in a step, and whatever rounding makes of that, the axis stays where it was.
TEST(AxisLocks, TurnedFrom_LeavesTheTurningAboutTheAxis) {
  const Vec3 axis = Vec3(1, -2, 0.5).normalized();
  const AxisLocks one{Vec3::Ones(), AxisLocks::Turning::kOneAxis, axis};
  const Quat start = Quat(0.5, 0.1, -0.4, 0.7).normalized();
  Quat now = start;
  for (int i = 0; i < 1000; ++i) {
    const Vec3 astray = 1e-9 * Vec3(std::sin(i), std::cos(2.0 * i), 1.0);
    const Quat after =
        Quat(Eigen::AngleAxisd(0.013 * i * i, axis)) * Quat(1.0, astray.x(), astray.y(), astray.z()) * now;
    const Quat turned = one.turnedFrom(now, after);
    EXPECT_LT(turned.angularDistance(after.normalized()), 1e-8);
    now = turned;
  }
  EXPECT_LT((now * (start.conjugate() * axis) - axis).norm(), 1000 * 0x1p-50);
  EXPECT_NEAR(now.norm(), 1.0, 1000 * 0x1p-50);
  const AxisLocks none{Vec3::Ones(), AxisLocks::Turning::kLocked, axis};
  EXPECT_EQ(none.turnedFrom(start, now).coeffs(), start.coeffs());
  EXPECT_EQ(AxisLocks{}.turnedFrom(start, now).coeffs(), now.coeffs());
}

// K of a body with locked axes is the limit of one that is ever heavier along them.
TEST(CollisionMatrix, OfLockedBodiesIsTheLimitOfHeavyOnes) {
  const Inertia inertia = inertiaOf(3.0, 2.0, kUnit);
  const AxisLocks locks{Vec3(1, 0, 1), AxisLocks::Turning::kOneAxis, Vec3::UnitZ()};
  const Inertia locked = lockedInertia(inertia, locks, Quat::Identity());
  ImpulseBody body;
  body.inverse_mass = inertia.inverse_mass;
  body.inverse_tensor = turningResponse(locked, locks);
  body.free_axes = locks.free_axes;
  body.has_locks = true;
  const Vec3 r(0.3, -0.2, 0.5), n = Vec3(1, 2, -0.5).normalized();
  const Mat3 K = collisionMatrix({}, body, Vec3::Zero(), r);
  ImpulseBody pushed = body;
  pushed.apply(n, r);
  EXPECT_LT((K * n - pushed.velocity.at(r)).norm(), 1e-10);
  EXPECT_EQ(pushed.velocity.linear.y(), 0.0);
  EXPECT_FALSE(isUnanswered({}, body, n.dot(K * n)));
  EXPECT_TRUE(isUnanswered(
      {}, body, Vec3::UnitY().dot(collisionMatrix({}, body, Vec3::Zero(), Vec3::UnitY()) * Vec3::UnitY())));
}

}  // namespace
}  // namespace carom
