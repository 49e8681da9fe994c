#pragma once
// From all corners of a contact polygon to the four that carry it. Every vertex of a quadrilateral ends one
// of its diagonals, and over a diagonal the largest quadrilateral has the farthest corners on its two sides;
// so the search goes over the diagonals from the deepest corners: exact up to 24 corners. Longer polygons are
// first thinned to the corners that stand out (Ramer 1972, Douglas and Peucker 1973) by more than what four
// corners can lose of 5 % of the area. Tested in tests/engine/contact/manifold_reduction_test.cpp.

#include <array>
#include <span>

#include "engine/contact/contact_polygon.h"

namespace carom {

/// Indices of corners, ascending.
struct KeptCorners {
  static constexpr int kMost = 4;
  int count = 0;
  std::array<int, kMost> index{};
};

/// The corners that were kept of the polygon that this one was before its bodies moved on, those that are
/// still there; one whose gap is within `same_gap_m` of the least counts as a deepest.
struct FormerCorners {
  KeptCorners kept;
  double same_gap_m = 0.0;
};
inline constexpr double kKeptArea = 0.95;  ///< Of the largest that is to be had.

/// All corners of a polygon with up to four; of a larger one a deepest corner (a gap within `same_gap_m` of
/// the least) and three more, spanning at least 95 % of the largest area that four corners with a deepest one
/// among them span. Where the gaps are all equal this is the largest area of any four. Equal choices fall to
/// the names of the corners, so that swapping or moving the bodies keeps the choice. Needs a convex polygon;
/// quadratic in its corners only where many of them are deepest. Four former corners stay as long as a
/// deepest is among them and they span `kKeptArea` of the largest area: between choices nearly as good, what
/// stands would be handed to and fro, and its loads with it.
KeptCorners reducePolygon(const ContactPolygon& polygon, double same_gap_m, const FormerCorners& former = {});

}  // namespace carom
