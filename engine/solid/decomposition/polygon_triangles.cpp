#include "engine/solid/decomposition/polygon_triangles.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

#include "engine/foundation/index.h"

namespace carom {
namespace {

/// Twice the area of a, b, c; positive where they run counter-clockwise.
double turnOf(const Vec2& a, const Vec2& b, const Vec2& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

/// On which side of the line from a to b the point p is: 1 left, -1 right, 0 on it.
int sideOf(const Vec2& a, const Vec2& b, const Vec2& p, double tolerance_m) {
  const double turn = turnOf(a, b, p);
  if (turn * turn <= tolerance_m * tolerance_m * (b - a).squaredNorm()) return 0;
  return turn > 0.0 ? 1 : -1;
}

/// Most corners are far from an ear: they are told by this, much sooner than by the sides of lines.
struct Reach {
  Vec2 lowest, highest;
  void add(const Vec2& p) {
    lowest = lowest.cwiseMin(p);
    highest = highest.cwiseMax(p);
  }
  /// Whether the way from d to e does, by being on one side of it.
  bool misses(const Vec2& d, const Vec2& e) const {
    return (d.x() < lowest.x() && e.x() < lowest.x()) || (d.x() > highest.x() && e.x() > highest.x()) ||
           (d.y() < lowest.y() && e.y() < lowest.y()) || (d.y() > highest.y() && e.y() > highest.y());
  }
};

/// A corner on the way around what is left, with the side that begins there. `beyond` says what lies on the
/// other side of that: a ring's or triangle's side, or a bridge.
struct Node {
  int corner = -1;
  int beyond = 0;
};

// Bridges have two sides each; as what lies beyond a node's side they are numbered from here on.
constexpr int kBridges = 1 << 30;

/// One ring that runs along the sides of all.
class JoinedRing {
 public:
  JoinedRing(const Rings& rings, const std::vector<Vec2>& corners, double tolerance_m)
      : corners_(corners), tolerance_m_(tolerance_m), ring_(nodesOf(rings[0])) {
    std::vector<std::vector<Node>> waiting;
    for (std::size_t i = 1; i < rings.size(); ++i) waiting.push_back(nodesOf(rings[i]));
    while (!waiting.empty() && bridgeShortest(waiting)) {
    }
    complete_ = waiting.empty();
  }
  bool complete() const { return complete_; }
  const std::vector<Node>& ring() const { return ring_; }
  int bridges() const { return bridges_; }

 private:
  struct Way {
    double length = std::numeric_limits<double>::infinity();
    std::size_t hole = 0, from = 0, to = 0;  // positions in the hole and in the ring
  };

  static std::vector<Node> nodesOf(const std::vector<int>& ring) {
    std::vector<Node> nodes;
    nodes.reserve(ring.size());
    for (const int corner : ring) nodes.push_back({corner, ringSide(corner)});
    return nodes;
  }
  const Vec2& p(const Node& node) const { return corners_[at(node.corner)]; }

  /// Joins the waiting hole that has the shortest free way to the ring; false where there is none.
  bool bridgeShortest(std::vector<std::vector<Node>>& waiting) {
    std::vector<Way> ways;
    for (std::size_t h = 0; h < waiting.size(); ++h)
      for (std::size_t i = 0; i < waiting[h].size(); ++i)
        for (std::size_t k = 0; k < ring_.size(); ++k)
          ways.push_back({(p(waiting[h][i]) - p(ring_[k])).norm(), h, i, k});
    std::sort(ways.begin(), ways.end(), [](const Way& x, const Way& y) {
      return std::tuple(x.length, x.hole, x.from, x.to) < std::tuple(y.length, y.hole, y.from, y.to);
    });
    for (const Way& way : ways) {
      if (!isFree(way, waiting)) continue;
      join(waiting[way.hole], way);
      waiting.erase(waiting.begin() + static_cast<std::ptrdiff_t>(way.hole));
      return true;
    }
    return false;
  }

  // From the ring's corner over the bridge, around the hole, and back; where the two touch no bridge is
  // needed.
  void join(const std::vector<Node>& hole, const Way& way) {
    const Node corner = ring_[way.to];
    const bool touch = way.length == 0.0;
    const int bridge = kBridges + 2 * bridges_;
    if (!touch) ++bridges_;
    std::vector<Node> joined(ring_.begin(), ring_.begin() + static_cast<std::ptrdiff_t>(way.to));
    if (!touch) joined.push_back({corner.corner, bridge});
    for (std::size_t i = 0; i < hole.size(); ++i) joined.push_back(hole[(way.from + i) % hole.size()]);
    if (!touch) joined.push_back({hole[way.from].corner, bridge + 1});
    joined.push_back(corner);
    joined.insert(joined.end(), ring_.begin() + static_cast<std::ptrdiff_t>(way.to) + 1, ring_.end());
    ring_ = std::move(joined);
  }

  bool isFree(const Way& way, const std::vector<std::vector<Node>>& waiting) const {
    const std::vector<Node>& hole = waiting[way.hole];
    const Vec2 &a = p(hole[way.from]), &b = p(ring_[way.to]);
    if (way.length == 0.0) return leadsInside(ring_, way.to, p(hole[(way.from + 1) % hole.size()]));
    if (!leadsInside(ring_, way.to, a) || !leadsInside(hole, way.from, b) || touches(ring_, a, b))
      return false;
    return std::none_of(waiting.begin(), waiting.end(),
                        [&](const std::vector<Node>& other) { return touches(other, a, b); });
  }

  /// Whether the way from a ring's corner towards `to` begins in the region on its left.
  bool leadsInside(const std::vector<Node>& ring, std::size_t i, const Vec2& to) const {
    const Vec2& before = p(ring[(i + ring.size() - 1) % ring.size()]);
    const Vec2 &here = p(ring[i]), &after = p(ring[(i + 1) % ring.size()]);
    const bool left_of_first = sideOf(before, here, to, tolerance_m_) > 0;
    const bool left_of_second = sideOf(here, after, to, tolerance_m_) > 0;
    return sideOf(before, here, after, tolerance_m_) < 0 ? left_of_first || left_of_second
                                                         : left_of_first && left_of_second;
  }

  /// Whether a side of the ring meets the way from a to b anywhere but at corners that are a or b.
  bool touches(const std::vector<Node>& ring, const Vec2& a, const Vec2& b) const {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vec2 &c = p(ring[i]), &d = p(ring[(i + 1) % ring.size()]);
      if (c == a || c == b || d == a || d == b) continue;
      if (sideOf(a, b, c, tolerance_m_) * sideOf(a, b, d, tolerance_m_) <= 0 &&
          sideOf(c, d, a, tolerance_m_) * sideOf(c, d, b, tolerance_m_) <= 0)
        return true;
    }
    return false;
  }

  const std::vector<Vec2>& corners_;
  double tolerance_m_;
  std::vector<Node> ring_;
  int bridges_ = 0;
  bool complete_ = false;
};

constexpr int kGone = -1;  // no node, or what follows one that has been clipped

/// The nodes of a ring in blocks of those that follow each other, with a box around the sides of each: what
/// is far from an ear is told a block at a time.
class RingBlocks {
 public:
  RingBlocks(std::size_t node_count, const std::vector<int>& after) : after_(after), place_(node_count) {}

