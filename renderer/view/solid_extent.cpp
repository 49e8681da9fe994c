#include "renderer/view/solid_extent.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace carom::renderer {
namespace {

struct Corners {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 high = Vec3::Constant(-std::numeric_limits<double>::infinity());
  void include(const Vec3& p) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
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

// Steiner's formula: the box, slabs on its faces, quarter cylinders on its edges, a ball in its corners.
double volumeOf(const RoundedBox& box) {
  const Vec3 size = 2.0 * box.half;
  const double r = box.radius;
  const double faces = size.x() * size.y() + size.y() * size.z() + size.z() * size.x();
  return size.prod() + 2.0 * faces * r + std::numbers::pi * r * r * (size.sum() + 4.0 / 3.0 * r);
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
  for (std::size_t i = 0; i < solid.parts().size(); ++i)
    if (!solid.isPiece(i)) corners.include(solid.parts()[i]);
  for (const Vec3& p : solid.surface().mesh.vertices) corners.include(p);
  return {0.5 * (corners.low + corners.high), 0.5 * (corners.high - corners.low)};
}

void addCorners(const Extent& extent, const Pose& X_WB, std::vector<Vec3>& corners_W) {
  for (const double x : {-1.0, 1.0})
    for (const double y : {-1.0, 1.0})
      for (const double z : {-1.0, 1.0})
        corners_W.push_back(X_WB * Vec3(extent.center + extent.half.cwiseProduct(Vec3(x, y, z))));
}

bool isBall(const Solid& solid) {
  return solid.parts().size() == 1 && !solid.isPiece(0) && solid.parts().front().core.vertexCount() == 1;
}

bool hasRoundPart(const Solid& solid) {
  for (std::size_t i = 0; i < solid.parts().size(); ++i)
    if (!solid.isPiece(i) && solid.parts()[i].core.faceCount() == 0) return true;
  return false;
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
  // A pointed part fills little of that box: the same form, about its centre of mass, with its volume.
  const MassProperties mass = polyhedronMass(part.core);
  const double scale = std::cbrt(mass.mass / volumeOf(box));
  box.X_BR.position = mass.center;
  box.half *= scale;
  box.radius *= scale;
  return box;
}

std::vector<RoundedBox> occludingBoxes(const Solid& solid) {
  std::vector<RoundedBox> boxes;
  for (std::size_t i = 0; i < solid.parts().size(); ++i) {
    boxes.push_back(roundedBox(solid.parts()[i]));
    boxes.back().part = solid.isPiece(i) ? -1 : static_cast<int>(i);
  }
  return boxes;
}

}  // namespace carom::renderer
