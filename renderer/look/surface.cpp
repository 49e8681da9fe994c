#include "renderer/look/surface.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace carom::renderer {
namespace {

template <typename Kind>
std::optional<Kind> kindOf(const std::string& name, const std::vector<std::string>& names) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) return std::nullopt;
  return static_cast<Kind>(found - names.begin());
}

std::string define(const std::string& what, std::string name) {
  std::transform(name.begin(), name.end(), name.begin(),
                 [](char c) { return 'a' <= c && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; });
  return "#define " + what + "_" + name + "\n";
}

constexpr Color fromBytes(int r, int g, int b) {
  return {static_cast<float>(r) / 255.0f, static_cast<float>(g) / 255.0f, static_cast<float>(b) / 255.0f};
}

}  // namespace

const std::vector<std::string>& surfaceNames() {
  static const std::vector<std::string> names{"plain",  "wood",      "brick",  "concrete", "steel",
                                              "rubber", "cardboard", "marble", "glass"};
  return names;
}

const std::vector<std::string>& groundNames() {
  static const std::vector<std::string> names{"checker", "grid", "concrete", "planks", "sand", "plain"};
  return names;
}

const std::string& nameOf(SurfaceKind kind) {
  return surfaceNames()[static_cast<std::size_t>(kind)];
}

const std::string& nameOf(GroundPattern pattern) {
  return groundNames()[static_cast<std::size_t>(pattern)];
}

std::optional<SurfaceKind> surfaceOf(const std::string& name) {
  return kindOf<SurfaceKind>(name, surfaceNames());
}

std::optional<GroundPattern> groundOf(const std::string& name) {
  return kindOf<GroundPattern>(name, groundNames());
}

std::string shaderLines(SurfaceKind kind) {
  return kind == SurfaceKind::kPlain ? "" : "#define SURFACE\n" + define("SURFACE", nameOf(kind));
}

std::string shaderLines(GroundPattern pattern) {
  const bool has_noise = pattern == GroundPattern::kConcrete || pattern == GroundPattern::kPlanks ||
                         pattern == GroundPattern::kSand;
  return (has_noise ? "#define GROUND_NOISE\n" : "") + define("GROUND", nameOf(pattern));
}

Color naturalColor(SurfaceKind kind) {
  static constexpr std::array<Color, kSurfaceKinds> colors{
      {fromBytes(200, 200, 200), fromBytes(178, 134, 92), fromBytes(168, 84, 58), fromBytes(166, 163, 157),
       fromBytes(201, 202, 204), fromBytes(48, 48, 51), fromBytes(184, 151, 112), fromBytes(236, 233, 228),
       fromBytes(214, 240, 234)}};
  return colors[static_cast<std::size_t>(kind)];
}

Color naturalColor(GroundPattern pattern) {
  static constexpr std::array<Color, kGroundPatterns> colors{
      {fromBytes(180, 180, 182), fromBytes(188, 191, 196), fromBytes(171, 168, 162), fromBytes(164, 118, 74),
       fromBytes(214, 190, 148), fromBytes(184, 185, 188)}};
  return colors[static_cast<std::size_t>(pattern)];
}

SurfaceFrame surfaceFrame(const Surface& surface, const Vec3& half_size) {
  constexpr std::uint32_t kNumbers = 4096;
  int axis = 0;
  for (int i = 1; i < 3; ++i)
    if (half_size[i] > 1.001 * half_size[axis]) axis = i;
  return {surface.kind == SurfaceKind::kBrick ? 2 : axis,
          static_cast<double>(surface.seed % kNumbers) / kNumbers};
}

double usualScale(double middle_side_m) {
  return std::exp2(std::min(0.0, std::round(std::log2(middle_side_m))));
}

}  // namespace carom::renderer