  template <class PlaceOf>
  void begin(const std::vector<int>& ring, const PlaceOf& p) {
    ring_ = ring;
    blocks_.clear();
    for (std::size_t i = 0; i < ring.size(); ++i) {
      place_[at(ring[i])] = i;
      if (i % kSize == 0) blocks_.push_back({{p(ring[i]), p(ring[i])}, 0});
      Block& block = blocks_.back();
      block.box.add(p(ring[i]));
      block.box.add(p(ring[(i + 1) % ring.size()]));
      ++block.left;
    }
  }

  /// The side from `before` ends at `end` now.
  void cutOff(int ear, int before, const Vec2& end) {
    --blocks_[blockOf(ear)].left;
    blocks_[blockOf(before)].box.add(end);
  }

  /// The first node on the way around from one to another that `is_in_the_way`, or kGone; only asked of those
  /// in blocks that `reach` does not miss.
  template <class Condition>
  int first(int from, int until, const Reach& reach, const Condition& is_in_the_way) const {
    for (int k = from; k != until;) {
      const std::size_t block = blockOf(k);
      if (reach.misses(blocks_[block].box.lowest, blocks_[block].box.highest)) {
        k = blockOf(until) == block && place_[at(until)] > place_[at(k)] ? until : firstOfNext(block);
        continue;
      }
      for (; k != until && blockOf(k) == block; k = after_[at(k)])
        if (is_in_the_way(k)) return k;
    }
    return kGone;
  }

