#include "engine/modes/resting.h"

#include <vector>

#include "engine/environment/gravity.h"
#include "engine/foundation/tolerances.h"
#include "engine/modes/support_polygon.h"

namespace carom {
namespace {

// How far the effective force may pass beside the polygon, relative to the body's radius: contact points
// stand half a gap beside the true ones. The balance of forces (2) is what decides; this spares it most
// hopeless cases.
constexpr double kSupportSlack = 0.05;
// The polygon speaks for contacts that are level within this sine; on slopes and in wedges friction can hold
// a body whose centre is not above its contacts, and (2) alone decides.
constexpr double kLevelSine = 0.05;

bool standsOnLevelContacts(std::span<const BodyContact> contacts, const Vec3& weight) {
  const Vec3 down = weight.normalized();
  for (const BodyContact& c : contacts)
    if (!c.force_N.isZero(0.0) && c.n_W.cross(down).norm() > kLevelSine) return false;
  return true;
}

bool forcesPassThroughSupports(const RestQuestion& q) {
  std::vector<std::vector<BodyContact>> contacts(q.bodies.size());
  for (const ContactRow& row : q.rows) {
    const Vec3 force = rowImpulse(row, row.impulse) / q.step_s;
    const auto a = static_cast<std::size_t>(row.a);
    const auto b = static_cast<std::size_t>(row.b);
    contacts[a].push_back({q.bodies[a].center + row.r_a, -row.n, -force});
    contacts[b].push_back({q.bodies[b].center + row.r_b, row.n, force});
  }
  for (std::size_t i = 0; i < q.bodies.size(); ++i) {
    if (q.bodies[i].inverse_mass == 0.0) continue;
    const Vec3 weight = q.gravity / q.bodies[i].inverse_mass;
    if (weight.isZero(0.0)) return false;
    if (!standsOnLevelContacts(contacts[i], weight)) continue;
    if (supportMiss(q.bodies[i].center, weight, contacts[i]) > kSupportSlack * q.radii[i]) return false;
  }
  return true;
}

bool conesBalanceGravity(const RestQuestion& q) {
  std::vector<ContactRow> rows(q.rows.begin(), q.rows.end());
  std::vector<ImpulseBody> bodies(q.bodies.begin(), q.bodies.end());
  const double gravity_speed = q.gravity.norm() * q.step_s;
  for (ImpulseBody& body : bodies) {
    body.velocity = {};
    if (body.inverse_mass > 0.0) body.velocity.linear = gravityImpulsePerMass(q.gravity, q.step_s);
  }
  for (const ContactRow& row : rows) applyToRow(row, row.impulse, bodies);
  const double allowed = tolerance::kRestAcceleration * gravity_speed;
  solveContacts(rows, bodies, {tolerance::kRestSweeps, 0.01 * allowed, true});
  for (std::size_t i = 0; i < bodies.size(); ++i)
    if (bodies[i].velocity.linear.norm() + bodies[i].velocity.angular.norm() * q.radii[i] > allowed)
      return false;
  return true;
}

}  // namespace

bool liesStill(const Velocity& velocity, double radius_m) {
  return velocity.linear.norm() + velocity.angular.norm() * radius_m < tolerance::kRestSpeed;
}

bool canRest(const RestQuestion& question) {
  return forcesPassThroughSupports(question) && conesBalanceGravity(question);
}

}  // namespace carom
