#pragma once
// Closed meshes that are not convex, made from numbers: what decompositions, importers and pictures are
// tested with. All coordinates have all their digits, and all are in general position: turned and moved.

#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "engine/foundation/elementary.h"
#include "engine/solid/surface_mesh.h"

namespace carom::generated {

inline void addQuad(SurfaceMesh& mesh, int a, int b, int c, int d) {
  mesh.triangles.push_back({a, b, c});
  mesh.triangles.push_back({a, c, d});
}

/// The surface of unit cells; `filled` of each within `count`.
inline SurfaceMesh cells(const std::array<int, 3>& count, const std::function<bool(int, int, int)>& filled) {
  SurfaceMesh mesh;
  std::map<std::array<int, 3>, int> number;
  const auto vertex = [&](std::array<int, 3> p) {
    const auto [found, is_new] = number.insert({p, static_cast<int>(mesh.vertices.size())});
    if (is_new) mesh.vertices.emplace_back(p[0], p[1], p[2]);
    return found->second;
  };
  const auto at = [&](const std::array<int, 3>& c) {
    for (std::size_t i = 0; i < 3; ++i)
      if (c[i] < 0 || c[i] >= count[i]) return false;
    return filled(c[0], c[1], c[2]);
  };
  for (int x = 0; x < count[0]; ++x)
    for (int y = 0; y < count[1]; ++y)
      for (int z = 0; z < count[2]; ++z) {
        const std::array<int, 3> cell{x, y, z};
        if (!at(cell)) continue;
        for (std::size_t axis = 0; axis < 3; ++axis)
          for (const int step : {-1, 1}) {
            std::array<int, 3> beside = cell;
            beside[axis] += step;
            if (at(beside)) continue;
            std::array<std::array<int, 3>, 4> corners{cell, cell, cell, cell};
            const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
            corners[1][u] += 1;
            corners[2][u] += 1;
            corners[2][v] += 1;
            corners[3][v] += 1;
            for (auto& corner : corners) corner[axis] += step > 0 ? 1 : 0;
            if (step < 0) std::swap(corners[1], corners[3]);
            addQuad(mesh, vertex(corners[0]), vertex(corners[1]), vertex(corners[2]), vertex(corners[3]));
          }
      }
  return mesh;
}

/// A closed band of rings of equally many points, the last joined to the first.
inline SurfaceMesh band(const std::vector<std::vector<Vec3>>& rings) {
  SurfaceMesh mesh;
  const int n = static_cast<int>(rings.size()), m = static_cast<int>(rings[0].size());
  for (const std::vector<Vec3>& ring : rings)
    mesh.vertices.insert(mesh.vertices.end(), ring.begin(), ring.end());
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < m; ++k) {
      const int j = (i + 1) % n, l = (k + 1) % m;
      addQuad(mesh, i * m + k, j * m + k, j * m + l, i * m + l);
    }
  return mesh;
}

/// `along` rings of `around` points about the axis z.
inline SurfaceMesh torus(int along, int around, double radius = 1.0, double thickness = 0.35) {
  std::vector<std::vector<Vec3>> rings(static_cast<std::size_t>(along));
  for (int i = 0; i < along; ++i)
    for (int k = 0; k < around; ++k) {
      const double a = 2.0 * std::numbers::pi * i / along, b = 2.0 * std::numbers::pi * (k + 0.5) / around;
      const double r = radius + thickness * std::cos(b);
      rings[static_cast<std::size_t>(i)].emplace_back(r * std::cos(a), r * std::sin(a),
                                                      thickness * std::sin(b));
    }
  return band(rings);
}

/// A chain's link: two half tori joined by straight bars.
inline SurfaceMesh link(int along, int around, double straight = 1.0) {
  std::vector<std::vector<Vec3>> rings;
  for (int i = 0; i < along + 2; ++i) {
    const int half = along / 2 + 1;
    const double a = std::numbers::pi * (i % half) / (half - 1) +
                     (i < half ? -0.5 * std::numbers::pi : 0.5 * std::numbers::pi);
    const double shift = i < half ? 0.5 * straight : -0.5 * straight;
    rings.emplace_back();
    for (int k = 0; k < around; ++k) {
      const double b = 2.0 * std::numbers::pi * (k + 0.5) / around, r = 0.8 + 0.25 * std::cos(b);
      rings.back().emplace_back(r * std::cos(a) + shift, r * std::sin(a), 0.25 * std::sin(b));
    }
  }
  return band(rings);
}

/// What turns about z: points (radius, height), counter-clockwise seen with the axis on the left; closed.
inline SurfaceMesh turned(const std::vector<Vec2>& outline, int sides) {
  std::vector<std::vector<Vec3>> rings(static_cast<std::size_t>(sides));
  for (int i = 0; i < sides; ++i)
    for (const Vec2& p : outline) {
      const double a = 2.0 * std::numbers::pi * i / sides;
      rings[static_cast<std::size_t>(i)].emplace_back(p.x() * std::cos(a), p.x() * std::sin(a), p.y());
    }
  SurfaceMesh mesh = band(rings);
  // Points on the axis are one; closedSurface drops what has no area then.
  return mesh;
}

