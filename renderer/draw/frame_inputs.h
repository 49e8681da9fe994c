#pragma once
// What GL is given to draw one frame, besides what stays the same while a renderer lives. All pixels follow
// from it: two frames with the same inputs are the same. Tested in
// tests/renderer/frame/frame_damage_test.cpp.

#include <cstdint>
#include <span>
#include <vector>

#include "renderer/draw/draw_list.h"
#include "renderer/draw/shaders.h"
#include "renderer/mesh/contact_occlusion.h"
#include "renderer/view/shadow_cells.h"

namespace carom::renderer {

/// A mesh drawn once, by one shader.
struct DrawnBody {
  InstanceRecord record;
  MeshRange mesh;
  BodyLook look;
};
static_assert(sizeof(DrawnBody) == sizeof(InstanceRecord) + sizeof(MeshRange) + 8, "compared as bytes");

struct FrameInputs {
  FrameBlock block{};
  bool ground_seen = false;
  GroundPattern ground_pattern = GroundPattern::kChecker;
  std::vector<DrawnBody> visible;  ///< In the order in which they are drawn.
  std::vector<DrawnBody> glass;    ///< Over all of them; whoever is behind shows, so that all is drawn anew.
  std::vector<DrawnBody> casting;  ///< Into the shadow map; their order changes nothing.
  std::vector<GroundTriangle> ground_shadows;
  std::vector<OcclusionTriangle> occlusion;
};

/// The groups' bodies, one by one.
std::vector<DrawnBody> drawnBodies(std::span<const DrawGroup> groups,
                                   std::span<const InstanceRecord> records);

/// Appends the record of a body behind `records` and to `groups`: to the last one, if it is drawn alike.
void appendTo(std::vector<DrawGroup>& groups, std::vector<InstanceRecord>& records, const DrawnBody& body);

}  // namespace carom::renderer
