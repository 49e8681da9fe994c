#pragma once
// The closest points of two features, each taken as a closed set (an edge with its ends, a face with its
// boundary): the five states of V-Clip (paper §2): V-V, V-E, V-F, E-E and E-F. The answer is reduced to the
// lowest features that hold the points, by clipping an edge against the V-planes at its ends and a face
// against its sides. For given poses the distance is a pure function of the feature pair; V-Clip's
// termination rests on that. Tested in tests/engine/closest_features/pair/feature_distance_test.cpp.

#include <cmath>
#include <limits>

#include "engine/closest_features/pair/feature.h"
#include "engine/closest_features/pair/polyhedron_pair.h"

namespace carom {

/// Edges that cross at a larger angle have a well-defined common perpendicular; at a smaller one their
/// direction is the way between them.
inline constexpr double kCrossingSine = 1e-3;

/// The closest points of two closed features, in the frame of A.
struct FeatureDistance {
  FeaturePair features;  ///< The lowest features that hold the points; never face-face or edge-face.
  Vec3 p_a = Vec3::Zero();
  Vec3 p_b = Vec3::Zero();
  double squared_m2 = 0.0;
  /// How far the witnesses are from leaving their features for lower ones; infinite at vertices.
  double inside_m = std::numeric_limits<double>::infinity();
  bool crossing = false;  ///< The edge pierces the face: the solids intersect.
  bool behind = false;    ///< V-F only: the vertex is on the inner side of the face's plane.

  double distance() const { return std::sqrt(squared_m2); }
};

/// At most one of the two features may be a face.
FeatureDistance featureDistance(const PolyhedronPair& pair, FeaturePair features);

}  // namespace carom
