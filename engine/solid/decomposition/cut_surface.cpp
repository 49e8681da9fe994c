#include "engine/solid/decomposition/cut_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "engine/foundation/contract.h"
#include "engine/foundation/elementary.h"
#include "engine/solid/decomposition/disjoint_sets.h"
#include "engine/solid/decomposition/polygon_triangles.h"

namespace carom {
namespace {

/// The same for a side and its mate.
int edgeOf(int half, int mate) {
  return std::min(half, mate);
}

double cross2(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Whether the ring winds around the point.
bool winds(const std::vector<int>& ring, const Vec2& q, const std::vector<Vec2>& corners) {
  const auto corner = [&](std::size_t i) { return corners[static_cast<std::size_t>(ring[i % ring.size()])]; };
  bool inside = false;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 a = corner(i), b = corner(i + 1);
    if ((a.y() > q.y()) != (b.y() > q.y()) &&
        q.x() < a.x() + (q.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()))
      inside = !inside;
  }
  return inside;
}

/// Whether one ring is in another, by the middles of its sides: rounding may put a few of them on the wrong
/// side.
bool isWithin(const std::vector<int>& inner, const std::vector<int>& outer,
              const std::vector<Vec2>& corners) {
  const auto corner = [&](std::size_t i) {
    return corners[static_cast<std::size_t>(inner[i % inner.size()])];
  };
  int votes = 0;
  for (std::size_t i = 0; i < inner.size(); ++i)
    votes += winds(outer, 0.5 * (corner(i) + corner(i + 1)), corners) ? 1 : -1;
  return votes > 0;
}

}  // namespace

/// The curves in which a plane meets a piece, from edge to edge through its triangles. A curve's number is
/// below count(), and some numbers are no curve's.
class CutSurface::Curves {
 public:
  explicit Curves(CutSurface& surface) : surface_(surface) {
    surface.node_of_point_.assign(surface.points_.size(), -1);
    surface.node_of_half_.assign(surface.mates_.size(), -1);
    for (int t = 0; t < surface.triangleCount(); ++t) {
      const Triangle& c = surface.triangle(t);
      const int side = label(c[0]);
      if (side == 0 || label(c[1]) != side || label(c[2]) != side) follow(t);
    }
  }

  /// The triangles that touch the plane, in order: few of many.
  const std::vector<int>& met() const { return met_; }
  /// The edges that cross the plane, in order.
  const std::vector<int>& crossed() const { return crossed_; }
  int ofPoint(int v) { return nodes_.rootOf(surface_.node_of_point_[at(v)]); }
  int ofEdge(int half) { return nodes_.rootOf(edgeNode(half)); }

  /// By curve: whether it is the one on which the point is, or its box meets that of a chosen one. No other
  /// can be around the point's curve or in it.
  std::vector<char> near(int own_point, const Plane& plane) {
    const std::vector<Eigen::AlignedBox2d> boxes = boxesIn(plane);
    const int own = ofPoint(own_point);
    std::vector<char> chosen(boxes.size(), 0);
    Eigen::AlignedBox2d reach = boxes[at(own)];
    chosen[at(own)] = 1;
    for (bool more = true; more;) {
      more = false;
      for (std::size_t i = 0; i < boxes.size(); ++i)
        if (!chosen[i] && !boxes[i].isEmpty() && boxes[i].intersects(reach)) {
          chosen[i] = 1;
          reach.extend(boxes[i]);
          more = true;
        }
    }
    return chosen;
  }

 private:
  int label(int v) const { return surface_.label_[at(v)]; }
  int& edgeNode(int half) { return surface_.node_of_half_[at(edgeOf(half, surface_.mate(half)))]; }

  /// The points and edges of one triangle that are on the plane or cross it are on one curve.
  void follow(int t) {
    met_.push_back(t);
    int first = -1;
    const auto meet = [&](int& node) {
      if (node < 0) node = nodes_.add();
      if (first < 0) first = node;
      nodes_.join(first, node);
    };
    for (int half = 3 * t; half < 3 * t + 3; ++half) {
      const int from = label(surface_.tail(half)), to = label(surface_.head(half));
      if (from == 0) meet(surface_.node_of_point_[at(surface_.tail(half))]);
      if (from * to < 0) {
        meet(edgeNode(half));
        if (half < surface_.mate(half)) crossed_.push_back(half);
      }
    }
  }

