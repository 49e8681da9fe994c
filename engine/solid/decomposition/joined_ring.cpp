#include "engine/solid/decomposition/joined_ring.h"

#include <algorithm>
#include <limits>
#include <tuple>
#include <utility>

#include "engine/foundation/index.h"
#include "engine/solid/decomposition/plane_sides.h"

namespace carom {
namespace {

class RingJoining {
 public:
  RingJoining(const Rings& rings, const std::vector<Vec2>& corners, double tolerance_m)
      : rings_(rings), corners_(corners), tolerance_m_(tolerance_m), ring_(nodesOf(rings[0])) {}

  std::optional<JoinedRing> run() {
    std::vector<std::vector<RingNode>> waiting;
    for (std::size_t i = 1; i < rings_.size(); ++i) waiting.push_back(nodesOf(rings_[i]));
    while (!waiting.empty())
      if (!bridgeShortest(waiting)) return std::nullopt;
    return JoinedRing{std::move(ring_), bridges_};
  }

 private:
  struct Way {
    double length = std::numeric_limits<double>::infinity();
    std::size_t hole = 0, from = 0, to = 0;  // positions in the hole and in the ring
  };

  static std::vector<RingNode> nodesOf(const std::vector<int>& ring) {
    std::vector<RingNode> nodes;
    nodes.reserve(ring.size());
    for (const int corner : ring) nodes.push_back({corner, ringSide(corner)});
    return nodes;
  }
  const Vec2& p(const RingNode& node) const { return corners_[at(node.corner)]; }

  /// Joins the waiting hole that has the shortest free way to the ring; false where there is none.
  bool bridgeShortest(std::vector<std::vector<RingNode>>& waiting) {
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
  void join(const std::vector<RingNode>& hole, const Way& way) {
    const RingNode corner = ring_[way.to];
    const bool touch = way.length == 0.0;
    const int bridge = kBridges + 2 * bridges_;
    if (!touch) ++bridges_;
    std::vector<RingNode> joined(ring_.begin(), ring_.begin() + static_cast<std::ptrdiff_t>(way.to));
    if (!touch) joined.push_back({corner.corner, bridge});
    for (std::size_t i = 0; i < hole.size(); ++i) joined.push_back(hole[(way.from + i) % hole.size()]);
    if (!touch) joined.push_back({hole[way.from].corner, bridge + 1});
    joined.push_back(corner);
    joined.insert(joined.end(), ring_.begin() + static_cast<std::ptrdiff_t>(way.to) + 1, ring_.end());
    ring_ = std::move(joined);
  }

  bool isFree(const Way& way, const std::vector<std::vector<RingNode>>& waiting) const {
    const std::vector<RingNode>& hole = waiting[way.hole];
    const Vec2 &a = p(hole[way.from]), &b = p(ring_[way.to]);
    if (way.length == 0.0) return leadsInside(ring_, way.to, p(hole[(way.from + 1) % hole.size()]));
    if (!leadsInside(ring_, way.to, a) || !leadsInside(hole, way.from, b) || touches(ring_, a, b))
      return false;
    return std::none_of(waiting.begin(), waiting.end(),
                        [&](const std::vector<RingNode>& other) { return touches(other, a, b); });
  }

  /// Whether the way from a ring's corner towards `to` begins in the region on its left.
  bool leadsInside(const std::vector<RingNode>& ring, std::size_t i, const Vec2& to) const {
    const Vec2& before = p(ring[(i + ring.size() - 1) % ring.size()]);
    const Vec2 &here = p(ring[i]), &after = p(ring[(i + 1) % ring.size()]);
    const bool left_of_first = sideOf(before, here, to, tolerance_m_) > 0;
    const bool left_of_second = sideOf(here, after, to, tolerance_m_) > 0;
    return sideOf(before, here, after, tolerance_m_) < 0 ? left_of_first || left_of_second
                                                         : left_of_first && left_of_second;
  }

  /// Whether a side of the ring meets the way from a to b anywhere but at corners that are a or b.
  bool touches(const std::vector<RingNode>& ring, const Vec2& a, const Vec2& b) const {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vec2 &c = p(ring[i]), &d = p(ring[(i + 1) % ring.size()]);
      if (c == a || c == b || d == a || d == b) continue;
      if (sideOf(a, b, c, tolerance_m_) * sideOf(a, b, d, tolerance_m_) <= 0 &&
          sideOf(c, d, a, tolerance_m_) * sideOf(c, d, b, tolerance_m_) <= 0)
        return true;
    }
    return false;
  }

  const Rings& rings_;
  const std::vector<Vec2>& corners_;
  double tolerance_m_;
  std::vector<RingNode> ring_;
  int bridges_ = 0;
};

}  // namespace

std::optional<JoinedRing> joinedRing(const Rings& rings, const std::vector<Vec2>& corners,
                                     double tolerance_m) {
  return RingJoining(rings, corners, tolerance_m).run();
}

}  // namespace carom
