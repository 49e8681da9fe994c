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

// Brings one body to the bounds of its rows, round by round.
void settle(std::span<const UpperEnd> ends, std::span<const ContactRow> rows, std::span<ImpulseBody> bodies,
            std::span<double> impulses) {
  ImpulseBody& body = bodies[at(ends.front().body)];
  double first = 0.0;
  for (int round = 0; round < kRoundsOfABody; ++round) {
    double largest = 0.0;
    for (std::size_t k = 0; k < ends.size(); ++k) {
      const ContactRow& row = rows[ends[k].row];
      const bool is_b = row.b == ends[k].body;
      const double miss = dot(row.n, rowVelocityInWorld(row, bodies)) - row.lowest_speed;
      if (miss >= 0.0 && impulses[k] == 0.0) continue;
      const Vec3& r = is_b ? row.r_b : row.r_a;
      const Vec3 lever = r.cross(row.n);
      const double response = body.inverseMassAlong(row.n) + dot(lever, body.inverse_tensor * lever);
      const double impulse = std::max(0.0, impulses[k] - miss / response);
      const double change = impulse - impulses[k];
      if (change == 0.0) continue;
      impulses[k] = impulse;
      body.apply((is_b ? change : -change) * row.n, r);
      largest = std::max(largest, std::abs(change) * response);
    }
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
  std::vector<double> impulses(ends.size(), 0.0);
  for (std::size_t first = 0, end = 0; first < ends.size(); first = end) {
    while (end < ends.size() && ends[end].body == ends[first].body) ++end;
    settle(std::span(ends).subspan(first, end - first), rows, bodies,
           std::span(impulses).subspan(first, end - first));
  }
}

}  // namespace carom
