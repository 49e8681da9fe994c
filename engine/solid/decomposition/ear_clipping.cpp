#include "engine/solid/decomposition/ear_clipping.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <queue>
#include <tuple>
#include <utility>

#include "engine/foundation/index.h"
#include "engine/solid/decomposition/plane_sides.h"

namespace carom {
namespace {

/// Most corners are far from an ear: they are told by this, much sooner than by the sides of lines.
struct Reach {
  Vec2 lowest = Vec2::Constant(std::numeric_limits<double>::infinity());
  Vec2 highest = -lowest;
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

constexpr int kNoNode = -1;

/// The nodes that are left of a ring, at the places they had when it began, with a tree of boxes around the
/// sides of those that follow each other: what is far from an ear is told many at a time.
class RingTree {
 public:
  explicit RingTree(std::size_t node_count) : place_(node_count, kGone) {}

  template <class PointOf>
  void begin(const std::vector<int>& ring, const PointOf& p) {
    for (const int node : ring_) place_[at(node)] = kGone;
    ring_ = ring;
    levels_.clear();
    for (std::size_t size = kFan; size < kFan * ring.size(); size *= kFan)
      levels_.emplace_back((ring.size() + size - 1) / size);
    for (std::size_t i = 0; i < ring.size(); ++i) {
      place_[at(ring[i])] = i;
      add(i, p(ring[i]), 1);
      add(i, p(ring[(i + 1) % ring.size()]), 0);
    }
  }

  bool holds(int node) const { return place_[at(node)] != kGone; }
  std::size_t place(int node) const { return place_[at(node)]; }

  void remove(int node) {
    for (std::size_t i = place(node); std::vector<Box> & level : levels_) --level[i /= kFan].left;
    place_[at(node)] = kGone;
  }

  /// The side from `node` ends at `end` now.
  void lead(int node, const Vec2& end) { add(place(node), end, 0); }

  /// The first node on the way around from one to another that `is_in_the_way`, or kNoNode; only asked of
  /// those that are left and in boxes that `reach` does not miss.
  template <class Condition>
  int first(int from, int until, const Reach& reach, const Condition& is_in_the_way) const {
    if (place(from) <= place(until)) return firstWithin(place(from), place(until), reach, is_in_the_way);
    const int found = firstWithin(place(from), ring_.size(), reach, is_in_the_way);
    return found == kNoNode ? firstWithin(0, place(until), reach, is_in_the_way) : found;
  }

 private:
  static constexpr std::size_t kGone = std::numeric_limits<std::size_t>::max();
  // What is found is the same for any.
  static constexpr int kFanBits = 3;
  static constexpr std::size_t kFan = std::size_t{1} << kFanBits;
  struct Box {
    Reach sides;
    int left = 0;
  };

  void add(std::size_t place, const Vec2& end, int nodes) {
    for (std::vector<Box>& level : levels_) {
      Box& box = level[place /= kFan];
      box.sides.add(end);
      box.left += nodes;
    }
  }

  template <class Condition>
  int firstWithin(std::size_t i, std::size_t end, const Reach& reach, const Condition& is_in_the_way) const {
    while (i < end) {
      const std::size_t passed = placesPassed(i, reach);
      if (passed == 0 && holds(ring_[i]) && is_in_the_way(ring_[i])) return ring_[i];
      i += std::max<std::size_t>(passed, 1);
    }
    return kNoNode;
  }

  /// How many from place `i` on are in a box that is empty or missed.
  std::size_t placesPassed(std::size_t i, const Reach& reach) const {
    const int top = static_cast<int>(levels_.size());
    for (int level = i == 0 ? top : std::min(top, std::countr_zero(i) / kFanBits); level > 0; --level) {
      const Box& box = levels_[at(level - 1)][i >> (kFanBits * level)];
      if (box.left == 0 || reach.misses(box.sides.lowest, box.sides.highest))
        return std::size_t{1} << (kFanBits * level);
    }
    return 0;
  }

  std::vector<int> ring_;
  std::vector<std::size_t> place_;        // of each node
  std::vector<std::vector<Box>> levels_;  // each of kFan times as many places as the one before
};

class EarClipping {
 public:
  EarClipping(const JoinedRing& joined, const std::vector<Vec2>& corners, double tolerance_m)
      : nodes_(joined.nodes),
        corners_(corners),
        tolerance_m_(tolerance_m),
        tree_(nodes_.size()),
        quality_(nodes_.size()),
        obstacles_(nodes_.size()),
        hindered_(nodes_.size()),
        bridges_(joined.bridges) {
    const int n = static_cast<int>(nodes_.size());
    for (const RingNode& node : nodes_)
      extent_ = std::max(extent_, (corners[at(node.corner)] - corners[at(nodes_[0].corner)]).norm());
    for (int i = 0; i < n; ++i) {
      before_.push_back((i + n - 1) % n);
      after_.push_back((i + 1) % n);
    }
  }

