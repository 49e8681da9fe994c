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

constexpr double kPlaceGrid = 65536.0;  // On a picture's side.

double bevelCap(std::span<const Solid> solids) {
  std::vector<double> widths;
  for (const Solid& solid : solids) widths.push_back(renderer::thinnestPart(solid));
  const auto middle = widths.begin() + static_cast<std::ptrdiff_t>((widths.size() - 1) / 2);
  std::nth_element(widths.begin(), middle, widths.end());
  return kBevelCapFraction * *middle;
}

/// Of each of the solids that are drawn, as fine as the triangles of all bodies allow.
std::map<int, renderer::TriangleMesh> meshesOf(const SceneWorld& scene, std::span<const int> of_bodies) {
  std::map<int, renderer::TriangleMesh> meshes;
  const double cap = bevelCap(scene.drawnSolids());
  for (const int segments : kSegments) {
    meshes.clear();
    double triangles = 0.0;
    for (const int number : of_bodies) {
      const auto [mesh, is_new] = meshes.try_emplace(number);
      const Solid& solid = scene.drawnSolids()[static_cast<std::size_t>(number)];
      if (is_new)
        mesh->second = renderer::buildMesh(
            solid, {renderer::Edges::kBevelled, renderer::bevelWidth(solid, cap), segments});
      triangles += static_cast<double>(mesh->second.indices.size()) / 3.0;
    }
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

bool isTinted(const renderer::MeshVertex& v) {
  return v.tint[0] != 255 || v.tint[1] != 255 || v.tint[2] != 255;
}

/// `layers`: of the solid's pictures.
void addPlaces(const renderer::TriangleMesh& mesh, std::span<const int> layers, WrittenMesh& out) {
  for (const renderer::MeshVertex& v : mesh.vertices) {
    const int layer = v.picture[2] < 0.0f ? -1 : layers[static_cast<std::size_t>(v.picture[2])];
    for (std::size_t i = 0; i < 2; ++i)
      out.places[i].push_back(layer < 0 ? 0 : std::llround(kPlaceGrid * static_cast<double>(v.picture[i])));
    out.places[2].push_back(layer);
  }
}

WrittenMesh written(const renderer::TriangleMesh& mesh, const PlacedMesh& placed,
                    std::span<const int> layers) {
  WrittenMesh out;
  const Vec3 size = (placed.high - placed.low).cwiseMax(1e-300);
  for (const renderer::MeshVertex& v : mesh.vertices) {
    const Vec3 p = kGrid * (vectorOf(v.position) - placed.low).cwiseQuotient(size);
    const Vec2 n = kNormalGrid * folded(vectorOf(v.normal));
    for (std::size_t i = 0; i < 3; ++i)
      out.columns[i].push_back(std::llround(p[static_cast<Eigen::Index>(i)]));
    out.columns[3].push_back(std::llround(n.x()));
    out.columns[4].push_back(std::llround(n.y()));
  }
  if (std::any_of(mesh.vertices.begin(), mesh.vertices.end(), isTinted))
    for (const renderer::MeshVertex& v : mesh.vertices)
      for (std::size_t i = 0; i < 3; ++i) out.colors[i].push_back(v.tint[i]);
  if (std::any_of(layers.begin(), layers.end(), [](int layer) { return layer >= 0; }))
    addPlaces(mesh, layers, out);
  out.corners.assign(mesh.indices.begin(), mesh.indices.end());
  return out;
}

/// But for a step of rounding: single precision does not scale exactly.
bool areAlike(const WrittenMesh& a, const WrittenMesh& b) {
  if (a.corners != b.corners || a.colors != b.colors || a.places != b.places) return false;
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

PageShapes::PageShapes(const SceneWorld& scene, PagePictures& pictures) {
  for (std::size_t i = 0; i < scene.names.size(); ++i) solids_.push_back(scene.drawnSolid(i));
  for (const auto& [solid, mesh] : meshesOf(scene, solids_)) {
    std::vector<int> layers;
    for (const SurfacePicture& picture :
         scene.drawnSolids()[static_cast<std::size_t>(solid)].surface().pictures)
      layers.push_back(pictures.add(picture));
    PlacedMesh placed = placedMesh(mesh);
    WrittenMesh numbers = written(mesh, placed, layers);
    const auto same = std::find_if(meshes_.begin(), meshes_.end(),
                                   [&numbers](const WrittenMesh& known) { return areAlike(known, numbers); });
    placed.mesh = static_cast<int>(same - meshes_.begin());
    if (same == meshes_.end()) meshes_.push_back(std::move(numbers));
    placed_.emplace(solid, placed);
  }
}

void PageShapes::write(ByteStream& out) const {
  out.add(static_cast<std::int64_t>(meshes_.size()));
  for (const WrittenMesh& mesh : meshes_) {
    out.add(static_cast<std::int64_t>(mesh.columns[0].size()));
    out.add(static_cast<std::int64_t>(mesh.corners.size() / 3));
    out.add(mesh.colors[0].empty() ? 0 : 1);
    out.add(mesh.places[0].empty() ? 0 : 1);
    for (const std::vector<std::int64_t>& column : mesh.columns) addDifferences(out, column);
    for (const std::vector<std::int64_t>& column : mesh.colors) addDifferences(out, column);
    for (const std::vector<std::int64_t>& column : mesh.places) addDifferences(out, column);
    addDifferences(out, mesh.corners);
  }
}

std::optional<PageGround> pageGround(const SceneWorld& scene) {
  std::optional<PageGround> ground;
  for (std::size_t i = 0; i < scene.looks.size(); ++i) {
    const BodyDescription& body = scene.world.bodies()[i];
    const Solid& solid = scene.drawn(i);
    if (!scene.looks[i].checker || !body.is_static || renderer::hasRoundPart(solid)) continue;
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
