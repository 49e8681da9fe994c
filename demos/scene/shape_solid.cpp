#include "demos/scene/shape_solid.h"

#include <sstream>

#include <Eigen/Geometry>

#include "demos/asset/mesh_import.h"
#include "engine/foundation/contract.h"
#include "engine/solid/convex_hull.h"

namespace carom::demos {
namespace {

using Mesh = std::optional<std::filesystem::path>;

/// What a shape is made of, in its own frame.
struct ShapeParts {
  std::vector<ConvexPart> parts;
  BoundingSurface surface;
};

void fitInto(std::vector<Vec3>& points, double longest_m) {
  Eigen::AlignedBox3d bounds;
  for (const Vec3& p : points) bounds.extend(p);
  const double longest = bounds.sizes().maxCoeff();
  if (!(longest > 0.0)) throw InputError("all vertices coincide");
  const Vec3 middle = bounds.center();
  for (Vec3& p : points) p = (p - middle) * (longest_m / longest);
}

}  // namespace

std::vector<Vec3> cornersOf(const std::vector<ConvexPart>& parts) {
  std::vector<Vec3> corners;
  for (const ConvexPart& part : parts)
    corners.insert(corners.end(), part.core.vertices().begin(), part.core.vertices().end());
  return corners;
}

void requireLengths(const std::vector<Vec3>& points, const std::string& what) {
  Eigen::AlignedBox3d bounds;
  for (const Vec3& p : points) bounds.extend(p);
  const double longest_m = bounds.sizes().maxCoeff();
  const double farthest_m = bounds.min().cwiseAbs().cwiseMax(bounds.max().cwiseAbs()).maxCoeff();
  std::ostringstream message;
  if (!(longest_m >= kSmallestLength_m && longest_m <= kLargestLength_m))
    message << "the " << what << "'s longest side is " << longest_m << " m; accepted: " << kSmallestLength_m
            << " to " << kLargestLength_m << ", see \"scale\" and \"fit\"";
  else if (farthest_m > kLargestLength_m)
    message << "the " << what << " reaches to " << farthest_m << " m; accepted: " << -kLargestLength_m
            << " to " << kLargestLength_m << ", see \"fit\"";
  if (message.tellp() > 0) throw InputError(message.str());
}

namespace {

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

/// Where the shapes of a compound are put together.
class PartMaker {
 public:
  PartMaker(const Mesh& mesh, SceneMeshes& meshes, std::vector<MeshReport>& reports)
      : mesh_(mesh), meshes_(meshes), reports_(reports) {}

  ShapeParts partsOf(const Shape& shape) const {
    return std::visit([this](const auto& form) { return (*this)(form); }, shape.form);
  }

 private:
  ShapeParts operator()(const BoxShape& box) const { return {{{boxPolyhedron(box.size_m), 0.0}}, {}}; }
  ShapeParts operator()(const SphereShape& sphere) const {
    return {{{ConvexPolyhedron::point(Vec3::Zero()), sphere.radius_m}}, {}};
  }
  ShapeParts operator()(const CapsuleShape& capsule) const {
    const Vec3 half(0.0, 0.0, 0.5 * capsule.length_m);
    return {{{ConvexPolyhedron::segment(-half, half), capsule.radius_m}}, {}};
  }

  ShapeParts operator()(const RoundedBoxShape& box) const {
    return {{{boxPolyhedron(box.size_m - 2.0 * box.radius_m * Vec3::Ones()), box.radius_m}}, {}};
  }

  ShapeParts operator()(const HullShape& hull) const {
    ShapeParts made;
    if (!hull.file.empty()) {
      const MeshSolid& solid = meshes_.solid(hull.replaceable && mesh_ ? *mesh_ : hull.file,
                                             {hull.scale, hull.fit_m, hull.y_up, hull.as_hull});
      reports_.push_back(solid.report);
      made = {solid.parts, solid.surface};
    } else {
      std::vector<Vec3> points = hull.points;
      for (Vec3& p : points) p *= hull.scale;
      if (hull.fit_m) fitInto(points, *hull.fit_m);
      made.parts.push_back({convexHull(points).polyhedron, 0.0});
    }
    requireLengths(cornersOf(made.parts), "hull");
    return made;
  }

  ShapeParts operator()(const CompoundShape& compound) const {
    ShapeParts made;
    for (const CompoundPart& member : compound.parts) append(partsOf(member.shape), member.X_SP, made);
    return made;
  }

