#include "engine/response/sweeps/no_room.h"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "engine/response/sweeps/turning_resistance.h"

namespace carom {
namespace {

constexpr int kSweeps = 16;  // before impulses are taken to grow evenly; twice as many each time they do not
constexpr std::size_t kMostRoomVisits =
    4000;  // of rows, the last time: a row of n bodies takes some n^2 sweeps
// A body that would have to give way so many times as fast as it is pushed is blocked: pressed by a wedge of
// two degrees, for one.
constexpr double kMostLeverage = 30.0;

// The speed at which one of a row's bodies, on its way, presses the row together, m/s; `sign`: 1 for A, -1
// for B.
double pushOf(const ImpulseBody& body, const Vec3& r, const Vec3& n, double sign) {
  return body.inverse_mass == 0.0 ? sign * dot(n, body.velocity.at(r)) : 0.0;
}
double pushOfA(const ContactRow& row, std::span<const ImpulseBody> bodies) {
  return pushOf(bodies[static_cast<std::size_t>(row.a)], row.r_a, row.n, 1.0);
}
double pushOfB(const ContactRow& row, std::span<const ImpulseBody> bodies) {
  return pushOf(bodies[static_cast<std::size_t>(row.b)], row.r_b, row.n, -1.0);
}

// The bodies without what the rows have given them.
std::vector<ImpulseBody> before(std::span<const ContactRow> rows, std::span<const ImpulseBody> bodies) {
  std::vector<ImpulseBody> without(bodies.begin(), bodies.end());
  for (const ContactRow& row : rows) takeBackLoad(row, without);
  return without;
}

// Rows that are swept on and on, from no impulses.
struct Swept {
  std::vector<ContactRow> rows;
  std::vector<ImpulseBody> bodies;
  bool friction = false;
};

Swept begin(std::span<const ContactRow> rows, std::vector<ImpulseBody> bodies, bool friction) {
  Swept swept{{rows.begin(), rows.end()}, std::move(bodies), friction};
  for (ContactRow& row : swept.rows) {
    row.impulse.setZero();
    row.torque.setZero();
    row.seen_stir = -1.0;
  }
  return swept;
}

// By how much the impulses grow in further sweeps, as impulses in the cones.
std::vector<Vec3> growthIn(int sweeps, Swept& swept) {
  std::vector<Vec3> growth;
  for (const ContactRow& row : swept.rows) growth.push_back(-row.impulse);
  SolverReport report;
  for (int i = 0; i < sweeps; ++i)
    sweepRows(swept.rows, swept.bodies, {.friction = swept.friction, .forward = i % 2 == 0}, report);
  for (std::size_t i = 0; i < growth.size(); ++i) {
    const ContactRow& row = swept.rows[i];
    growth[i] += row.impulse;
    growth[i].x() = std::max(0.0, growth[i].x());
    growth[i].tail<2>() =
        shortened(growth[i].tail<2>(), swept.friction ? row.coefficient * growth[i].x() : 0.0);
  }
  return growth;
}

// kg: of the bodies that such impulses press and can move.
double massOf(std::span<const ContactRow> rows, std::span<const Vec3> impulses,
              std::span<const ImpulseBody> bodies) {
  std::vector<int> pressed;
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (impulses[i].x() > 0.0) pressed.insert(pressed.end(), {rows[i].a, rows[i].b});
  std::sort(pressed.begin(), pressed.end());
  pressed.erase(std::unique(pressed.begin(), pressed.end()), pressed.end());
  double mass = 0.0;
  for (const int i : pressed) {
    const double inverse_mass = bodies[static_cast<std::size_t>(i)].inverse_mass;
    if (inverse_mass > 0.0) mass += 1.0 / inverse_mass;
  }
  return mass;
}

// Twice the energy of what such impulses make of velocities at rest, J.
double twiceEnergyOf(std::span<const ContactRow> rows, std::span<const Vec3> impulses,
                     std::vector<ImpulseBody> bodies) {
  for (ImpulseBody& body : bodies) body.velocity = {};
  for (std::size_t i = 0; i < rows.size(); ++i) applyToRow(rows[i], impulses[i], bodies);
  double twice_energy = 0.0;
  for (std::size_t i = 0; i < rows.size(); ++i)
    twice_energy += dot(impulses[i], rowVelocity(rows[i], bodies));
  return twice_energy;
}

// Whether such impulses, which press and move nothing, prove that there is no room.
bool prove(std::span<const ContactRow> rows, std::span<const Vec3> impulses,
           std::span<const ImpulseBody> bodies) {
  double on_misses = 0.0, by_push = 0.0, fastest = 0.0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double pressing = impulses[i].x();
    if (!(pressing > 0.0)) continue;
    const double missing = -rowMiss(rows[i], bodies).x();
    const double push = pushOfA(rows[i], bodies) + pushOfB(rows[i], bodies);
    on_misses += pressing * missing;
    by_push += pressing * push;
    fastest = std::max({fastest, missing, push});
  }
  if (!(on_misses > 0.0) || by_push < 0.5 * on_misses) return false;
  const double reach = kMostLeverage * fastest;
  return on_misses * on_misses > reach * reach * massOf(rows, impulses, bodies) *
                                     twiceEnergyOf(rows, impulses, {bodies.begin(), bodies.end()});
}

// Who pushes most on rows that such impulses press, and whoever does half as much. What slides by pushes by
// rounding.
std::vector<int> pushersOf(std::span<const ContactRow> rows, std::span<const Vec3> impulses,
                           std::span<const ImpulseBody> bodies) {
  std::map<int, double> powers;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double pressing = impulses[i].x();
    if (!(pressing > 0.0)) continue;
    powers[rows[i].a] += pressing * pushOfA(rows[i], bodies);
    powers[rows[i].b] += pressing * pushOfB(rows[i], bodies);
  }
  double most = 0.0;
  for (const auto& [body, power] : powers) most = std::max(most, power);
  std::vector<int> pushers;
  for (const auto& [body, power] : powers)
    if (power > 0.0 && power >= 0.5 * most) pushers.push_back(body);
  return pushers;
}

}  // namespace

std::vector<int> leavingNoRoom(std::span<const ContactRow> rows, std::span<const ImpulseBody> bodies,
                               bool friction) {
  const bool pushed = std::any_of(rows.begin(), rows.end(), [&](const ContactRow& row) {
    return pushOfA(row, bodies) > 0.0 || pushOfB(row, bodies) > 0.0;
  });
  if (!pushed) return {};
  const std::vector<ImpulseBody> start = before(rows, bodies);
  for (const bool rubs : {false, true}) {
    if (rubs && !friction) break;
    Swept swept = begin(rows, start, rubs);
    growthIn(kSweeps, swept);
    for (int sweeps = kSweeps;
         sweeps == kSweeps || static_cast<std::size_t>(sweeps) * rows.size() <= kMostRoomVisits;
         sweeps *= 2) {
      const std::vector<Vec3> growth = growthIn(sweeps, swept);
      if (prove(rows, growth, start)) return pushersOf(rows, growth, start);
    }
  }
  return {};
}

}  // namespace carom