  std::optional<PolygonTriangles> run() {
    waiting_ = {0};
    while (!waiting_.empty()) {
      const int start = waiting_.back();
      waiting_.pop_back();
      if (!clip(start)) return std::nullopt;
    }
    resolveBridges();
    return std::move(found_);
  }

 private:
  static constexpr double kNoEar = -1.0;
  /// What keeps a corner from being an ear: a node, and the side that begins there.
  struct Obstacle {
    int node = kNoNode, after = kNoNode;
  };
  /// Two places on the way around a ring that are at one point, the first first.
  struct Touch {
    std::size_t first = 0, second = 0;
  };
  /// A corner and what its quality was; the best are on top, the first of them on the way around.
  struct Ear {
    double quality;
    std::size_t place;
    int node;
    bool operator<(const Ear& other) const {
      return std::tuple(quality, other.place) < std::tuple(other.quality, place);
    }
  };
  const Vec2& p(int node) const { return corners_[at(nodes_[at(node)].corner)]; }

  std::vector<int> ringFrom(int start) const {
    std::vector<int> ring{start};
    for (int i = after_[at(start)]; i != start; i = after_[at(i)]) ring.push_back(i);
    return ring;
  }

  /// Until nothing is left of the ring; parts that are taken off it wait for their turn.
  bool clip(int start) {
    begin(ringFrom(start));
    if (left_ < 2) return false;  // a corner alone has no side
    start = partedAtTouches(start);
    for (const int node : ringFrom(start)) ask(node);
    while (left_ > 2) {
      int ear = bestEar();
      if (ear == kNoNode && left_ > 3) return false;
      // Three corners are one triangle: whether it is off by more than rounding is seen at the end.
      if (ear == kNoNode) ear = start;
      if (ear == start) start = after_[at(ear)];
      const int before = before_[at(ear)], after = after_[at(ear)];
      cutOff(ear);
      ask(before);
      ask(after);
    }
    join(nodes_[at(start)].beyond, nodes_[at(after_[at(start)])].beyond);
    return true;
  }

  void begin(const std::vector<int>& ring) {
    left_ = ring.size();
    tree_.begin(ring, [&](int node) { return p(node); });
    ears_ = {};
    freed_.clear();
  }

  void ask(int node) {
    quality_[at(node)] = qualityOf(node);
    offer(node);
  }
  void offer(int node) {
    if (quality_[at(node)] != kNoEar) ears_.push({quality_[at(node)], tree_.place(node), node});
  }

  /// The first of the best; those that were freed are only asked where there is none with area. kNoNode where
  /// no corner can be clipped.
  int bestEar() {
    const int best = topEar();
    if (best != kNoNode && quality_[at(best)] > 0.0) return best;
    for (const int node : std::exchange(freed_, {}))
      if (tree_.holds(node) && isFreed(node)) ask(node);
    return topEar();
  }
  int topEar() {
    while (!ears_.empty()) {
      const Ear& ear = ears_.top();
      if (tree_.holds(ear.node) && quality_[at(ear.node)] == ear.quality) return ear.node;
      ears_.pop();
    }
    return kNoNode;
  }

  void cutOff(int ear) {
    const int before = before_[at(ear)], after = after_[at(ear)];
    const int first = 3 * static_cast<int>(found_.triangles.size());
    found_.triangles.push_back({nodes_[at(before)].corner, nodes_[at(ear)].corner, nodes_[at(after)].corner});
    join(first, nodes_[at(before)].beyond);
    join(first + 1, nodes_[at(ear)].beyond);
    nodes_[at(before)].beyond = first + 2;
    link(before, after);
    remove(ear);
    tree_.lead(before, p(after));
  }

  void link(int before, int after) {
    after_[at(before)] = after;
    before_[at(after)] = before;
    free(before);
  }
  void remove(int node) {
    tree_.remove(node);
    free(node);
    --left_;
  }
  /// What the node was in the way of is worth asking again.
  void free(int node) {
    freed_.insert(freed_.end(), hindered_[at(node)].begin(), hindered_[at(node)].end());
    hindered_[at(node)].clear();
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

  /// All touches of a ring, by first and then by second place.
  std::vector<Touch> touchesOf(const std::vector<int>& ring) const {
    std::vector<std::size_t> order(ring.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t k) {
      const Vec2 &a = p(ring[i]), &b = p(ring[k]);
      return std::tuple(a.x(), a.y(), i) < std::tuple(b.x(), b.y(), k);
    });
    std::vector<Touch> touches;
    for (std::size_t i = 0; i < order.size(); ++i)
      for (std::size_t k = i + 1; k < order.size() && p(ring[order[i]]) == p(ring[order[k]]); ++k)
        touches.push_back({order[i], order[k]});
    std::sort(touches.begin(), touches.end(), [](const Touch& a, const Touch& b) {
      return std::tuple(a.first, a.second) < std::tuple(b.first, b.second);
    });
    return touches;
  }

