#include "renderer/solid_extent.h"

#include <cmath>
#include <limits>

namespace carom::renderer {
namespace {

struct Corners {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 high = Vec3::Constant(-std::numeric_limits<double>::infinity());
  void include(const ConvexPart& part) {
    for (const Vec3& p : part.core.vertices()) {
      low = low.cwiseMin((p.array() - part.radius_m).matrix());
      high = high.cwiseMax((p.array() + part.radius_m).matrix());
    }
  }
};

// The rounding for which the corner of the rounded box is as far out as the part's farthest vertex:
// |half - r| + r = reach, solved for r where the box has one size, by bisection otherwise (50 halvings).
double matchRounding(const Vec3& half, double reach) {
  double low = 0.0, high = half.minCoeff();
  for (int i = 0; i < 50; ++i) {
    const double r = 0.5 * (low + high);
    const double corner = (half.array() - r).matrix().norm() + r;
    (corner > reach ? low : high) = r;
  }
  return low;
}

RoundedBox boxOfSegment(const ConvexPart& part) {
  const Vec3 &a = part.core.vertex(0), &b = part.core.vertex(part.core.vertexCount() - 1);
  RoundedBox box;
  box.radius = part.radius_m;
  box.X_BR.position = 0.5 * (a + b);
  box.half = Vec3(0.0, 0.0, 0.5 * (b - a).norm());
  if (box.half.z() > 0.0) box.X_BR.rotation = Quat::FromTwoVectors(Vec3::UnitZ(), b - a);
  return box;
}

}  // namespace

Extent solidExtent(const Solid& solid) {
  Corners corners;
  for (const ConvexPart& part : solid.parts()) corners.include(part);
  return {0.5 * (corners.low + corners.high), 0.5 * (corners.high - corners.low)};
}

RoundedBox roundedBox(const ConvexPart& part) {
  if (part.core.faceCount() == 0) return boxOfSegment(part);
  Corners corners;
  corners.include(part);
  const Vec3 half = 0.5 * (corners.high - corners.low);
  RoundedBox box;
  box.X_BR.position = 0.5 * (corners.low + corners.high);
  box.radius = matchRounding(half, part.core.radiusAbout(box.X_BR.position) + part.radius_m);
  box.half = (half.array() - box.radius).matrix();
  return box;
}

}  // namespace carom::renderer
