#include "demos/page/page_contacts.h"

#include <algorithm>
#include <cmath>

#include "demos/overlay/v_region_shape.h"

namespace carom::demos {
namespace {

constexpr double kRegionReach = 1.2;  // Of the smaller body's radius, as in the overlay of `render`.
constexpr double kWideFace = 4.0;     // Faces reaching farther, in those radii, are shown about the witness.
constexpr double kNormalSteps = 127.0;
constexpr double kArrowCoarseness = 4.0;  // Of an impulse's arrow, over that of points.

/// A unit vector, each coordinate in 127 steps: at most 0.4 degrees off, enough for an arrow.
std::array<std::int64_t, 3> roundedNormal(const Vec3& n) {
  return {std::llround(kNormalSteps * n.x()), std::llround(kNormalSteps * n.y()),
          std::llround(kNormalSteps * n.z())};
}

void append(std::vector<std::int64_t>& row, const std::array<std::int64_t, 3>& numbers) {
  row.insert(row.end(), numbers.begin(), numbers.end());
}

/// How a region is shown.
enum class RegionKind { kShape, kColumn };

}  // namespace

PageContacts::PageContacts(SceneWorld& scene, const Choice& choice) : scene_(scene), choice_(choice) {
  if (!choice_.recorded) scene_.world.watch(&step_);
}

PageContacts::~PageContacts() {
  if (!choice_.recorded) scene_.world.watch(nullptr);
}

PageContacts::Point PageContacts::rounded(const Vec3& p) const {
  Point point{};
  for (std::size_t i = 0; i < 3; ++i)
    point[i] =
        std::llround(std::clamp(p[static_cast<Eigen::Index>(i)] / choice_.length_quantum_m, -0x1p45, 0x1p45));
  return point;
}

void PageContacts::add(std::span<const BodyState> states, int frame, double time_s) {
  OverlayFrame of{scene_,  focus_, states, frame, time_s, nearPairs(scene_.world, states),
                  nullptr, {},     {},     {}};
  if (!choice_.recorded) {
    // The world may stand at the end of a step that the frame's instant lies in: what comes later is kept.
    const auto later =
        std::stable_partition(step_.collisions.begin(), step_.collisions.end(),
                              [&](const ContactView& contact) { return contact.time_s <= time_s; });
    of.collisions.assign(step_.collisions.begin(), later);
    step_.collisions.erase(step_.collisions.begin(), later);
    of.step = &step_;
  }
  addContacts(of);
  addImpulses(of);
  addDistances(of);
  addClosest(of);
}

void PageContacts::addPairs(const std::vector<std::pair<Pair, Row>>& rows, Former& former) {
  Former now;
  std::map<Pair, int> count;
  frames_.add(static_cast<std::int64_t>(rows.size()));
  for (const auto& [pair, row] : rows) {
    const std::tuple key(pair.first, pair.second, count[pair]++);
    const auto before = former.find(key);
    const bool is_known = before != former.end() && before->second.size() == row.size();
    frames_.add(pair.first);
    frames_.add(pair.second);
    frames_.add(static_cast<std::int64_t>(row.size()));
    for (std::size_t i = 0; i < row.size(); ++i) frames_.add(row[i] - (is_known ? before->second[i] : 0));
    now[key] = row;
  }
  former = std::move(now);
}

void PageContacts::addContacts(const OverlayFrame& frame) {
  int room = std::max(kFewestPoints, kMostPoints / choice_.frames);
  std::vector<std::pair<Pair, Row>> rows;
  for (const NearPair& near : frame.pairs) {
    if (!touches(near)) continue;
    const ContactManifold manifold = manifoldOf(near);
    room -= manifold.count;
    if (room < 0) {
      left_out_ += manifold.count;
      continue;
    }
    Row row{std::llround(normalLength(frame, near) / choice_.length_quantum_m)};
    for (const ManifoldPoint& point : manifold) {
      append(row, rounded(point.p_W));
      append(row, roundedNormal(point.n_W));
    }
    rows.push_back({{near.body_a, near.body_b}, std::move(row)});
  }
  // In the order of bodies, which hardly changes, so that the bytes of one frame are like those before.
  std::stable_sort(rows.begin(), rows.end(), [](const auto& x, const auto& y) { return x.first < y.first; });
  addPairs(rows, contacts_);
}

void PageContacts::addImpulses(const OverlayFrame& frame) {
  const std::vector<ShownImpulse> shown = shownImpulses(frame);
  const auto room = static_cast<std::size_t>(std::max(kFewestPoints, kMostPoints / choice_.frames));
  const std::size_t count = std::min(shown.size(), room);
  left_out_ += static_cast<std::int64_t>(shown.size() - count);
  std::vector<std::pair<Pair, Row>> rows;
  for (std::size_t i = 0; i < count; ++i) {
    const ShownImpulse& impulse = shown[i];
    Row row;
    append(row, rounded(impulse.p_W));
    append(row, rounded(impulse.length_m / kArrowCoarseness * impulse.impulse_W.normalized()));
    row.push_back(byLogarithm(impulse.impulse_W.norm()));
    rows.push_back({{impulse.body, impulse.is_collision ? 1 : 0}, std::move(row)});
  }
  addPairs(rows, impulses_);
}

// Of each body the pair with its nearest neighbour.
void PageContacts::addDistances(const OverlayFrame& frame) {
  std::vector<bool> has_one(frame.bodies.size(), false);
  std::vector<std::pair<Pair, Row>> rows;
  for (const NearPair& near : frame.pairs) {
    const auto a = static_cast<std::size_t>(near.body_a), b = static_cast<std::size_t>(near.body_b);
    const bool is_news =
        (!has_one[a] && !frame.isStatic(near.body_a)) || (!has_one[b] && !frame.isStatic(near.body_b));
    if (!is_news) continue;
    has_one[a] = has_one[b] = true;
    if (rows.size() >= static_cast<std::size_t>(kMostDistances)) {
      ++left_out_;
      continue;
    }
    Row row;
    append(row, rounded(near.closest.p_A_W));
    append(row, rounded(near.closest.p_B_W));
    row.push_back(byLogarithm(near.closest.distance_m));
    rows.push_back({{near.body_a, near.body_b}, std::move(row)});
  }
  addPairs(rows, distances_);
}

void PageContacts::addClosest(const OverlayFrame& frame) {
  if (frame.pairs.empty()) return frames_.add(0);
  const NearPair& near = frame.pairs.front();
  const double radius = frame.pairRadius(near.body_a, near.body_b);
  frames_.add(1);
  frames_.add(near.body_a);
  frames_.add(near.body_b);
  frames_.add(regionOf(near, true, radius));
  frames_.add(regionOf(near, false, radius));
  for (const std::int64_t number : rounded(near.closest.p_A_W)) frames_.add(number);
  for (const std::int64_t number : rounded(near.closest.p_B_W)) frames_.add(number);
  frames_.add(byLogarithm(near.closest.distance_m));
}

// In the body's frame, where it stays the same: kind, feature, reach, corners of the feature, then the sides
// and rims of the region, or of a wide face its normal.
int PageContacts::regionOf(const NearPair& pair, bool of_a, double radius_m) {
  const ConvexPart& part = of_a ? *pair.part_a : *pair.part_b;
  const Feature feature = of_a ? pair.closest.features.a : pair.closest.features.b;
  const Vec3 p_W = of_a ? pair.closest.p_A_W : pair.closest.p_B_W;
  const Vec3 p_B = (of_a ? pair.X_WA : pair.X_WB).inverse() * p_W;
  const double reach_m = kRegionReach * radius_m;
  const std::tuple key(&part, static_cast<int>(feature.kind), feature.index,
                       static_cast<int>(std::min(1e9, reach_m / choice_.length_quantum_m)));
  const auto [known, is_new] = known_.try_emplace(key, static_cast<int>(regions_.size()));
  if (!is_new) return known->second;

  const std::vector<Vec3> corners = featureCorners(part.core, feature);
  const bool is_wide = feature.kind == FeatureKind::kFace &&
                       std::any_of(corners.begin(), corners.end(), [&](const Vec3& corner) {
                         return (corner - p_B).norm() > kWideFace * radius_m;
                       });
  ByteStream& out = regions_.emplace_back();
  const auto addPoints = [&](const std::vector<Vec3>& points) {
    out.add(static_cast<std::int64_t>(points.size()));
    for (const Vec3& p : points)
      for (const std::int64_t number : rounded(p)) out.add(number);
  };
  out.add(static_cast<std::int64_t>(is_wide ? RegionKind::kColumn : RegionKind::kShape));
  out.add(static_cast<std::int64_t>(feature.kind));
  out.add(feature.index);
  for (const double length_m : {reach_m, part.radius_m})
    out.add(std::llround(length_m / choice_.length_quantum_m));
  if (is_wide) {
    for (const std::int64_t number : roundedNormal(part.core.plane(feature.index).normal)) out.add(number);
    return known->second;
  }
  addPoints(corners);
  const RegionShape shape = regionShape(part.core, feature, reach_m);
  for (const std::vector<std::vector<Vec3>>* lines : {&shape.sides, &shape.rims}) {
    out.add(static_cast<std::int64_t>(lines->size()));
    for (const std::vector<Vec3>& line : *lines) addPoints(line);
  }
  return known->second;
}

void PageContacts::write(ByteStream& out) const {
  out.add(static_cast<std::int64_t>(regions_.size()));
  for (const ByteStream& region : regions_) out.addBytes(region.bytes());
  out.addBytes(frames_.bytes());
}

}  // namespace carom::demos
