#pragma once
// The solids' triangles on the GPU's side, uploaded once: every solid at several levels of detail in one
// vertex and one index buffer. Tested through the frames of tests/renderer/frame/frame_renderer_test.cpp.

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "renderer/draw/picture_array.h"
#include "renderer/gl/gl_functions.h"
#include "renderer/mesh/face_light.h"
#include "renderer/view/solid_extent.h"

namespace carom::renderer {

inline constexpr int kDetailLevels = 5;
inline constexpr int kSharpLevel = 0;       ///< The level without bevels.
inline constexpr int kLastShadedLevel = 2;  ///< The last level with bevels in its normals alone.

/// The level for a solid whose radius is `radius_px` on the image: bevels narrower than a pixel are left out,
/// and the sides of a ball's silhouette deviate by less than a quarter of a pixel (up to the finest level's
/// 1000 pixels).
int detailLevel(double radius_px);

/// Whether the faces of a solid with lit faces can be drawn one without the other at this level.
bool drawsSingleFaces(int level);

/// A range of the index buffer, and the box around its vertices in the solid's frame.
struct MeshRange {
  std::size_t first_byte = 0;
  GLsizei count = 0;
  GLint base_vertex = 0;
  float center[3] = {};
  float half[3] = {};
  bool operator==(const MeshRange&) const = default;
};

struct SolidGeometry {
  std::array<MeshRange, kDetailLevels> levels;
  std::array<MeshRange, kDetailLevels> casting;  ///< What casts the shadow of each level.
  MeshRange flat_parts;                          ///< The parts without rounding, unbevelled.
  Extent extent;
  std::vector<RoundedBox> boxes;  ///< What darkens others: see occludingBoxes.
  double bevel_m = 0.0;           ///< Infinite where rounding decides the level.
  bool is_curved = false;         ///< Has bevels of triangles on all levels but the sharp one.
  bool is_ball = false;
  bool is_round = false;  ///< Has a ball or capsule among its parts.
};

/// What changes per drawn body: the rows of X_EB, the colour, which faces are drawn and which of them the sun
/// reaches if nothing is looked up (see the body shader).
struct InstanceRecord {
  float rows[3][4];
  float color[4];
  FaceMask faces;
  FaceMask sunlit;
  float finish[4];  ///< Of its surface: 1 / scale, which axis lies along it, the body's number in [0, 1).
  float half[4];    ///< Half its size.
};

class SceneGeometry {
 public:
  SceneGeometry(const GlFunctions& gl, std::span<const Solid> solids);

  const SolidGeometry& solid(int index) const { return solids_[static_cast<std::size_t>(index)]; }
  /// Those of the solids' surfaces: bound while bodies are drawn.
  const PictureArray& pictures() const { return pictures_; }
  int solidCount() const { return static_cast<int>(solids_.size()); }

  /// Makes `records` the instances that draws refer to by index.
  void uploadInstances(const GlFunctions& gl, std::span<const InstanceRecord> records) const;
  void draw(const GlFunctions& gl, const MeshRange& range, int first_instance, int count) const;

 private:
  std::vector<SolidGeometry> solids_;
  PictureArray pictures_;
  GLuint vertex_array_ = 0;
  GLuint instance_buffer_ = 0;
};

}  // namespace carom::renderer
