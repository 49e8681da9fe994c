#include "tests/explore/random_shapes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "demos/asset/asset_path.h"

namespace carom::explore {

using demos::Body;
using demos::BoxShape;
using demos::CapsuleShape;
using demos::CompoundShape;
using demos::HullShape;
using demos::Shape;
using demos::SphereShape;
using oracle::Random;

bool oneIn(Random& random, int n) {
  return random.integer(1, n) == 1;
}

double reachOf(const Shape& shape) {
  if (const auto* box = std::get_if<BoxShape>(&shape.form)) return 0.5 * box->size_m.norm();
  if (const auto* ball = std::get_if<SphereShape>(&shape.form)) return ball->radius_m;
  if (const auto* capsule = std::get_if<CapsuleShape>(&shape.form))
    return capsule->radius_m + 0.5 * capsule->length_m;
  double reach = 0.0;
  const auto* hull = std::get_if<HullShape>(&shape.form);
  if (hull != nullptr && hull->fit_m)
    return 0.5 * std::numbers::sqrt3 * *hull->fit_m;  // Its box about its middle.
  if (hull != nullptr)
    for (const Vec3& p : hull->points) reach = std::max(reach, p.norm());
  if (const auto* compound = std::get_if<CompoundShape>(&shape.form))
    for (const demos::CompoundPart& part : compound->parts)
      reach = std::max(reach, part.X_SP.position.norm() + reachOf(part.shape));
  return reach;
}

Pose scatteredPose(Random& random, double reach_m, std::span<const Body> others, const ScatteredOver& over) {
  Pose X{random.rotation(), Vec3::Zero()};
  for (double wide = over.wide_m;; wide *= 1.1) {
    const double x = random.uniform(-wide, wide), y = random.uniform(-wide, wide);
    X.position = Vec3(x, y, reach_m + random.uniform(over.lowest, over.highest) * wide);
    const bool clear = std::all_of(others.begin(), others.end(), [&](const Body& other) {
      return (other.X_WS.position - X.position).norm() > reach_m + 1.001 * reachOf(other.shape);
    });
    if (clear) return X;
  }
}

Shape boxOf(const Vec3& size) {
  return {BoxShape{size.cwiseMax(kSmallestShape_m)}, {}};
}

namespace {

/// A hull of 4 to 12 points on an ellipsoid with these half axes.
Shape hullOf(Random& random, const Vec3& half_axes) {
  HullShape hull;
  // The corners of a tetrahedron first, so that the points span a volume.
  const Quat R = random.rotation();
  for (const Vec3& p : {Vec3(1, 1, 1), Vec3(1, -1, -1), Vec3(-1, 1, -1), Vec3(-1, -1, 1)})
    hull.points.push_back((R * p.normalized()).cwiseProduct(half_axes));
  for (int i = random.integer(0, 8); i > 0; --i)
    hull.points.push_back(random.direction().cwiseProduct(half_axes));
  return {hull, {}};
}

/// Two or three boxes in a row that overlap a little or lie flush: an L, a bar, a hammer.
Shape compoundOf(Random& random, double size) {
  CompoundShape compound;
  const Vec3 arm(size, 0.3 * size, 0.3 * size);
  compound.parts.push_back({boxOf(arm), Pose{}});
  Pose at_end;
  at_end.position = Vec3(0.35 * size, 0.0, random.uniform(0.0, 0.3) * size);
  if (oneIn(random, 2)) at_end.position.z() = 0.3 * size;  // flush
  compound.parts.push_back({boxOf(0.3 * Vec3(size, size, size)), at_end});
  if (oneIn(random, 3)) {
    Pose other = at_end;
    other.position.x() = -other.position.x();
    compound.parts.push_back({{SphereShape{0.15 * size}, {}}, other});
  }
  return {compound, {}};
}

}  // namespace

Shape anyShape(Random& random, double size) {
  switch (random.integer(0, 9)) {
    case 0:
    case 1: {
      const double x = random.uniform(0.3, 1.0), y = random.uniform(0.3, 1.0);
      return boxOf(size * Vec3(x, y, 1.0));
    }
    case 2: {
      const double thin = random.logUniform(1e-3, 0.1);
      return boxOf(size * Vec3(1.0, thin, oneIn(random, 2) ? thin : 2.0 * thin));  // a needle
    }
    case 3: {
      const double thin = random.logUniform(1e-3, 0.1);
      return boxOf(size * Vec3(1.0, random.uniform(0.3, 1.0), thin));  // a plate
    }
    case 4:
      return {SphereShape{std::max(kSmallestShape_m, 0.5 * size)}, {}};
    case 5: {
      const double slender = random.logUniform(0.02, 0.4);
      return {CapsuleShape{std::max(kSmallestShape_m, 0.5 * slender * size),
                           std::max(kSmallestShape_m, (1.0 - slender) * size)},
              {}};
    }
    case 6:
    case 7:
      return hullOf(random, Vec3::Constant(0.5 * size));
    case 8: {
      const double y = random.logUniform(0.02, 1.0), z = random.logUniform(0.02, 1.0);
      return hullOf(random, 0.5 * size * Vec3(1.0, y, z));
    }
    default:
      return compoundOf(random, size);
  }
}

Material anyMaterial(Random& random) {
  Material m;
  const int friction = random.integer(0, 4);
  m.static_friction = friction == 0 ? 0.0 : friction <= 2 ? 0.5 : random.uniform(0.0, 2.0);
  m.dynamic_friction = m.static_friction * (oneIn(random, 3) ? 0.7 : 1.0);
  const int bounce = random.integer(0, 9);
  m.restitution = bounce < 6 ? 0.0 : bounce == 6 ? 1.0 : random.uniform(0.0, 1.0);
  m.density_kgpm3 = oneIn(random, 2) ? 1000.0 : random.logUniform(100.0, 8000.0);
  return m;
}

Shape concaveOf(Random& random, double size) {
  constexpr const char* kMeshes[] = {"ring", "link", "cup", "gear-18", "nut", "lock-bolt", "bolt", "funnel"};
  HullShape mesh;
  const std::string name = std::string("meshes/") + kMeshes[random.integer(0, 7)] + ".obj";
  mesh.file = demos::findBeside("explored.json", name).value();
  mesh.as_hull = false;
  mesh.fit_m = std::max(10.0 * kSmallestShape_m, size);
  return {mesh, {}};
}

demos::Body& addBody(demos::Scene& scene, demos::Shape shape, const Pose& X_WS, const Material& material) {
  demos::Body body;
  body.name.assign(1, 'b').append(std::to_string(scene.bodies.size()));
  body.shape = std::move(shape);
  body.X_WS = X_WS;
  body.material = material;
  scene.bodies.push_back(std::move(body));
  return scene.bodies.back();
}

void lockAtRandom(oracle::Random& random, demos::Body& body) {
  for (int axis = 0; axis < 3; ++axis)
    if (oneIn(random, 3)) body.locks.free_axes[axis] = 0.0;
  const int turning = random.integer(0, 3);
  if (turning == 1) body.locks.turning = AxisLocks::Turning::kLocked;
  if (turning == 2) {
    body.locks.turning = AxisLocks::Turning::kOneAxis;
    body.locks.axis_W = Vec3::Unit(random.integer(0, 2));
  }
}

}  // namespace carom::explore
