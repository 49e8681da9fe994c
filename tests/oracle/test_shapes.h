#pragma once
// Solids and poses for tests: regular solids, prisms, triangulated boxes, random hulls, and a random
// generator whose numbers are the same everywhere (the standard library's distributions are not).

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <random>
#include <vector>

#include "engine/solid/convex_hull.h"
#include "engine/solid/solid.h"

namespace carom::oracle {

/// A repeatable source of random numbers; a test prints the seed that it began with.
class Random {
 public:
  explicit Random(std::uint64_t seed) : bits_(seed) {}

  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(bits_() >> 11) * 0x1p-53;
  }
  /// From low to high inclusive.
  int integer(int low, int high) {
    return low + static_cast<int>(bits_() % static_cast<std::uint64_t>(high - low + 1));
  }
  /// Each power of ten between the bounds equally likely.
  double logUniform(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }
  Vec3 direction() {
    for (;;) {
      // One after the other: in which order a call's arguments are drawn would be the compiler's choice.
      Vec3 p;
      for (int i = 2; i >= 0; --i) p[i] = uniform(-1, 1);
      const double length = p.norm();
      if (length > 0.1 && length < 1.0) return p / length;
    }
  }
  Quat rotation() {
    for (;;) {
      Eigen::Vector4d q;
      for (int i = 3; i >= 0; --i) q[i] = uniform(-1, 1);
      const double length = q.norm();
      if (length > 0.1 && length < 1.0) return Quat(q / length);
    }
  }
  /// Any rotation, with the centre within `reach` of the origin.
  Pose pose(double reach) {
    Pose X;
    X.rotation = rotation();
    const Vec3 away = direction();
    X.position = uniform(0.0, reach) * away;
    return X;
  }

 private:
  std::mt19937_64 bits_;
};

inline Quat turned(const Vec3& axis, double radians) {
  return Quat(Eigen::AngleAxisd(radians, axis.normalized()));
}

/// The box's six faces as twelve triangles: coplanar neighbours, flat edges.
inline ConvexPolyhedron triangulatedBox(const Vec3& size_m) {
  const ConvexPolyhedron box = boxPolyhedron(size_m);
  std::vector<std::vector<int>> loops;
  for (int f = 0; f < box.faceCount(); ++f) {
    const std::span<const int> c = box.faceVertices(f);
    loops.push_back({c[0], c[1], c[2]});
    loops.push_back({c[0], c[2], c[3]});
  }
  return ConvexPolyhedron::fromFaces(box.vertices(), loops);
}

/// A box whose faces are cut into `cells` x `cells` rectangles, every other one of them into two triangles:
/// coplanar neighbours all over, vertices in the middle of edges and faces. Nothing is merged.
inline ConvexPolyhedron coplanarGrid(int cells, const Vec3& size_m) {
  std::vector<Vec3> vertices;
  std::map<std::array<int, 3>, int> number;
  const auto vertexAt = [&](int axis, int side, int i, int j) {
    std::array<int, 3> at{};
    const auto k = static_cast<std::size_t>(axis);
    at[k] = side;
    at[(k + 1) % 3] = i;
    at[(k + 2) % 3] = j;
    const auto [known, added] = number.try_emplace(at, static_cast<int>(vertices.size()));
    if (added)
      vertices.push_back((Vec3(at[0], at[1], at[2]) / cells - Vec3::Constant(0.5)).cwiseProduct(size_m));
    return known->second;
  };
  std::vector<std::vector<int>> loops;
  for (int axis = 0; axis < 3; ++axis)
    for (const int side : {0, cells})
      for (int i = 0; i < cells; ++i)
        for (int j = 0; j < cells; ++j) {
          std::array<int, 4> c{vertexAt(axis, side, i, j), vertexAt(axis, side, i + 1, j),
                               vertexAt(axis, side, i + 1, j + 1), vertexAt(axis, side, i, j + 1)};
          if (side == 0) std::swap(c[1], c[3]);
          if ((i + j) % 2 == 0) {
            loops.push_back({c[0], c[1], c[2], c[3]});
          } else {
            loops.push_back({c[0], c[1], c[2]});
            loops.push_back({c[0], c[2], c[3]});
          }
        }
  return ConvexPolyhedron::fromFaces(std::move(vertices), loops);
}

