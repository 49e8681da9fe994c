#pragma once
// The closest points of two features, each taken as a closed set (an edge with its ends, a face with its
// boundary): the five states of V-Clip (paper §2): V-V, V-E, V-F, E-E and E-F. The answer is reduced to the
// lowest features that hold the points, by clipping an edge against the V-planes at its ends and a face
// against its sides. For given poses the distance is a pure function of the feature pair; V-Clip's
// termination rests on that. Tested in tests/engine/closest_features/feature_distance_test.cpp.

#include "engine/closest_features/feature.h"
#include "engine/solid/convex_polyhedron.h"

namespace carom {

/// Two polyhedra and where the second stands in the frame of the first.
struct PolyhedronPair {
  PolyhedronPair(const ConvexPolyhedron& a_in, const Pose& X_WA, const ConvexPolyhedron& b_in,
                 const Pose& X_WB);

  Vec3 toA(const Vec3& p_B) const { return R_AB * p_B + t_AB; }
  Vec3 toB(const Vec3& p_A) const { return R_AB.transpose() * (p_A - t_AB); }
  /// The same pair seen from the other side.
  PolyhedronPair swapped() const;

  const ConvexPolyhedron& a;
  const ConvexPolyhedron& b;
  Mat3 R_AB;
  Vec3 t_AB;

 private:
  PolyhedronPair(const ConvexPolyhedron& a_in, const ConvexPolyhedron& b_in, const Mat3& R, const Vec3& t)
      : a(a_in), b(b_in), R_AB(R), t_AB(t) {}
};

/// The closest points of two closed features, in the frame of A.
struct FeatureDistance {
  FeaturePair features;  ///< The lowest features that hold the points; never face-face or edge-face.
  Vec3 p_a = Vec3::Zero();
  Vec3 p_b = Vec3::Zero();
  double distance_m = 0.0;
  bool crossing = false;  ///< The edge pierces the face: the solids intersect.
  bool behind = false;    ///< V-F only: the vertex is on the inner side of the face's plane.
};

/// At most one of the two features may be a face.
FeatureDistance featureDistance(const PolyhedronPair& pair, FeaturePair features);

}  // namespace carom
