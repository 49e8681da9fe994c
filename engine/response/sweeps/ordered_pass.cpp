#include "engine/response/sweeps/ordered_pass.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/foundation/index.h"

namespace carom {
namespace {

constexpr int kRoundsOfABody = 8;  // over the rows of one body, at most
constexpr double kSettled = 1e-3;  // of what the first round changed: a round that changes less is the last

// The end of a row that gives way to the other.
struct UpperEnd {
  double height = 0.0;
  int body = -1;
  std::size_t row = 0;
  auto operator<=>(const UpperEnd&) const = default;
};

int upperBody(const ContactRow& row, std::span<const ImpulseBody> bodies, const Vec3& up) {
  const ImpulseBody& a = bodies[at(row.a)];
  const ImpulseBody& b = bodies[at(row.b)];
  if (b.inverse_mass == 0.0) return row.a;
  if (a.inverse_mass == 0.0) return row.b;
  return dot(up, b.center - a.center) >= 0.0 ? row.b : row.a;
}

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

void passUpwards(std::span<const ContactRow> rows, std::span<ImpulseBody> bodies, const Vec3& up) {
  if (up.isZero(0.0)) return;
  std::vector<UpperEnd> ends;
  ends.reserve(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const int body = upperBody(rows[i], bodies, up);
    if (bodies[at(body)].inverse_mass > 0.0) ends.push_back({dot(up, bodies[at(body)].center), body, i});
  }
  std::sort(ends.begin(), ends.end());
  std::vector<Bound> bounds;
  for (std::size_t first = 0, end = 0; first < ends.size(); first = end) {
    const int body = ends[first].body;
    bounds.clear();
    for (; end < ends.size() && ends[end].body == body; ++end) {
      const ContactRow& row = rows[ends[end].row];
      const bool is_b = row.b == body;
      const Vec3 other =
          is_b ? bodies[at(row.a)].velocity.at(row.r_a) : bodies[at(row.b)].velocity.at(row.r_b);
      bounds.push_back({&row, is_b, other});
    }
    settle(bounds, bodies[at(body)]);
  }
}

}  // namespace carom
