// state_hashes SECONDS SCENE.json...: a line for each scene, its name and the hash of its state after so many
// seconds. What it prints is the same from every compiler and under every sanitizer (checks.sh hashes); it is
// a program of its own because the half of carom that it needs is built in half the time.

#include <cmath>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <iostream>
#include <span>

#include "demos/format/content_hash.h"
#include "demos/language/scene_file.h"
#include "demos/scene/scene_world.h"

namespace carom::demos {
namespace {

std::string hashAfter(double seconds, const std::filesystem::path& file) {
  const Scene scene = readSceneFile(file);
  SceneWorld made = makeSceneWorld(scene, std::nullopt);
  const auto steps = std::lround(seconds * scene.rate_hz);
  for (long i = 0; i < steps; ++i) made.world.step();
  return hexText(made.world.stateHash());
}

}  // namespace
}  // namespace carom::demos

int main(int argc, char** argv) {
  const std::span<char*> arguments(argv, static_cast<std::size_t>(argc));
  if (arguments.size() < 3) {
    std::cerr << "state_hashes SECONDS SCENE.json...\n";
    return 2;
  }
  try {
    const double seconds = std::strtod(arguments[1], nullptr);
    for (const char* file : arguments.subspan(2))
      std::cout << std::filesystem::path(file).stem().string() << ' '
                << carom::demos::hashAfter(seconds, file) << std::endl;
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 3;
  }
  return 0;
}