  std::vector<Eigen::AlignedBox2d> boxesIn(const Plane& plane) {
    const PlaneCoordinates flat{tangentBasis(plane.normal)};
    std::vector<Eigen::AlignedBox2d> boxes(at(nodes_.count()));
    for (const int t : met_)
      for (int half = 3 * t; half < 3 * t + 3; ++half) {
        const int v = surface_.tail(half);
        if (label(v) == 0) boxes[at(ofPoint(v))].extend(flat(surface_.point(v)));
        if (edgeNode(half) >= 0) boxes[at(ofEdge(half))].extend(flat(surface_.crossing(plane, half)));
      }
    return boxes;
  }

  CutSurface& surface_;
  DisjointSets nodes_;
  std::vector<int> met_, crossed_;
};

/// The curves of a section that are near the notch.
struct CutSurface::Section {
  Plane plane;
  PlaneCoordinates flat;
  std::vector<int> crossed;       // edges, in order
  std::vector<char> near_notch;   // by point: on the plane, and on a curve that is cut
  std::vector<char> edge_chosen;  // by half (of crossed edges)
  double twice_area = 0.0;
};

/// The rims of a section as rings of corners. Corner numbers are those of the rims' sides, one behind the
/// other; each stands for the side's tail.
struct CutSurface::Rims {
  std::vector<std::vector<int>> ways;
  Rings rings;
  std::vector<Vec2> corners;
  std::vector<double> twice_areas;
  std::size_t own = 0;  // the notch's

  /// The smallest ring with area on its left that the hole is in.
  std::optional<std::size_t> around(std::size_t hole) const {
    std::optional<std::size_t> smallest;
    for (std::size_t i = 0; i < rings.size(); ++i)
      if (twice_areas[i] > 0.0 && i != hole && (!smallest || twice_areas[i] < twice_areas[*smallest]) &&
          isWithin(rings[hole], rings[i], corners))
        smallest = i;
    return smallest;
  }
};

CutSurface::CutSurface(const ClosedSurface& surface, double tolerance_m)
    : tolerance_m_(tolerance_m), points_(surface.mesh.vertices), triangles_(surface.mesh.triangles) {
  std::map<std::pair<int, int>, int> half_of;
  mates_.assign(3 * triangles_.size(), -1);
  for (int half = 0; half < static_cast<int>(mates_.size()); ++half) {
    const auto other = half_of.find({head(half), tail(half)});
    if (other == half_of.end()) {
      half_of[{tail(half), head(half)}] = half;
    } else {
      pair(half, other->second);
      half_of.erase(other);
    }
  }
  REQUIRE(half_of.empty(), half_of.size());

  facets_of_.assign(triangles_.size(), -1);
  std::vector<double> area(triangles_.size());
  for (std::size_t t = 0; t < area.size(); ++t) area[t] = triangleArea(static_cast<int>(t)).norm();
  std::vector<int> order(triangles_.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return area[at(a)] > area[at(b)]; });
  for (const int t : order)
    if (facets_of_[at(t)] < 0) growFacet(t);
}

Vec3 CutSurface::triangleArea(int t) const {
  const Triangle& c = triangles_[at(t)];
  return 0.5 * (point(c[1]) - point(c[0])).cross(point(c[2]) - point(c[0]));
}

