#pragma once
// A convex polyhedron with the neighbourhood of its features (paper §2: a face has edges; an edge has two
// vertices and two faces; a vertex has the edges that lead into it). Features live in contiguous arrays;
// there is no limit on their number. A single point (ball core) and a segment (capsule core) are the two
// degenerate members: no face. Invariants, checked by `validate`: closed and manifold (Euler V - E + F = 2),
// convex, planar faces, finite. Tested in tests/engine/solid/convex_polyhedron_test.cpp.

#include <cstdint>
#include <span>
#include <vector>

#include "engine/foundation/frames.h"
#include "engine/solid/support_table.h"

namespace carom {

/// An edge: from `tail` to `head`; `left` is the face that runs through it tail to head counter-clockwise
/// seen from outside, `right` the one that runs head to tail; both -1 on a segment.
struct Edge {
  int tail = -1;
  int head = -1;
  int left = -1;
  int right = -1;
  Vec3 direction = Vec3::Zero();  ///< Unit, tail to head.
  double length_m = 0.0;
  Vec3 into_left =
      Vec3::Zero();  ///< Unit, in the left face, perpendicular to the edge, pointing into the face.
  Vec3 into_right = Vec3::Zero();  ///< The same for the right face.
};

/// The plane n . p = offset of a face; n is unit and points outwards.
struct Plane {
  Vec3 normal = Vec3::Zero();
  double offset = 0.0;
  double signedDistance(const Vec3& p) const { return dot(normal, p) - offset; }
};

/// An edge seen from one of its vertices.
struct Spoke {
  Vec3 direction = Vec3::Zero();  ///< Unit, away from the vertex.
  int edge = -1;
  int head = -1;  ///< The vertex at its other end.
};

/// A ball within a polyhedron, in its frame: the simplest bound from below of how far it reaches in any
/// direction.
struct InnerBall {
  Vec3 center = Vec3::Zero();
  double radius_m = 0.0;
};

class ConvexPolyhedron {
 public:
  /// One point: the core of a ball.
  static ConvexPolyhedron point(const Vec3& p);
  /// Two distinct points: the core of a capsule. Throws InputError when they coincide.
  static ConvexPolyhedron segment(const Vec3& a, const Vec3& b);
  /// From vertices and faces as loops of vertex indices, counter-clockwise seen from outside.
  /// Throws InputError with the reason when the result is not a closed convex polyhedron.
  static ConvexPolyhedron fromFaces(std::vector<Vec3> vertices, const std::vector<std::vector<int>>& loops);

  int vertexCount() const { return static_cast<int>(vertices_.size()); }
  int edgeCount() const { return static_cast<int>(edges_.size()); }
  int faceCount() const { return static_cast<int>(planes_.size()); }

  const std::vector<Vec3>& vertices() const { return vertices_; }
  const Vec3& vertex(int v) const { return vertices_[static_cast<std::size_t>(v)]; }
  const Edge& edge(int e) const { return edges_[static_cast<std::size_t>(e)]; }
  const Plane& plane(int f) const { return planes_[static_cast<std::size_t>(f)]; }

  /// The vertices around face f, counter-clockwise seen from outside.
  std::span<const int> faceVertices(int f) const { return slice(face_vertices_, face_begin_, f); }
  /// The edges around face f: the i-th joins the i-th and the next vertex of `faceVertices(f)`.
  std::span<const int> faceEdges(int f) const { return slice(face_edges_, face_begin_, f); }
  /// The edges at vertex v seen from there: their directions are the normals of its V-planes.
  std::span<const Spoke> spokes(int v) const { return slice(spokes_, vertex_begin_, v); }
  /// The V-planes of face f, the i-th through `faceEdges(f)[i]`: the prism over the face is where all are >=
  /// 0.
  std::span<const Plane> faceSides(int f) const { return slice(face_sides_, face_begin_, f); }

  /// The unit direction that leads from face f's edge into the face.
  const Vec3& intoFace(int e, int f) const {
    return edge(e).left == f ? edge(e).into_left : edge(e).into_right;
  }
  /// The face on the other side of edge e.
  int faceAcross(int e, int f) const { return edge(e).left == f ? edge(e).right : edge(e).left; }
  /// The other end of edge e.
  int otherEnd(int e, int v) const { return edge(e).tail == v ? edge(e).head : edge(e).tail; }

  /// A vertex farthest along `direction` (any length), by hill climbing from `start`; the answer does not
  /// depend on `start` unless several vertices are equally far to rounding.
  int support(const Vec3& direction, int start) const;
  /// The same from a table of directions: its cost does not grow with the number of vertices.
  int support(const Vec3& direction) const {
    return support(direction, support_table_.vertexNear(direction));
  }

  /// The middle of the bounding box, and a radius about it that holds every vertex, metres.
  const Vec3& center() const { return center_; }
  double radius() const { return radius_m_; }
  /// The largest coordinate of a vertex in its frame is at most this, metres.
  double reach() const { return reach_m_; }
  /// One over the length of the shortest edge, 1/m; 0 without edges.
  double inverseShortestEdge() const { return inverse_shortest_edge_; }
  /// The largest distance of a vertex from `p`, metres.
  double radiusAbout(const Vec3& p) const;
  /// The smallest width over the directions of the face normals, metres; 0 for a point or segment.
  double width() const { return width_m_; }
  /// The largest, to a thousandth of its radius mostly; of radius 0 in a point or segment.
  const InnerBall& innerBall() const { return inner_ball_; }
  /// Of the vertices and faces, bit for bit: what was found out about one polyhedron is true of another with
  /// the same fingerprint.
  std::uint64_t fingerprint() const { return fingerprint_; }

  /// The same polyhedron moved: vertices become p + shift.
  ConvexPolyhedron translated(const Vec3& shift) const;

 private:
  template <typename T>
  static std::span<const T> slice(const std::vector<T>& items, const std::vector<int>& begin, int i) {
    const auto k = static_cast<std::size_t>(i);
    return {items.data() + begin[k], static_cast<std::size_t>(begin[k + 1] - begin[k])};
  }
  void buildEdges(const std::vector<std::vector<int>>& loops);
  void buildSpokes();
  void buildSides();
  void validate() const;
  void measure();
  InnerBall largestInnerBall() const;
  std::uint64_t computeFingerprint() const;
  /// The face to the left of a spoke, seen from its vertex outwards.
  int faceBeside(const Spoke& spoke, int v) const {
    const Edge& e = edge(spoke.edge);
    return e.tail == v ? e.left : e.right;
  }
  bool isFlat(int v) const;
  bool facesAway(int v, const Vec3& direction) const;
  int farthestVertex(const Vec3& direction) const;

  std::vector<Vec3> vertices_;
  std::vector<Edge> edges_;
  std::vector<Plane> planes_;
  std::vector<int> face_begin_{0}, face_vertices_, face_edges_;
  std::vector<Plane> face_sides_;
  std::vector<int> vertex_begin_{0};
  std::vector<Spoke> spokes_;
  SupportTable support_table_;
  Vec3 center_ = Vec3::Zero();
  double radius_m_ = 0.0;
  double reach_m_ = 0.0;
  double inverse_shortest_edge_ = 0.0;
  bool has_flat_vertices_ = false;  // some vertex is in the middle of coplanar faces
  double width_m_ = 0.0;
  InnerBall inner_ball_;
  std::uint64_t fingerprint_ = 0;
};

}  // namespace carom
