#pragma once
// A closed surface of triangles: what bounds a solid that need not be convex. `closedSurface` makes one of
// the triangles of a file: corners at equal places become one vertex, every edge must have two triangles, and
// the triangles are turned so that they run counter-clockwise seen from outside, around cavities too. Tested
// in tests/engine/solid/surface_mesh_test.cpp.

#include <array>
#include <vector>

#include "engine/foundation/frames.h"
#include "engine/solid/mass_properties.h"

namespace carom {

using Triangle = std::array<int, 3>;

struct SurfaceMesh {
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
};

/// A surface that bounds a volume, and how it was made of what was given.
struct ClosedSurface {
  SurfaceMesh mesh;
  std::vector<int> shell;     ///< Of each triangle: the connected surface that it is of.
  std::vector<int> within;    ///< Of each shell: the shell whose inside it is a cavity of, or -1.
  std::vector<int> source;    ///< Of each triangle: its number among those given.
  std::vector<char> turned;   ///< Of each triangle: whether its corners' order was reversed.
  int handles = 0;            ///< Holes right through: the genus of all shells together.
  int cavities = 0;           ///< Shells within another.
  int shells_turned = 0;      ///< Shells that faced inwards, or were wound both ways.
  int triangles_dropped = 0;  ///< With two corners at one place.
};

/// Throws InputError, with the place, for a surface that is open or of which an edge has more than two
/// triangles, and for one that encloses no volume.
ClosedSurface closedSurface(const SurfaceMesh& given);

/// Whether every edge of the triangles, whose corners at equal places count as one, has exactly two.
bool isClosed(const SurfaceMesh& given);

/// Of what the surface encloses, by the divergence theorem; the volume is negative where it faces inwards.
MassProperties surfaceMass(const SurfaceMesh& mesh);

}  // namespace carom
