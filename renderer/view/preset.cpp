#include "renderer/view/preset.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "engine/foundation/contract.h"
#include "engine/foundation/elementary.h"
#include "renderer/view/view.h"

namespace carom::renderer {
namespace {

constexpr double kGoldenAngle = 2.399963229728653;  // Radians: successive points of a disc's even spiral.

/// The bits of `i`, of which `count` (a power of two) has one more, in reverse order, over `count`.
double reversedBits(int i, int count) {
  int reversed = 0;
  for (int bit = 1; bit < count; bit *= 2) reversed = 2 * reversed + ((i & bit) != 0 ? 1 : 0);
  return static_cast<double>(reversed) / count;
}

/// The i-th of `count` points spread evenly over the unit disc (Vogel 1979).
Vec2 onDisc(int i, int count) {
  const double radius = std::sqrt((i + 0.5) / count);
  const SineCosine turn = sineCosine(kGoldenAngle * i);
  return {radius * turn.cosine, radius * turn.sine};
}

std::ptrdiff_t placeOf(const std::string& name, const std::vector<std::string>& names) {
  const auto found = std::find(names.begin(), names.end(), name);
  REQUIRE(found != names.end(), name);
  return found - names.begin();
}

}  // namespace

const std::vector<std::string>& presetNames() {
  static const std::vector<std::string> names{"fast", "realtime", "quality", "cinematic"};
  return names;
}

const std::vector<std::string>& styleNames() {
  static const std::vector<std::string> names{"daylight", "print"};
  return names;
}

const std::string& nameOf(Preset preset) {
  return presetNames()[static_cast<std::size_t>(preset)];
}

const std::string& nameOf(Style style) {
  return styleNames()[static_cast<std::size_t>(style)];
}

Preset presetOf(const std::string& name) {
  return static_cast<Preset>(placeOf(name, presetNames()));
}

Style styleOf(const std::string& name) {
  return static_cast<Style>(placeOf(name, styleNames()));
}

Quality qualityOf(Preset preset, Style style) {
  switch (preset) {
    case Preset::kFast:
      return {.shadow_texels = 512, .soft_look_up = false};
    case Preset::kRealtime:
      return {};
    case Preset::kQuality:
      return {.shadow_texels = 2048, .samples = 4, .sun_half_angle = 0.014};
    case Preset::kCinematic:
      break;
  }
  return {.samples = 16, .sun_half_angle = 0.05, .ground_roughness = 0.02, .mirror = style != Style::kPrint};
}

Quality qualityOf(const Settings& settings) {
  Quality quality = qualityOf(settings.preset, settings.style);
  quality.sun_half_angle *= settings.light.softness;
  quality.mirror = quality.mirror && !settings.cutout;
  return quality;
}

std::vector<Sample> samplesOf(const Quality& quality, const Vec3& to_light) {
  if (quality.samples == 1) return {{Vec2::Zero(), to_light, Vec2::Zero(), Vec2::Zero()}};
  const TangentBasis basis = tangentBasis(to_light);
  const int count = quality.samples;
  std::vector<Sample> samples;
  for (int i = 0; i < count; ++i) {
    // Hammersley's points in the pixel; the disc's in another order, so that the two do not go together.
    const Vec2 shift((i + 0.5) / count - 0.5, reversedBits(i, count) + 0.5 / count - 0.5);
    const Vec2 sun = quality.sun_half_angle * onDisc((11 * i) % count, count);
    const Vec2 shear = quality.ground_roughness * onDisc((7 * i) % count, count);
    samples.push_back({shift, (to_light + sun.x() * basis.t1 + sun.y() * basis.t2).normalized(), shear,
                       onDisc((5 * i) % count, count)});
  }
  return samples;
}

}  // namespace carom::renderer
