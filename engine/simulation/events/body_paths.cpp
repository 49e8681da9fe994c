#include "engine/simulation/events/body_paths.h"

#include <algorithm>
#include <utility>

#include "engine/foundation/index.h"
#include "engine/simulation/contacts/carried_path.h"
#include "engine/simulation/events/path_lifts.h"

namespace carom {

void BodyPaths::bring(int index, double time_s) {
  Body& body = bodies_[at(index)];
  if (body.path.start_s == time_s) return;
  counters_.work_J += planner_.countWorkOfLoad(index, body, time_s);
  if (ended_ != nullptr) ended_->add(at(index), body, time_s);
  const Pose X_WB = body.path.at(time_s);
  const Velocity momentum_velocity = body.velocityAt(time_s, X_WB.rotation);
  countPath(body, momentum_velocity, X_WB.position, time_s);
  body.momentum_velocity = momentum_velocity;
  body.solved_spin_B += (time_s - body.path.start_s) * body.turning_B;
  body.path.velocity = body.path.velocityAt(time_s);
  body.path.spin += (time_s - body.path.start_s) * body.path.spin_change.rate;
  body.path.X_WB = X_WB;
  body.path.start_s = time_s;
}

void BodyPaths::fly(int index) {
  Body& body = bodies_[at(index)];
  body.travel = Travel::kBallistic;
  planner_.plan(index, body);
}

void BodyPaths::flyStraight(int index) {
  fly(index);
  Body& body = bodies_[at(index)];
  const double rest = restOf(body);
  body.travel = Travel::kCarried;
  carryAlong(body, {body.path.meanVelocity(body.path.start_s, rest), body.path.spin}, rest, false);
}

void BodyPaths::carryTo(int index, const Velocity& end, bool bends) {
  Body& body = bodies_[at(index)];
  body.travel = Travel::kCarried;
  drive(body, end);
  carryAlong(body,
             {0.5 * (body.momentum_velocity.linear + end.linear),
              0.5 * (body.momentum_velocity.angular + end.angular)},
             restOf(body), bends);
}

void BodyPaths::keepPath(int index, const Velocity& end, const Velocity& mean) {
  Body& body = bodies_[at(index)];
  body.travel = Travel::kCarried;
  drive(body, end);
  carryAlong(body, mean, restOf(body), false);
}

void BodyPaths::driveHeld(int index, const Velocity& end) {
  Body& body = bodies_[at(index)];
  const double rest = restOf(body);
  if (rest > 0.0) drive(body, end);
}

// By the tensor of the path's start.
void BodyPaths::drive(Body& body, const Velocity& end) {
  const Velocity& begin = body.momentum_velocity;
  driveEvenly(body, {begin,
                     {end.linear - begin.linear, end.angular - begin.angular},
                     body.path.X_WB.rotation,
                     begin.angular,
                     restOf(body)});
}

void BodyPaths::lead(int index, const Velocity& mean, bool bends) {
  Body& body = bodies_[at(index)];
  body.travel = Travel::kCarried;
  carryAlong(body, mean, restOf(body), bends);
}

Velocity BodyPaths::meanOfPath(const Body& body, double time_s) const {
  return {body.path.meanVelocity(time_s, settings_.step_s - time_s), body.path.angularVelocityAt(time_s)};
}

Velocity BodyPaths::meanOfMomentum(const Body& body, double time_s) const {
  const Velocity begin = body.velocityAt(time_s), end = body.velocityAt(settings_.step_s);
  return {0.5 * (begin.linear + end.linear), 0.5 * (begin.angular + end.angular)};
}

void BodyPaths::findOpening(int index) {
  Body& body = bodies_[at(index)];
  const double time_s = body.path.start_s, rest = restOf(body);
  body.opening_W = 0.0;
  if (!(rest > 0.0) || body.travel == Travel::kBallistic) return;  // in flight the path is the momentum's
  const Velocity path = meanOfPath(body, time_s), momentum = meanOfMomentum(body, time_s);
  for (const int p : table_.pairsOf(index)) {
    const ShapePair& pair = table_.pairs()[at(p)];
    if (!pair.presses()) continue;
    const bool is_a = pair.body_a == index;
    const Body& other = bodies_[at(is_a ? pair.body_b : pair.body_a)];
    PairMotions motions{path, meanOfPath(other, time_s), momentum, meanOfMomentum(other, time_s)};
    if (!is_a) {
      std::swap(motions.path_a, motions.path_b);
      std::swap(motions.momentum_a, motions.momentum_b);
    }
    for (const RememberedImpulse& acting : pair.remembered) {
      const OpeningPower opening =
          openingPower({acting.n_W, acting.arm_a, acting.arm_b}, dot(acting.force_W, acting.n_W), motions,
                       openingNoise(pair.window, rest));
      body.opening_W += is_a ? opening.of_a_W : opening.of_b_W;
    }
  }
}

void BodyPaths::halve(int index) {
  const Trajectory& path = bodies_[at(index)].path;
  const Velocity mean{path.meanVelocity(path.start_s, restOf(bodies_[at(index)])),
                      path.angularVelocityAt(path.start_s)};
  lead(index, {0.5 * mean.linear, 0.5 * mean.angular}, false);
}

void BodyPaths::hold(int index) {
  Body& body = bodies_[at(index)];
  if (body.is_static || body.travel == Travel::kHeld) return;
  if (body.is_kinematic) {
    stop(index);
    return;
  }
  endPath(body);
  counters_.stopped_bodies += !body.frozen;
  body.frozen = true;
}

bool BodyPaths::stopDriven(int index, double time_s) {
  if (bodies_[at(index)].travel != Travel::kDriven) return false;
  bring(index, time_s);
  stop(index);
  return true;
}

void BodyPaths::stop(int index) {
  Body& body = bodies_[at(index)];
  countForcesOf(index, body.path.start_s, -1.0);
  stopKinematic(body);
  ++counters_.stopped_kinematic;
}

void BodyPaths::beginNextPiece(int index) {
  Body& body = bodies_[at(index)];
  const double time_s = body.piece_end_s;
  countForcesOf(index, time_s, -1.0);
  bring(index, time_s);
  planner_.drive(index, body);
  countForcesOf(index, time_s, 1.0);
}

void BodyPaths::countForcesOf(int index, double time_s, double sign) {
  for (const int pair : table_.pairsOf(index))
    counters_.work_J += sign * workOfForces(table_.pairs()[at(pair)], bodies_, time_s, settings_.step_s);
}

}  // namespace carom