  /// Takes the ring, which `start` is on, apart at every touch that leaves area on the left of both parts or
  /// of none; gives a node of the part that goes on. An ear that is clipped before could lie across both.
  int partedAtTouches(int start) {
    const std::vector<int> ring = ringFrom(start);
    const Vec2& origin = p(start);
    std::vector<double> area{0.0};  // from the first place up to each
    for (std::size_t k = 0; k < ring.size(); ++k)
      area.push_back(area.back() + turnOf(origin, p(ring[k]), p(ring[(k + 1) % ring.size()])));
    const double least = -tolerance_m_ * static_cast<double>(ring.size()) * extent_;
    double all = area.back();
    for (const Touch& touch : touchesOf(ring)) {
      const int first = ring[touch.first], second = ring[touch.second];
      if (!tree_.holds(first) || !tree_.holds(second)) continue;
      // The two ends of a side without length: it goes with a corner that has no area.
      if (after_[at(first)] == second || after_[at(second)] == first) continue;
      // Nothing has been taken off between the two: it would have begun before.
      const double part = area[touch.second] - area[touch.first] + turnOf(origin, p(second), p(first));
      if (part < least || all - part < least) continue;
      const bool inner_waits = 2 * (touch.second - touch.first) <= left_;
      takeApart(first, second, inner_waits);
      all = inner_waits ? all - part : part;
      start = inner_waits ? second : first;
    }
    return start;
  }

  /// The part that begins at `first`, or the one that begins at `second`, waits for its turn.
  void takeApart(int first, int second, bool first_waits) {
    const int last = before_[at(second)], before = before_[at(first)];
    link(last, first);
    link(before, second);
    waiting_.push_back(first_waits ? first : second);
    for (const int node : ringFrom(waiting_.back())) remove(node);
  }

  /// Whether what kept the corner from being an ear has been clipped, or has another side behind it.
  bool isFreed(int i) const {
    const Obstacle& obstacle = obstacles_[at(i)];
    if (obstacle.node == kNoNode) return false;
    return !tree_.holds(obstacle.node) || after_[at(obstacle.node)] != obstacle.after;
  }

  /// Twice the area over the square of the longest side; kNoEar where the corner cannot be clipped. One
  /// without area is between 0 and kNoEar, the shorter the better.
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
    int in_the_way = straight ? kNoNode : nodeWithin(before, i, after);
    if (in_the_way == kNoNode) in_the_way = sideAcross(before, after);
    if (in_the_way != kNoNode) {
      obstacles_[at(i)] = {in_the_way, after_[at(in_the_way)]};
      hindered_[at(in_the_way)].push_back(i);
      return kNoEar;
    }
    return straight ? -longest / (4.0 * extent_) : turn / (longest * longest);
  }

  /// A node of the ring that is inside the triangle of three of them or on the open side from the last to the
  /// first.
  int nodeWithin(int before, int ear, int after) const {
    const Vec2 &a = p(before), &b = p(ear), &c = p(after);
    const Reach reach{a.cwiseMin(b).cwiseMin(c).array() - tolerance_m_,
                      a.cwiseMax(b).cwiseMax(c).array() + tolerance_m_};
    return tree_.first(after_[at(after)], before, reach,
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
    return tree_.first(after, before, reach, [&](int k) {
      const Vec2 &d = p(k), &e = p(after_[at(k)]);
      return !reach.misses(d, e) && sideOf(a, c, d, tolerance_m_) * sideOf(a, c, e, tolerance_m_) < 0 &&
             sideOf(d, e, a, tolerance_m_) * sideOf(d, e, c, tolerance_m_) < 0;
    });
  }

  std::vector<RingNode> nodes_;
  const std::vector<Vec2>& corners_;
  double tolerance_m_;
  std::vector<int> before_, after_;
  std::vector<int> waiting_;  // a node of each part that is still to be clipped

  // Of the ring that is clipped:
  RingTree tree_;
  std::size_t left_ = 0;
  std::priority_queue<Ear> ears_;
  std::vector<int> freed_;

  // By node:
  std::vector<double> quality_;
  std::vector<Obstacle> obstacles_;
  std::vector<std::vector<int>> hindered_;  // what it is, or was, in the way of

  int bridges_;
  double extent_ = 0.0;
  std::vector<std::pair<int, int>> raw_joins_;
  PolygonTriangles found_;
};

}  // namespace

std::optional<PolygonTriangles> clippedEars(const JoinedRing& joined, const std::vector<Vec2>& corners,
                                            double tolerance_m) {
  return EarClipping(joined, corners, tolerance_m).run();
}

}  // namespace carom
