#pragma once
// Values of a scene file that stand in many places: numbers within their range, vectors, rotations, colours,
// looks, light. Each throws InputError with the value's place and what is accepted. Tested through
// scene_file.h.

#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "demos/format/json.h"
#include "demos/scene/scene.h"
#include "engine/foundation/frames.h"

namespace carom::demos {

/// The values that are accepted; a limit that is `open` is itself left out.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false;
};
inline constexpr Range kLength{kSmallestLength_m, kLargestLength_m};
inline constexpr Range kCoordinate{-kLargestLength_m, kLargestLength_m};
inline constexpr Range kDensity{kSmallestDensity_kgpm3, kLargestDensity_kgpm3};
inline constexpr Range kFactor{0.0, 1000.0};
inline constexpr Range kResistance{0.0, 100.0};  // metres
inline constexpr Range kExposure{0.01, 100.0};
inline constexpr Range kSpeed{-1e5, 1e5};  // m/s and rad/s

std::string plainNumber(double value);
std::string shown(const Range& range);
double readNumber(const Json& json, const Range& range);
int readWhole(const Json& json, int least, int most);
Vec3 readVec3(const Json& json, const Range& range);

/// "file:line: path", for messages about what is made of a value.
Place placeOf(const Json& json, const std::filesystem::path& file);

/// {"axis": [x, y, z], "degrees": d} or a quaternion [w, x, y, z].
Quat readRotation(const Json& json);
/// "position" and "rotation", each where it is given.
Pose readPose(const Json& json);

/// "#rrggbb", or a list of them.
renderer::Color readColor(const Json& json);
std::vector<renderer::Color> readColors(const Json& json);

/// "color", "checker", "ground", "surface" and "surfaceScale", each where it is given.
SurfaceLook readLook(const Json& material);

/// A light's name, or an object of what is not as in the one that is "like" it.
SceneLight readLight(const Json& json);

}  // namespace carom::demos
