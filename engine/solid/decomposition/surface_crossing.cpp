#include "engine/solid/decomposition/surface_crossing.h"

#include <algorithm>
#include <numeric>

#include "engine/foundation/index.h"

namespace carom {
namespace {

bool has(const Triangle& t, int vertex) {
  return t[0] == vertex || t[1] == vertex || t[2] == vertex;
}

/// Where the way from a to b goes through the inside of a triangle.
std::optional<Vec3> piercing(const SurfaceMesh& mesh, int a, int b, const Triangle& t, double tolerance_m) {
  const Vec3 &u = mesh.vertices[at(t[0])], &v = mesh.vertices[at(t[1])], &w = mesh.vertices[at(t[2])];
  const Vec3 area = (v - u).cross(w - u);
  if (!(area.norm() > 0.0)) return std::nullopt;
  const Vec3 n = area.normalized();
  const double da = dot(n, mesh.vertices[at(a)] - u), db = dot(n, mesh.vertices[at(b)] - u);
  if (!((da > tolerance_m && db < -tolerance_m) || (da < -tolerance_m && db > tolerance_m)))
    return std::nullopt;
  const Vec3 p = mesh.vertices[at(a)] + da / (da - db) * (mesh.vertices[at(b)] - mesh.vertices[at(a)]);
  for (int k = 0; k < 3; ++k) {
    const Vec3 &from = mesh.vertices[at(t[at(k)])], &to = mesh.vertices[at(t[at((k + 1) % 3)])];
    if (dot(n.cross(to - from).normalized(), p - from) <= tolerance_m) return std::nullopt;
  }
  return p;
}

std::optional<Vec3> crossing(const SurfaceMesh& mesh, const Triangle& s, const Triangle& t,
                             double tolerance_m) {
  int shared = 0;
  for (const int v : s) shared += has(t, v) ? 1 : 0;
  if (shared >= 2) return std::nullopt;
  for (const auto& [edges, through] : {std::pair(s, t), std::pair(t, s)})
    for (std::size_t k = 0; k < 3; ++k) {
      const int a = edges[k], b = edges[(k + 1) % 3];
      if (has(through, a) || has(through, b)) continue;
      if (const std::optional<Vec3> p = piercing(mesh, a, b, through, tolerance_m)) return p;
    }
  return std::nullopt;
}

/// Looks at the pairs of triangles whose boxes meet: parts the triangles at the middle of the longest side of
/// all, those on both sides into both parts, until few are left or most are on both sides.
class CrossingSearch {
 public:
  CrossingSearch(const SurfaceMesh& mesh, double tolerance_m) : mesh_(mesh), tolerance_m_(tolerance_m) {
    for (const Triangle& t : mesh.triangles) {
      boxes_.emplace_back();
      for (const int v : t) boxes_.back().extend(mesh.vertices[at(v)]);
    }
  }

  std::optional<Vec3> among(std::vector<int> triangles) const {
    if (triangles.size() <= kFewTriangles) return alongAxis(std::move(triangles), 0);
    Eigen::AlignedBox3d middles;
    for (const int t : triangles) middles.extend(boxes_[at(t)].center());
    Eigen::Index axis = 0;
    middles.sizes().maxCoeff(&axis);
    const auto half = triangles.begin() + static_cast<std::ptrdiff_t>(triangles.size() / 2);
    std::nth_element(triangles.begin(), half, triangles.end(), [&](int a, int b) {
      return std::pair(boxes_[at(a)].center()[axis], a) < std::pair(boxes_[at(b)].center()[axis], b);
    });
    const double middle = boxes_[at(*half)].center()[axis];
    std::vector<int> below, above;
    for (const int t : triangles) {
      if (boxes_[at(t)].min()[axis] <= middle) below.push_back(t);
      if (boxes_[at(t)].max()[axis] >= middle) above.push_back(t);
    }
    if (kParts * (below.size() + above.size()) > kMostInParts * triangles.size())
      return alongAxis(std::move(triangles), axis);
    triangles = {};
    if (const std::optional<Vec3> p = among(std::move(below))) return p;
    return among(std::move(above));
  }

 private:
  // What is on both sides is looked at twice, and so on: a quarter more doubles in three partings.
  static constexpr std::size_t kFewTriangles = 24, kMostInParts = 5, kParts = 4;

  std::optional<Vec3> alongAxis(std::vector<int> triangles, Eigen::Index axis) const {
    std::sort(triangles.begin(), triangles.end(), [&](int a, int b) {
      return std::pair(boxes_[at(a)].min()[axis], a) < std::pair(boxes_[at(b)].min()[axis], b);
    });
    for (std::size_t i = 0; i < triangles.size(); ++i)
      for (std::size_t k = i + 1; k < triangles.size(); ++k) {
        const std::size_t a = at(triangles[i]), b = at(triangles[k]);
        if (boxes_[b].min()[axis] > boxes_[a].max()[axis]) break;
        if (!boxes_[a].intersects(boxes_[b])) continue;
        if (const std::optional<Vec3> p =
                crossing(mesh_, mesh_.triangles[a], mesh_.triangles[b], tolerance_m_))
          return p;
      }
    return std::nullopt;
  }

  const SurfaceMesh& mesh_;
  double tolerance_m_;
  std::vector<Eigen::AlignedBox3d> boxes_;
};

}  // namespace

std::optional<Vec3> findCrossing(const SurfaceMesh& mesh, double tolerance_m) {
  std::vector<int> all(mesh.triangles.size());
  std::iota(all.begin(), all.end(), 0);
  return CrossingSearch(mesh, tolerance_m).among(std::move(all));
}

}  // namespace carom
