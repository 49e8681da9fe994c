#pragma once
// Solids and poses for tests: regular solids, prisms, triangulated boxes, random hulls, and a random
// generator whose numbers are the same everywhere (the standard library's distributions are not).

#include <array>
#include <cmath>
#include <cstdint>
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
      const Vec3 p(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
      const double length = p.norm();
      if (length > 0.1 && length < 1.0) return p / length;
    }
  }
  Quat rotation() {
    for (;;) {
      const Eigen::Vector4d q(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
      const double length = q.norm();
      if (length > 0.1 && length < 1.0) return Quat(q / length);
    }
  }
  /// Any rotation, with the centre within `reach` of the origin.
  Pose pose(double reach) {
    Pose X;
    X.rotation = rotation();
    X.position = uniform(0.0, reach) * direction();
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
