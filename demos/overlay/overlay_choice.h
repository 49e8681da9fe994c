#pragma once
// Which overlays a run draws: the names of `--overlay`, checked, in one order. Tested in
// tests/demos/overlay/overlay_choice_test.cpp.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace carom::demos {

/// In the order they are drawn.
enum class Overlay : std::uint8_t {
  kModes,
  kBounds,
  kPairs,
  kRegions,
  kSupport,
  kTrails,
  kManifold,
  kClosest,
  kNormals,
  kImpulses,
  kVelocities,
  kWindow,
  kDistance,
  kLabels,
  kStatistics,
  kTimings
};
inline constexpr std::size_t kOverlays = 16;

struct OverlayDescription {
  Overlay overlay;
  const char* name;
  const char* text;
  bool of_recordings = true;  ///< Can be drawn from a recording.
};
std::span<const OverlayDescription> overlayDescriptions();

class OverlayChoice {
 public:
  bool has(Overlay overlay) const { return chosen_[static_cast<std::size_t>(overlay)]; }
  bool any() const;
  void add(Overlay overlay) { chosen_[static_cast<std::size_t>(overlay)] = true; }
  /// The names, comma separated, always in the same order.
  std::string text() const;

 private:
  std::array<bool, kOverlays> chosen_{};
};

/// "closest,distance"; empty: none. Throws UsageError for an unknown or empty name.
OverlayChoice readOverlays(const std::string& list);

/// Throws UsageError, naming all that a recording cannot show.
void requireRecordable(const OverlayChoice& choice);

/// One line an overlay: what `--overlay help` prints.
std::string overlayHelp();

}  // namespace carom::demos