// The plane is fitted again with each triangle, so that a facet of slender triangles does not depend on the
// one it began with.
void CutSurface::growFacet(int seed) {
  const int id = static_cast<int>(facets_.size());
  Vec3 area = Vec3::Zero(), moment = Vec3::Zero();
  double weight = 0.0;
  const auto include = [&](int t) {
    const Vec3 a = triangleArea(t);
    const Triangle& c = triangles_[at(t)];
    area += a;
    weight += a.norm();
    moment += a.norm() * (point(c[0]) + point(c[1]) + point(c[2])) / 3.0;
    facets_of_[at(t)] = id;
  };
  include(seed);
  if (!(weight > 0.0)) {  // three corners on a line, beside nothing that is flat with them
    facets_.push_back({{Vec3::UnitZ(), point(triangles_[at(seed)][0]).z()}, 1.0});
    return;
  }
  std::vector<int> reached{seed};
  for (std::size_t i = 0; i < reached.size(); ++i)
    for (int k = 0; k < 3; ++k) {
      const int half = mate(3 * reached[i] + k), t = half / 3;
      if (facets_of_[at(t)] >= 0) continue;
      const Vec3 n = area.normalized(), center = moment / weight;
      const Vec3& apex = point(tail(next(next(half))));
      if (std::abs(dot(n, apex - center)) > tolerance_m_) continue;
      // A triangle that is folded back is flat, but no part of the facet.
      const Vec3 own = triangleArea(t);
      const Triangle& c = triangles_[at(t)];
      const double longest = std::max({(point(c[1]) - point(c[0])).norm(), (point(c[2]) - point(c[1])).norm(),
                                       (point(c[0]) - point(c[2])).norm()});
      if (dot(n, own) < 0.0 && own.norm() > tolerance_m_ * longest) continue;
      include(t);
      reached.push_back(t);
    }
  const Vec3 n = area.normalized();
  // How wide the facet is at least: twice its area over its longest extent.
  double longest = 0.0;
  for (const int t : reached)
    for (const int v : triangles_[at(t)])
      longest = std::max(longest, 2.0 * (point(v) - Vec3(moment / weight)).norm());
  const double width = 2.0 * weight / std::max(longest, std::numeric_limits<double>::min());
  facets_.push_back({{n, dot(n, Vec3(moment / weight))}, std::min(1.0, tolerance_m_ / width)});
}

bool CutSurface::isNotch(int half) const {
  const int f = facetOf(half), g = facetOf(mate(half));
  if (f == g) return false;
  const Facet &left = facets_[at(f)], &right = facets_[at(g)];
  const Vec3 along = (point(head(half)) - point(tail(half))).normalized();
  return dot(left.plane.normal.cross(right.plane.normal), along) < -(left.normal_error + right.normal_error);
}

std::vector<int> CutSurface::notches() const {
  std::vector<int> found;
  for (int half = 0; half < 3 * triangleCount(); ++half)
    if (half < mate(half) && isNotch(half)) found.push_back(half);
  return found;
}

bool CutSurface::divides(const Plane& plane, int half) const {
  const int f = facetOf(half), g = facetOf(mate(half));
  const Vec3 along = point(head(half)) - point(tail(half));
  const double left = dot(plane.normal, facet(f).normal.cross(along)) / along.norm();
  const double right = -dot(plane.normal, facet(g).normal.cross(along)) / along.norm();
  const double l = std::abs(left) <= facets_[at(f)].normal_error ? 0.0 : left;
  const double r = std::abs(right) <= facets_[at(g)].normal_error ? 0.0 : right;
  return l * r < 0.0 || ((l == 0.0) != (r == 0.0));
}

// The same bits from either side of the edge.
Vec3 CutSurface::crossing(const Plane& plane, int half) const {
  const int low = std::min(tail(half), head(half)), high = std::max(tail(half), head(half));
  const double l = plane.signedDistance(point(low)), h = plane.signedDistance(point(high));
  return point(low) + (l / (l - h)) * (point(high) - point(low));
}

void CutSurface::labelPoints(const NotchPlane& by) {
  label_.resize(points_.size());
  for (std::size_t v = 0; v < points_.size(); ++v) {
    const double d = by.plane.signedDistance(points_[v]);
    label_[v] = std::abs(d) <= tolerance_m_ ? 0 : d > 0.0 ? 1 : -1;
  }
  for (const int v : {tail(by.half), head(by.half)}) label_[at(v)] = 0;
  if (by.along < 0) return;
  for (std::size_t t = 0; t < triangles_.size(); ++t)
    if (facets_of_[t] == by.along)
      for (const int v : triangles_[t]) label_[at(v)] = 0;
}

CutSurface::Section CutSurface::sectionOf(const NotchPlane& by) {
  labelPoints(by);
  Curves curves(*this);
  const std::vector<char> chosen = curves.near(tail(by.half), by.plane);
  Section section;
  section.plane = by.plane;
  section.flat = {tangentBasis(by.plane.normal)};
  section.near_notch.assign(points_.size(), 0);
  section.edge_chosen.assign(mates_.size(), 0);
  for (const int t : curves.met())
    for (const int v : triangles_[at(t)])
      if (label_[at(v)] == 0) section.near_notch[at(v)] = chosen[at(curves.ofPoint(v))];
  for (const int half : curves.crossed())
    if (chosen[at(curves.ofEdge(half))]) {
      section.crossed.push_back(half);
      section.edge_chosen[at(half)] = 1;
    }
  for (const int t : curves.met()) addArea(t, section);
  return section;
}