 private:
  static constexpr std::size_t kSize = 32;  // what is found is the same for any
  struct Block {
    Reach box;
    int left;
  };
  std::size_t blockOf(int node) const { return place_[at(node)] / kSize; }

  int firstOfNext(std::size_t block) const {
    do block = (block + 1) % blocks_.size();
    while (blocks_[block].left == 0);
    std::size_t i = block * kSize;
    while (after_[at(ring_[i])] == kGone) ++i;
    return ring_[i];
  }

  const std::vector<int>& after_;
  std::vector<int> ring_;
  std::vector<std::size_t> place_;  // of each node of the ring
  std::vector<Block> blocks_;
};

/// Clips ears off a ring, and takes it apart where it touches itself.
class EarClipping {
 public:
  EarClipping(const JoinedRing& joined, const std::vector<Vec2>& corners, double tolerance_m)
      : nodes_(joined.ring()),
        corners_(corners),
        tolerance_m_(tolerance_m),
        blocks_(nodes_.size(), after_),
        bridges_(joined.bridges()) {
    const int n = static_cast<int>(nodes_.size());
    for (const Node& node : nodes_)
      extent_ = std::max(extent_, (corners[at(node.corner)] - corners[at(nodes_[0].corner)]).norm());
    for (int i = 0; i < n; ++i) {
      before_.push_back((i + n - 1) % n);
      after_.push_back((i + 1) % n);
    }
    obstacles_.resize(nodes_.size());
    known_.resize(nodes_.size(), kUnknown);
    places_.resize(nodes_.size());
  }

  std::optional<PolygonTriangles> run() {
    std::vector<int> rings{0};
    while (!rings.empty()) {
      const int start = rings.back();
      rings.pop_back();
      if (!clip(start, rings)) return std::nullopt;
    }
    resolveBridges();
    return std::move(found_);
  }

 private:
  static constexpr double kNoEar = -1.0;
  static constexpr double kUnknown = -2.0;
  /// What keeps a corner from being an ear: a node, and the side that begins there.
  struct Obstacle {
    int node = kGone, after = kGone;
  };
  /// Two nodes at one place, the first before the second on the way around the ring.
  struct Touch {
    int first = kGone, second = kGone;
  };
  const Vec2& p(int node) const { return corners_[at(nodes_[at(node)].corner)]; }

  std::vector<int> ringFrom(int start) const {
    std::vector<int> ring{start};
    for (int i = after_[at(start)]; i != start; i = after_[at(i)]) ring.push_back(i);
    return ring;
  }

