#include "engine/response/sweeps/bearing_order.h"

#include <algorithm>
#include <functional>
#include <queue>

#include "engine/foundation/index.h"

namespace carom {
namespace {

// The least cosine between up and the normal of a steep row: it is nearer to up, or to down, than to level.
constexpr double kSteepCosine = 0.70710678118654752;

}  // namespace

void BearingOrder::find(std::span<const ContactRow> rows, std::span<const ImpulseBody> bodies,
                        const Vec3& up) {
  sortByHeight(rows, bodies, up);
  findHanging(rows, up);
  if (hanging_.empty()) return;
  listBorne(rows);
  putBearersFirst();
}

void BearingOrder::sortByHeight(std::span<const ContactRow> rows, std::span<const ImpulseBody> bodies,
                                const Vec3& up) {
  places_.resize(bodies.size());
  for (const ContactRow& row : rows) places_[at(row.a)] = places_[at(row.b)] = -1;
  bodies_.clear();
  for (const ContactRow& row : rows)
    for (const int body : {row.a, row.b})
      if (bodies[at(body)].inverse_mass > 0.0 && std::exchange(places_[at(body)], 0) < 0)
        bodies_.push_back(body);
  std::sort(bodies_.begin(), bodies_.end(), [&](int x, int y) {
    return std::pair(dot(up, bodies[at(x)].center), x) < std::pair(dot(up, bodies[at(y)].center), y);
  });
  for (std::size_t i = 0; i < bodies_.size(); ++i) places_[at(bodies_[i])] = static_cast<int>(i);
}

// Zero where the row is not steep, or one of its bodies cannot move.
BearingOrder::Lifted BearingOrder::liftedBy(const ContactRow& row, const Vec3& up) const {
  const int a = placeOf(row.a), b = placeOf(row.b);
  const double along = dot(row.n, up);
  if (!joinsMoving(row) || std::abs(along) < kSteepCosine * up.norm()) return {};
  return {std::minmax({a, b}), b > a ? along : -along};
}

// Among `hanging_`; its size: they are not.
std::size_t BearingOrder::hangingPlace(const Places& places) const {
  const auto known = std::ranges::lower_bound(hanging_, places, {}, &Lifted::places);
  const bool hang = known != hanging_.end() && known->places == places;
  return hang ? static_cast<std::size_t>(known - hanging_.begin()) : hanging_.size();
}

void BearingOrder::findHanging(std::span<const ContactRow> rows, const Vec3& up) {
  hanging_.clear();
  for (const ContactRow& row : rows)
    if (const Lifted lifted = liftedBy(row, up); lifted.up < 0.0) hanging_.push_back({lifted.places, 0.0});
  if (hanging_.empty()) return;
  std::ranges::sort(hanging_, {}, &Lifted::places);
  const auto same = [](const Lifted& x, const Lifted& y) { return x.places == y.places; };
  hanging_.erase(std::unique(hanging_.begin(), hanging_.end(), same), hanging_.end());
  for (const ContactRow& row : rows) {
    const Lifted lifted = liftedBy(row, up);
    if (lifted.up == 0.0) continue;
    if (const std::size_t known = hangingPlace(lifted.places); known < hanging_.size())
      hanging_[known].up += lifted.up;
  }
  std::erase_if(hanging_, [](const Lifted& lifted) { return lifted.up >= 0.0; });
}

// Of the bodies of a row, by height: who bears, and who is borne.
BearingOrder::Places BearingOrder::bearingOf(const ContactRow& row) const {
  const auto [lower, upper] = std::minmax({placeOf(row.a), placeOf(row.b)});
  const Places places{lower, upper};
  return hangingPlace(places) < hanging_.size() ? Places{upper, lower} : places;
}

void BearingOrder::listBorne(std::span<const ContactRow> rows) {
  bearers_.assign(bodies_.size(), 0);
  begins_.assign(bodies_.size() + 2, 0);
  for (const ContactRow& row : rows) {
    if (!joinsMoving(row)) continue;
    const auto [bearer, borne] = bearingOf(row);
    ++bearers_[at(borne)];
    ++begins_[at(bearer) + 2];
  }
  for (std::size_t i = 2; i < begins_.size(); ++i) begins_[i] += begins_[i - 1];
  borne_.resize(at(begins_.back()));
  for (const ContactRow& row : rows) {
    if (!joinsMoving(row)) continue;
    const auto [bearer, borne] = bearingOf(row);
    borne_[at(begins_[at(bearer) + 1]++)] = borne;  // which moves them one on: each ends where it began
  }
}

// Their topological order (Kahn 1962), the lowest of those whose turn it is first.
void BearingOrder::putBearersFirst() {
  by_height_ = bodies_;
  std::priority_queue<int, std::vector<int>, std::greater<>> ready;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    places_[at(by_height_[i])] = -1;
    if (bearers_[i] == 0) ready.push(static_cast<int>(i));
  }
  const auto isPlaced = [&](std::size_t i) { return places_[at(by_height_[i])] >= 0; };
  std::size_t lowest = 0;
  for (std::size_t place = 0; place < bodies_.size(); ++place) {
    while (isPlaced(lowest)) ++lowest;
    std::size_t next = lowest;  // where those left bear each other all round
    if (!ready.empty()) {
      next = at(ready.top());
      ready.pop();
    }
    bodies_[place] = by_height_[next];
    places_[at(bodies_[place])] = static_cast<int>(place);
    for (int k = begins_[next]; k < begins_[next + 1]; ++k) {
      const int borne = borne_[at(k)];
      if (--bearers_[at(borne)] == 0 && !isPlaced(at(borne))) ready.push(borne);
    }
  }
}

}  // namespace carom
