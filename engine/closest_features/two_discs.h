#pragma once
// How far two facets that share a side reach between them. Of the first, the foot of the origin is known, and
// how near to that side it is; both are represented by discs that touch the side beside the foot. Tested in
// tests/engine/closest_features/two_discs_test.cpp.

namespace carom {

/// Lengths in metres.
struct TwoDiscs {
  double depth_m = 0.0;       ///< The height of the first facet's plane over the origin.
  double near_m = 0.0;        ///< From the foot to the side; not negative.
  double radius_m = 0.0;      ///< Of the first disc.
  double across_m = 0.0;      ///< The radius of the second, on the other side.
  double lean_cosine = 1.0;   ///< Of the angle between the facets' normals ...
  double lean_tangent = 0.0;  ///< ... by which the second leans back.
};

/// Whether in every direction within the angle t0 of the first facet's normal, given by tan(t0 / 2), the
/// support of one of the discs is `depth_m` or more. May be false where it is, not the other way round; above
/// 90 degrees it is false.
bool reachWithin(double half_tangent, const TwoDiscs& discs);

}  // namespace carom