// The area by the curves' segments, on whose left the section is: against the triangles' own direction.
void CutSurface::addArea(int t, Section& section) const {
  std::optional<Vec2> up, down;
  for (int half = 3 * t; half < 3 * t + 3; ++half) {
    const int from = label_[at(tail(half))], to = label_[at(head(half))];
    if (from * to < 0 && section.edge_chosen[at(edgeOf(half, mate(half)))])
      (to > 0 ? up : down) = section.flat(crossing(section.plane, half));
    if (to == 0 && section.near_notch[at(head(half))]) {
      const int beyond = label_[at(head(next(half)))];
      if (from * beyond < 0) (beyond > 0 ? up : down) = section.flat(point(head(half)));
    }
    if (isRim(half, section))
      section.twice_area += cross2(section.flat(point(head(half))), section.flat(point(tail(half))));
  }
  if (up && down) section.twice_area += cross2(*down, *up);
}

// Which side of the plane a triangle is on that it does not cross: one in the plane belongs to what is behind
// its face.
int CutSurface::sideOf(int t, const Section& section) const {
  for (const int v : triangles_[at(t)])
    if (label_[at(v)] != 0) return label_[at(v)];
  return dot(facet(facets_of_[at(t)]).normal, section.plane.normal) > 0.0 ? -1 : 1;
}

/// Whether the side runs along the cut, with its triangle below the plane and the other above.
bool CutSurface::isRim(int half, const Section& section) const {
  const int a = tail(half), b = head(half);
  if (label_[at(a)] != 0 || label_[at(b)] != 0) return false;
  if (!section.near_notch[at(a)] || !section.near_notch[at(b)]) return false;
  return sideOf(half / 3, section) < 0 && sideOf(mate(half) / 3, section) > 0;
}

CutEffect CutSurface::effect(std::span<const int> notches, const NotchPlane& by) {
  const Section section = sectionOf(by);
  CutEffect effect;
  effect.area_m2 = 0.5 * section.twice_area;
  for (const int half : notches) {
    const int a = tail(half), b = head(half);
    if (label_[at(a)] * label_[at(b)] < 0) effect.notches_crossed += section.edge_chosen[at(half)];
    const bool on = label_[at(a)] == 0 && label_[at(b)] == 0;
    if (on && section.near_notch[at(a)] && divides(by.plane, half)) ++effect.notches_removed;
  }
  return effect;
}

std::vector<std::vector<int>> CutSurface::shells() const {
  std::vector<int> shell_of(triangles_.size(), -1), reached;
  std::vector<std::vector<int>> found;
  for (int t = 0; t < triangleCount(); ++t) {
    if (shell_of[at(t)] < 0) {
      reached = {t};
      shell_of[at(t)] = static_cast<int>(found.size());
      for (std::size_t i = 0; i < reached.size(); ++i)
        for (int k = 0; k < 3; ++k) {
          const int beside = mate(3 * reached[i] + k) / 3;
          if (shell_of[at(beside)] >= 0) continue;
          shell_of[at(beside)] = static_cast<int>(found.size());
          reached.push_back(beside);
        }
      found.emplace_back().reserve(reached.size());
    }
    found[at(shell_of[at(t)])].push_back(t);
  }
  return found;
}

CutSurface CutSurface::part(std::span<const int> triangles) const {
  CutSurface made(tolerance_m_);
  std::vector<int> triangle_in(triangles_.size(), -1), point_in(points_.size(), -1);
  std::vector<int> facet_in(facets_.size(), -1);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    triangle_in[at(triangles[i])] = static_cast<int>(i);
    for (const int v : triangle(triangles[i])) point_in[at(v)] = 0;
    facet_in[at(facets_of_[at(triangles[i])])] = 0;
  }
  const auto keep = [](std::vector<int>& new_of, const auto& all, auto& kept) {
    for (std::size_t i = 0; i < all.size(); ++i)
      if (new_of[i] == 0) {
        new_of[i] = static_cast<int>(kept.size());
        kept.push_back(all[i]);
      }
  };
  keep(point_in, points_, made.points_);
  keep(facet_in, facets_, made.facets_);
  for (const int t : triangles) {
    const Triangle& c = triangle(t);
    made.triangles_.push_back({point_in[at(c[0])], point_in[at(c[1])], point_in[at(c[2])]});
    made.facets_of_.push_back(facet_in[at(facets_of_[at(t)])]);
    for (int half = 3 * t; half < 3 * t + 3; ++half)
      made.mates_.push_back(3 * triangle_in[at(mate(half) / 3)] + mate(half) % 3);
  }
  return made;
}