/// The same part with every coordinate multiplied, and built anew.
inline ConvexPart scaledPart(const ConvexPart& part, double factor) {
  const ConvexPolyhedron& p = part.core;
  const double radius_m = factor * part.radius_m;
  if (p.vertexCount() == 1) return {ConvexPolyhedron::point(factor * p.vertex(0)), radius_m};
  if (p.faceCount() == 0)
    return {ConvexPolyhedron::segment(factor * p.vertex(0), factor * p.vertex(1)), radius_m};
  std::vector<Vec3> vertices;
  for (const Vec3& v : p.vertices()) vertices.push_back(factor * v);
  std::vector<std::vector<int>> loops;
  for (int f = 0; f < p.faceCount(); ++f)
    loops.emplace_back(p.faceVertices(f).begin(), p.faceVertices(f).end());
  return {ConvexPolyhedron::fromFaces(std::move(vertices), loops), radius_m};
}

/// A right prism over a regular n-gon of circumradius `radius_m`, along z, centred.
inline ConvexPolyhedron prism(int n, double radius_m, double height_m) {
  std::vector<Vec3> vertices;
  std::vector<std::vector<int>> loops(2);
  for (int k = 0; k < n; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / n;
    vertices.emplace_back(radius_m * std::cos(angle), radius_m * std::sin(angle), -0.5 * height_m);
  }
  for (int k = 0; k < n; ++k)
    vertices.emplace_back(vertices[static_cast<std::size_t>(k)] + Vec3(0, 0, height_m));
  for (int k = 0; k < n; ++k) {
    loops[0].push_back(n - 1 - k);
    loops[1].push_back(n + k);
    loops.push_back({k, (k + 1) % n, n + (k + 1) % n, n + k});
  }
  return ConvexPolyhedron::fromFaces(std::move(vertices), loops);
}

/// Corners (1,1,1), (1,-1,-1), (-1,1,-1), (-1,-1,1): edge length 2 sqrt 2.
inline ConvexPolyhedron tetrahedron() {
  return ConvexPolyhedron::fromFaces({{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}},
                                     {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}});
}

/// Corners at distance 1 on the axes: edge length sqrt 2.
inline ConvexPolyhedron octahedron() {
  return ConvexPolyhedron::fromFaces(
      {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
      {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}});
}

inline std::vector<Vec3> icosahedronPoints() {
  const double phi = std::numbers::phi;
  std::vector<Vec3> p;
  for (double s : {-1.0, 1.0})
    for (double t : {-phi, phi}) {
      p.emplace_back(0, s, t);
      p.emplace_back(s, t, 0);
      p.emplace_back(t, 0, s);
    }
  return p;  // edge length 2
}

inline std::vector<Vec3> dodecahedronPoints() {
  const double phi = std::numbers::phi;
  std::vector<Vec3> p;
  for (double x : {-1.0, 1.0})
    for (double y : {-1.0, 1.0}) {
      for (double z : {-1.0, 1.0}) p.emplace_back(x, y, z);
      p.emplace_back(0, x / phi, y * phi);
      p.emplace_back(x / phi, y * phi, 0);
      p.emplace_back(x * phi, 0, y / phi);
    }
  return p;  // edge length 2 / phi
}

inline ConvexPolyhedron icosahedron() {
  return convexHull(icosahedronPoints()).polyhedron;
}
inline ConvexPolyhedron dodecahedron() {
  return convexHull(dodecahedronPoints()).polyhedron;
}

/// The hull of n random points on an ellipsoid with these half axes: all n are vertices.
inline ConvexPolyhedron randomHull(Random& random, int n, const Vec3& half_axes = Vec3::Ones()) {
  std::vector<Vec3> points;
  for (int i = 0; i < n; ++i) points.push_back(random.direction().cwiseProduct(half_axes));
  return convexHull(points).polyhedron;
}

}  // namespace carom::oracle