  /// Until nothing is left of the ring; parts of it that remain are added to `rings`.
  bool clip(int start, std::vector<int>& rings) {
    std::vector<int> ring = ringFrom(start);
    blocks_.begin(ring, [&](int node) { return p(node); });
    const std::vector<Touch> touches = touchesOf(ring);
    std::vector<double> quality;
    quality.reserve(ring.size());
    for (const int i : ring) quality.push_back(known_[at(i)] == kUnknown ? qualityOf(i) : known_[at(i)]);
    while (ring.size() > 2) {
      const std::size_t k = bestEar(ring, quality);
      if (!(quality[k] > 0.0) && comesApart(ring, quality, touches, rings)) return true;
      if (quality[k] == kNoEar) return false;
      const int ear = ring[k], before = before_[at(ear)], after = after_[at(ear)];
      cutOff(ear);
      ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(k));
      quality.erase(quality.begin() + static_cast<std::ptrdiff_t>(k));
      for (std::size_t i = 0; i < ring.size(); ++i)
        if (ring[i] == before || ring[i] == after) quality[i] = qualityOf(ring[i]);
    }
    if (ring.size() < 2) return false;  // a side without length
    join(nodes_[at(ring[0])].beyond, nodes_[at(ring[1])].beyond);
    return true;
  }

  /// The position of the first of the best; an ear that was clipped may have freed others.
  std::size_t bestEar(const std::vector<int>& ring, std::vector<double>& quality) {
    const auto best = [&] {
      return static_cast<std::size_t>(std::ranges::max_element(quality) - quality.begin());
    };
    if (const std::size_t k = best(); quality[k] > 0.0) return k;
    for (std::size_t k = 0; k < ring.size(); ++k)
      if (isFreed(ring[k])) quality[k] = qualityOf(ring[k]);
    return best();
  }

  /// Whether the ring has been taken apart.
  bool comesApart(const std::vector<int>& ring, const std::vector<double>& quality,
                  const std::vector<Touch>& touches, std::vector<int>& rings) {
    const std::optional<Touch> touch = dividing(ring, touches);
    if (!touch) return false;
    for (std::size_t k = 0; k < ring.size(); ++k) known_[at(ring[k])] = quality[k];
    takeApart(ring, *touch, rings);
    return true;
  }

  void cutOff(int ear) {
    const int before = before_[at(ear)], after = after_[at(ear)];
    const int first = 3 * static_cast<int>(found_.triangles.size());
    found_.triangles.push_back({nodes_[at(before)].corner, nodes_[at(ear)].corner, nodes_[at(after)].corner});
    join(first, nodes_[at(before)].beyond);
    join(first + 1, nodes_[at(ear)].beyond);
    nodes_[at(before)].beyond = first + 2;
    after_[at(before)] = after;
    before_[at(after)] = before;
    after_[at(ear)] = kGone;
    blocks_.cutOff(ear, before, p(after));
  }

  void join(int side, int other) { raw_joins_.push_back({side, other}); }

  /// The two sides of a bridge lie on each other: what lies on one lies on what lies on the other.
  void resolveBridges() {
    std::vector<int> on_bridge(at(2 * bridges_), 0);
    for (const auto& [side, other] : raw_joins_) {
      if (side >= kBridges) on_bridge[at(side - kBridges)] = other;
      if (other >= kBridges) on_bridge[at(other - kBridges)] = side;
    }
    const auto across = [&](int side) {
      while (side >= kBridges) side = on_bridge[at((side - kBridges) ^ 1)];
      return side;
    };
    for (const auto& [side, other] : raw_joins_) {
      const bool side_first = side < kBridges;
      if (!side_first && other >= kBridges) continue;
      const int own = side_first ? side : other, beyond = across(side_first ? other : side);
      if (own < beyond || (side_first && other < kBridges)) found_.joins.push_back({own, beyond});
    }
  }

