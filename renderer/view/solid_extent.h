#pragma once
// How much room a solid takes: the box around it, and for each part the rounded box nearest to its shape,
// which stands for the part where only its rough form matters (contact shadows). Exact for balls, capsules
// and boxes. Tested in tests/renderer/view/solid_extent_test.cpp.

#include <vector>

#include "engine/solid/solid.h"

namespace carom::renderer {

/// The axis-aligned box around a solid in its own frame.
struct Extent {
  Vec3 center = Vec3::Zero();
  Vec3 half = Vec3::Zero();
};
Extent solidExtent(const Solid& solid);
/// Appends the box's eight corners, placed by the pose.
void addCorners(const Extent& extent, const Pose& X_WB, std::vector<Vec3>& corners_W);

/// Whether it is drawn as one ball; whether a ball or capsule is drawn among its parts.
bool isBall(const Solid& solid);
bool hasRoundPart(const Solid& solid);

/// A box with half sizes `half`, grown by `radius`, in a frame R of its own.
struct RoundedBox {
  Pose X_BR;
  Vec3 half = Vec3::Zero();
  double radius = 0.0;
  int part = 0;  ///< Whose faces others darken; -1: none, as those of a surface's piece are not all seen.

  /// Half the smallest width, metres.
  double size() const { return half.minCoeff() + radius; }
  /// Half the largest width, metres.
  double span() const { return half.maxCoeff() + radius; }
};
RoundedBox roundedBox(const ConvexPart& part);

/// One of each part.
std::vector<RoundedBox> occludingBoxes(const Solid& solid);

}  // namespace carom::renderer
