#include "engine/solid/surface_mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <sstream>
#include <tuple>

#include "engine/foundation/contract.h"
#include "engine/foundation/index.h"

namespace carom {
namespace {

std::string shown(const Vec3& p) {
  std::ostringstream text;
  text << '(' << p.x() << ", " << p.y() << ", " << p.z() << ')';
  return text.str();
}

/// Of each vertex the first at the same place.
std::vector<int> firstAtPlace(const std::vector<Vec3>& vertices) {
  std::vector<int> order(vertices.size()), first(vertices.size());
  std::iota(order.begin(), order.end(), 0);
  const auto key = [&](int i) {
    const Vec3& p = vertices[at(i)];
    return std::tuple(p.x(), p.y(), p.z());
  };
  std::stable_sort(order.begin(), order.end(), [&](int i, int j) { return key(i) < key(j); });
  for (std::size_t k = 0; k < order.size(); ++k)
    first[at(order[k])] = k > 0 && key(order[k - 1]) == key(order[k]) ? first[at(order[k - 1])] : order[k];
  return first;
}

/// A side of a triangle, by its two ends in order of their numbers.
struct EdgeUse {
  int low, high, half;  // half = 3 * triangle + side
  bool operator<(const EdgeUse& o) const {
    return std::tuple(low, high, half) < std::tuple(o.low, o.high, o.half);
  }
  bool sameEdge(const EdgeUse& o) const { return low == o.low && high == o.high; }
};

std::vector<EdgeUse> edgeUses(const std::vector<Triangle>& triangles) {
  std::vector<EdgeUse> uses;
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(triangles[t][at(k)], triangles[t][at((k + 1) % 3)]);
      uses.push_back({low, high, static_cast<int>(3 * t) + k});
    }
  std::sort(uses.begin(), uses.end());
  return uses;
}

/// The sides that share an edge with each other; throws InputError unless they are two everywhere.
std::vector<int> pairedSides(const SurfaceMesh& mesh) {
  const std::vector<EdgeUse> uses = edgeUses(mesh.triangles);
  std::vector<int> mates(uses.size(), -1);
  int open = 0, shared = 0;
  const EdgeUse *first_open = nullptr, *first_shared = nullptr;
  for (std::size_t i = 0, end = 0; i < uses.size(); i = end) {
    end = i + 1;
    while (end < uses.size() && uses[end].sameEdge(uses[i])) ++end;
    if (end - i == 2) {
      mates[at(uses[i].half)] = uses[i + 1].half;
      mates[at(uses[i + 1].half)] = uses[i].half;
    } else if (end - i == 1) {
      if (open++ == 0) first_open = &uses[i];
    } else {
      if (shared++ == 0) first_shared = &uses[i];
    }
  }
  if (open == 0 && shared == 0) return mates;
  const EdgeUse& edge = open > 0 ? *first_open : *first_shared;
  const std::string where =
      "from " + shown(mesh.vertices[at(edge.low)]) + " to " + shown(mesh.vertices[at(edge.high)]);
  if (open > 0)
    throw InputError("the surface is open: " + std::to_string(open) +
                     (open == 1 ? " edge has" : " edges have") + " one triangle only, the first " + where);
  throw InputError("the surface is not manifold: " + std::to_string(shared) +
                   (shared == 1 ? " edge has" : " edges have") + " more than two triangles, the first " +
                   where);
}

/// Without repeated vertices, unused ones, and triangles of less than three corners.
void weld(const SurfaceMesh& given, ClosedSurface& made) {
  const std::vector<int> first = firstAtPlace(given.vertices);
  std::vector<int> number(given.vertices.size(), -1);
  for (std::size_t t = 0; t < given.triangles.size(); ++t) {
    Triangle corners;
    for (std::size_t k = 0; k < 3; ++k) corners[k] = first[at(given.triangles[t][k])];
    if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) {
      ++made.triangles_dropped;
      continue;
    }
    for (int& v : corners) {
      if (number[at(v)] < 0) {
        number[at(v)] = static_cast<int>(made.mesh.vertices.size());
        made.mesh.vertices.push_back(given.vertices[at(v)]);
      }
      v = number[at(v)];
    }
    made.mesh.triangles.push_back(corners);
    made.source.push_back(static_cast<int>(t));
  }
}

