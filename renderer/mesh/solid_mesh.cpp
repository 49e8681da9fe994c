#include "renderer/mesh/solid_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "renderer/mesh/curved_part_mesh.h"
#include "renderer/mesh/rounded_part_mesh.h"

namespace carom::renderer {
namespace {

constexpr double kBevelFraction = 0.03;  // Of the part's width.
constexpr double kPullIn = 0.25;         // How far bevels recede from the sharp edge to the inscribed round.
constexpr double kMaxVertexPull = 0.5;   // Of the bevel's width: needles are not blunted further.
constexpr double kUsableEdge = 0.9;      // Of an edge's length, what the bevels at its two ends may take.
constexpr int kMaxBevelledFaces = 400;   // A part with more faces is round by itself.

std::uint32_t faceBit(int face) {
  return static_cast<std::uint32_t>(std::min(face, kNoFace));
}

void addSharpPart(TriangleMesh& mesh, const ConvexPolyhedron& core) {
  for (int f = 0; f < core.faceCount(); ++f) {
    std::vector<std::uint32_t> loop;
    for (const int v : core.faceVertices(f))
      loop.push_back(mesh.addVertex(core.vertex(v), core.plane(f).normal));
    mesh.addFan(loop);
    for (const std::uint32_t i : loop) mesh.vertices[i].face = faceBit(f);
  }
}

// One corner of a face: a vertex, the edges before and after it, and where the corner moves per metre of
// bevel.
struct Corner {
  int vertex = -1;
  int before = -1;
  int after = -1;
  Vec3 inward = Vec3::Zero();
};

std::vector<Corner> faceCorners(const ConvexPolyhedron& core, int f) {
  const std::span<const int> vertices = core.faceVertices(f), edges = core.faceEdges(f);
  std::vector<Corner> corners;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const int before = edges[(i + edges.size() - 1) % edges.size()], after = edges[i];
    // The point at distance one from both edges: a multiple of the sum of their unit directions into the
    // face.
    const Vec3 a = core.intoFace(before, f), b = core.intoFace(after, f);
    corners.push_back({vertices[i], before, after, (a + b) / (1.0 + a.dot(b))});
  }
  return corners;
}

// The widest bevel up to `wanted_m` for which no edge of the shrunken face turns around.
double faceBevel(const ConvexPolyhedron& core, const std::vector<Corner>& corners, double wanted_m) {
  double width = wanted_m;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Corner& tail = corners[i];
    const Corner& head = corners[(i + 1) % corners.size()];
    const Vec3 along = (core.vertex(head.vertex) - core.vertex(tail.vertex)).normalized();
    const double taken = tail.inward.dot(along) - head.inward.dot(along);
    if (taken > 0.0) width = std::min(width, kUsableEdge * core.edge(tail.after).length_m / taken);
  }
  return width;
}

std::uint32_t addBentVertex(TriangleMesh& mesh, const Vec3& p, const Vec3& n, const Vec3& bend,
                            double nearness) {
  const std::uint32_t index = mesh.addVertex(p, n);
  MeshVertex& vertex = mesh.vertices[index];
  for (int i = 0; i < 3; ++i) vertex.bend[i] = static_cast<float>(bend[i]);
  vertex.nearness = static_cast<float>(nearness);
  return index;
}

// A triangle from each edge to the middle of the face, across which the nearness of that edge is linear.
void addShadedFace(TriangleMesh& mesh, const ConvexPolyhedron& core, int f, double bevel_m) {
  const std::vector<Corner> corners = faceCorners(core, f);
  const Vec3& n = core.plane(f).normal;
  Vec3 middle = Vec3::Zero();
  for (const Corner& c : corners) middle += core.vertex(c.vertex) / static_cast<double>(corners.size());
  const auto toEdge = [&](const Corner& c) {
    return core.intoFace(c.after, f).dot(middle - core.vertex(c.vertex));
  };
  double width = faceBevel(core, corners, bevel_m);
  for (const Corner& c : corners) width = std::min(width, toEdge(c));
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Corner& tail = corners[i];
    const Edge& edge = core.edge(tail.after);
    const Vec3 bend = (core.plane(edge.left).normal + core.plane(edge.right).normal).normalized() - n;
    const std::uint32_t a = addBentVertex(mesh, core.vertex(tail.vertex), n, bend, 1.0);
    const std::uint32_t b =
        addBentVertex(mesh, core.vertex(corners[(i + 1) % corners.size()].vertex), n, bend, 1.0);
    const std::uint32_t c = addBentVertex(mesh, middle, n, bend, 1.0 - toEdge(tail) / width);
    mesh.addTriangle(a, b, c);
    for (const std::uint32_t vertex : {a, b, c}) mesh.vertices[vertex].face = faceBit(f);
  }
}