/// Thick-walled, open above, with a flat bottom.
inline SurfaceMesh cup(int sides) {
  return turned({{0.0, 0.0}, {0.7, 0.0}, {1.0, 2.0}, {0.88, 2.0}, {0.6, 0.15}, {0.0, 0.15}}, sides);
}

/// A round bowl: two balls' surfaces of `rows` rows.
inline SurfaceMesh bowl(int sides, int rows) {
  std::vector<Vec2> outline;
  for (int i = 0; i <= rows; ++i) {
    const double a = 0.5 * std::numbers::pi * i / rows;
    outline.emplace_back(1.15 * std::sin(a), -1.15 * std::cos(a));
  }
  for (int i = rows; i >= 0; --i) {
    const double a = 0.5 * std::numbers::pi * i / rows;
    outline.emplace_back(std::sin(a), -std::cos(a));
  }
  outline.front().x() = outline.back().x() = 0.0;
  return turned(outline, sides);
}

/// A wheel with teeth and a bore.
inline SurfaceMesh gear(int teeth) {
  std::vector<std::vector<Vec3>> rings;
  for (int i = 0; i < 4 * teeth; ++i) {
    const double shares[] = {0.0, 0.3, 0.45, 0.85};
    const double a = 2.0 * std::numbers::pi * (i / 4 + shares[i % 4]) / teeth;
    const double r = i % 4 == 0 || i % 4 == 3 ? 0.85 : 1.05;
    const Vec3 out(std::cos(a), std::sin(a), 0.0), up(0.0, 0.0, 0.15);
    rings.push_back({r * out - up, r * out + up, 0.4 * out + up, 0.4 * out - up});
  }
  // The bore is straight between its corners, so that all faces stay flat.
  SurfaceMesh mesh = band(rings);
  for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

/// SplitMix64.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  double unit() {
    state_ += 0x9e3779b97f4a7c15ull;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
  }
  double between(double low, double high) { return low + (high - low) * unit(); }
  Vec3 inCube() {
    const double x = between(-1.0, 1.0), y = between(-1.0, 1.0);
    return {x, y, between(-1.0, 1.0)};
  }

 private:
  std::uint64_t state_;
};

/// A ball of latitude and longitude, of which one point in `every` is pushed in.
inline SurfaceMesh dentedBall(int sides, int rows, int every, std::uint64_t seed) {
  Random random(seed);
  SurfaceMesh mesh;
  const auto add = [&](double latitude, double longitude) {
    const bool dent = random.unit() * every < 1.0;
    const double r = dent ? random.between(0.6, 0.95) : 1.0;
    mesh.vertices.emplace_back(r * std::cos(latitude) * std::cos(longitude),
                               r * std::cos(latitude) * std::sin(longitude), r * std::sin(latitude));
    return static_cast<int>(mesh.vertices.size()) - 1;
  };
  const int south = add(-0.5 * std::numbers::pi, 0.0), north = add(0.5 * std::numbers::pi, 0.0);
  std::vector<std::vector<int>> rings;
  for (int i = 1; i < rows; ++i) {
    rings.emplace_back();
    for (int k = 0; k < sides; ++k)
      rings.back().push_back(
          add(std::numbers::pi * i / rows - 0.5 * std::numbers::pi, 2.0 * std::numbers::pi * k / sides));
  }
  for (std::size_t k = 0; k < rings[0].size(); ++k) {
    const std::size_t l = (k + 1) % rings[0].size();
    mesh.triangles.push_back({south, rings[0][l], rings[0][k]});
    mesh.triangles.push_back({north, rings.back()[k], rings.back()[l]});
    for (std::size_t i = 0; i + 1 < rings.size(); ++i)
      addQuad(mesh, rings[i][k], rings[i][l], rings[i + 1][l], rings[i + 1][k]);
  }
  return mesh;
}

/// Both surfaces as one.
inline SurfaceMesh joined(SurfaceMesh a, const SurfaceMesh& b, bool inside_out, double scale,
                          const Vec3& shift) {
  const int first = static_cast<int>(a.vertices.size());
  for (const Vec3& p : b.vertices) a.vertices.push_back(scale * p + shift);
  for (Triangle t : b.triangles) {
    if (inside_out) std::swap(t[1], t[2]);
    a.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  }
  return a;
}

inline SurfaceMesh placed(SurfaceMesh mesh, double scale = 1.0) {
  const Quat turn = rotationBy(Vec3(0.3, -0.7, 1.1));
  for (Vec3& p : mesh.vertices) p = scale * (turn * p + Vec3(0.13, -0.27, 0.41));
  return mesh;
}

struct NamedMesh {
  std::string name;
  SurfaceMesh mesh;
  int most_pieces;
};

}  // namespace carom::generated