int CutSurface::addTriangle(const Triangle& corners, int facet) {
  triangles_.push_back(corners);
  facets_of_.push_back(facet);
  mates_.insert(mates_.end(), 3, -1);
  return static_cast<int>(triangles_.size()) - 1;
}

void CutSurface::pair(int half, int other) {
  mates_[at(half)] = other;
  mates_[at(other)] = half;
}

// Both triangles a b c of the edge from a to b become a p c and p b c.
void CutSurface::splitEdge(int half, int p) {
  const int other = mate(half);
  const auto divide = [&](int side) {
    const int t = side / 3;
    const int b = head(side), c = head(next(side));
    const int beyond = mate(next(side));  // of the side from b to c
    const int added = addTriangle({p, b, c}, facets_of_[at(t)]);
    triangles_[at(t)][at((side + 1) % 3)] = p;
    pair(3 * added + 1, beyond);
    moved_[next(side)] = 3 * added + 1;
    pair(3 * added + 2, next(side));
    return 3 * added;
  };
  const int second = divide(half), other_second = divide(other);
  // `half` is now a p and `other` b p; the added sides are p b and p a.
  pair(half, other_second);
  pair(second, other);
}

/// The closed ways along the rim; one that comes to a vertex twice is two.
std::vector<std::vector<int>> CutSurface::rims(const Section& section) const {
  constexpr std::size_t kNowhere = std::numeric_limits<std::size_t>::max();
  std::vector<char> taken(mates_.size(), 0);
  std::vector<std::size_t> place(points_.size(), kNowhere);  // on the way, of the sides' tails
  std::vector<std::vector<int>> found;
  const auto cutBack = [&](std::vector<int>& way, std::size_t length) {
    const auto first = way.begin() + static_cast<std::ptrdiff_t>(length);
    for (auto half = first; half != way.end(); ++half) place[at(tail(*half))] = kNowhere;
    found.emplace_back(first, way.end());
    way.erase(first, way.end());
  };
  for (int start = 0; start < 3 * triangleCount(); ++start) {
    if (taken[at(start)] || !isRim(start, section)) continue;
    std::vector<int> way;
    for (int half = start; !taken[at(half)];) {
      taken[at(half)] = 1;
      if (place[at(tail(half))] != kNowhere) cutBack(way, place[at(tail(half))]);
      place[at(tail(half))] = way.size();
      way.push_back(half);
      half = next(half);
      // Around the vertex, through what is below the plane, to where the rim goes on.
      for (std::size_t turns = 0; !isRim(half, section) && turns < mates_.size(); ++turns)
        half = next(mate(half));
    }
    cutBack(way, 0);
  }
  return found;
}

void CutSurface::splitCrossed(Section& section) {
  moved_.clear();
  for (int half : section.crossed) {
    for (auto moved = moved_.find(half); moved != moved_.end(); moved = moved_.find(half))
      half = moved->second;
    const int p = static_cast<int>(points_.size());
    points_.push_back(crossing(section.plane, half));
    label_.push_back(0);
    section.near_notch.push_back(1);
    splitEdge(half, p);
  }
}

CutSurface::Rims CutSurface::rimsAround(int notch, const Section& section) const {
  Rims found;
  found.ways = rims(section);
  for (std::size_t i = 0; i < found.ways.size(); ++i) {
    found.rings.emplace_back();
    for (const int half : found.ways[i]) {
      if (half == notch) found.own = i;
      found.rings.back().push_back(static_cast<int>(found.corners.size()));
      found.corners.push_back(section.flat(point(tail(half))));
    }
    std::reverse(found.rings.back().begin(), found.rings.back().end());
  }
  for (const std::vector<int>& ring : found.rings)
    found.twice_areas.push_back(twiceArea(ring, found.corners));
  return found;
}