// Builds the bevelled surface of one polyhedral part: shrunken faces, two strips an edge that meet in a ridge
// with the mean normal, and a four-cornered patch for each corner of each face around a vertex.
class BevelledPart {
 public:
  BevelledPart(TriangleMesh& mesh, const ConvexPolyhedron& core, double bevel_m) : mesh_(mesh), core_(core) {
    const auto edges = static_cast<std::size_t>(core.edgeCount());
    const auto vertices = static_cast<std::size_t>(core.vertexCount());
    edge_width_.assign(edges, bevel_m);
    reach_.assign(edges, {0.0, 0.0});
    vertex_width_.assign(vertices, bevel_m);
    vertex_normal_.assign(vertices, Vec3::Zero());
    for (int f = 0; f < core.faceCount(); ++f) measureFace(f, bevel_m);
    for (int e = 0; e < core.edgeCount(); ++e) addRidge(e);
    for (int v = 0; v < core.vertexCount(); ++v) addPeak(v);
    for (int f = 0; f < core.faceCount(); ++f) addFace(f);
  }

 private:
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  int end(int e, int v) const { return core_.edge(e).tail == v ? 0 : 1; }

  void measureFace(int f, double bevel_m) {
    const std::vector<Corner> corners = faceCorners(core_, f);
    const double width = faceBevel(core_, corners, bevel_m);
    face_width_.push_back(width);
    for (const Corner& c : corners) {
      edge_width_[at(c.after)] = std::min(edge_width_[at(c.after)], width);
      vertex_width_[at(c.vertex)] = std::min(vertex_width_[at(c.vertex)], width);
      vertex_normal_[at(c.vertex)] += core_.plane(f).normal;
      // Half of what each of the two faces takes of the edge at this end.
      for (const int e : {c.before, c.after}) {
        const Vec3 along = (core_.vertex(core_.otherEnd(e, c.vertex)) - core_.vertex(c.vertex)).normalized();
        reach_[at(e)][at(end(e, c.vertex))] += 0.5 * width * std::max(0.0, c.inward.dot(along));
      }
    }
  }

  // The ridge recedes towards the arc that touches both faces where the bevel begins: w tan(phi / 4).
  void addRidge(int e) {
    const Edge& edge = core_.edge(e);
    const Vec3 &l = core_.plane(edge.left).normal, &r = core_.plane(edge.right).normal;
    const Vec3 n = (l + r).normalized();
    const double phi = std::acos(std::clamp(l.dot(r), -1.0, 1.0));
    const Vec3 shift = -kPullIn * edge_width_[at(e)] * std::tan(0.25 * phi) * n;
    const Vec3 tail = core_.vertex(edge.tail) + reach_[at(e)][0] * edge.direction;
    const Vec3 head = core_.vertex(edge.head) - reach_[at(e)][1] * edge.direction;
    ridge_.push_back({mesh_.addVertex(tail + shift, n), mesh_.addVertex(head + shift, n)});
  }

  // The peak recedes towards the ball that touches the faces around the vertex, along the mean of its edges:
  // unlike the mean of the normals that leads into the solid however pointed the vertex is.
  void addPeak(int v) {
    const Vec3 n = vertex_normal_[at(v)].normalized();
    Vec3 inward = Vec3::Zero();
    double lean = 0.0;
    for (const Spoke& spoke : core_.spokes(v)) {
      inward += spoke.direction;
      lean += n.dot(core_.plane(core_.edge(spoke.edge).left).normal);
    }
    lean = std::clamp(lean / static_cast<double>(core_.spokes(v).size()), 0.1, 1.0);
    const double depth = std::min(kMaxVertexPull, kPullIn * (1.0 / lean - 1.0)) * vertex_width_[at(v)];
    peak_.push_back(mesh_.addVertex(core_.vertex(v) + depth * inward.normalized(), n));
  }

