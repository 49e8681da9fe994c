#include "demos/overlay/overlay_choice.h"

#include <algorithm>
#include <sstream>
#include <vector>

#include "demos/format/nearest_name.h"
#include "demos/system/exit_code.h"

namespace carom::demos {
namespace {

constexpr std::array<OverlayDescription, kOverlays> kDescriptions = {{
    {Overlay::kModes, "modes", "bodies in the colours of their modes, with a legend"},
    {Overlay::kBounds, "bounds", "the bounds that bodies sweep in the step", false},
    {Overlay::kPairs, "pairs", "candidate pairs: bodies whose swept bounds meet, and where", false},
    {Overlay::kRegions, "regions", "the V-regions of the closest features of the nearest pair"},
    {Overlay::kSupport, "support", "support polygons with the projected centres of mass"},
    {Overlay::kTrails, "trails", "where the centres of mass were in the last two seconds"},
    {Overlay::kManifold, "manifold", "contact polygons and points, with the features that name them"},
    {Overlay::kClosest, "closest", "closest features and witness points of the nearest pairs"},
    {Overlay::kNormals, "normals", "contact normals, from body A to body B"},
    {Overlay::kImpulses, "impulses", "impulses of contacts and collisions as arrows", false},
    {Overlay::kVelocities, "velocities", "velocities of the centres of mass, and angular velocities"},
    {Overlay::kWindow, "window", "gauges of the collision window with the gaps in it"},
    {Overlay::kDistance, "distance", "the distances of the nearest pairs"},
    {Overlay::kLabels, "labels", "the bodies' names"},
    {Overlay::kStatistics, "statistics", "a panel: time, frame, modes, smallest gap, energy"},
    {Overlay::kTimings, "timings", "a panel: milliseconds a phase (different in every run)", false},
}};

// A name more of a list.
void append(std::string& list, const char* name, const char* separator) {
  if (!list.empty()) list += separator;
  list += name;
}

}  // namespace

std::span<const OverlayDescription> overlayDescriptions() {
  return kDescriptions;
}

bool OverlayChoice::any() const {
  return std::any_of(chosen_.begin(), chosen_.end(), [](bool chosen) { return chosen; });
}

std::string OverlayChoice::text() const {
  std::string text;
  for (const OverlayDescription& d : kDescriptions)
    if (has(d.overlay)) append(text, d.name, ",");
  return text;
}

OverlayChoice readOverlays(const std::string& list) {
  OverlayChoice choice;
  if (list.empty()) return choice;
  std::vector<std::string> names;
  for (const OverlayDescription& d : kDescriptions) names.emplace_back(d.name);
  std::size_t begin = 0;
  while (begin <= list.size()) {
    const std::size_t end = std::min(list.find(',', begin), list.size());
    const std::string name = list.substr(begin, end - begin);
    const auto known = std::find(names.begin(), names.end(), name);
    if (known == names.end())
      throw UsageError("--overlay: no overlay \"" + name + "\"" + acceptedNames(name, names));
    choice.add(kDescriptions[static_cast<std::size_t>(known - names.begin())].overlay);
    begin = end + 1;
  }
  return choice;
}

void requireRecordable(const OverlayChoice& choice) {
  std::string refused, accepted;
  for (const OverlayDescription& d : kDescriptions) {
    std::string& names = d.of_recordings ? accepted : refused;
    if (d.of_recordings || choice.has(d.overlay)) append(names, d.name, ", ");
  }
  if (refused.empty()) return;
  throw UsageError("--overlay: a recording does not hold what " + refused +
                   " would show; accepted with --from: " + accepted);
}

std::string overlayHelp() {
  std::ostringstream out;
  for (const OverlayDescription& d : kDescriptions) {
    const std::string name = d.name;
    out << name << std::string(12 - name.size(), ' ') << d.text
        << (d.of_recordings ? "" : " (not with --from)") << '\n';
  }
  return out.str();
}

}  // namespace carom::demos