  /// All touches of a ring, by first and then by second node on the way around.
  std::vector<Touch> touchesOf(const std::vector<int>& ring) const {
    std::vector<std::size_t> order(ring.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t k) {
      const Vec2 &a = p(ring[i]), &b = p(ring[k]);
      return std::tuple(a.x(), a.y(), i) < std::tuple(b.x(), b.y(), k);
    });
    std::vector<std::pair<std::size_t, std::size_t>> positions;
    for (std::size_t i = 0; i < order.size(); ++i)
      for (std::size_t k = i + 1; k < order.size() && p(ring[order[i]]) == p(ring[order[k]]); ++k)
        positions.emplace_back(order[i], order[k]);
    std::sort(positions.begin(), positions.end());
    std::vector<Touch> touches;
    touches.reserve(positions.size());
    for (const auto& [first, second] : positions) touches.push_back({ring[first], ring[second]});
    return touches;
  }

  /// The first of the touches that are left in a ring that parts it in two with area on the left of both or
  /// of none.
  std::optional<Touch> dividing(const std::vector<int>& ring, const std::vector<Touch>& touches) {
    if (touches.empty()) return std::nullopt;
    std::vector<double> area{0.0};  // from the first corner up to each
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Vec2 &a = p(ring[0]), &b = p(ring[k]), &c = p(ring[(k + 1) % ring.size()]);
      area.push_back(area.back() + turnOf(a, b, c));
      places_[at(ring[k])] = k;
    }
    const double least = -tolerance_m_ * static_cast<double>(ring.size()) * extent_;
    for (const Touch& touch : touches) {
      if (after_[at(touch.first)] == kGone || after_[at(touch.second)] == kGone) continue;
      const double part = area[places_[at(touch.second)]] - area[places_[at(touch.first)]] +
                          turnOf(p(ring[0]), p(touch.second), p(touch.first));
      if (part >= least && area.back() - part >= least) return touch;
    }
    return std::nullopt;
  }

  /// What is known of corners holds in the parts, but beside the touch and where what was in the way is in
  /// the other part.
  void takeApart(const std::vector<int>& ring, const Touch& touch, std::vector<int>& rings) {
    const int last = before_[at(touch.second)], first = before_[at(touch.first)];
    const auto isInner = [&](int node) {
      return places_[at(node)] >= places_[at(touch.first)] && places_[at(node)] < places_[at(touch.second)];
    };
    for (const int node : ring) {
      const int in_the_way = obstacles_[at(node)].node;
      if (in_the_way == kGone) continue;
      if (after_[at(in_the_way)] == kGone || isInner(in_the_way) != isInner(node))
        known_[at(node)] = kUnknown;
    }
    for (const int node : {touch.first, touch.second, last, first}) known_[at(node)] = kUnknown;
    after_[at(last)] = touch.first;
    before_[at(touch.first)] = last;
    after_[at(first)] = touch.second;
    before_[at(touch.second)] = first;
    rings.push_back(touch.first);
    rings.push_back(touch.second);
  }

  /// Whether what kept the corner from being an ear is there no more, or has another side behind it.
  bool isFreed(int i) const {
    const Obstacle& obstacle = obstacles_[at(i)];
    return obstacle.node >= 0 && after_[at(obstacle.node)] != obstacle.after;
  }

  /// Twice the area over the square of the longest side; kNoEar where the corner cannot be clipped.
  double qualityOf(int i) {
    obstacles_[at(i)] = {};
    const int before = before_[at(i)], after = after_[at(i)];
    const Vec2 &a = p(before), &b = p(i), &c = p(after);
    if (a == c) return kNoEar;
    const double longest =
        std::sqrt(std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()}));
    const double turn = turnOf(a, b, c);
    // A corner in the middle of a straight side has no area to clip.
    const bool straight = std::abs(turn) <= tolerance_m_ * longest;
    if (!straight && turn < 0.0) return kNoEar;
    int in_the_way = straight ? kGone : nodeWithin(before, i, after);
    if (in_the_way == kGone) in_the_way = sideAcross(before, after);
    if (in_the_way != kGone) {
      obstacles_[at(i)] = {in_the_way, after_[at(in_the_way)]};
      return kNoEar;
    }
    return straight ? 0.0 : turn / (longest * longest);
  }

  /// A node of the ring that is inside the triangle of three of them or on the open side from the last to the
  /// first.
  int nodeWithin(int before, int ear, int after) const {
    const Vec2 &a = p(before), &b = p(ear), &c = p(after);
    const Reach reach{a.cwiseMin(b).cwiseMin(c).array() - tolerance_m_,
                      a.cwiseMax(b).cwiseMax(c).array() + tolerance_m_};
    return blocks_.first(after_[at(after)], before, reach,
                         [&](int k) { return !reach.misses(p(k), p(k)) && holds(a, b, c, p(k)); });
  }

  /// Whether q is inside the triangle or on the open side from a to c.
  bool holds(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& q) const {
    if (q == a || q == b || q == c) return false;
    return sideOf(a, b, q, tolerance_m_) > 0 && sideOf(b, c, q, tolerance_m_) > 0 &&
           sideOf(c, a, q, tolerance_m_) >= 0;
  }

  /// The node at which a side of the ring begins that crosses the way from `after` to `before`.
  int sideAcross(int before, int after) const {
    const Vec2 &a = p(before), &c = p(after);
    const Reach reach{a.cwiseMin(c), a.cwiseMax(c)};
    return blocks_.first(after, before, reach, [&](int k) {
      const Vec2 &d = p(k), &e = p(after_[at(k)]);
      return !reach.misses(d, e) && sideOf(a, c, d, tolerance_m_) * sideOf(a, c, e, tolerance_m_) < 0 &&
             sideOf(d, e, a, tolerance_m_) * sideOf(d, e, c, tolerance_m_) < 0;
    });
  }

  std::vector<Node> nodes_;
  const std::vector<Vec2>& corners_;
  double tolerance_m_;
  std::vector<int> before_, after_;
  RingBlocks blocks_;                // of the ring that is clipped
  std::vector<Obstacle> obstacles_;  // by node, as are:
  std::vector<double> known_;        // qualities of those whose ring has been taken apart
  std::vector<std::size_t> places_;  // on the way around a ring that may be taken apart
  int bridges_;
  double extent_ = 0.0;
  std::vector<std::pair<int, int>> raw_joins_;
  PolygonTriangles found_;
};

}  // namespace

