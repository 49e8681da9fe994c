// `carom new`: a scene to begin with, which says in comments what can be changed. Tested in
// tests/demos/program/new_program_test.cpp.
#include "demos/command/command.h"

#include <iostream>

#include "demos/system/atomic_file.h"

namespace carom::demos {
namespace {

constexpr char kScene[] =
    R"json(// A scene of Carom. Metres, kilograms, seconds; z is up. Comments are allowed, unknown keys are not.
//   carom check FILE      says what is wrong, all of it, with line and column
//   carom render FILE     draws frames (-o clip.apng: a moving picture, -o still.png: one picture)
// All keys with their meanings: assets/scene.schema.json, and demos/manual/scene-language.md.
{
  "format": 1,
  "description": "a ball rolls down a ramp into a stack of crates",
  "duration": 4,
  // Names for numbers, which "=..." reckons with. carom render FILE --set set.rows=5 changes one for a run.
  "set": { "rows": 3, "size": 0.3 },
  // Friction and restitution of two bodies combine; density in kg/m^3.
  "materials": {
    "floor": { "staticFriction": 0.6, "dynamicFriction": 0.5, "checker": true },
    "wood": { "staticFriction": 0.6, "dynamicFriction": 0.5, "restitution": 0.2, "density": 600 },
    "steel": { "staticFriction": 0.5, "dynamicFriction": 0.4, "restitution": 0.3, "density": 7800, "color": "#8a9099" }
  },
  "bodies": [
    // "static" never moves. A box is given by its whole sizes, and stands where its middle is.
    { "name": "floor", "shape": { "box": [20, 20, 1] }, "position": [0, 0, -0.5], "static": true, "material": "floor" },
    { "name": "ramp", "shape": { "wedge": [2, 1, 1] }, "position": [-2, 0, 0.5], "static": true, "material": "wood",
      "color": "#c9a26b" },
    // Just above the ramp: bodies must not overlap at the start.
    { "name": "ball", "shape": { "sphere": { "radius": 0.2 } }, "position": [-2.6, 0, 1.05], "material": "steel" },
    // A loop: i is 0, 1, 2 ... rows - 1. "repeat" makes copies along any direction.
    { "for": { "i": "=rows" }, "bodies": [
      { "name": "row{i}", "shape": { "box": ["=size", "=size", "=size"] }, "material": "wood",
        "position": [0.6, "=-size", "=size*(i + 0.5) + 0.001*i"],
        "repeat": { "count": 3, "step": [0, "=size + 0.005", 0] } } ] }
  ],
  "cameras": { "main": { "eye": [3, -5, 2.5], "target": [-0.8, 0, 0.5], "fovDegrees": 40 } }
}
)json";

}  // namespace

ExitCode newScene(const NewOptions& options) {
  const std::filesystem::path& path = options.output;
  if (path.extension() != ".json")
    throw UsageError("new: " + path.string() + ": accepted: a name that ends in .json");
  std::error_code ignored;
  if (std::filesystem::exists(std::filesystem::symlink_status(path, ignored)))
    throw CannotWrite("cannot write " + path.string() + ": it is there already; accepted: another name");
  AtomicFile file(path);
  file.write(std::string_view(kScene));
  file.commit();
  std::cout << path.string() << ": a scene to begin with; carom check " << path.string() << ", carom render "
            << path.string() << " -o clip.apng\n";
  return ExitCode::kOk;
}

}  // namespace carom::demos