/// Numbers the shells, and marks the triangles that are wound the other way than the first of their shell.
/// Throws InputError for a surface with one side only.
int findShells(const std::vector<int>& mates, ClosedSurface& made) {
  const std::vector<Triangle>& triangles = made.mesh.triangles;
  made.shell.assign(triangles.size(), -1);
  made.turned.assign(triangles.size(), 0);
  int shells = 0;
  std::vector<int> reached;
  for (std::size_t seed = 0; seed < triangles.size(); ++seed) {
    if (made.shell[seed] >= 0) continue;
    made.shell[seed] = shells;
    reached.assign(1, static_cast<int>(seed));
    while (!reached.empty()) {
      const int t = reached.back();
      reached.pop_back();
      for (int k = 0; k < 3; ++k) {
        const int mate = mates[at(3 * t + k)], s = mate / 3;
        const bool same_way = triangles[at(t)][at(k)] == triangles[at(s)][at(mate % 3)];
        const char turned = static_cast<char>(made.turned[at(t)] != (same_way ? 1 : 0));
        if (made.shell[at(s)] < 0) {
          made.shell[at(s)] = shells;
          made.turned[at(s)] = turned;
          reached.push_back(s);
        } else if (made.turned[at(s)] != turned) {
          throw InputError("the surface has one side only, as a Moebius strip has: seen from " +
                           shown(made.mesh.vertices[at(triangles[at(t)][0])]));
        }
      }
    }
    ++shells;
  }
  return shells;
}

double sixVolumes(const SurfaceMesh& mesh, const Triangle& t, const Vec3& origin) {
  return dot(mesh.vertices[at(t[0])] - origin,
             (mesh.vertices[at(t[1])] - origin).cross(mesh.vertices[at(t[2])] - origin));
}

/// The triangles of one shell, with the box around them.
struct Shell {
  std::vector<int> triangles;
  Eigen::AlignedBox3d bounds;
  double volume = 0.0;
  bool wound_both_ways = false;
};

