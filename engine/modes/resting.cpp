#include "engine/modes/resting.h"

#include <algorithm>
#include <vector>

#include "engine/foundation/tolerances.h"
#include "engine/modes/support_polygon.h"
#include "engine/response/standing_solver.h"

namespace carom {
namespace {

// How far the effective force may pass beside the polygon, relative to the body's radius: contact points
// stand half a gap beside the true ones. The balance of forces (2) is what decides; this spares it most
// hopeless cases.
constexpr double kSupportMargin = 0.05;
// The polygon speaks for contacts that are level within this sine; on slopes and in wedges friction can hold
// a body whose centre is not above its contacts, and (2) alone decides.
constexpr double kLevelContactSine = 0.05;
// Sweeps between two looks at whether forces balance.
constexpr int kBalanceSweeps = 100;
// Of the allowed speed: sweeps that change less will not balance them.
constexpr double kConvergedShare = 0.01;

bool standsOnLevelContacts(std::span<const BodyContact> contacts, const Vec3& weight) {
  const Vec3 down = weight.normalized();
  for (const BodyContact& c : contacts)
    if (!c.force_N.isZero(0.0) && c.n_W.cross(down).norm() > kLevelContactSine) return false;
  return true;
}

bool forcesPassThroughSupports(const RestQuestion& q) {
  std::vector<std::vector<BodyContact>> contacts(q.bodies.size());
  std::vector<char> resisted(q.bodies.size(), 0);  // torques hold it: only (2) knows
  for (const ContactRow& row : q.rows) {
    const Vec3 force = rowImpulse(row, row.impulse) / q.step_s;
    const auto a = static_cast<std::size_t>(row.a);
    const auto b = static_cast<std::size_t>(row.b);
    contacts[a].push_back({q.bodies[a].center + row.r_a, -row.n, -force});
    contacts[b].push_back({q.bodies[b].center + row.r_b, row.n, force});
    if (row.resistance.rolling_m > 0.0) resisted[a] = resisted[b] = 1;
  }
  for (std::size_t i = 0; i < q.bodies.size(); ++i) {
    if (q.bodies[i].inverse_mass == 0.0) continue;
    const Vec3 weight = q.gravity / q.bodies[i].inverse_mass;
    if (weight.isZero(0.0)) return false;
    if (resisted[i] != 0 || !standsOnLevelContacts(contacts[i], weight)) continue;
    if (supportMiss(q.bodies[i].center, weight, contacts[i]) > kSupportMargin * q.radii[i]) return false;
  }
  return true;
}

// By how much pressures within the margin of their points could turn each body in the step, N m s.
std::vector<double> marginMoments(const RestQuestion& q, std::span<const ContactRow> rows) {
  std::vector<double> moments(q.bodies.size(), 0.0);
  for (std::size_t k = 0; k < q.slack_m.size(); ++k) {
    const double moment = rows[k].impulse.x() * q.slack_m[k];
    moments[static_cast<std::size_t>(rows[k].a)] += moment;
    moments[static_cast<std::size_t>(rows[k].b)] += moment;
  }
  return moments;
}

// Whether a moment that large could stop a body that only turns, be it about its contact points: along the
// angular velocity it stops what has 2 E / omega of momentum about the axis.
bool stopsTurning(const ImpulseBody& body, double radius_m, double moment) {
  const Velocity& v = body.velocity;
  const double omega = v.angular.norm();
  if (body.inverse_mass == 0.0 || v.linear.norm() > omega * radius_m) return false;
  if (body.has_locks) return false;  // what holds it is not known by its contacts alone
  const double twice_energy =
      v.linear.squaredNorm() / body.inverse_mass + dot(v.angular, body.inverse_tensor.inverse() * v.angular);
  return twice_energy <= omega * moment;
}

// Whether forces leave nothing over: after one step from standstill even the fastest point is slower than
// allowed, but for turning within the margin of contact points.
bool isBalanced(const RestQuestion& q, std::span<const ContactRow> rows, std::span<const ImpulseBody> bodies,
                double allowed_mps) {
  std::vector<double> moments;  // made when some body asks
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const Velocity& v = bodies[i].velocity;
    if (v.linear.norm() + v.angular.norm() * q.radii[i] <= allowed_mps) continue;
    if (moments.empty()) moments = marginMoments(q, rows);
    if (!stopsTurning(bodies[i], q.radii[i], moments[i])) return false;
  }
  return true;
}

// Whether impulses come to balance what the bodies have been given, within a bound of sweeps.
bool comesToBalance(const RestQuestion& q, std::span<ContactRow> rows, std::span<ImpulseBody> bodies) {
  const double allowed = tolerance::kRestAcceleration * q.gravity.norm() * q.step_s;
  const double converged = kConvergedShare * allowed;
  const auto most =
      std::max(tolerance::kRestSweeps, tolerance::kRestRowVisits / static_cast<int>(rows.size() + 1));
  for (int sweeps = 0; sweeps < most;) {
    const SolverReport report =
        solveStandingContacts(rows, bodies, {.sweeps = kBalanceSweeps, .residual_mps = converged});
    sweeps += report.sweeps;
    if (isBalanced(q, rows, bodies, allowed)) return true;
    if (report.residual_mps <= converged) return false;
  }
  return false;
}

// Whether impulses within the friction cones take all that gravity, air and water give in a step. Contacts
// that press now hold at the gap they have.
bool conesBalanceGravity(const RestQuestion& q) {
  std::vector<ContactRow> rows(q.rows.begin(), q.rows.end());
  std::vector<ImpulseBody> bodies(q.bodies.begin(), q.bodies.end());
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    bodies[i].velocity = {};
    if (bodies[i].inverse_mass == 0.0) continue;
    bodies[i].velocity = q.pushes.empty() ? Velocity{q.step_s * q.gravity, Vec3::Zero()} : q.pushes[i];
  }
  for (ContactRow& row : rows) {
    row.still_slip.setZero();
    if (row.impulse.x() > 0.0) row.lowest_speed = 0.0;
    applyLoad(row, bodies);
  }
  const bool balanced = comesToBalance(q, rows, bodies);
  for (std::size_t i = 0; i < q.balance.size(); ++i) q.balance[i] = {rows[i].impulse, rows[i].torque};
  return balanced;
}

}  // namespace

bool liesStill(const Velocity& velocity, double radius_m) {
  return velocity.linear.norm() + velocity.angular.norm() * radius_m < tolerance::kRestSpeed;
}

bool canRest(const RestQuestion& question) {
  return (!question.pushes.empty() || forcesPassThroughSupports(question)) && conesBalanceGravity(question);
}

}  // namespace carom
