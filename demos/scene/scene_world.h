#pragma once
// From a described scene to a world that is ready to step, with the names and looks of its bodies beside it.
// Repeated bodies are laid out here; their jitter comes from an integer generator of our own, so that a seed
// gives the same scene everywhere. Tested in tests/demos/scene/scene_world_test.cpp.

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "demos/asset/mesh_solid.h"
#include "demos/scene/scene.h"
#include "engine/foundation/contract.h"
#include "engine/simulation/world.h"
#include "renderer/frame/frame_renderer.h"

namespace carom::demos {

/// Indices are those of the world's bodies.
struct SceneWorld {
  World world;
  std::vector<std::string> names;  ///< "crate", or "crate[7]" for the copies of a repeated body.
  std::vector<SurfaceLook> looks;
  std::vector<renderer::Surface> surfaces = {};  ///< The looks' as they are drawn.
  std::vector<std::pair<std::string, MeshReport>> meshes =
      {};  ///< What was made of mesh files, by the body's name.
  /// The places of what moves in the whole run (run_extent.h): runs the scene once, in a world of its own.
  std::function<std::vector<Vec3>()> movedPoints = {};
  std::vector<Solid> looking_otherwise = {};  ///< Solids as they are drawn, where some body has a "visual":
                                              ///< the world's own, then the others.
  std::vector<int> drawn_as = {};             ///< Of each body the solid that is drawn, then; else none.

  std::span<const Solid> drawnSolids() const {
    return looking_otherwise.empty() ? std::span<const Solid>(world.solids()) : looking_otherwise;
  }
  int drawnSolid(std::size_t body) const {
    return drawn_as.empty() ? world.bodies()[body].solid : drawn_as[body];
  }
  /// The body's solid as it is drawn: for all that is shown, framed or measured on pictures.
  const Solid& drawn(std::size_t body) const {
    return drawnSolids()[static_cast<std::size_t>(drawnSolid(body))];
  }
  bool looksOtherwise(std::size_t body) const { return drawnSolid(body) != world.bodies()[body].solid; }
  /// The largest distance of any point of it from the body's centre of mass, metres.
  double drawnRadius(std::size_t body) const;
};

/// A scene whose bodies overlap, or that touch and have no room to part.
class OverlapsAtStart : public InputError {
 public:
  OverlapsAtStart(const std::string& line, std::vector<std::string> all)
      : InputError(line), pairs(std::move(all)) {}
  std::vector<std::string> pairs;  ///< A line each, deepest first: both names, the depth, where.
};

/// `threads` step it (WorldSettings). Throws InputError when `mesh` is given and no hull of the scene is
/// replaceable, when a shape encloses no volume, and OverlapsAtStart.
SceneWorld makeSceneWorld(const Scene& scene, const std::optional<std::filesystem::path>& mesh,
                          int threads = 1);

/// What the renderer is to draw for these states of the scene's bodies.
std::vector<renderer::Instance> drawnInstances(const SceneWorld& scene, std::span<const BodyState> states);

/// Fingerprint of the scene's file, its meshes' files and its seed.
std::uint64_t sceneHash(const Scene& scene, const std::optional<std::filesystem::path>& mesh);

}  // namespace carom::demos
