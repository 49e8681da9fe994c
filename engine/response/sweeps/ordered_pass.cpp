#include "engine/response/sweeps/ordered_pass.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/foundation/index.h"
#include "engine/response/sweeps/shared_sweeps.h"

namespace carom {
namespace {

constexpr int kRoundsOfABody = 8;  // over the rows of one body, at most
constexpr double kSettled = 1e-3;  // of what the first round changed: a round that changes less is the last

// What one body, which alone moves, has of a row.
struct Bound {
  const ContactRow* row = nullptr;
  bool is_b = false;
  Vec3 other = Vec3::Zero();  // the other body's velocity at the point, m/s
  double response = 0.0;      // of the separating speed to an impulse, 1/kg; 0: not asked for yet
  double impulse = 0.0;       // N s

  const Vec3& arm() const { return is_b ? row->r_b : row->r_a; }
};

double responseOf(const ImpulseBody& body, const Bound& bound) {
  const Vec3 lever = bound.arm().cross(bound.row->n);
  return body.inverseMassAlong(bound.row->n) + dot(lever, body.inverse_tensor * lever);
}

// Brings the body to one of its bounds. Returns the change of speed, m/s.
double meet(Bound& bound, ImpulseBody& body) {
  const Vec3& n = bound.row->n;
  const Vec3 own = body.velocity.at(bound.arm());
  const double miss = dot(n, bound.is_b ? own - bound.other : bound.other - own) - bound.row->lowest_speed;
  if (miss >= 0.0 && bound.impulse == 0.0) return 0.0;
  if (bound.response == 0.0) bound.response = responseOf(body, bound);
  if (isUnanswered(body, {}, bound.response)) return 0.0;
  const double impulse = std::max(0.0, bound.impulse - miss / bound.response);
  const double change = impulse - bound.impulse;
  if (change == 0.0) return 0.0;
  bound.impulse = impulse;
  body.apply((bound.is_b ? change : -change) * n, bound.arm());
  return std::abs(change) * bound.response;
}

// Brings one body to its bounds, round by round.
void settle(std::span<Bound> bounds, ImpulseBody& body) {
  double first = 0.0;
  for (int round = 0; round < kRoundsOfABody; ++round) {
    double largest = 0.0;
    for (Bound& bound : bounds) largest = std::max(largest, meet(bound, body));
    if (round == 0) first = largest;
    if (largest <= kSettled * first) return;
  }
}

}  // namespace

// The bodies that rows bear, each after those that bear it, and the rows of each in their order.
void UpwardPass::placeRows(std::span<const ContactRow> rows, const BearingOrder& order) {
  for (const int body : order.bodies()) borne_.push_back({.body = body});
  for (const ContactRow& row : rows)
    if (const int body = order.borneBy(row); body >= 0) ++borne_[at(order.placeOf(body))].end;
  std::size_t placed = 0;
  for (Borne& borne : borne_) {
    const std::size_t count = std::exchange(borne.end, placed);
    borne.begin = placed;
    placed += count;
  }
  rows_.resize(placed);
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (const int body = order.borneBy(rows[i]); body >= 0) rows_[borne_[at(order.placeOf(body))].end++] = i;
}

void UpwardPass::findLevels(std::span<const ContactRow> rows, std::span<const ImpulseBody> bodies,
                            Scratch& scratch) {
  for (const ContactRow& row : rows) scratch.level[at(row.a)] = scratch.level[at(row.b)] = 0;
  for (Borne& borne : borne_) {
    for (std::size_t i = borne.begin; i < borne.end; ++i) {
      const ContactRow& row = rows[rows_[i]];
      const int below = row.a == borne.body ? row.b : row.a;
      if (bodies[at(below)].inverse_mass > 0.0)
        borne.level = std::max(borne.level, scratch.level[at(below)] + 1);
    }
    scratch.level[at(borne.body)] = borne.level;
  }
  std::stable_sort(borne_.begin(), borne_.end(),
                   [](const Borne& x, const Borne& y) { return x.level < y.level; });
  for (std::size_t i = 0; i < borne_.size(); ++i) {
    if (i == 0 || borne_[i].level != borne_[i - 1].level) levels_.push_back({i, i, 0});
    levels_.back().end = i + 1;
    levels_.back().rows += borne_[i].end - borne_[i].begin;
  }
}

void UpwardPass::order(std::span<const ContactRow> rows, std::span<const ImpulseBody> bodies, const Vec3& up,
                       Scratch& scratch) {
  borne_.clear();
  rows_.clear();
  levels_.clear();
  const auto stands = [&](const ContactRow& row) {
    return bodies[at(row.a)].inverse_mass == 0.0 || bodies[at(row.b)].inverse_mass == 0.0;
  };
  if (up.isZero(0.0) || std::none_of(rows.begin(), rows.end(), stands)) return;
  scratch.level.resize(bodies.size());
  scratch.order.find(rows, bodies, up);
  placeRows(rows, scratch.order);
  findLevels(rows, bodies, scratch);
}

void UpwardPass::make(std::span<const ContactRow> rows, std::span<ImpulseBody> bodies, Crew* crew) const {
  const auto settleSome = [&](std::span<const Borne> some, std::vector<Bound>& bounds) {
    for (const Borne& borne : some) {
      bounds.clear();
      for (std::size_t i = borne.begin; i < borne.end; ++i) {
        const ContactRow& row = rows[rows_[i]];
        const bool is_b = row.b == borne.body;
        const Vec3 other =
            is_b ? bodies[at(row.a)].velocity.at(row.r_a) : bodies[at(row.b)].velocity.at(row.r_b);
        bounds.push_back({&row, is_b, other});
      }
      settle(bounds, bodies[at(borne.body)]);
    }
  };
  std::vector<Bound> of_caller;
  for (const Level& level : levels_) {
    const std::span<const Borne> some = std::span(borne_).subspan(level.begin, level.end - level.begin);
    if (crew == nullptr || crew->threads() == 1 || level.rows < kWorthSharing) {
      settleSome(some, of_caller);
      continue;
    }
    const std::size_t few = std::max<std::size_t>(1, some.size() * (kWorthSharing / 2) / level.rows);
    crew->runStretches(some.size(), few, [&](std::size_t begin, std::size_t end) {
      std::vector<Bound> bounds;
      settleSome(some.subspan(begin, end - begin), bounds);
    });
  }
}

}  // namespace carom
