#include "engine/closest_features/two_discs.h"

namespace carom {

// A direction is given by its angle t from the first normal, and by p, from the outward direction of the side
// to where it leans; z = 1 - cos p. Supports are taken along the direction over cos t, less D: wanted is
// D / cos t - D = D tan(t / 2) tan t. Over tan t:
//   the first disc gives near + beyond z, which for z from z0 on is enough up to t0;
//   the second at least near (1 - z) + b (1 - z - tan s cot t), with s the lean and b = 2 radius cos s.
// The first stops where D tan(t / 2) = near + beyond z. From there to t0, what the second gives less
// D tan(t / 2) is concave in t, so that the ends decide. At the first end, with cot t < 1 / (2 tan(t / 2)),
// it is no less than a concave function of z: z = 0 and z0 decide. At t0 it falls with z: z0 decides, where
// the two ends are one.
bool reachWithin(double half_tangent, const TwoDiscs& discs) {
  if (!(half_tangent <= 1.0 && discs.lean_cosine > 0.0 && discs.lean_tangent >= 0.0)) return false;
  const double near = discs.near_m;
  const double wanted = discs.depth_m * half_tangent;
  if (near >= wanted) return true;
  const double beyond = discs.radius_m - near;
  const double z0 = (wanted - near) / beyond;
  const double lag = 0.5 * discs.depth_m * discs.lean_tangent;
  if (!(beyond > 0.0 && z0 < 1.0 && lag <= near)) return false;
  const double breadth = 2.0 * discs.across_m * discs.lean_cosine;
  return breadth * (1.0 - z0 - lag / wanted) >= (near + beyond) * z0;
}

}  // namespace carom
