#include "demos/shape_solid.h"

#include <sstream>

#include <Eigen/Geometry>

#include "demos/mesh_import.h"
#include "engine/foundation/contract.h"
#include "engine/solid/convex_hull.h"

namespace carom::demos {
namespace {

using Mesh = std::optional<std::filesystem::path>;

/// Returns the factor that the parts were scaled by.
double fitInto(std::vector<std::vector<Vec3>>& parts, double longest_m) {
  Eigen::AlignedBox3d bounds;
  for (const std::vector<Vec3>& part : parts)
    for (const Vec3& p : part) bounds.extend(p);
  const double longest = bounds.sizes().maxCoeff();
  if (!(longest > 0.0)) throw InputError("all vertices coincide");
  const Vec3 middle = bounds.center();
  for (std::vector<Vec3>& part : parts)
    for (Vec3& p : part) p = (p - middle) * (longest_m / longest);
  return longest_m / longest;
}

/// A hull of a body has the size of any other shape, and lies as near.
void requireLengths(const std::vector<ConvexPart>& parts) {
  Eigen::AlignedBox3d bounds;
  for (const ConvexPart& part : parts)
    for (const Vec3& p : part.core.vertices()) bounds.extend(p);
  const double longest_m = bounds.sizes().maxCoeff();
  const double farthest_m = bounds.min().cwiseAbs().cwiseMax(bounds.max().cwiseAbs()).maxCoeff();
  std::ostringstream message;
  if (!(longest_m >= kSmallestLength_m && longest_m <= kLargestLength_m))
    message << "the hull's longest side is " << longest_m << " m; accepted: " << kSmallestLength_m << " to "
            << kLargestLength_m << ", see \"scale\" and \"fit\"";
  else if (farthest_m > kLargestLength_m)
    message << "the hull reaches to " << farthest_m << " m; accepted: " << -kLargestLength_m << " to "
            << kLargestLength_m << ", see \"fit\"";
  if (message.tellp() > 0) throw InputError(message.str());
}

/// The same part moved; its frame S was P before.
ConvexPart placed(const ConvexPart& part, const Pose& X_SP) {
  const ConvexPolyhedron& core = part.core;
  std::vector<Vec3> vertices;
  for (const Vec3& p_P : core.vertices()) vertices.push_back(X_SP * p_P);
  if (vertices.size() == 1) return {ConvexPolyhedron::point(vertices[0]), part.radius_m};
  if (vertices.size() == 2) return {ConvexPolyhedron::segment(vertices[0], vertices[1]), part.radius_m};
  std::vector<std::vector<int>> loops;
  for (int f = 0; f < core.faceCount(); ++f)
    loops.emplace_back(core.faceVertices(f).begin(), core.faceVertices(f).end());
  return {ConvexPolyhedron::fromFaces(std::move(vertices), loops), part.radius_m};
}

std::vector<ConvexPart> makeParts(const Shape& shape, const Mesh& mesh);

std::vector<ConvexPart> partsOf(const BoxShape& box, const Mesh&) {
  return {{boxPolyhedron(box.size_m), 0.0}};
}

std::vector<ConvexPart> partsOf(const SphereShape& sphere, const Mesh&) {
  return {{ConvexPolyhedron::point(Vec3::Zero()), sphere.radius_m}};
}

std::vector<ConvexPart> partsOf(const CapsuleShape& capsule, const Mesh&) {
  const Vec3 half(0.0, 0.0, 0.5 * capsule.length_m);
  return {{ConvexPolyhedron::segment(-half, half), capsule.radius_m}};
}

std::vector<ConvexPart> partsOf(const HullShape& hull, const Mesh& mesh) {
  std::vector<ConvexPart> parts;
  if (!hull.file.empty()) {
    parts = meshParts(hull.replaceable && mesh ? *mesh : hull.file, hull.scale, hull.fit_m).parts;
  } else {
    std::vector<std::vector<Vec3>> points{hull.points};
    for (Vec3& p : points[0]) p *= hull.scale;
    if (hull.fit_m) fitInto(points, *hull.fit_m);
    parts.push_back({convexHull(points[0]).polyhedron, 0.0});
  }
  requireLengths(parts);
  return parts;
}

std::vector<ConvexPart> partsOf(const CompoundShape& compound, const Mesh& mesh) {
  std::vector<ConvexPart> parts;
  for (const CompoundPart& member : compound.parts)
    for (const ConvexPart& part : makeParts(member.shape, mesh)) parts.push_back(placed(part, member.X_SP));
  return parts;
}

std::vector<ConvexPart> makeParts(const Shape& shape, const Mesh& mesh) {
  return std::visit([&mesh](const auto& form) { return partsOf(form, mesh); }, shape.form);
}

}  // namespace

MeshSolid meshParts(const std::filesystem::path& path, double scale, const std::optional<double>& fit_m) {
  auto [meshes, coordinate_error_m] = importMesh(path);
  for (std::vector<Vec3>& mesh : meshes)
    for (Vec3& p : mesh) p *= scale;
  coordinate_error_m *= scale;
  MeshSolid solid;
  std::string reason;
  try {
    if (fit_m) coordinate_error_m *= fitInto(meshes, *fit_m);
  } catch (const InputError& error) {
    throw InputError(path.string() + ": " + error.what());
  }
  for (const std::vector<Vec3>& mesh : meshes) {
    try {
      const HullSettings settings{.coordinate_error_m = coordinate_error_m};
      solid.parts.push_back({convexHull(mesh, settings).polyhedron, 0.0});
    } catch (const InputError& error) {
      ++solid.flat_parts;
      reason = error.what();
    }
  }
  if (solid.parts.empty()) throw InputError(path.string() + ": " + reason);
  return solid;
}

ConvexPolyhedron meshHull(const std::filesystem::path& path) {
  const ImportedMesh file = importMesh(path);
  std::vector<Vec3> points;
  for (const std::vector<Vec3>& mesh : file.parts) points.insert(points.end(), mesh.begin(), mesh.end());
  try {
    return convexHull(points, {.coordinate_error_m = file.coordinate_error_m}).polyhedron;
  } catch (const InputError& error) {
    throw InputError(path.string() + ": " + error.what());
  }
}

Solid makeSolid(const Shape& shape, const Mesh& mesh) {
  try {
    return Solid(makeParts(shape, mesh));
  } catch (const InputError& error) {
    throw InputError(shape.place + ": " + error.what());
  }
}

}  // namespace carom::demos
