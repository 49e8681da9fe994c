#pragma once
// What a frame draws, decided on the CPU: which instances the camera or the shadow map can see, at which
// level of detail, in which order, which one is the endless ground, and how deep the view is. Tested in
// tests/renderer/draw_list_test.cpp.

#include <optional>
#include <span>
#include <vector>

#include "renderer/frame_renderer.h"
#include "renderer/scene_geometry.h"

namespace carom::renderer {

/// Consecutive instance records that share a mesh.
struct DrawGroup {
  MeshRange range;
  int first = 0;
  int count = 0;
};

struct DrawList {
  std::vector<InstanceRecord> records;  ///< First those of `visible`, then those of `casting`.
  std::vector<DrawGroup> visible;       ///< Nearest group first.
  std::vector<DrawGroup> casting;
  std::optional<int> ground;  ///< The instance drawn as an endless plane.
  double ground_z_E = 0.0;    ///< Height of that plane above the eye.
  DepthRange depth;
};

/// Which checker instance stands for the endless ground: the lowest whose top is level.
std::optional<int> findGround(std::span<const Instance> instances, const SceneGeometry& geometry);
/// World height of the level top of an instance.
double topHeight(const Instance& instance, const SolidGeometry& solid);

/// Where and in which colour an instance is drawn.
InstanceRecord instanceRecord(const Instance& instance, const SolidGeometry& solid, const Camera& camera);

DrawList buildDrawList(std::span<const Instance> instances, const Camera& camera, const Settings& settings,
                       const SceneGeometry& geometry);

}  // namespace carom::renderer
