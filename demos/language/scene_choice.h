#pragma once
// The scene and the camera that somebody chose: by name, with his own seed, duration and mesh.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "demos/scene/scene.h"
#include "demos/scene/written_files.h"

namespace carom::demos {

/// What is chosen about a scene on the command line.
struct SceneChoice {
  std::string scene;
  std::optional<double> duration_s;
  std::optional<std::uint64_t> seed;
  std::optional<std::filesystem::path> mesh;
  bool as_hull = false;               ///< Of the mesh its convex hull.
  std::vector<std::string> settings;  ///< "path=value", put into the scene.
  int threads = 0;                    ///< That step it; 0: one for each processor, at most eight.
  std::vector<NamedFile> written;     ///< By the command: nothing that the scene is made of.
};
int threadsOf(const SceneChoice& choice);
/// Reads the scene and puts the chosen seed and duration in. Throws UsageError where one of its files is to
/// be written.
Scene chosenScene(const SceneChoice& choice);

struct NamedCamera {
  std::string name;
  SceneCamera camera;
};
/// The scene's camera of that name; for an empty name "main", else its first. Where the scene has none of
/// that name: "auto" frames what moves in the run, "fit" shows everything, "orbit" circles about it,
/// "follow:BODY" looks at a body. Throws UsageError.
NamedCamera chosenCamera(const Scene& scene, const std::string& name);

}  // namespace carom::demos