  void addFace(int f) {
    const std::vector<Corner> corners = faceCorners(core_, f);
    std::vector<std::uint32_t> loop;
    for (const Corner& c : corners)
      loop.push_back(
          mesh_.addVertex(core_.vertex(c.vertex) + face_width_[at(f)] * c.inward, core_.plane(f).normal));
    mesh_.addFan(loop);
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Corner& c = corners[i];
      const std::size_t next = (i + 1) % corners.size();
      const std::uint32_t here = ridge_[at(c.after)][at(end(c.after, c.vertex))];
      const std::uint32_t there = ridge_[at(c.after)][at(end(c.after, corners[next].vertex))];
      const std::uint32_t before = ridge_[at(c.before)][at(end(c.before, c.vertex))];
      mesh_.addFan(std::array{loop[i], here, there, loop[next]});
      mesh_.addFan(std::array{loop[i], before, peak_[at(c.vertex)], here});
    }
  }

  TriangleMesh& mesh_;
  const ConvexPolyhedron& core_;
  std::vector<double> face_width_, edge_width_, vertex_width_;
  std::vector<std::array<double, 2>> reach_;  // How far from tail and head an edge's ridge begins.
  std::vector<Vec3> vertex_normal_;
  std::vector<std::array<std::uint32_t, 2>> ridge_;
  std::vector<std::uint32_t> peak_;
};

// A ball, or two half balls about `a` and `b` joined by a cylinder: rings of latitude, the equator twice.
// Vertices lie half a sagitta outside, so that the silhouette is as often outside the true circle as inside.
void addRoundPart(TriangleMesh& mesh, const Vec3& a, const Vec3& b, double radius_m, int segments) {
  const Vec3 axis = (b - a).norm() > 0.0 ? Vec3((b - a).normalized()) : Vec3(Vec3::UnitZ());
  const TangentBasis basis = tangentBasis(axis);
  const double step = 2.0 * std::numbers::pi / segments;
  const double radius = radius_m / (0.5 + 0.5 * std::cos(0.5 * step));
  const int quarter = std::max(2, segments / 4);
  std::vector<std::vector<std::uint32_t>> rings;
  for (int i = 0; i <= 2 * quarter + 1; ++i) {
    const bool upper = i > quarter;
    const double latitude = 0.5 * std::numbers::pi * (i - quarter - (upper ? 1 : 0)) / quarter;
    std::vector<std::uint32_t> ring;
    for (int k = 0; k < segments; ++k) {
      const double c = std::cos(step * k), s = std::sin(step * k);
      const double level =
          i == 0 || i == 2 * quarter + 1 ? 0.0 : std::cos(latitude);  // Poles are single points.
      const Vec3 n = level * (c * basis.t1 + s * basis.t2) + std::sin(latitude) * axis;
      ring.push_back(mesh.addVertex((upper ? b : a) + radius * n, n));
    }
    rings.push_back(ring);
  }
  for (std::size_t i = 0; i + 1 < rings.size(); ++i) {
    const bool equator = i == static_cast<std::size_t>(quarter);
    if (equator && (b - a).norm() == 0.0) continue;
    for (std::size_t k = 0; k < rings[i].size(); ++k) {
      const std::size_t n = (k + 1) % rings[i].size();
      if (i > 0) mesh.addTriangle(rings[i][k], rings[i][n], rings[i + 1][n]);
      if (i + 2 < rings.size()) mesh.addTriangle(rings[i][k], rings[i + 1][n], rings[i + 1][k]);
    }
  }
}

void addPart(TriangleMesh& mesh, const ConvexPart& part, const MeshDetail& detail) {
  const ConvexPolyhedron& core = part.core;
  if (core.faceCount() == 0)
    addRoundPart(mesh, core.vertex(0), core.vertex(core.vertexCount() - 1), part.radius_m, detail.segments);
  else if (part.radius_m > 0.0)
    addRoundedPolyhedron(mesh, part, detail.segments);
  else if (isCurved(core))
    addCurvedPart(mesh, core, detail.edges == Edges::kSharp ? 0.0 : detail.bevel_m);
  else if (detail.edges == Edges::kSharp || core.faceCount() > kMaxBevelledFaces)
    addSharpPart(mesh, core);
  else if (detail.edges == Edges::kBevelled)
    BevelledPart(mesh, core, detail.bevel_m);
  else
    for (int f = 0; f < core.faceCount(); ++f) addShadedFace(mesh, core, f, detail.bevel_m);
}

