#pragma once
// The usual case of a depth, by itself: the facet of the Minkowski difference M = A - B that was nearest to
// the origin last time still is, or one that it leads on to, and a few numbers prove it. What they do not
// prove is left to the tracked polytope (inner_polytope.h).
//
// Down: where the foot of the origin on a facet's plane lies beyond one of its sides, the facet across that
// side is nearer: along the arc between the two normals, t from the first, M's support is D cos t + i sin t,
// with D the facet's height and i < 0 how far inside the side the foot is. A facet that holds its foot is a
// local minimum of the support. It is the least of all if the support is D or more in every direction:
// - In most directions a ball says so: M contains the difference of balls within the bodies, which has the
//   sum of their radii, about the difference of their centres, and the support radius + n . centre. It leaves
//   a cap of directions.
// - There the facet's corners say so, from its normal to where the caps that they prove end: across each
//   side, inside by i, at tan(t / 2) = i / D. Where one ends within what the balls leave, other points help
//   (cap_cover.h), or there is a direction from which M's support falls, and it goes on down there.
// Tested in tests/engine/closest_features/penetrating/warm_facet_test.cpp.

#include "engine/closest_features/penetrating/penetration.h"

namespace carom {

struct WarmFacet {
  MinimumTranslation gap;  ///< Along the facet's normal, exact.
  bool proven = false;     ///< No other facet is nearer.
  bool stale = false;      ///< Of one that is not: some facet is certain to be nearer, whichever it is.
  double inside_m = 0.0;   ///< Of one that is proven: how far the foot of the origin is inside it.
};

/// From the facet of `features` down; none where they make no facet.
std::optional<WarmFacet> nearestFacet(const PolyhedronPair& pair, FeaturePair features, double noise_m);

}  // namespace carom
