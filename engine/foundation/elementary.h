#pragma once
// Elementary functions whose bits we own: only additions and multiplications in a fixed order, so that the
// state of a simulation does not depend on the C library. Tested in
// tests/engine/foundation/elementary_test.cpp.

#include "engine/foundation/frames.h"

namespace carom {

struct SineCosine {
  double sine;
  double cosine;
};
/// Sine and cosine of an angle in radians, within 2 ulp of one for |angle| <= 1e5.
SineCosine sineCosine(double angle);
/// The angle in (-pi, pi] whose sine and cosine are in the ratio of `y` to `x`; 0 when both are.
double angleOf(double y, double x);
/// e^x for |x| <= 700, within 2 ulp.
double exponential(double x);

/// The rotation by |rotation| radians about the direction of `rotation` (exponential map).
Quat rotationBy(const Vec3& rotation);
/// Its inverse: the shortest rotation vector, radians, of a unit quaternion.
Vec3 rotationOf(const Quat& q);

}  // namespace carom
