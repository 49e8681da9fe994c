#pragma once
// The exact minimum translation of two intersecting polyhedra by the separating-axis theorem: the largest
// signed gap over all face normals and over the edge pairs whose arcs cross on the Gauss map (only those are
// faces of the Minkowski difference). Cost: faces x support + edges x edges; used when V-Clip reports an
// intersection. Tested in tests/engine/closest_features/penetration_test.cpp.

#include "engine/closest_features/feature_distance.h"

namespace carom {

/// Frame of A; `normal` from A to B. `gap_m` < 0 is minus the depth; > 0 by rounding only when they barely
/// touch.
struct MinimumTranslation {
  double gap_m = 0.0;
  Vec3 normal = Vec3::UnitZ();
  FeaturePair features;
  Vec3 p_a = Vec3::Zero();  ///< On A's surface.
  Vec3 p_b = Vec3::Zero();  ///< On B's surface; p_b - p_a = gap * normal.
};

MinimumTranslation minimumTranslation(const PolyhedronPair& pair);

}  // namespace carom
