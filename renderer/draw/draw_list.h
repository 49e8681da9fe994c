#pragma once
// What a frame draws, decided on the CPU: which instances the camera or the shadow map can see, at which
// level of detail, by which shader, in which order, which one is the endless ground, and how deep the view
// is. Tested in tests/renderer/draw/draw_list_test.cpp.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "renderer/draw/scene_geometry.h"
#include "renderer/image/grid_cover.h"
#include "renderer/view/projection.h"
#include "renderer/view/view.h"

namespace carom::renderer {

/// Which variant of the body shader an instance needs.
enum class BodyShader {
  kSunlit,    ///< Nothing else can darken it, or it is turned away from the sun.
  kShadowed,  ///< Shadows are looked up.
  kChecker,   ///< So they are, and level faces show a checker board.
};
inline constexpr int kBodyShaders = 3;

/// A program that draws bodies: the variant, and what is seen close by, by number.
struct BodyLook {
  BodyShader shader = BodyShader::kShadowed;
  std::int32_t finish = 0;  ///< A SurfaceKind; where it is a checker, a GroundPattern.
  auto operator<=>(const BodyLook&) const = default;
};

inline bool isGlass(const BodyLook& look) {
  return look.shader != BodyShader::kChecker && look.finish == static_cast<std::int32_t>(SurfaceKind::kGlass);
}

/// Consecutive instance records that share a mesh and a shader.
struct DrawGroup {
  MeshRange range;
  BodyLook look;
  int first = 0;
  int count = 0;
};

/// What is drawn within a block of pixels or texels.
struct BlockGroups {
  GridBlock block;
  std::vector<DrawGroup> groups;
};

struct DrawList {
  std::vector<InstanceRecord> records;  ///< Those of `visible`, of `casting`, of `glass`.
  std::vector<DrawGroup> visible;       ///< Nearest group first.
  std::vector<DrawGroup> glass;         ///< Seen through: one body each, the farthest first.
  std::vector<DrawGroup> casting;       ///< All but the ground, as the shadow map needs them.
  std::vector<DrawGroup> mirrored;      ///< The same as the camera would see them, where the ground mirrors.
  std::optional<int> ground;            ///< The instance drawn as an endless plane.
  double ground_z_E = 0.0;              ///< Height of that plane above the eye.
  DepthRange depth;
};

/// Which checker instance stands for the endless ground: the lowest whose top is level.
std::optional<int> findGround(std::span<const Instance> instances, const SceneGeometry& geometry);
/// World height of the level top of an instance.
double topHeight(const Instance& instance, const SolidGeometry& solid);

/// Where and in which colour an instance is drawn.
InstanceRecord instanceRecord(const Instance& instance, const SolidGeometry& solid, const Camera& camera);

/// `lights` has one of every instance; a visible one is drawn twice where that saves looking up
/// shadows on some of its faces.
DrawList buildDrawList(std::span<const Instance> instances, const Camera& camera, const Settings& settings,
                       const SceneGeometry& geometry, std::span<const FaceLight> lights);

}  // namespace carom::renderer
