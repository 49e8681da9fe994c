#pragma once
// What a query finds out about the polyhedra of two parts, before their radii are taken off, and the
// direction across a pair of features. Tested in tests/engine/closest_features/vclip_test.cpp.

#include "engine/closest_features/pair/feature_distance.h"

namespace carom {

/// The gap of two polyhedra with its normal (unit, from A to B) and witnesses, in the frame of A.
struct CoreAnswer {
  double gap_m = 0.0;
  Vec3 normal = Vec3::UnitZ();
  Vec3 p_a = Vec3::Zero();
  Vec3 p_b = Vec3::Zero();
  FeaturePair features;
};

/// The way from A to B across a pair of features, of any length. A face's normal and the common perpendicular
/// of two edges are exact; the difference of the witnesses is as good as it is long.
struct Across {
  Vec3 w;
  double length;
  bool exact;
  Vec3 unit() const { return w / length; }
};

Across acrossOf(const PolyhedronPair& pair, const FeatureDistance& d);

/// The distance of two features as the gap of their polyhedra.
CoreAnswer answerFrom(const PolyhedronPair& pair, const FeatureDistance& found);

}  // namespace carom
