#include "renderer/mesh/curved_part_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace carom::renderer {
namespace {

constexpr int kFewestSides = 16;
constexpr double kSmoothCosine = 0.917;  // Of 23.5 degrees: a little more than a sixteenth of a turn.
constexpr double kPullIn = 0.25;         // As the bevels of other parts (solid_mesh.cpp).
constexpr double kMostOfEdge = 0.3;      // Of what a face measures across, what a bevel may take.

bool isSmooth(const ConvexPolyhedron& core, int e) {
  const Edge& edge = core.edge(e);
  return core.plane(edge.left).normal.dot(core.plane(edge.right).normal) > kSmoothCosine;
}

int smoothEdges(const ConvexPolyhedron& core, int f) {
  int count = 0;
  for (const int e : core.faceEdges(f)) count += isSmooth(core, e) ? 1 : 0;
  return count;
}

class CurvedPart {
 public:
  CurvedPart(TriangleMesh& mesh, const ConvexPolyhedron& core, double bevel_m) : mesh_(mesh), core_(core) {
    width_ = std::min(bevel_m, kMostOfEdge * narrowest());
    for (int v = 0; v < core_.vertexCount(); ++v) addRidge(v);
    for (int f = 0; f < core_.faceCount(); ++f) addFace(f);
  }

 private:
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  bool isBelt(int f) const { return smoothEdges(core_, f) > 0; }

  // The least of what the faces measure between a sharp edge and what lies across.
  double narrowest() const {
    double least = std::numeric_limits<double>::infinity();
    for (int f = 0; f < core_.faceCount(); ++f)
      for (const int e : core_.faceEdges(f)) {
        if (isSmooth(core_, e)) continue;
        double across = 0.0;
        for (const int v : core_.faceVertices(f))
          across =
              std::max(across, core_.intoFace(e, f).dot(core_.vertex(v) - core_.vertex(core_.edge(e).tail)));
        least = std::min(least, across);
      }
    return least;
  }

  // The normal of face f at its corner `i`: on a belt that between it and its neighbour there.
  Vec3 normalAt(int f, std::size_t i) const {
    const std::span<const int> edges = core_.faceEdges(f);
    const int before = edges[(i + edges.size() - 1) % edges.size()], after = edges[i];
    const bool smooth_before = isSmooth(core_, before), smooth_after = isSmooth(core_, after);
    const Vec3& own = core_.plane(f).normal;
    if (smooth_before == smooth_after) return own;  // The tip of a cone, or no belt.
    return (own + core_.plane(core_.faceAcross(smooth_after ? after : before, f)).normal).normalized();
  }

  // Where corner `i` of face f lies without the bevels along its sharp edges.
  Vec3 insetAt(int f, std::size_t i) const {
    const std::span<const int> edges = core_.faceEdges(f), vertices = core_.faceVertices(f);
    const int before = edges[(i + edges.size() - 1) % edges.size()], after = edges[i];
    const Vec3& p = core_.vertex(vertices[i]);
    const bool smooth_before = isSmooth(core_, before), smooth_after = isSmooth(core_, after);
    if (smooth_before && smooth_after) return p;
    const Vec3 a = core_.intoFace(before, f), b = core_.intoFace(after, f);
    if (!smooth_before && !smooth_after) return p + width_ * (a + b) / (1.0 + a.dot(b));
    return insetAlong(smooth_before ? before : after, vertices[i]);
  }

  // The same for both faces of a smooth edge, to the bit: on the edge, as far from the rims of both as the
  // mean has it.
  Vec3 insetAlong(int e, int v) const {
    const Vec3& p = core_.vertex(v);
    const Vec3 direction = (core_.vertex(core_.otherEnd(e, v)) - p).normalized();
    double rise = 0.0;
    for (const int f : {core_.edge(e).left, core_.edge(e).right})
      for (const int sharp : core_.faceEdges(f))
        if (!isSmooth(core_, sharp) && (core_.edge(sharp).tail == v || core_.edge(sharp).head == v))
          rise += 0.5 * core_.intoFace(sharp, f).dot(direction);
    return p + width_ / rise * direction;
  }

  // The middle of the bevel at a vertex of a rim: between the normals of the two sides, a little inside of
  // the corner.
  void addRidge(int v) {
    ridge_.push_back(0);
    if (width_ == 0.0) return;
    const Edge* rim = nullptr;
    for (const Spoke& spoke : core_.spokes(v))
      if (!isSmooth(core_, spoke.edge)) rim = &core_.edge(spoke.edge);
    if (rim == nullptr) return;
    // The faces about the vertex belong to either side of the rim.
    const Vec3 &left = core_.plane(rim->left).normal, &right = core_.plane(rim->right).normal;
    Vec3 sides[2] = {Vec3::Zero(), Vec3::Zero()};
    for (const Spoke& spoke : core_.spokes(v))
      for (const int f : {core_.edge(spoke.edge).left, core_.edge(spoke.edge).right}) {
        const Vec3& n = core_.plane(f).normal;
        sides[n.dot(left) >= n.dot(right) ? 0 : 1] += n;
      }
    for (Vec3& side : sides) side.normalize();
    const Vec3 n = (sides[0] + sides[1]).normalized();
    const double phi = std::acos(std::clamp(sides[0].dot(sides[1]), -1.0, 1.0));
    const Vec3 shift = -kPullIn * width_ * std::tan(0.25 * phi) * n;
    ridge_.back() = mesh_.addVertex(core_.vertex(v) + shift, n);
  }

  void addFace(int f) {
    const std::span<const int> edges = core_.faceEdges(f), vertices = core_.faceVertices(f);
    std::vector<std::uint32_t> loop;
    for (std::size_t i = 0; i < vertices.size(); ++i)
      loop.push_back(mesh_.addVertex(insetAt(f, i), normalAt(f, i)));
    mesh_.addFan(loop);
    if (width_ == 0.0) return;
    for (std::size_t i = 0; i < edges.size(); ++i) {
      if (isSmooth(core_, edges[i])) continue;
      const std::size_t next = (i + 1) % vertices.size();
      mesh_.addFan(std::array{loop[i], ridge_[at(vertices[i])], ridge_[at(vertices[next])], loop[next]});
    }
  }

  TriangleMesh& mesh_;
  const ConvexPolyhedron& core_;
  double width_ = 0.0;
  std::vector<std::uint32_t> ridge_;  // By vertex; of no meaning away from the rims.
};

}  // namespace

bool isCurved(const ConvexPolyhedron& core) {
  if (core.faceCount() < kFewestSides) return false;
  int belt = 0;
  for (int f = 0; f < core.faceCount(); ++f) {
    const int smooth = smoothEdges(core, f);
    if (smooth != 0 && smooth != 2) return false;
    belt += smooth / 2;
  }
  return belt >= kFewestSides;
}

void addCurvedPart(TriangleMesh& mesh, const ConvexPolyhedron& core, double bevel_m) {
  CurvedPart(mesh, core, bevel_m);
}

}  // namespace carom::renderer
