#include "engine/contact/manifold_reduction.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "engine/contact/contact_id.h"
#include "engine/foundation/stack_arena.h"

namespace carom {
namespace {

// Bytes for a polygon of some hundred corners and what thinning needs.
constexpr std::size_t kReductionBytes = std::size_t{32} << 10;

constexpr int kExactCorners = 24;    // up to here no thinning
constexpr double kSameScore = 1e-7;  // relative: equal lengths, heights and areas, chosen between by name
constexpr double kNoHeight = 1e-12;  // of the length: corners in a line

// In the unit frame of the polygon (below) the largest quadrilateral has at least area 1/2, and moving one of
// its corners by s changes the area by at most s sqrt(5) / 2. Four corners moved by this lose less than 5 %
// of 1/2.
constexpr double kThinning = 0.0055;

using Name = std::pair<std::uint64_t, std::uint64_t>;

struct FlatCorner {
  Vec2 p = Vec2::Zero();
  Name name;
  int index = -1;
  bool deepest = false;
};

using FlatCorners = ArenaVector<FlatCorner>;

double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

// The largest of several scores; scores equal but for rounding are chosen between by name.
class Best {
 public:
  explicit Best(double same) : same_(same) {}
  void offer(double score, const FlatCorner& corner) {
    if (score < score_ - same_) return;
    if (corner_ == nullptr || score > score_ + same_ || corner.name < corner_->name) corner_ = &corner;
    score_ = std::max(score_, score);
  }
  const FlatCorner* corner() const { return corner_; }

 private:
  double same_;
  double score_ = 0.0;
  const FlatCorner* corner_ = nullptr;
};

using Four = std::array<const FlatCorner*, KeptCorners::kMost>;

// Whether the names of x, in order, come before those of y.
bool namedBefore(Four x, Four y) {
  const auto by_name = [](const FlatCorner* a, const FlatCorner* b) { return a->name < b->name; };
  std::sort(x.begin(), x.end(), by_name);
  std::sort(y.begin(), y.end(), by_name);
  return std::lexicographical_compare(x.begin(), x.end(), y.begin(), y.end(), by_name);
}

// Farthest from `from`.
const FlatCorner& farthest(std::span<const FlatCorner> corners, const FlatCorner& from) {
  double longest = 0.0;
  for (const FlatCorner& c : corners) longest = std::max(longest, (c.p - from.p).squaredNorm());
  Best best(kSameScore * longest);
  for (const FlatCorner& c : corners) best.offer((c.p - from.p).squaredNorm(), c);
  return *best.corner();
}

// The corner of a chain farthest from a diagonal that turns about its tail `from`: it only ever moves on, as
// the polygon is convex, so that all diagonals of one tail cost one way round.
class FarthestOfChain {
 public:
  FarthestOfChain(std::span<const FlatCorner> corners, std::size_t from) : corners_(corners), from_(from) {}

  /// Over the corners begin .. end - 1 (counted round, begin never less than before) for the diagonal to
  /// `to`.
  void turnTo(std::size_t to, std::size_t begin, std::size_t end) {
    const Vec2& tail = at(from_).p;
    const Vec2 d = at(to).p - tail;
    const auto off = [&](std::size_t i) { return std::abs(cross(d, at(i).p - tail)); };
    reached_ = std::max(reached_, begin);
    double most = off(reached_);
    while (reached_ + 1 < end) {
      const double next = off(reached_ + 1);
      if (next < most) break;
      most = next;
      ++reached_;
    }
    begin_ = begin;
    end_ = end;
    to_ = to;
    area_ = most;
  }
  /// That corner; of two that are equally far the one named first.
  const FlatCorner* corner() const {
    const Vec2 d = at(to_).p - at(from_).p;
    Best best(kSameScore);
    for (std::size_t i = std::max(reached_, begin_ + 1) - 1; i < std::min(reached_ + 2, end_); ++i)
      best.offer(std::abs(cross(d, at(i).p - at(from_).p)), at(i));
    return best.corner();
  }
  double area() const { return area_; }

 private:
  const FlatCorner& at(std::size_t i) const {
    return corners_[i < corners_.size() ? i : i - corners_.size()];
  }

