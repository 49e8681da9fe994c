#include "engine/contact/polygon_clip.h"

#include <algorithm>
#include <span>

namespace carom {
namespace {

constexpr std::size_t kFewCorners = 12;  // all are cut anew: quicker than to find out which are not touched

enum class Place { kInside, kOn, kOutside };

Place placeOf(double inside_m, double same_m) {
  return inside_m > same_m ? Place::kInside : inside_m < -same_m ? Place::kOutside : Place::kOn;
}

// What of the clipping polyhedron is at a place that lies both on `feature` and on `edge`. Sides that are no
// neighbours meet outside the face; unless the sides between are shorter than the tolerance, a later cut
// takes that corner away.
Feature meet(const ConvexPolyhedron& clip, Feature feature, int edge) {
  if (feature.kind == FeatureKind::kFace) return edgeFeature(edge);
  if (feature.kind == FeatureKind::kVertex || feature.index == edge) return feature;
  const Edge& x = clip.edge(feature.index);
  const Edge& y = clip.edge(edge);
  return vertexFeature(x.tail == y.tail || x.tail == y.head ? x.tail : x.head);
}

ClipCorner between(const ClipCorner& from, const ClipCorner& to) {
  const double t = from.inside_m / (from.inside_m - to.inside_m);
  ClipCorner corner = from;
  corner.p = from.p + t * (to.p - from.p);
  corner.height_m = from.height_m + t * (to.height_m - from.height_m);
  return corner;
}

// The corners that a cut touches: not inside, or next to one that is not. Empty if all are inside.
struct Touched {
  std::size_t begin = 0;
  std::size_t end = 0;
};

Touched touchedBy(std::span<const ClipCorner> corners, double same_m) {
  const std::size_t n = corners.size();
  const auto inside = [&](std::size_t i) { return corners[i < n ? i : 0].inside_m > same_m; };
  Touched touched{0, n};
  if (n <= kFewCorners) return touched;
  while (touched.begin < n && inside(touched.begin) && inside(touched.begin + 1)) ++touched.begin;
  while (touched.end > touched.begin && inside(touched.end - 1) && inside(touched.end)) --touched.end;
  return touched;
}

// Puts `fresh` in the place of the touched corners; the others stay where they are.
void splice(ArenaVector<ClipCorner>& corners, const Touched& touched, ArenaVector<ClipCorner>& fresh) {
  if (touched.begin == 0 && touched.end == corners.size()) return std::swap(corners, fresh);
  const auto at = [&](std::size_t i) { return corners.begin() + static_cast<std::ptrdiff_t>(i); };
  const std::size_t common = std::min(fresh.size(), touched.end - touched.begin);
  std::copy_n(fresh.begin(), common, at(touched.begin));
  if (touched.begin + common < touched.end) {
    corners.erase(at(touched.begin + common), at(touched.end));
  } else {
    corners.insert(at(touched.end), fresh.begin() + static_cast<std::ptrdiff_t>(common), fresh.end());
  }
}

// What is left of a polygon may be a segment: both ways along it are one then.
void joinWays(std::span<ClipCorner> corners) {
  if (corners.size() != 2) return;
  corners[0].subject_edge = std::max(corners[0].subject_edge, corners[1].subject_edge);
  corners[0].clip_edge = std::max(corners[0].clip_edge, corners[1].clip_edge);
}

// The cut itself. `name` gives a new corner its features from the stretch that it lies on; `rename` adds the
// cut to the features of a corner that lies on it; `cut_edge` is the clipping edge that the cut runs along.
template <typename Name, typename Rename>
void cut(ClipPolygon& polygon, int cut_edge, double same_m, Name&& name, Rename&& rename) {
  ArenaVector<ClipCorner>& corners = polygon.corners;
  ArenaVector<ClipCorner>& fresh = polygon.scratch;
  fresh.clear();
  const std::size_t n = corners.size();
  const auto alongTheCut = [&](ClipCorner& corner) {
    corner.subject_edge = -1;
    corner.clip_edge = cut_edge;
  };
  const Touched touched = touchedBy(corners, same_m);
  for (std::size_t i = touched.begin; i < touched.end; ++i) {
    const ClipCorner& here = corners[i];
    const ClipCorner& next = corners[i + 1 < n ? i + 1 : 0];
    const Place at_here = placeOf(here.inside_m, same_m);
    const Place at_next = placeOf(next.inside_m, same_m);
    if (at_here != Place::kOutside) fresh.push_back(here);
    if (at_here == Place::kOn) {
      rename(fresh.back());
      if (at_next == Place::kOn && cut_edge >= 0) fresh.back().clip_edge = cut_edge;
      if (at_next == Place::kOutside && n > 2) alongTheCut(fresh.back());
    }
    const bool last_of_segment = n <= 2 && i + 1 == n;  // a segment has one stretch, not two
    const bool leaves = at_here == Place::kInside && at_next == Place::kOutside;
    const bool enters = at_here == Place::kOutside && at_next == Place::kInside;
    if (last_of_segment || !(leaves || enters)) continue;
    fresh.push_back(between(here, next));
    name(fresh.back());
    if (leaves && n > 2) alongTheCut(fresh.back());
  }
  splice(corners, touched, fresh);
  if (n > 2) joinWays(corners);
}

}  // namespace

void clipBySide(ClipPolygon& polygon, const ClipLine& side, const ConvexPolyhedron& clip, int edge,
                Feature subject_face, double same_m) {
  double least = same_m + 1.0;
  for (ClipCorner& c : polygon.corners) {
    c.inside_m = side.into.x() * c.p.x() + side.into.y() * c.p.y() - side.offset_m;
    least = std::min(least, c.inside_m);
  }
  if (least > same_m) return;
  cut(
      polygon, edge, same_m,
      [&](ClipCorner& c) {
        c.on_subject = c.subject_edge >= 0 ? edgeFeature(c.subject_edge) : subject_face;
        c.on_clip = c.clip_edge >= 0 ? meet(clip, edgeFeature(c.clip_edge), edge) : edgeFeature(edge);
      },
      [&](ClipCorner& c) { c.on_clip = meet(clip, c.on_clip, edge); });
}

void clipByHeight(ClipPolygon& polygon, Feature subject_face, Feature clip_face, double same_m) {
  double least = same_m + 1.0;
  for (const ClipCorner& c : polygon.corners) least = std::min(least, c.inside_m);
  if (least > same_m) return;
  cut(
      polygon, -1, same_m,
      [&](ClipCorner& c) {
        c.on_subject = c.subject_edge >= 0 ? edgeFeature(c.subject_edge) : subject_face;
        c.on_clip = c.clip_edge >= 0 ? edgeFeature(c.clip_edge) : clip_face;
      },
      [](ClipCorner&) {});
}

}  // namespace carom
