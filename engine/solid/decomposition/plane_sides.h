#pragma once
// On which side of a line a point of a plane is. Tested with the polygons that ask.

#include "engine/foundation/frames.h"

namespace carom {

/// Twice the area of a, b, c; positive where they run counter-clockwise.
inline double turnOf(const Vec2& a, const Vec2& b, const Vec2& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

/// On which side of the line from a to b the point p is: 1 left, -1 right, 0 on it.
inline int sideOf(const Vec2& a, const Vec2& b, const Vec2& p, double tolerance_m) {
  const double turn = turnOf(a, b, p);
  if (turn * turn <= tolerance_m * tolerance_m * (b - a).squaredNorm()) return 0;
  return turn > 0.0 ? 1 : -1;
}

}  // namespace carom
