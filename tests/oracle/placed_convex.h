#pragma once
// A convex part as the oracles see it: plain lists of world points in long double, with the face normals
// computed afresh from the corners. The oracles of this folder share nothing with V-Clip but the part's lists
// of vertices, edges and face loops. Tested in tests/oracle/oracle_test.cpp.

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "engine/solid/solid.h"

namespace carom::oracle {

using Real = long double;
using Vec3R = Eigen::Matrix<Real, 3, 1>;
using Mat3R = Eigen::Matrix<Real, 3, 3>;

struct PlacedConvex {
  std::vector<Vec3R> vertices;
  std::vector<std::array<std::size_t, 2>> edges;
  std::vector<std::array<std::size_t, 3>> triangles;  ///< A fan for each face.
  std::vector<Vec3R> face_normals;                    ///< Unit, outwards.
  std::vector<Vec3R> face_points;                     ///< One corner of each face.
  std::vector<Vec3R> edge_directions;                 ///< Unit; parallel edges are listed once.
  Real radius_m = 0;  ///< The part is everything within this distance of the core.

  bool flat() const { return face_normals.empty(); }  ///< A point or a segment.
};

/// Newell's sum over a face's corners about the first one: twice the area times the outward normal.
inline Vec3R areaVector(std::span<const int> loop, const std::vector<Vec3R>& vertices) {
  Vec3R sum = Vec3R::Zero();
  const Vec3R& base = vertices[static_cast<std::size_t>(loop[0])];
  for (std::size_t i = 1; i + 1 < loop.size(); ++i)
    sum += (vertices[static_cast<std::size_t>(loop[i])] - base)
               .cross(vertices[static_cast<std::size_t>(loop[i + 1])] - base);
  return sum;
}

/// The part at its pose. A rotation that has drifted from unit length is normalised first.
inline PlacedConvex place(const ConvexPart& part, const Pose& X_WP) {
  const Eigen::Matrix<Real, 3, 3> R = X_WP.rotation.cast<Real>().normalized().toRotationMatrix();
  const Vec3R t = X_WP.position.cast<Real>();
  PlacedConvex placed;
  placed.radius_m = part.radius_m;
  for (const Vec3& v : part.core.vertices()) placed.vertices.push_back(R * v.cast<Real>() + t);
  for (int f = 0; f < part.core.faceCount(); ++f) {
    const std::span<const int> loop = part.core.faceVertices(f);
    placed.face_normals.push_back(areaVector(loop, placed.vertices).normalized());
    placed.face_points.push_back(placed.vertices[static_cast<std::size_t>(loop[0])]);
    for (std::size_t i = 1; i + 1 < loop.size(); ++i)
      placed.triangles.push_back({static_cast<std::size_t>(loop[0]), static_cast<std::size_t>(loop[i]),
                                  static_cast<std::size_t>(loop[i + 1])});
  }
  constexpr Real kSameDirection =
      1e-17L;  // sine of the angle: below it the directions differ by rounding only
  for (int e = 0; e < part.core.edgeCount(); ++e) {
    const Edge& edge = part.core.edge(e);
    const std::array<std::size_t, 2> ends{static_cast<std::size_t>(edge.tail),
                                          static_cast<std::size_t>(edge.head)};
    placed.edges.push_back(ends);
    const Vec3R d = (placed.vertices[ends[1]] - placed.vertices[ends[0]]).normalized();
    bool known = false;
    for (const Vec3R& other : placed.edge_directions)
      known = known || d.cross(other).squaredNorm() < kSameDirection * kSameDirection;
    if (!known) placed.edge_directions.push_back(d);
  }
  return placed;
}

}  // namespace carom::oracle