/// How many times a shell winds around a point that is not on it: the solid angle of its triangles (Van
/// Oosterom and Strackee 1983) over 4 pi.
double windingAbout(const SurfaceMesh& mesh, const Shell& shell, const Vec3& p) {
  if (!shell.bounds.contains(p)) return 0.0;
  double angle = 0.0;
  for (const int t : shell.triangles) {
    const Triangle& corners = mesh.triangles[at(t)];
    const Vec3 a = mesh.vertices[at(corners[0])] - p, b = mesh.vertices[at(corners[1])] - p,
               c = mesh.vertices[at(corners[2])] - p;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    angle +=
        2.0 * std::atan2(dot(a, b.cross(c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
  }
  return angle / (4.0 * std::numbers::pi);
}

void turn(Triangle& triangle) {
  std::swap(triangle[1], triangle[2]);
}

std::vector<Shell> windShells(int count, ClosedSurface& made) {
  std::vector<Shell> shells(at(count));
  const Vec3 origin = made.mesh.vertices.front();
  for (std::size_t t = 0; t < made.mesh.triangles.size(); ++t) {
    Triangle& corners = made.mesh.triangles[t];
    Shell& shell = shells[at(made.shell[t])];
    if (made.turned[t]) {
      turn(corners);
      shell.wound_both_ways = true;
    }
    shell.triangles.push_back(static_cast<int>(t));
    shell.volume += sixVolumes(made.mesh, corners, origin) / 6.0;
    for (const int v : corners) shell.bounds.extend(made.mesh.vertices[at(v)]);
  }
  return shells;
}

/// Shells within an odd number of others are cavities and face into them; all others face outwards.
void orientShells(int count, ClosedSurface& made) {
  const std::vector<Shell> shells = windShells(count, made);
  made.within.assign(shells.size(), -1);
  for (std::size_t s = 0; s < shells.size(); ++s) {
    const Vec3& p = made.mesh.vertices[at(made.mesh.triangles[at(shells[s].triangles[0])][0])];
    int depth = 0;
    int& within = made.within[s];
    for (std::size_t other = 0; other < shells.size(); ++other) {
      if (other == s || std::abs(windingAbout(made.mesh, shells[other], p)) < 0.5) continue;
      ++depth;
      if (within < 0 || std::abs(shells[other].volume) < std::abs(shells[at(within)].volume))
        within = static_cast<int>(other);
    }
    const bool cavity = depth % 2 == 1;
    if (!cavity) within = -1;
    made.cavities += cavity ? 1 : 0;
    const bool inwards = (shells[s].volume < 0.0) != cavity;
    made.shells_turned += inwards || shells[s].wound_both_ways ? 1 : 0;
    for (std::size_t k = 0; inwards && k < shells[s].triangles.size(); ++k) {
      const std::size_t t = at(shells[s].triangles[k]);
      turn(made.mesh.triangles[t]);
      made.turned[t] = static_cast<char>(!made.turned[t]);
    }
  }
}

}  // namespace

bool isClosed(const SurfaceMesh& given) {
  ClosedSurface made;
  weld(given, made);
  const std::vector<EdgeUse> uses = edgeUses(made.mesh.triangles);
  for (std::size_t i = 0; i < uses.size(); i += 2)
    if (i + 1 >= uses.size() || !uses[i].sameEdge(uses[i + 1]) ||
        (i + 2 < uses.size() && uses[i].sameEdge(uses[i + 2])))
      return false;
  return !uses.empty();
}

ClosedSurface closedSurface(const SurfaceMesh& given) {
  for (const Vec3& p : given.vertices)
    if (!p.allFinite()) throw InputError("a vertex has a coordinate that is not finite");
  ClosedSurface made;
  weld(given, made);
  if (made.mesh.triangles.empty()) throw InputError("the surface has no triangles");
  const int shells = findShells(pairedSides(made.mesh), made);
  orientShells(shells, made);
  // Euler's formula of each closed shell: V - E + F = 2 - 2 handles, with 2 E = 3 F. A vertex at which shells
  // or parts of one touch counts for each of them; `mates` tell how many fans of triangles it has.
  std::vector<char> seen(3 * made.mesh.triangles.size(), 0);
  const std::vector<int> mates = pairedSides(made.mesh);
  int fans = 0;
  for (std::size_t corner = 0; corner < seen.size(); ++corner) {
    if (seen[corner]) continue;
    ++fans;
    for (int half = static_cast<int>(corner); !seen[at(half)];) {
      seen[at(half)] = 1;
      half = mates[at(half - half % 3 + (half + 2) % 3)];  // the side that leaves the same vertex next
    }
  }
  made.handles = shells - (fans - static_cast<int>(made.mesh.triangles.size()) / 2) / 2;
  return made;
}

MassProperties surfaceMass(const SurfaceMesh& mesh) {
  // Signed tetrahedra from the first vertex, as in mass_properties.cpp.
  MassProperties mass;
  if (mesh.vertices.empty()) return mass;
  const Vec3 origin = mesh.vertices.front();
  Vec3 first = Vec3::Zero();
  Mat3 second = Mat3::Zero();
  for (const Triangle& t : mesh.triangles) {
    const Vec3 a = mesh.vertices[at(t[0])] - origin, b = mesh.vertices[at(t[1])] - origin,
               c = mesh.vertices[at(t[2])] - origin;
    const double det = dot(a, b.cross(c));
    const Vec3 s = a + b + c;
    mass.mass += det / 6.0;
    first += det / 24.0 * s;
    second += det / 120.0 * (a * a.transpose() + b * b.transpose() + c * c.transpose() + s * s.transpose());
  }
  if (mass.mass == 0.0) return mass;
  const Vec3 center = first / mass.mass;
  const Mat3 about = second - mass.mass * center * center.transpose();
  mass.inertia = about.trace() * Mat3::Identity() - about;
  mass.center = origin + center;
  return mass;
}

}  // namespace carom
