#include "demos/page/page_shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "renderer/mesh/solid_mesh.h"
#include "renderer/view/solid_extent.h"

namespace carom::demos {
namespace {

constexpr double kMostTriangles = 6e5;  // Of all bodies together; phones draw these.
constexpr std::array<int, 5> kSegments = {64, 48, 32, 20, 12};
constexpr double kBevelCapFraction = 0.05;  // Of the typical solid's width, as the renderer's.
constexpr double kGrid = 65535.0;
constexpr double kNormalGrid = 1023.0;  // Normals are at most 0.1 degree off.
constexpr double kLevelTop = 0.9999;    // Cosine between a ground's own axis and the vertical.

double bevelCap(std::span<const Solid> solids) {
  std::vector<double> widths;
  for (const Solid& solid : solids) widths.push_back(renderer::thinnestPart(solid));
  const auto middle = widths.begin() + static_cast<std::ptrdiff_t>((widths.size() - 1) / 2);
  std::nth_element(widths.begin(), middle, widths.end());
  return kBevelCapFraction * *middle;
}

/// As fine as the triangles of all bodies allow.
std::vector<renderer::TriangleMesh> meshesOf(const World& world) {
  std::vector<renderer::TriangleMesh> meshes;
  const double cap = bevelCap(world.solids());
  for (const int segments : kSegments) {
    meshes.clear();
    for (const Solid& solid : world.solids())
      meshes.push_back(renderer::buildMesh(
          solid, {renderer::Edges::kBevelled, renderer::bevelWidth(solid, cap), segments}));
    double triangles = 0.0;
    for (const BodyDescription& body : world.bodies())
      triangles += static_cast<double>(meshes[static_cast<std::size_t>(body.solid)].indices.size()) / 3.0;
    if (triangles <= kMostTriangles) break;
  }
  return meshes;
}

/// A direction on the unfolded octahedron, both coordinates within [-1, 1] (Cigolle et al., A Survey of
/// Efficient Representations for Independent Unit Vectors, JCGT 2014).
Vec2 folded(const Vec3& n) {
  const Vec3 p = n / n.cwiseAbs().sum();
  if (p.z() >= 0.0) return {p.x(), p.y()};
  return {(1.0 - std::abs(p.y())) * (p.x() < 0.0 ? -1.0 : 1.0),
          (1.0 - std::abs(p.x())) * (p.y() < 0.0 ? -1.0 : 1.0)};
}

Vec3 vectorOf(const float (&v)[3]) {
  return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
}

void addDifferences(ByteStream& out, std::span<const std::int64_t> column) {
  std::int64_t last = 0;
  for (const std::int64_t number : column) {
    out.add(number - last);
    last = number;
  }
}

WrittenMesh written(const renderer::TriangleMesh& mesh, const PlacedMesh& placed) {
  WrittenMesh out;
  out.has_colors = std::any_of(mesh.vertices.begin(), mesh.vertices.end(), [](const renderer::MeshVertex& v) {
    return v.tint[0] != 255 || v.tint[1] != 255 || v.tint[2] != 255;
  });
  const Vec3 size = (placed.high - placed.low).cwiseMax(1e-300);
  for (const renderer::MeshVertex& v : mesh.vertices) {
    const Vec3 p = kGrid * (vectorOf(v.position) - placed.low).cwiseQuotient(size);
    const Vec2 n = kNormalGrid * folded(vectorOf(v.normal));
    for (std::size_t i = 0; i < 3; ++i) {
      out.columns[i].push_back(std::llround(p[static_cast<Eigen::Index>(i)]));
      out.columns[5 + i].push_back(v.tint[i]);
    }
    out.columns[3].push_back(std::llround(n.x()));
    out.columns[4].push_back(std::llround(n.y()));
  }
  out.corners.assign(mesh.indices.begin(), mesh.indices.end());
  return out;
}

/// But for a step of rounding: single precision does not scale exactly.
bool areAlike(const WrittenMesh& a, const WrittenMesh& b) {
  if (a.corners != b.corners || a.has_colors != b.has_colors) return false;
  for (std::size_t c = 0; c < a.columns.size(); ++c) {
    if (a.columns[c].size() != b.columns[c].size()) return false;
    for (std::size_t i = 0; i < a.columns[c].size(); ++i)
      if (std::abs(a.columns[c][i] - b.columns[c][i]) > 1) return false;
  }
  return true;
}

PlacedMesh placedMesh(const renderer::TriangleMesh& mesh) {
  PlacedMesh placed{0, Vec3::Constant(std::numeric_limits<double>::infinity()),
                    Vec3::Constant(-std::numeric_limits<double>::infinity())};
  for (const renderer::MeshVertex& v : mesh.vertices) {
    placed.low = placed.low.cwiseMin(vectorOf(v.position));
    placed.high = placed.high.cwiseMax(vectorOf(v.position));
  }
  return placed;
}

}  // namespace

PageShapes::PageShapes(const SceneWorld& scene) {
  for (const BodyDescription& body : scene.world.bodies()) solids_.push_back(body.solid);
  for (const renderer::TriangleMesh& mesh : meshesOf(scene.world)) {
    PlacedMesh placed = placedMesh(mesh);
    WrittenMesh numbers = written(mesh, placed);
    const auto same = std::find_if(meshes_.begin(), meshes_.end(),
                                   [&](const WrittenMesh& known) { return areAlike(known, numbers); });
    placed.mesh = static_cast<int>(same - meshes_.begin());
    if (same == meshes_.end()) meshes_.push_back(std::move(numbers));
    placed_.push_back(placed);
  }
}

void PageShapes::write(ByteStream& out) const {
  out.add(static_cast<std::int64_t>(meshes_.size()));
  for (const WrittenMesh& mesh : meshes_) {
    out.add(static_cast<std::int64_t>(mesh.columns[0].size()));
    out.add(static_cast<std::int64_t>(mesh.corners.size() / 3));
    out.add(mesh.has_colors ? 1 : 0);
    for (std::size_t c = 0; c < (mesh.has_colors ? 8 : 5); ++c) addDifferences(out, mesh.columns[c]);
    addDifferences(out, mesh.corners);
  }
}

std::optional<PageGround> pageGround(const SceneWorld& scene) {
  std::optional<PageGround> ground;
  for (std::size_t i = 0; i < scene.looks.size(); ++i) {
    const BodyDescription& body = scene.world.bodies()[i];
    const Solid& solid = scene.world.solids()[static_cast<std::size_t>(body.solid)];
    if (!scene.looks[i].checker || !body.is_static || solid.parts().front().core.faceCount() == 0) continue;
    const Pose& X_WB = scene.world.states()[i].X_WB;
    const Vec3 up_B = X_WB.rotation.conjugate() * Vec3::UnitZ();
    if (up_B.cwiseAbs().maxCoeff() < kLevelTop) continue;
    const renderer::Extent extent = renderer::solidExtent(solid);
    const double top = (X_WB * extent.center).z() + up_B.cwiseAbs().dot(extent.half);
    if (!ground || top < ground->z_m) ground = PageGround{static_cast<int>(i), top};
  }
  return ground;
}

}  // namespace carom::demos
