#include "engine/foundation/frames.h"

#include <cmath>

namespace carom {

TangentBasis tangentBasis(const Vec3& n) {
  // Cross with the axis that n leans on least, so that the product is never short.
  const Vec3 a = n.cwiseAbs();
  Vec3 axis = Vec3::UnitX();
  if (a.y() < a.x() && a.y() <= a.z()) axis = Vec3::UnitY();
  if (a.z() < a.x() && a.z() < a.y()) axis = Vec3::UnitZ();
  const Vec3 t1 = n.cross(axis).normalized();
  return {t1, n.cross(t1)};
}

}  // namespace carom
