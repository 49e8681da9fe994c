#include "demos/cli/shared_options.h"

namespace carom::demos {
namespace {

constexpr int kMostThreads = 64;

}  // namespace

void addMeshOptions(CLI::App& command, SceneChoice& choice) {
  command.add_option("--mesh", choice.mesh, "A mesh file in place of the scene's replaceable ones");
  command.add_flag("--hull", choice.as_hull,
                   "Its convex hull, or that of each of its meshes, in place of the mesh");
}

void addSettings(CLI::App& command, SceneChoice& choice) {
  command
      .add_option("--set", choice.settings,
                  "PATH=VALUE put into the scene, such as bodies.crate.position=[0,0,3] or set.n=5")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

void addSceneOptions(CLI::App& command, SceneChoice& choice) {
  command.add_option("SCENE", choice.scene, "A shipped scene's name (see list) or a path to a .json file")
      ->required();
  command.add_option("--duration", choice.duration_s, "Seconds instead of the scene's own");
  command.add_option("--seed", choice.seed, "Seed of the scene's jitter")->check(CLI::Range(0, kMostSeed));
  addMeshOptions(command, choice);
  addSettings(command, choice);
}

void addThreadsOption(CLI::App& command, SceneChoice& choice) {
  command
      .add_option(
          "--threads", choice.threads,
          "That step large islands together (0: one for each processor); states are the same for any number")
      ->check(CLI::Range(0, kMostThreads))
      ->capture_default_str();
}

void addTellingOptions(CLI::App& command, Telling& telling) {
  command
      .add_option("--progress", telling.progress,
                  "json, none, or auto: redrawn on a terminal, else a line a second")
      ->check(CLI::IsMember({"json", "none", "auto"}));
  command.add_flag("-q,--quiet", telling.quiet,
                   "No progress and no summary, only errors and what was asked for");
}

void addGlOption(CLI::App& command, std::string& gl) {
  command
      .add_option(
          "--gl", gl,
          "Who makes the GL context: osmesa, egl without a surface, or auto: osmesa where it is, else egl")
      ->check(CLI::IsMember(renderer::backendNames()))
      ->capture_default_str();
}

void addLightOption(CLI::App& command, std::string& light) {
  command.add_option("--light", light, "In place of the scene's own light")
      ->check(CLI::IsMember(renderer::lightNames()));
}

void addPresetOption(CLI::App& command, std::string& preset) {
  command.add_option("--preset", preset, "How much a frame may cost")
      ->check(CLI::IsMember(renderer::presetNames()))
      ->capture_default_str();
}

void addTrajectoryOptions(CLI::App& command, TrajectoryPaths& paths) {
  command.add_option(
      "--csv", paths.csv,
      "One row a body and frame: poses, velocities, modes; to a file or - for standard output");
  command.add_option("--npy", paths.npy, "A folder of NumPy arrays: times, poses, velocities, modes, names");
}

}  // namespace carom::demos
