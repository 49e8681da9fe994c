#include "engine/solid/surface_crossing.h"

#include <algorithm>
#include <numeric>

namespace carom {
namespace {

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

bool has(const Triangle& t, int vertex) {
  return t[0] == vertex || t[1] == vertex || t[2] == vertex;
}

/// Where the way from a to b goes through the inside of a triangle.
std::optional<Vec3> piercing(const SurfaceMesh& mesh, int a, int b, const Triangle& t, double tolerance_m) {
  const Vec3 &u = mesh.vertices[at(t[0])], &v = mesh.vertices[at(t[1])], &w = mesh.vertices[at(t[2])];
  const Vec3 area = (v - u).cross(w - u);
  if (!(area.norm() > 0.0)) return std::nullopt;
  const Vec3 n = area.normalized();
  const double da = n.dot(mesh.vertices[at(a)] - u), db = n.dot(mesh.vertices[at(b)] - u);
  if (!((da > tolerance_m && db < -tolerance_m) || (da < -tolerance_m && db > tolerance_m)))
    return std::nullopt;
  const Vec3 p = mesh.vertices[at(a)] + da / (da - db) * (mesh.vertices[at(b)] - mesh.vertices[at(a)]);
  for (int k = 0; k < 3; ++k) {
    const Vec3 &from = mesh.vertices[at(t[at(k)])], &to = mesh.vertices[at(t[at((k + 1) % 3)])];
    if (n.cross(to - from).normalized().dot(p - from) <= tolerance_m) return std::nullopt;
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

}  // namespace

std::optional<Vec3> findCrossing(const SurfaceMesh& mesh, double tolerance_m) {
  std::vector<Eigen::AlignedBox3d> boxes;
  Eigen::AlignedBox3d all;
  for (const Triangle& t : mesh.triangles) {
    boxes.emplace_back();
    for (const int v : t) boxes.back().extend(mesh.vertices[at(v)]);
    all.extend(boxes.back());
  }
  // A sweep along the longest axis.
  Eigen::Index axis = 0;
  all.sizes().maxCoeff(&axis);
  std::vector<int> order(boxes.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return boxes[at(a)].min()[axis] < boxes[at(b)].min()[axis]; });
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t k = i + 1; k < order.size(); ++k) {
      const Eigen::AlignedBox3d &a = boxes[at(order[i])], &b = boxes[at(order[k])];
      if (b.min()[axis] > a.max()[axis]) break;
      if (!a.intersects(b)) continue;
      if (const std::optional<Vec3> p =
              crossing(mesh, mesh.triangles[at(order[i])], mesh.triangles[at(order[k])], tolerance_m))
        return p;
    }
  return std::nullopt;
}

}  // namespace carom
