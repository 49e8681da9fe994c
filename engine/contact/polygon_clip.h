#pragma once
// Clipping of a convex polygon, corner by corner with the features that meet there (Sutherland-Hodgman,
// CACM 17, 1974). The subject is the face or edge that lies on the other body's face; it is cut by the sides
// of that face and by the plane at height k (paper §2.4, fig. 8). Invariant: a corner's features are all that
// meet within `same_m` of it, so that a corner exactly on a side has one name however rounding falls.
// Tested in tests/engine/contact/contact_polygon_test.cpp.

#include "engine/closest_features/pair/feature.h"
#include "engine/foundation/stack_arena.h"
#include "engine/solid/convex_polyhedron.h"

namespace carom {

struct ClipCorner {
  Vec2 p = Vec2::Zero();  ///< In the plane of clipping.
  double height_m = 0.0;  ///< Of the subject above that plane.
  Feature on_subject;     ///< The subject's feature that the corner lies on.
  Feature on_clip;        ///< The clipping face's feature that the corner lies on.
  int subject_edge = -1;  ///< The subject's edge along which the way to the next corner runs; -1: none.
  int clip_edge = -1;     ///< The same for the clipping face.
  double inside_m = 0.0;  ///< Scratch of one cut: how far inside it the corner is.
};

/// Corners in order; two are a segment, one is a point.
struct ClipPolygon {
  /// With memory for as many corners.
  ClipPolygon(std::size_t most, Arena* memory) : corners(memory), scratch(memory) {
    corners.reserve(most);
    scratch.reserve(most);
  }

  ArenaVector<ClipCorner> corners;
  ArenaVector<ClipCorner> scratch;
};

/// The inner side of a line: `into` is unit, inside where into . p > offset_m.
struct ClipLine {
  Vec2 into = Vec2::Zero();
  double offset_m = 0.0;
};

/// Cuts by the side of edge `edge` of the clipping polyhedron `clip`. `subject_face` names corners inside the
/// subject. Linear in the corners.
void clipBySide(ClipPolygon& polygon, const ClipLine& side, const ConvexPolyhedron& clip, int edge,
                Feature subject_face, double same_m);

/// Cuts away what lies higher than k over the clipping face, where `corners[i].inside_m` is k less the gap,
/// already filled in.
void clipByHeight(ClipPolygon& polygon, Feature subject_face, Feature clip_face, double same_m);

}  // namespace carom
