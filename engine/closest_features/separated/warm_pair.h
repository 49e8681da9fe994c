#pragma once
// The usual case of a query, by itself: the pair that was closest last time still is, or one that it leads on
// to, and by more than rounding could hide. Each case measures the witnesses inside their features and the
// slopes along all ways off them at once. Where that fails it says where to go on, as V-Clip does (paper §2);
// but nothing hangs on it: a few pairs are tried, each that is clear has been proven, and anything less is
// left to the walk (feature_walk.h). Tested in tests/engine/closest_features/separated/warm_pair_test.cpp.

#include "engine/closest_features/pair/core_answer.h"

namespace carom {

/// A polyhedron where it stands, in the axes of the world from any origin: of a pair in place few vectors are
/// asked for, and to turn each costs less than to find the pose of one body in the frame of the other.
struct PlacedPolyhedron {
  PlacedPolyhedron(const ConvexPolyhedron& body, const Quat& rotation, const Vec3& centre)
      : polyhedron(body), R_WB(Rotation(rotation).matrix()), origin_W(centre) {}

  Vec3 point(const Vec3& p_B) const { return R_WB * p_B + origin_W; }
  Vec3 direction(const Vec3& d_B) const { return R_WB * d_B; }
  Vec3 pointBack(const Vec3& p_W) const { return directionBack(p_W - origin_W); }
  Vec3 directionBack(const Vec3& d_W) const { return R_WB.transpose() * d_W; }

  const ConvexPolyhedron& polyhedron;
  Mat3 R_WB;
  Vec3 origin_W;
};

/// The gap of two placed polyhedra, in the axes and from the origin of their places.
struct PlacedGap {
  double length_m;
  Vec3 normal;  ///< Unit, from A to B.
  Vec3 p_a;     ///< The witness on A; that on B is across the gap.
};

/// Whether `features` are certified to be the closest: witnesses farther than `noise_m` inside their
/// features, and every end of a feature's neighbours farther than that behind its support plane. Fills `gap`
/// if so.
bool certifiedClosest(const PlacedPolyhedron& a, const PlacedPolyhedron& b, FeaturePair features,
                      double noise_m, PlacedGap& gap);

/// What became of a few pairs that were asked in place.
struct PairsInPlace {
  int visited = 0;
  bool found = false;  ///< The last one is clear.
};

/// The same, asked of `features` and of what they lead on to, a few pairs, until one is clear; of the
/// vertices that face each other instead, where `features` are none of these bodies' or far from what is
/// closest. `features` are then the clear ones, or where to look further.
PairsInPlace findCertifiedClosest(const PlacedPolyhedron& a, const PlacedPolyhedron& b, double noise_m,
                                  FeaturePair& features, PlacedGap& gap);

/// The vertices that face each other along the line of centres: where to start when nothing is remembered.
FeaturePair facingFeatures(const PlacedPolyhedron& a, const PlacedPolyhedron& b);

/// The same questions about the facet of a minimum translation, F-V or E-E: whether the witnesses in `answer`
/// are inside its features, and whether these are the only ones that touch along its normal. False of others.
bool certifiedInside(const PolyhedronPair& pair, const CoreAnswer& answer, double noise_m);
bool certifiedAlone(const PolyhedronPair& pair, const CoreAnswer& answer, double noise_m);

}  // namespace carom
