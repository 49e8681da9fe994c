#include "renderer/mesh/rounded_part_mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace carom::renderer {
namespace {

// On the great circle from unit `a` to unit `b`, less than half a turn apart; the ends themselves to the bit.
Vec3 between(const Vec3& a, const Vec3& b, int step, int steps) {
  if (step == 0) return a;
  if (step == steps) return b;
  const double angle = std::atan2(a.cross(b).norm(), a.dot(b));
  const double share = static_cast<double>(step) / steps;
  if (!(std::sin(angle) > 1e-9)) return (a + share * (b - a)).normalized();
  return (std::sin((1.0 - share) * angle) * a + std::sin(share * angle) * b).normalized();
}

class RoundedPart {
 public:
  RoundedPart(TriangleMesh& mesh, const ConvexPart& part, int segments)
      : mesh_(mesh), core_(part.core), radius_m_(part.radius_m), segments_(segments) {
    for (int f = 0; f < core_.faceCount(); ++f) addFace(f);
    for (int e = 0; e < core_.edgeCount(); ++e) addStrip(e);
    for (int v = 0; v < core_.vertexCount(); ++v) addCap(v);
  }

 private:
  using Index = std::uint32_t;

  Index corner(int v, const Vec3& n) { return mesh_.addVertex(core_.vertex(v) + radius_m_ * n, n); }

  // The normals about an edge, from its left face's to its right one's.
  std::vector<Vec3> arc(int e) const {
    const Vec3 &left = core_.plane(core_.edge(e).left).normal,
               &right = core_.plane(core_.edge(e).right).normal;
    const double angle = std::atan2(left.cross(right).norm(), left.dot(right));
    const int steps =
        std::max(1, static_cast<int>(std::ceil(0.5 * angle * segments_ / std::numbers::pi - 1e-9)));
    std::vector<Vec3> normals;
    for (int i = 0; i <= steps; ++i) normals.push_back(between(left, right, i, steps));
    return normals;
  }

  void addFace(int f) {
    std::vector<Index> loop;
    for (const int v : core_.faceVertices(f)) loop.push_back(corner(v, core_.plane(f).normal));
    mesh_.addFan(loop);
  }

  void addStrip(int e) {
    const Edge& edge = core_.edge(e);
    Index tail = 0, head = 0;
    bool first = true;
    for (const Vec3& n : arc(e)) {
      const Index next_tail = corner(edge.tail, n), next_head = corner(edge.head, n);
      if (!first) {
        mesh_.addTriangle(next_tail, head, tail);
        mesh_.addTriangle(next_tail, next_head, head);
      }
      tail = next_tail, head = next_head, first = false;
    }
  }

  // Rings from the middle of the patch to the arcs around it, counter-clockwise seen from outside.
  void addCap(int v) {
    Vec3 sum = Vec3::Zero();
    std::size_t rings = 1;
    for (const Spoke& spoke : core_.spokes(v)) {
      const std::vector<Vec3> normals = arc(spoke.edge);
      sum += normals.front() + normals.back();
      rings = std::max(rings, normals.size() - 1);
    }
    const Vec3 middle = sum.normalized();
    for (const Spoke& spoke : core_.spokes(v)) {
      std::vector<Vec3> normals = arc(spoke.edge);
      if (core_.edge(spoke.edge).tail == v) std::reverse(normals.begin(), normals.end());
      addSector(v, middle, normals, static_cast<int>(rings));
    }
  }

  void addSector(int v, const Vec3& middle, const std::vector<Vec3>& rim, int rings) {
    std::vector<Index> inner(rim.size(), corner(v, middle));
    for (int ring = 1; ring <= rings; ++ring) {
      std::vector<Index> outer;
      for (const Vec3& n : rim) outer.push_back(corner(v, between(middle, n, ring, rings)));
      for (std::size_t i = 0; i + 1 < rim.size(); ++i) {
        mesh_.addTriangle(inner[i], outer[i], outer[i + 1]);
        if (ring > 1) mesh_.addTriangle(inner[i], outer[i + 1], inner[i + 1]);
      }
      inner = outer;
    }
  }

  TriangleMesh& mesh_;
  const ConvexPolyhedron& core_;
  double radius_m_;
  int segments_;
};

}  // namespace

void addRoundedPolyhedron(TriangleMesh& mesh, const ConvexPart& part, int segments) {
  RoundedPart(mesh, part, segments);
}

}  // namespace carom::renderer
