#include "engine/closest_features/penetrating/cap_cover.h"

#include <cmath>

namespace carom {
namespace {

// How far rounding may take the square of a crossing's length from 1.
constexpr double kUnit = 0x1p-48;
// The support point itself is sought once there are this many; before, any point that is high enough will do.
constexpr std::size_t kFewCaps = 10;

// The end of the steepest edge at a vertex along `direction`; the vertex itself where none rises.
int uphill(const ConvexPolyhedron& polyhedron, int v, const Vec3& direction) {
  int highest = v;
  double steepest = kLevelSlope;
  for (const Spoke& spoke : polyhedron.spokes(v))
    if (const double slope = dot(spoke.direction, direction); slope > steepest) {
      steepest = slope;
      highest = spoke.head;
    }
  return highest;
}

}  // namespace

CapCover::CapCover(const PolyhedronPair& pair, const Vec3& normal, double depth_m, double noise_m,
                   const DirectionCap& wanted)
    : pair_(pair),
      normal_(normal),
      depth_m_(depth_m),
      noise_m_(noise_m),
      wanted_(wanted),
      outside_m_(wanted.level_m - kCapMargin * (wanted.point.lpNorm<1>() + std::abs(wanted.level_m))) {}

void CapCover::addCorner(int a, int b, const Vec3& crossing) {
  Cap& cap = caps_[count_];
  cap.a = a;
  cap.b = b;
  cap.is_placed = false;
  setCrossing(count_, crossing);
  if (count_ > 0) connect(count_ - 1, count_);
  ++count_;
}

CapCover::Outcome CapCover::cover() {
  if (!wanted_.holds(normal_)) return Outcome::kUndecided;
  connect(count_ - 1, 0);
  around_ = static_cast<int>(count_);
  turn_ = dot(normal_, caps_[0].crossing.cross(caps_[1].crossing)) > 0.0 ? -1.0 : 1.0;
  while (open_count_ > 0) {
    const std::size_t i = open_[--open_count_];
    if (!caps_[i].is_open) continue;
    if (const Outcome outcome = coverCrossing(i); outcome != Outcome::kCovered) return outcome;
  }
  return Outcome::kCovered;
}

// Puts a point that is higher in the crossing's direction between a cap and the next, and in place of those
// around whose crossings it covers as well.
CapCover::Outcome CapCover::coverCrossing(std::size_t i) {
  if (count_ == kMostCaps) return Outcome::kUndecided;
  const std::size_t added = count_++;
  Cap& cap = caps_[added];
  if (!findHigher(cap, caps_[i])) return Outcome::kLower;
  const double along = dot(normal_, cap.w);
  const bool leaves_out_both =
      along <= depth_m_ && -along < depth_m_ - noise_m_;  // the normal and its opposite
  if (!leaves_out_both) return Outcome::kUndecided;
  std::size_t left = i, right = caps_[i].next;
  for (++around_; around_ > 3 && holds(cap, caps_[caps_[left].before].crossing); --around_) {
    caps_[left].is_open = false;
    left = caps_[left].before;
  }
  for (; around_ > 3 && holds(cap, caps_[right].crossing); --around_) {
    caps_[right].is_open = false;
    right = caps_[right].next;
  }
  connect(left, added);
  connect(added, right);
  return cross(left) && cross(added) ? Outcome::kCovered : Outcome::kUndecided;
}

// A point that is higher at the crossing of a cap with the next one, climbed to from there; false where none
// is.
bool CapCover::findHigher(Cap& cap, const Cap& from) {
  const Vec3& n = from.crossing;
  const Vec3 minus_n_B = -pair_.directionToB(n);
  int a = from.a, b = from.b;
  for (bool found = false;;) {
    const int higher_a = uphill(pair_.a, a, n);
    const int higher_b = uphill(pair_.b, b, minus_n_B);
    if (higher_a == a && higher_b == b) {
      lower_ = {n, a, b};
      return found;
    }
    cap.a = a = higher_a;
    cap.b = b = higher_b;
    place(cap);
    found = dot(n, cap.w) > depth_m_ + noise_m_;
    if (found && count_ < kFewCaps) return true;
  }
}

void CapCover::place(Cap& cap) const {
  cap.w = pair_.a.vertex(cap.a) - pair_.toA(pair_.b.vertex(cap.b));
  cap.is_placed = true;
}

void CapCover::setCrossing(std::size_t i, const Vec3& n) {
  caps_[i].crossing = n;
  caps_[i].is_open = !(dot(n, wanted_.point) < outside_m_);
  if (caps_[i].is_open) open_[open_count_++] = i;
}

void CapCover::connect(std::size_t cap, std::size_t next) {
  caps_[cap].next = next;
  caps_[next].before = cap;
}

// Where a cap's rim crosses the next one's, outside; false if they do not. The directions with n . w = D for
// both points w are on a line across both; the point of the line next to the origin, and how far from there
// the sphere is, give them.
bool CapCover::cross(std::size_t i) {
  Cap& cap = caps_[i];
  Cap& next = caps_[cap.next];
  if (!cap.is_placed) place(cap);
  if (!next.is_placed) place(next);
  const Vec3 side = next.w - cap.w;
  const Vec3 along = cap.w.cross(side);
  const double inverse = 1.0 / along.squaredNorm();
  const double scale = depth_m_ * inverse;
  const double rest = inverse - scale * scale * side.squaredNorm();
  if (!(rest > 0.0)) return false;
  const Vec3 n = scale * side.cross(along) + turn_ * std::sqrt(rest) * along;
  setCrossing(i, n);
  return std::abs(n.squaredNorm() - 1.0) <= kUnit && holds(cap, n) && holds(next, n);
}

}  // namespace carom