  std::span<const FlatCorner> corners_;
  std::size_t from_;
  std::size_t begin_ = 0, end_ = 0, to_ = 0;
  std::size_t reached_ = 0;
  double area_ = 0.0;
};

double breadthOf(std::span<const FlatCorner> corners) {
  double low = 0.0, high = 0.0;
  for (const FlatCorner& c : corners) {
    low = std::min(low, c.p.x());
    high = std::max(high, c.p.x());
  }
  return high - low;
}

// Four corners in the unit frame with a deepest one among them and the largest area (twice the area, here and
// where it is compared). Null if there are none.
Four largestFour(std::span<const FlatCorner> corners) {
  const std::size_t n = corners.size();
  const double breadth = breadthOf(corners);
  Four best{};
  double largest = 0.0;
  for (std::size_t from = 0; from < n; ++from) {
    if (!corners[from].deepest) continue;
    FarthestOfChain before(corners, from);
    FarthestOfChain behind(corners, from);
    for (std::size_t to = from + 2; to + 1 < from + n; ++to) {
      const FlatCorner& head = corners[to < n ? to : to - n];
      if (to >= n && head.deepest) continue;  // a diagonal of two deepest comes once
      const Vec2 d = head.p - corners[from].p;
      // No more than the polygon's bounding box allows across this diagonal.
      if (std::abs(d.x()) + std::abs(d.y()) * breadth < largest - kSameScore) continue;
      before.turnTo(to, from + 1, to);
      behind.turnTo(to, to + 1, from + n);
      const double area = before.area() + behind.area();
      if (area < largest - kSameScore) continue;
      const Four four{&corners[from], before.corner(), &head, behind.corner()};
      if (best[0] == nullptr || area > largest + kSameScore || namedBefore(four, best)) best = four;
      largest = std::max(largest, area);
    }
  }
  return best;
}

// Moves the corners to the unit frame: from p along q, p and q as far apart as the search from p finds, so
// that every corner is within 1 of p along the first axis; the polygon's height across is 1 too. Areas keep
// their ratios. False if the corners lie in a line.
bool toUnitFrame(FlatCorners& corners, const FlatCorner& p, const FlatCorner& q) {
  const double length = (q.p - p.p).norm();
  if (!(length > 0.0)) return false;
  const Vec2 axis = (q.p - p.p) / length;
  double low = 0.0, high = 0.0;
  for (FlatCorner& c : corners) {
    const Vec2 r = (c.p - p.p) / length;
    c.p = Vec2(dot(axis, r), cross(axis, r));
    low = std::min(low, c.p.y());
    high = std::max(high, c.p.y());
  }
  if (!(high - low > kNoHeight)) return false;
  for (FlatCorner& c : corners) c.p.y() /= high - low;
  return true;
}

// The thinning of one chain, ends included in `stands` already: what stands out farthest from the chord
// stays, and so on in both halves. `open`: the memory of its stack.
using Halves = ArenaVector<std::pair<std::size_t, std::size_t>>;
void thinChain(std::span<const FlatCorner> corners, std::size_t begin, std::size_t end,
               ArenaVector<char>& stands, Halves& open) {
  const auto at = [&](std::size_t i) -> const FlatCorner& {
    return corners[i < corners.size() ? i : i - corners.size()];
  };
  open.assign(1, {begin, end});
  while (!open.empty()) {
    const auto [from, to] = open.back();
    open.pop_back();
    const Vec2 base = at(from).p;
    const Vec2 chord = at(to).p - base;
    const double length = chord.norm();
    double most = kThinning;
    std::size_t apex = from;
    for (std::size_t i = from + 1; i < to; ++i) {
      const Vec2 r = at(i).p - base;
      const double out = length > 0.0 ? std::abs(cross(chord, r)) / length : r.norm();
      const bool same = std::abs(out - most) <= kSameScore && apex != from;
      if (same ? at(i).name < at(apex).name : out > most) {
        most = std::max(most, out);
        apex = i;
      }
    }
    if (apex == from) continue;
    stands[apex % corners.size()] = 1;
    open.push_back({from, apex});
    open.push_back({apex, to});
  }
}

// Leaves only the corners that stand out; the ends of the deepest stretch stay, so that thinning of that
// stretch is by corners of its own.
void thin(FlatCorners& corners, const FlatCorner& p, const FlatCorner& q) {
  const std::size_t n = corners.size();
  Arena* memory = corners.get_allocator().arena();
  ArenaVector<char> stands(n, 0, memory);
  ArenaVector<std::size_t> fixed(memory);
  Halves open(memory);
  stands[static_cast<std::size_t>(p.index)] = stands[static_cast<std::size_t>(q.index)] = 1;
  for (std::size_t i = 0; i < n; ++i)
    if (corners[i].deepest && !(corners[(i + 1) % n].deepest && corners[(i + n - 1) % n].deepest))
      stands[i] = 1;
  // The chains between the fixed corners, once round from p.
  std::size_t from = static_cast<std::size_t>(p.index);
  for (std::size_t i = from + 1; i <= static_cast<std::size_t>(p.index) + n; ++i)
    if (stands[i % n] != 0) fixed.push_back(i);
  for (const std::size_t to : fixed) {
    thinChain(corners, from, to, stands, open);
    from = to;
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < n; ++i)
    if (stands[i] != 0) corners[kept++] = corners[i];
  corners.resize(kept);
}

void flatten(const ContactPolygon& polygon, double same_gap_m, FlatCorners& corners) {
  const TangentBasis t = tangentBasis(polygon.n_W);
  const Vec3& base = polygon.corners[0].p_W;
  double least = polygon.corners[0].gap_m;
  for (const PolygonCorner& c : polygon.corners) least = std::min(least, c.gap_m);
  corners.reserve(polygon.corners.size());
  for (std::size_t i = 0; i < polygon.corners.size(); ++i) {
    const PolygonCorner& c = polygon.corners[i];
    const Vec3 r = c.p_W - base;
    corners.push_back({Vec2(dot(t.t1, r), dot(t.t2, r)), symmetricKey(c.features), static_cast<int>(i),
                       c.gap_m <= least + same_gap_m});
  }
}

// Twice the area of four corners in order round.
double areaOf(const Four& four) {
  return std::abs(cross(four[2]->p - four[0]->p, four[3]->p - four[1]->p));
}
double areaOf(std::span<const FlatCorner> corners, const KeptCorners& kept) {
  const auto corner = [&](std::size_t i) { return &corners[static_cast<std::size_t>(kept.index[i])]; };
  return areaOf({corner(0), corner(1), corner(2), corner(3)});
}

// Whether all four are still there, and one of them is as deep as any corner.
bool holdsADeepest(const ContactPolygon& polygon, const FormerCorners& former) {
  if (former.kept.count < KeptCorners::kMost) return false;
  double least = std::numeric_limits<double>::infinity();
  for (const PolygonCorner& c : polygon.corners) least = std::min(least, c.gap_m);
  return std::any_of(former.kept.index.begin(), former.kept.index.end(), [&](int i) {
    return polygon.corners[static_cast<std::size_t>(i)].gap_m <= least + former.same_gap_m;
  });
}

// Into its place among those kept, once.
void keep(KeptCorners& kept, int index) {
  int place = kept.count;
  for (int i = 0; i < kept.count; ++i)
    if (kept.index[static_cast<std::size_t>(i)] == index) return;
  for (; place > 0 && kept.index[static_cast<std::size_t>(place - 1)] > index; --place)
    kept.index[static_cast<std::size_t>(place)] = kept.index[static_cast<std::size_t>(place - 1)];
  kept.index[static_cast<std::size_t>(place)] = index;
  ++kept.count;
}

}  // namespace

KeptCorners reducePolygon(const ContactPolygon& polygon, double same_gap_m, const FormerCorners& former) {
  KeptCorners kept;
  const int n = static_cast<int>(polygon.corners.size());
  if (n <= KeptCorners::kMost) {
    for (int i = 0; i < n; ++i) kept.index[static_cast<std::size_t>(kept.count++)] = i;
    return kept;
  }
  StackArena<kReductionBytes> arena;
  FlatCorners corners(&arena);
  flatten(polygon, same_gap_m, corners);
  const FlatCorner deepest =
      *std::min_element(corners.begin(), corners.end(), [](const FlatCorner& x, const FlatCorner& y) {
        return std::pair(!x.deepest, x.name) < std::pair(!y.deepest, y.name);
      });
  const FlatCorner p = farthest(corners, deepest);
  const FlatCorner q = farthest(corners, p);
  // Corners in a line have no area to choose by; the deepest and the ends are all that counts.
  Four four{&deepest, &p, &q, nullptr};
  if (toUnitFrame(corners, p, q)) {
    const double former_area = holdsADeepest(polygon, former) ? areaOf(corners, former.kept) : 0.0;
    if (n > kExactCorners) thin(corners, p, q);
    const Four largest = largestFour(corners);
    if (largest[0] != nullptr) four = largest;
    if (largest[0] != nullptr && former_area >= kKeptArea * areaOf(largest)) return former.kept;
  }
  for (const FlatCorner* c : four)
    if (c != nullptr) keep(kept, c->index);
  return kept;
}

}  // namespace carom
