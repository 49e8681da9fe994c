#include "engine/simulation/swing_damping.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "engine/foundation/index.h"
#include "engine/simulation/events/path_lifts.h"

namespace carom {
namespace {

// Of each body, whether no friction holds it, or those that touch it, to what does not move: then nothing
// slows its sliding.
std::vector<char> glidingBodies(const std::vector<Body>& bodies, LastingContacts& contacts) {
  std::vector<char> gliding(bodies.size(), 0);
  const auto holds = [&](const ContactRow& row) {
    return row.impulse.x() > 0.0 && row.coefficient > 0.0 &&
           !(bodies[at(row.a)].moves() && bodies[at(row.b)].moves());
  };
  for (const LastingContacts::Island& island : contacts.islands) {
    const std::span<const ContactRow> rows = contacts.rowsOf(island);
    if (std::any_of(rows.begin(), rows.end(), holds)) continue;
    for (const ContactRow& row : rows) gliding[at(row.a)] = gliding[at(row.b)] = 1;
  }
  return gliding;
}

}  // namespace

void dampSwings(const LastingWorld& world, LastingContacts& contacts, const FlightPlanner& planner,
                const ClosedIslands& closed) {
  std::optional<std::vector<char>> gliding;  // once somebody swings
  for (const int i : world.active.list()) {
    Body& body = world.bodies[at(i)];
    // What touches only what flies with it has no rest to swing about, and keeps its momentum.
    const bool flies = planner.isVacuum() && closed.isClosed(i);
    if (!body.moves() || !contacts.touched[at(i)] || body.collided || flies) {
      body.swing.forget();
      continue;
    }
    const double energy_J = kineticEnergy(body.inertia, body.X_WB.rotation, body.velocity);
    const double weight_N = body.inertia.mass_kg * world.settings.gravity.norm();
    body.swing.follow(body.velocity, body.radius_m, energy_J / weight_N, world.settings.step_s);
    const double keeps = body.swing.keeps(world.settings.step_s);
    if (keeps == 1.0) continue;
    if (!gliding) gliding = glidingBodies(world.bodies, contacts);
    if ((*gliding)[at(i)] != 0) {
      slowAlong(body, keeps, planner.pull(i, body).normalized());
      continue;
    }
    body.velocity.linear *= keeps;
    body.velocity.angular *= keeps;
  }
}

}  // namespace carom
