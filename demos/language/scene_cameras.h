#pragma once
// The cameras of a scene file: what stands, frames, follows, circles, goes from keyframe to keyframe or along
// a path. Tested in tests/demos/language/scene_cameras_test.cpp.

#include <string>
#include <vector>

#include "demos/format/json.h"
#include "demos/scene/scene.h"

namespace carom::demos {

/// The names of all copies, in the order of the scene and sorted.
struct BodyNames {
  explicit BodyNames(const std::vector<Body>& bodies);
  /// Throws InputError at `place` with the nearest name where there is no such body.
  void require(const std::string& name, const Json& place) const;

  std::vector<std::string> in_order, sorted;
};

/// One of "eye" and "target", "fit", "frame", "follow", "orbit", "keyframes", "dolly"; a dolly takes
/// `duration_s` unless it says otherwise. Throws InputError.
SceneCamera readCamera(const Json& json, const BodyNames& names, double duration_s);

}  // namespace carom::demos
