#include "engine/simulation/events/path_lifts.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/foundation/index.h"

namespace carom {
namespace {

// The sine between two that are the same but for rounding.
constexpr double kRoundingOfNormals = 1e-9;

// Takes energy, J/kg, out of the speed along `down`. Returns what that has less.
double slowFall(Body& body, double energy, const Vec3& down) {
  const double falling = dot(body.velocity.linear, down);
  const double left = falling * falling - 2.0 * energy;
  body.velocity.linear += (std::copysign(std::sqrt(std::max(0.0, left)), falling) - falling) * down;
  return std::max(0.0, -0.5 * left);
}

// The part of a body's spin that its angular momentum across `down` makes.
Vec3 tippingOf(const Body& body, const Vec3& momentum, const Vec3& down) {
  const Mat3 response = body.impulseBody(body.X_WB, body.velocity).inverse_tensor;
  return response * (momentum - dot(down, momentum) * down);
}

// Takes energy, J/kg, as far as there is, out of the angular momentum across `down`.
void slowTipping(Body& body, double energy, const Vec3& down) {
  const Quat& R_WB = body.X_WB.rotation;
  const Vec3 momentum = angularMomentum(body.inertia, R_WB, body.velocity.angular);
  const Vec3 tipping = tippingOf(body, momentum, down);
  // Less by a share s of that the spin has less energy by s p - s^2 q / 2.
  const double p = dot(tipping, momentum);
  const double q = dot(tipping, angularMomentum(body.inertia, R_WB, tipping));
  if (!(p > 0.0 && q > 0.0)) return;
  const double root = std::sqrt(std::max(0.0, p * p - 2.0 * q * body.inertia.mass_kg * energy));
  body.velocity.angular -= std::min(1.0, (p - root) / q) * tipping;
}

// A body that rises, falls or tips does so by what lifted it, and this pays; what forces that way cannot
// change, its momentum across and its angular momentum about that, it keeps. Where nothing moves, it was held
// up.
void takeBack(Body& body, double energy, const Vec3& way) {
  const double left = slowFall(body, energy, way);
  if (left > 0.0) slowTipping(body, left, way);
}

bool isSameWay(const Vec3& n, const Vec3& m) {
  return n.cross(m).norm() <= kRoundingOfNormals;
}

}  // namespace

void slowAlong(Body& body, double keeps, const Vec3& way) {
  const Vec3 momentum = angularMomentum(body.inertia, body.X_WB.rotation, body.velocity.angular);
  body.velocity.angular -= (1.0 - keeps) * tippingOf(body, momentum, way);
  body.velocity.linear -= (1.0 - keeps) * dot(body.velocity.linear, way) * way;
}

double liftOfPath(const Body& body, const Velocity& velocity, const Vec3& position_m, double time_s) {
  // In flight the path is the momentum's, and what is driven has none.
  if (body.travel == Travel::kBallistic || body.is_kinematic) return 0.0;
  const Trajectory& path = body.path;
  const double dt = time_s - path.start_s;
  const Velocity& before = body.momentum_velocity;
  const Vec3 way = 0.5 * dt * (before.linear + velocity.linear) - (position_m - path.X_WB.position);
  const Vec3 spin = path.angularVelocityAt(path.start_s + 0.5 * dt);
  const Vec3 turn = dt * (0.5 * (before.angular + velocity.angular) - spin);
  return dot(body.acceleration, way) +
         body.inertia.inverse_mass * (dot(body.torque, turn) + dt * body.opening_W);
}

void countPath(Body& body, const Velocity& velocity, const Vec3& position_m, double time_s) {
  body.lift += liftOfPath(body, velocity, position_m, time_s);
  const Trajectory& path = body.path;
  const double dt = time_s - path.start_s;
  const Vec3 begin = path.X_WB.position - body.X_WB.position;
  body.place_sum += dt * (begin + dt * (0.5 * path.velocity + dt / 6.0 * path.acceleration));
}

void PathLifts::begin(std::size_t bodies) {
  together_.part(static_cast<int>(bodies));
  accounts_.resize(bodies);
}

void PathLifts::join(int a, int b, const std::vector<Body>& bodies) {
  if (bodies[at(a)].moves() && bodies[at(b)].moves()) together_.join(a, b);
}

// A pair with what does not give way.
void PathLifts::Account::meet(const ShapePair& pair) {
  for (const RememberedImpulse& acting : pair.remembered) {
    if (acting.force_W.isZero(0.0)) continue;
    if (nearest_m > 0.0) normal_W = acting.n_W;
    nearest_m = 0.0;
    has_one_normal &= isSameWay(acting.n_W, normal_W);
  }
  if (pair.closest.distance_m >= nearest_m) return;
  nearest_m = pair.closest.distance_m;
  normal_W = pair.closest.n_W;
}

// What the forces of what bears them cannot change is the same for all where that is one plane.
void PathLifts::findNormals(const std::vector<Body>& bodies, std::span<const int> active,
                            const PairTable& table) {
  for (const int i : active) {
    Account& account = accounts_[at(together_.of(i))];
    if (!bodies[at(i)].yields() || !(account.net_J > 0.0) || !account.has_one_normal) continue;
    for (const int index : table.pairsOf(i)) {
      const ShapePair& pair = table.pairs()[at(index)];
      if (!bodies[at(pair.body_a == i ? pair.body_b : pair.body_a)].yields()) account.meet(pair);
    }
  }
}

void PathLifts::pay(std::vector<Body>& bodies, std::span<const int> active, const PairTable& table,
                    const FlightPlanner& planner, ClosedIslands& closed) {
  const auto accountOf = [&](int i) -> Account& { return accounts_[at(together_.of(i))]; };
  for (const int i : active) accountOf(i) = {};
  for (const int i : active) {
    const Body& body = bodies[at(i)];
    const double lift_J = body.inertia.mass_kg * body.lift;
    accountOf(i).net_J += lift_J;
    accountOf(i).raised_J += std::max(0.0, lift_J);
  }
  findNormals(bodies, active, table);
  for (const int i : active) {
    Body& body = bodies[at(i)];
    const Account& account = accountOf(i);
    const double lift = std::exchange(body.lift, 0.0);
    if (!(lift > 0.0) || !(account.net_J > 0.0)) continue;
    const double energy = lift * (account.net_J / account.raised_J);
    if (closed.owe(i, body.inertia.mass_kg * energy)) continue;
    const Vec3 pull = planner.pull(i, body);
    // Where nothing pulls, there is no lift, and bodies that only meet each other keep their momentum.
    if (pull.isZero(0.0)) continue;
    const Vec3 down = pull.normalized();
    const bool is_on_slope =
        account.has_one_normal && !account.normal_W.isZero(0.0) && !isSameWay(account.normal_W, down);
    takeBack(body, energy, is_on_slope ? account.normal_W : down);
  }
}

}  // namespace carom