bool CutSurface::cut(const NotchPlane& by) {
  Section section = sectionOf(by);
  splitCrossed(section);
  // One of the sides of the notch is the rim's, or the plane does not divide it.
  const int notch = isRim(by.half, section) ? by.half : mate(by.half);
  if (!isRim(notch, section)) return false;
  const Rims found = rimsAround(notch, section);
  const std::vector<int>& own = found.ways[found.own];
  // The region: a ring with area on its left, and the holes of which it is the smallest ring around.
  const std::optional<std::size_t> outer =
      found.twice_areas[found.own] > 0.0 ? std::optional(found.own) : found.around(found.own);
  if (!outer && own.size() == 2) {
    // Two edges between the same corners: the piece hangs together by a line there, and comes apart without
    // a cap.
    const int a = own[0], b = own[1], mate_a = mate(a), mate_b = mate(b);
    pair(a, b);
    pair(mate_a, mate_b);
    return true;
  }
  if (!outer) {
    // The same with corners on the line: its caps are triangles without area.
    double length_m = 0.0;
    for (const int half : own) length_m += (point(head(half)) - point(tail(half))).norm();
    if (std::abs(found.twice_areas[found.own]) > tolerance_m_ * length_m) return false;
    return addCaps({own}, section, by);
  }
  std::vector<std::vector<int>> chosen{found.ways[*outer]};
  for (std::size_t i = 0; i < found.rings.size(); ++i)
    if (!(found.twice_areas[i] > 0.0) && i != *outer && found.around(i) == outer)
      chosen.push_back(found.ways[i]);
  return addCaps(chosen, section, by);
}

bool CutSurface::addCaps(const std::vector<std::vector<int>>& rims, const Section& section,
                         const NotchPlane& by) {
  std::vector<Vec2> corners;
  std::vector<int> corner_points;
  std::vector<std::pair<int, int>> rim_of;  // by corner: below and above the ring's side that begins there
  Rings rings;
  for (const std::vector<int>& rim : rims) {
    const int first = static_cast<int>(corners.size()), n = static_cast<int>(rim.size());
    rings.emplace_back();
    for (int i = 0; i < n; ++i) {
      corners.push_back(section.flat(point(tail(rim[at(i)]))));
      corner_points.push_back(tail(rim[at(i)]));
      rings.back().push_back(first + n - 1 - i);  // against the rim
      const int half = rim[at((i + n - 1) % n)];
      rim_of.push_back({half, mate(half)});
    }
  }
  const std::optional<PolygonTriangles> caps = polygonTriangles(rings, corners, tolerance_m_);
  if (!caps) return false;

  const int below = by.along >= 0 ? by.along : static_cast<int>(facets_.size());
  if (by.along < 0) facets_.push_back({by.plane, 0.0});
  const int above = static_cast<int>(facets_.size());
  const double error = facets_[at(below)].normal_error;
  facets_.push_back({{-by.plane.normal, -by.plane.offset}, error});
  for (int t = 0; t < triangleCount(); ++t) {
    const Triangle& c = triangles_[at(t)];
    if (label_[at(c[0])] != 0 || label_[at(c[1])] != 0 || label_[at(c[2])] != 0) continue;
    facets_of_[at(t)] = sideOf(t, section) < 0 ? below : above;
  }
  const int lower = triangleCount();
  for (const std::array<int, 3>& t : caps->triangles)
    addTriangle({corner_points[at(t[0])], corner_points[at(t[1])], corner_points[at(t[2])]}, below);
  const int upper = triangleCount();
  for (const std::array<int, 3>& t : caps->triangles)
    addTriangle({corner_points[at(t[0])], corner_points[at(t[2])], corner_points[at(t[1])]}, above);
  // Side k of a lower triangle is side 2 - k of the upper one, the other way round.
  const auto lowerHalf = [&](SideNumber side) {
    return side >= 0 ? 3 * lower + side : rim_of[at(-1 - side)].first;
  };
  const auto upperHalf = [&](SideNumber side) {
    return side >= 0 ? 3 * upper + side / 3 * 3 + 2 - side % 3 : rim_of[at(-1 - side)].second;
  };
  for (const auto& [side, other] : caps->joins) {
    pair(lowerHalf(side), lowerHalf(other));
    pair(upperHalf(side), upperHalf(other));
  }
  return true;
}

}  // namespace carom
