#include "engine/solid/solid.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "engine/foundation/contract.h"

namespace carom {
namespace {

MassProperties partMass(const ConvexPart& part) {
  if (!(part.radius_m >= 0.0)) throw InputError("a rounding radius is not negative");
  if (part.core.faceCount() == 0 && !(part.radius_m > 0.0))
    throw InputError("a ball or capsule needs a positive radius");
  return roundedMass(part.core, part.radius_m);
}

// Or some of it that is no less than `enough_m`: with every part there is more of it.
double extentAlong(const std::vector<ConvexPart>& parts, const Vec3& direction, double enough_m) {
  double high = -std::numeric_limits<double>::infinity();
  double low = std::numeric_limits<double>::infinity();
  for (const ConvexPart& part : parts) {
    if (high - low >= enough_m) break;
    high = std::max(high, dot(direction, part.core.vertex(part.core.support(direction))) + part.radius_m);
    low = std::min(low, dot(direction, part.core.vertex(part.core.support(-direction))) - part.radius_m);
  }
  return high - low;
}

double widthOf(const std::vector<ConvexPart>& parts) {
  if (parts.size() == 1) return parts.front().width();
  double width = std::numeric_limits<double>::infinity();
  for (const Vec3& axis : {Vec3(Vec3::UnitX()), Vec3(Vec3::UnitY()), Vec3(Vec3::UnitZ())})
    width = std::min(width, extentAlong(parts, axis, width));
  for (const ConvexPart& part : parts)
    for (int f = 0; f < part.core.faceCount(); ++f)
      width = std::min(width, extentAlong(parts, part.core.plane(f).normal, width));
  return width;
}

}  // namespace

Solid::Solid(std::vector<ConvexPart> parts) : Solid(std::move(parts), BoundingSurface{}) {}

Solid::Solid(std::vector<ConvexPart> parts, BoundingSurface surface)
    : parts_(std::move(parts)), surface_(std::move(surface)) {
  if (parts_.empty()) throw InputError("a solid needs at least one part");
  REQUIRE(!hasSurface() || surface_.of_part.size() == parts_.size(), surface_.of_part.size(), parts_.size());
  std::optional<MassProperties> mass;
  const auto include = [&](const MassProperties& more) {
    mass = mass ? MassProperties::combined(*mass, more) : more;
  };
  if (hasSurface()) include(surfaceMass(surface_.mesh));
  for (std::size_t i = 0; i < parts_.size(); ++i)
    if (!isPiece(i)) include(partMass(parts_[i]));
  mass_ = *mass;
  if (!(mass_.mass > 0.0) || !mass_.inertia.allFinite())
    throw InputError("a solid needs a positive finite volume");
  origin_B_ = -mass_.center;
  for (ConvexPart& part : parts_) {
    part.core = part.core.translated(origin_B_);
    radius_m_ = std::max(radius_m_, part.core.radiusAbout(Vec3::Zero()) + part.radius_m);
  }
  for (Vec3& p : surface_.mesh.vertices) p += origin_B_;
  mass_.center = Vec3::Zero();
  width_m_ = widthOf(parts_);
}

Solid Solid::shownAs(BoundingSurface look) const {
  Solid shown = *this;
  shown.surface_ = std::move(look);
  shown.surface_.of_part.assign(parts_.size(), 1);
  for (Vec3& p : shown.surface_.mesh.vertices) p += origin_B_;
  return shown;
}

Solid Solid::box(const Vec3& size_m) {
  return Solid({{boxPolyhedron(size_m), 0.0}});
}
Solid Solid::roundedBox(const Vec3& size_m, double radius_m) {
  if (!(radius_m >= 0.0)) throw InputError("a rounding radius is not negative");
  const Vec3 core_m = size_m - Vec3::Constant(2.0 * radius_m);
  if (!core_m.allFinite() || core_m.minCoeff() < 0.0)
    throw InputError("a rounded box needs finite sizes of at least twice its radius");
  const Vec3 half = 0.5 * core_m;
  switch ((core_m.array() > 0.0).count()) {
    case 3:
      return Solid({{boxPolyhedron(core_m), radius_m}});
    case 1:
      return Solid({{ConvexPolyhedron::segment(-half, half), radius_m}});
    case 0:
      return ball(radius_m);
    default:
      throw InputError("a rounded box whose radius is half of one size only has a flat core");
  }
}
Solid Solid::ball(double radius_m) {
  return Solid({{ConvexPolyhedron::point(Vec3::Zero()), radius_m}});
}
Solid Solid::capsule(double radius_m, double length_m) {
  const Vec3 half(0.0, 0.0, 0.5 * length_m);
  return Solid({{ConvexPolyhedron::segment(-half, half), radius_m}});
}
Solid Solid::polyhedron(ConvexPolyhedron p) {
  return Solid({{std::move(p), 0.0}});
}

ConvexPolyhedron boxPolyhedron(const Vec3& size_m) {
  if (!size_m.allFinite() || !(size_m.minCoeff() > 0.0))
    throw InputError("a box needs three positive finite sizes");
  std::vector<Vec3> vertices;
  vertices.reserve(8);
  for (int i = 0; i < 8; ++i)
    vertices.push_back(0.5 * Vec3((i & 1 ? 1 : -1) * size_m.x(), (i & 2 ? 1 : -1) * size_m.y(),
                                  (i & 4 ? 1 : -1) * size_m.z()));
  return ConvexPolyhedron::fromFaces(
      std::move(vertices),
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}});
}

}  // namespace carom