double twiceArea(const std::vector<int>& ring, const std::vector<Vec2>& corners) {
  double area = 0.0;
  for (std::size_t i = 1; i + 1 < ring.size(); ++i)
    area += turnOf(corners[at(ring[0])], corners[at(ring[i])], corners[at(ring[i + 1])]);
  return area;
}

std::optional<PolygonTriangles> polygonTriangles(const Rings& rings, const std::vector<Vec2>& corners,
                                                 double tolerance_m) {
  const JoinedRing joined(rings, corners, tolerance_m);
  if (!joined.complete()) return std::nullopt;
  std::optional<PolygonTriangles> found = EarClipping(joined, corners, tolerance_m).run();
  if (!found) return std::nullopt;
  // Triangles that overlap cover more than the region.
  double covered = 0.0, area = 0.0, sides = 0.0;
  for (const std::array<int, 3>& t : found->triangles)
    covered += std::abs(turnOf(corners[at(t[0])], corners[at(t[1])], corners[at(t[2])]));
  for (const std::vector<int>& ring : rings) {
    area += twiceArea(ring, corners);
    for (std::size_t i = 0; i < ring.size(); ++i)
      sides += (corners[at(ring[i])] - corners[at(ring[(i + 1) % ring.size()])]).norm();
  }
  // Each triangle is off by the tolerance times its longest side at most, which is no longer than half of all
  // rings together.
  if (covered - area > 2.0 * tolerance_m * sides * static_cast<double>(found->triangles.size()))
    return std::nullopt;
  return found;
}

}  // namespace carom