  static void append(const ShapeParts& member, const Pose& X_SP, ShapeParts& made) {
    const BoundingSurface& from = member.surface;
    BoundingSurface& to = made.surface;
    for (std::size_t i = 0; i < member.parts.size(); ++i) {
      made.parts.push_back(placed(member.parts[i], X_SP));
      to.of_part.push_back(from.of_part.empty() ? char{0} : from.of_part[i]);
    }
    if (from.mesh.triangles.empty()) return;
    // What has no normals or colours of its own gets those that change nothing.
    const std::size_t before = to.mesh.triangles.size(), added = from.mesh.triangles.size();
    appendPictures(from, before, added, to);
    if (!from.colors.empty() || !to.colors.empty()) {
      to.colors.resize(before, Vec3::Ones());
      to.colors.insert(to.colors.end(), from.colors.begin(), from.colors.end());
      to.colors.resize(before + added, Vec3::Ones());
    }
    if (!from.normals.empty() || !to.normals.empty()) {
      if (to.normals.empty()) to.normals = flatNormals(to.mesh);
      for (const Vec3& n : from.normals.empty() ? flatNormals(from.mesh) : from.normals)
        to.normals.push_back(X_SP.rotation * n);
    }
    const int first = static_cast<int>(to.mesh.vertices.size());
    for (const Vec3& p : from.mesh.vertices) to.mesh.vertices.push_back(X_SP * p);
    for (const Triangle& t : from.mesh.triangles)
      to.mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  }

  static void appendPictures(const BoundingSurface& from, std::size_t before, std::size_t added,
                             BoundingSurface& to) {
    if (from.pictures.empty() && to.pictures.empty()) return;
    to.uv.resize(3 * before, Vec2::Zero());
    to.picture_of.resize(before, -1);
    const int first = static_cast<int>(to.pictures.size());
    to.uv.insert(to.uv.end(), from.uv.begin(), from.uv.end());
    for (const int picture : from.picture_of) to.picture_of.push_back(picture < 0 ? -1 : first + picture);
    to.uv.resize(3 * (before + added), Vec2::Zero());
    to.picture_of.resize(before + added, -1);
    to.pictures.insert(to.pictures.end(), from.pictures.begin(), from.pictures.end());
  }

  static std::vector<Vec3> flatNormals(const SurfaceMesh& mesh) {
    std::vector<Vec3> normals;
    for (const Triangle& t : mesh.triangles) {
      const Vec3& a = mesh.vertices[static_cast<std::size_t>(t[0])];
      const Vec3 b = mesh.vertices[static_cast<std::size_t>(t[1])] - a;
      const Vec3 c = mesh.vertices[static_cast<std::size_t>(t[2])] - a;
      normals.insert(normals.end(), 3, b.cross(c).normalized());
    }
    return normals;
  }

  const Mesh& mesh_;
  SceneMeshes& meshes_;
  std::vector<MeshReport>& reports_;
};

}  // namespace

ConvexPolyhedron meshHull(const std::filesystem::path& path) {
  const ImportedMesh file = importMesh(path);
  std::vector<Vec3> points;
  for (const MeshPart& mesh : file.parts)
    points.insert(points.end(), mesh.vertices.begin(), mesh.vertices.end());
  try {
    return convexHull(points, {.coordinate_error_m = file.coordinate_error_m}).polyhedron;
  } catch (const InputError& error) {
    throw InputError(path.string() + ": " + error.what());
  }
}

BoundingSurface visualSurface(const Visual& visual, SceneMeshes& meshes, MeshReport& report) {
  try {
    BoundingSurface look =
        meshLook(visual.file, {visual.scale, visual.fit_m, visual.y_up, false}, meshes.files(), report);
    for (Vec3& p : look.mesh.vertices) p = visual.X_SV * p;
    for (Vec3& n : look.normals) n = visual.X_SV.rotation * n;
    requireLengths(look.mesh.vertices, "mesh");
    return look;
  } catch (const InputError& error) {
    throw InputError(visual.place + ": " + error.what());
  }
}

Solid makeSolid(const Shape& shape, const Mesh& mesh) {
  SceneMeshes meshes;
  std::vector<MeshReport> reports;
  return makeSolid(shape, mesh, meshes, reports);
}

Solid makeSolid(const Shape& shape, const Mesh& mesh, SceneMeshes& meshes, std::vector<MeshReport>& reports) {
  try {
    ShapeParts made = PartMaker(mesh, meshes, reports).partsOf(shape);
    return Solid(std::move(made.parts), std::move(made.surface));
  } catch (const InputError& error) {
    throw InputError(shape.place + ": " + error.what());
  }
}

}  // namespace carom::demos
