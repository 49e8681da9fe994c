#pragma once
// What bodies and grounds look like close by: the surface a body is made of and the pattern of a level
// ground, by name. They are procedural (renderer/glsl/surface.glsl, ground_pattern.glsl): the same on every
// machine, in the body's own frame, and faded out where a pixel shows more of them than it can hold. Tested
// in tests/renderer/look/surface_test.cpp.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/foundation/frames.h"
#include "renderer/image/color.h"

namespace carom::renderer {

enum class SurfaceKind : std::uint8_t {
  kPlain,  ///< One colour under a thin coat of lacquer.
  kWood,
  kBrick,
  kConcrete,
  kSteel,
  kRubber,
  kCardboard,
  kMarble,
  kGlass,
};
inline constexpr int kSurfaceKinds = 9;

enum class GroundPattern : std::uint8_t { kChecker, kGrid, kConcrete, kPlanks, kSand, kPlain };
inline constexpr int kGroundPatterns = 6;

/// In the order of the enumerations.
const std::vector<std::string>& surfaceNames();
const std::vector<std::string>& groundNames();
const std::string& nameOf(SurfaceKind kind);
const std::string& nameOf(GroundPattern pattern);
/// The one of that name, where there is one.
std::optional<SurfaceKind> surfaceOf(const std::string& name);
std::optional<GroundPattern> groundOf(const std::string& name);

/// The lines that choose it in the shaders of bodies and grounds; none for one without a surface.
std::string shaderLines(SurfaceKind kind);
std::string shaderLines(GroundPattern pattern);

/// The mean colour of what it is made of, where nobody chooses another.
Color naturalColor(SurfaceKind kind);
Color naturalColor(GroundPattern pattern);

struct Surface {
  SurfaceKind kind = SurfaceKind::kPlain;
  double scale_m = 1.0;    ///< How long a unit of the pattern is.
  std::uint32_t seed = 0;  ///< Which part of the endless pattern the body is cut from.
  bool operator==(const Surface&) const = default;
};

/// How a surface's pattern lies in a body: which of the body's axes is the pattern's z, and the body's number
/// within [0, 1), by which no two are cut from the same place.
struct SurfaceFrame {
  int axis = 2;
  double number = 0.0;
};
/// Courses of bricks stay level in the body's frame; every other pattern lies along the longest side.
SurfaceFrame surfaceFrame(const Surface& surface, const Vec3& half_size);

/// The scale that suits a body whose middle side has this length: metres from a metre on, below that in
/// proportion, by powers of two so that bodies of about one size look alike.
double usualScale(double middle_side_m);

}  // namespace carom::renderer
