#pragma once
// A solid: one or more convex parts that move as one body. A part is a convex core grown by a rounding
// radius, so a point is a ball and a segment a capsule for one and the same algorithm. The solid's own frame
// B has its origin in the centre of mass; `origin_B()` remembers where the origin of the frame it was
// described in went. Solids are immutable; bodies refer to them by index. Tested in
// tests/engine/solid/solid_test.cpp.

#include <cstdint>
#include <vector>

#include "engine/solid/convex_polyhedron.h"
#include "engine/solid/mass_properties.h"
#include "engine/solid/surface_mesh.h"

namespace carom {

/// A convex core grown by `radius_m` >= 0.
struct ConvexPart {
  ConvexPolyhedron core;
  double radius_m = 0.0;

  /// The smallest width of the part, metres.
  double width() const { return core.width() + 2.0 * radius_m; }
};

/// A picture on a surface: rows from the top, red, green and blue of each pixel in sRGB.
struct SurfacePicture {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;
  bool operator==(const SurfacePicture&) const = default;
};

/// The surface that some parts of a solid are the pieces of: what is drawn in their place, and what their
/// mass is that of.
struct BoundingSurface {
  SurfaceMesh mesh;
  std::vector<Vec3> normals;  ///< Of each corner of each triangle, unit; or none: the triangles' own.
  std::vector<Vec3> colors;   ///< Of each triangle, red, green, blue of 0 to 1; or none.
  std::vector<char> of_part;  ///< Of each part of the solid: whether it is a piece of this.
  std::vector<Vec2> uv;       ///< Of each corner of each triangle: its place on the picture, from its upper
                              ///< left to its lower right corner (0, 0) to (1, 1), repeated beyond; or none.
  std::vector<int> picture_of;  ///< Of each triangle its picture, -1 for none; or none has one.
  std::vector<SurfacePicture> pictures;
};

class Solid {
 public:
  /// Builds a solid from parts given in one common frame, and moves it so that its centre of mass is the
  /// origin. A part is a polyhedron with or without rounding, a point with a radius, or a segment with a
  /// radius. Throws InputError when there is no part or the volume is not positive.
  explicit Solid(std::vector<ConvexPart> parts);
  /// The same with a surface, in the parts' frame, around some of them.
  Solid(std::vector<ConvexPart> parts, BoundingSurface surface);

  static Solid box(const Vec3& size_m);
  /// `size_m` is the outer size, with the rounding. A radius of half of all three sizes makes a ball, of two
  /// of them a capsule; half of one only is refused, since its core is a flat rectangle.
  static Solid roundedBox(const Vec3& size_m, double radius_m);
  static Solid ball(double radius_m);
  /// Along z; `length_m` is the distance between the centres of the caps.
  static Solid capsule(double radius_m, double length_m);
  static Solid polyhedron(ConvexPolyhedron p);

  const std::vector<ConvexPart>& parts() const { return parts_; }
  /// In frame B; empty, without triangles, where the parts' own surfaces are the solid's.
  const BoundingSurface& surface() const { return surface_; }
  bool hasSurface() const { return !surface_.mesh.triangles.empty(); }
  bool isPiece(std::size_t part) const { return hasSurface() && surface_.of_part[part] != 0; }
  /// The same body with another look: the surface, in the frame that the solid was described in, is drawn in
  /// place of all parts. It need not be closed; nothing but what is drawn follows from it.
  Solid shownAs(BoundingSurface look) const;
  /// For unit density, about the origin of B (the centre of mass).
  double volume() const { return mass_.mass; }
  const Mat3& unitInertia() const { return mass_.inertia; }
  /// Where the origin of the describing frame lies in B, metres.
  const Vec3& origin_B() const { return origin_B_; }
  /// The largest distance of any point of the solid from its centre of mass, metres.
  double radius() const { return radius_m_; }
  /// The least extent of the solid, metres, of those along its parts' faces' normals and the axes of B: the
  /// scale of its collision window. Of one part its smallest width.
  double width() const { return width_m_; }

 private:
  std::vector<ConvexPart> parts_;
  BoundingSurface surface_;
  MassProperties mass_;
  Vec3 origin_B_ = Vec3::Zero();
  double radius_m_ = 0.0;
  double width_m_ = 0.0;
};

/// The vertices and outward faces of a box centred at the origin.
ConvexPolyhedron boxPolyhedron(const Vec3& size_m);

}  // namespace carom