enum class SurfaceNormals { kOwn, kFlat };

// Corners of equal place, normal, colour and place on a picture are one.
void addSurface(TriangleMesh& mesh, const BoundingSurface& surface, SurfaceNormals normals) {
  std::map<std::array<double, 10>, std::uint32_t> known;
  const bool own = normals == SurfaceNormals::kOwn && !surface.normals.empty();
  for (std::size_t t = 0; t < surface.mesh.triangles.size(); ++t) {
    const Triangle& triangle = surface.mesh.triangles[t];
    const auto corner = [&](std::size_t k) -> const Vec3& {
      return surface.mesh.vertices[static_cast<std::size_t>(triangle[k])];
    };
    const Vec3 flat = (corner(1) - corner(0)).cross(corner(2) - corner(0)).normalized();
    const Vec3 color = surface.colors.empty() ? Vec3(Vec3::Ones()) : surface.colors[t];
    std::array<std::uint32_t, 3> indices{};
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3& n = own ? surface.normals[3 * t + k] : flat;
      const int picture = surface.uv.empty() || surface.picture_of.empty() ? -1 : surface.picture_of[t];
      const Vec2 uv = picture < 0 ? Vec2(Vec2::Zero()) : surface.uv[3 * t + k];
      const std::uint32_t packed = static_cast<std::uint32_t>(std::lround(255.0 * color.x())) << 16 |
                                   static_cast<std::uint32_t>(std::lround(255.0 * color.y())) << 8 |
                                   static_cast<std::uint32_t>(std::lround(255.0 * color.z()));
      const Vec3& p = corner(k);
      const auto [found, is_new] =
          known.insert({{p.x(), p.y(), p.z(), n.x(), n.y(), n.z(), static_cast<double>(packed), uv.x(),
                         uv.y(), static_cast<double>(picture)},
                        0});
      if (is_new) {
        found->second = mesh.addVertex(p, n);
        std::uint8_t* tint = mesh.vertices.back().tint;
        for (int i = 0; i < 3; ++i) tint[i] = static_cast<std::uint8_t>(packed >> (16 - 8 * i) & 255);
        float* place = mesh.vertices.back().picture;
        place[0] = static_cast<float>(uv.x());
        place[1] = static_cast<float>(uv.y());
        place[2] = static_cast<float>(picture);
      }
      indices[k] = found->second;
    }
    mesh.addTriangle(indices[0], indices[1], indices[2]);
  }
}

}  // namespace

std::uint32_t TriangleMesh::addVertex(const Vec3& p, const Vec3& n) {
  const Eigen::Vector3f pf = p.cast<float>(), nf = n.cast<float>();
  vertices.push_back({{pf.x(), pf.y(), pf.z()}, {nf.x(), nf.y(), nf.z()}, {}, 0.0f, kNoFace});
  return static_cast<std::uint32_t>(vertices.size() - 1);
}

void TriangleMesh::addTriangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  indices.insert(indices.end(), {a, b, c});
}

void TriangleMesh::addFan(std::span<const std::uint32_t> loop) {
  for (std::size_t i = 2; i < loop.size(); ++i) addTriangle(loop[0], loop[i - 1], loop[i]);
}

TriangleMesh buildMesh(const Solid& solid, const MeshDetail& detail) {
  TriangleMesh mesh;
  for (std::size_t i = 0; i < solid.parts().size(); ++i)
    if (!solid.isPiece(i)) addPart(mesh, solid.parts()[i], detail);
  addSurface(mesh, solid.surface(), SurfaceNormals::kOwn);
  return mesh;
}

TriangleMesh buildFlatMesh(const Solid& solid) {
  TriangleMesh mesh;
  for (std::size_t i = 0; i < solid.parts().size(); ++i)
    if (!solid.isPiece(i) && solid.parts()[i].radius_m == 0.0) addSharpPart(mesh, solid.parts()[i].core);
  addSurface(mesh, solid.surface(), SurfaceNormals::kFlat);
  return mesh;
}

double thinnestPart(const Solid& solid) {
  double width = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < solid.parts().size(); ++i)
    if (!solid.isPiece(i)) width = std::min(width, solid.parts()[i].width());
  return std::isfinite(width) ? width : solid.width();
}

double bevelWidth(const Solid& solid, double cap_m) {
  return std::min(kBevelFraction * thinnestPart(solid), cap_m);
}

}  // namespace carom::renderer
