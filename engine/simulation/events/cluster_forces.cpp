// The forces of lasting contact for the rest of the step, after the collision: the second of a cluster's
// three solves.

#include <algorithm>
#include <limits>

#include "engine/foundation/index.h"
#include "engine/response/sweeps/energy_bound.h"
#include "engine/response/sweeps/turning_resistance.h"
#include "engine/simulation/contacts/carried_path.h"
#include "engine/simulation/events/contact_cluster.h"

namespace carom {
namespace {

// Of the resting mode's speed: forces that make less of it in a step wake no body.
constexpr double kWakingShare = 0.1;

// A remembered force, which is the one on B, acts on one of the two bodies: on A for a negative time.
void act(const RememberedImpulse& acting, const Vec3& arm, double dt_s, ImpulseBody& body) {
  body.apply(dt_s * acting.force_W, arm);
  body.turn(dt_s * acting.torque_W);
}

}  // namespace

// What forces make of member i by the end of the step, after the collision. Air and fluids resist the
// velocity that it has now.
void ContactCluster::findEnd(std::size_t i) {
  const Member& member = members_[i];
  const Body& body = bodies_[at(member.body)];
  const bool flies = body.yields() && (body.travel == Travel::kBallistic || body.travel == Travel::kCarried);
  const bool anew = flies && !planner_.isVacuum() && momentumChanged(i);
  const Velocity gain = anew ? planner_.gainedFrom(member.body, body, time_s_, momentum(i))
                             : gainedByForces(member, momentum(i));
  ends_[i].velocity = {momentum(i).linear + gain.linear, momentum(i).angular + gain.angular};
  if (!anew || body.travel == Travel::kBallistic) return;
  for (const int p : table_.pairsOf(member.body)) {
    const ShapePair& pair = table_.pairs()[at(p)];
    const bool on_a = pair.body_a == member.body;
    for (const RememberedImpulse& acting : pair.remembered)
      act(acting, on_a ? acting.arm_a : acting.arm_b, on_a ? -restOfStep() : restOfStep(), ends_[i]);
  }
}

bool ContactCluster::forcesChanged(std::size_t i) const {
  const Body& body = bodies_[at(members_[i].body)];
  const double change = (ends_[i].velocity.linear - planned_ends_[i].linear).norm() +
                        (ends_[i].velocity.angular - planned_ends_[i].angular).norm() * body.radius_m;
  return change > (body.resting ? kWakingShare * tolerance::kRestSpeed : 0.0);
}

// Ends the forces between the bodies of a pair, both members.
void ContactCluster::releaseForces(int index) {
  pair_released_[at(index)] = number_;
  const ShapePair& pair = table_.pairs()[at(index)];
  counters_.work_J -= workOfForces(pair, bodies_, time_s_, settings_.step_s);
  const int member_a = join(pair.body_a);
  const int member_b = join(pair.body_b);
  ImpulseBody& a = ends_[at(member_a)];
  ImpulseBody& b = ends_[at(member_b)];
  for (const RememberedImpulse& acting : pair.remembered) {
    act(acting, acting.arm_a, restOfStep(), a);
    act(acting, acting.arm_b, -restOfStep(), b);
  }
}

// Ends the forces of a body's pairs whose contact is over, but that still press each other. Before the others
// are solved: what such a force was balanced by must not be left to act alone.
void ContactCluster::releaseDistant(int body) {
  for (int p : table_.pairsOf(body)) {
    ShapePair& pair = table_.pairs()[at(p)];
    if (pair.remembered.empty() || pair_released_[at(p)] == number_) continue;
    releaseForces(p);
    pair.remembered.clear();
  }
}

// The forces that act between the bodies of a pair, whose rows these are, become the rows' own; rows of fast
// approaches, and of fast partings where restitution makes them bounce, give no support.
void ContactCluster::takeOverForces(std::size_t first, std::size_t count) {
  if (count == 0) return;
  const ShapePair& pair = table_.pairs()[at(sources_[first].pair)];
  releaseForces(sources_[first].pair);
  for (std::size_t k = first; k < first + count; ++k) {
    ContactRow& row = rows_[k];
    row.impulse.setZero();
    row.torque.setZero();
    row.lowest_speed = -std::numeric_limits<double>::max();
    if (collidesLater(row, sources_[k])) continue;
    if (pair.restitution > 0.0 && rowVelocity(row, momentum_).x() > pair.collision_speed_mps) continue;
    for (const RememberedImpulse& acting : pair.remembered) {
      if (acting.id != sources_[k].id) continue;
      row.impulse = inRowFrame(row, restOfStep() * acting.force_W);
      row.impulse.x() = std::max(0.0, row.impulse.x());
      row.torque = inRowFrame(row, restOfStep() * acting.torque_W);
    }
    applyLoad(row, ends_);
    row.lowest_speed = gapSpeeds(sources_[k].gap_m, pair, restOfStep(), row.impulse.x() > 0.0).momentum;
  }
}

// Points of the event's pair that press, but that the manifold of this instant does not show (of five corners
// it keeps four): else two corners struck in turn would each undo what holds the other.
void ContactCluster::recallPoints(int event_pair) {
  const auto of_event = [&](const SourcedRow& s) { return s.pair == event_pair; };
  const auto begin = std::ranges::find_if(sources_, of_event);
  if (begin == sources_.end()) return;
  const auto first = static_cast<std::size_t>(begin - sources_.begin());
  std::size_t end = first;
  while (end < sources_.size() && of_event(sources_[end])) ++end;
  const ShapePair& pair = table_.pairs()[at(event_pair)];
  for (const RememberedImpulse& acting : pair.remembered) {
    if (end - first >= ContactManifold::kMaxPoints) break;
    const std::span<const SourcedRow> shown(&sources_[first], end - first);
    const bool known = std::ranges::any_of(shown, [&](const SourcedRow& s) { return s.id == acting.id; });
    if (acting.force_W.isZero(0.0) || known) continue;
    SourcedRow recalled = sources_[first];
    recalled.id = acting.id;
    recalled.gap_m = pair.window.rest;  // held as it is
    recalled.row.r_a = acting.arm_a;
    recalled.row.r_b = acting.arm_b;
    if (rowVelocity(recalled.row, momentum_).x() > pair.collision_speed_mps) continue;
    sources_.insert(sources_.begin() + static_cast<std::ptrdiff_t>(end++), recalled);
  }
}

void ContactCluster::support() {
  stage_ = Stage::kSupport;
  for (std::size_t i = 0; i < members_.size(); ++i) {
    findEnd(i);
    solve_before_[i] = planned_ends_[i];
  }
  if (isExhausted()) {
    keepPlannedForces();
    return;
  }
  sources_.insert(sources_.begin(), collided_.begin(), collided_.end());
  collided_.clear();
  for (const int pair : event_pairs_) recallPoints(pair);
  rows_.clear();
  for (const SourcedRow& sourced : sources_) {
    rows_.push_back(sourced.row);
    prepareRow(rows_.back(), ends_);
  }
  for (std::size_t first = 0, end = 0; first < sources_.size(); first = end) {
    while (end < sources_.size() && sources_[end].pair == sources_[first].pair) ++end;
    takeOverForces(first, end - first);
  }
  for (std::size_t i = 0, known = members_.size(); i < known; ++i) {
    if (!bodies_[at(members_[i].body)].yields()) continue;
    if (members_[i].expanded) {
      releaseDistant(members_[i].body);
    } else if (members_[i].struck) {
      members_[i].expanded = true;
      expand(members_[i].body);
    }
  }
  double pull_mps2 = settings_.gravity.norm();
  for (const Member& member : members_)
    pull_mps2 = std::max(pull_mps2, bodies_[at(member.body)].pull.most_mps2);
  solveSpreading(tolerance::kSolverResidual * pull_mps2 * settings_.step_s);
  std::vector<Velocity> before;
  for (const ImpulseBody& body : momentum_) before.push_back(body.velocity);
  takeBackWork(rows_, ends_, before);
  stops_short_ = isCrowd();
  keepForces();
  findBends();
}

// Forces act on as they did before the event: where no more bodies may join, what ended on one side of a body
// would leave what balanced it on the other to act alone.
void ContactCluster::keepPlannedForces() {
  for (std::size_t i = 0; i < members_.size(); ++i) {
    if (!bodies_[at(members_[i].body)].yields()) continue;
    const std::span<const int> pairs = table_.pairsOf(members_[i].body);
    const bool is_pressed =
        std::any_of(pairs.begin(), pairs.end(), [&](int pair) { return table_.pairs()[at(pair)].presses(); });
    pressed_[i] = is_pressed ? 1 : 0;
  }
  findBends();
}

void ContactCluster::findBends() {
  std::vector<Vec3> accelerations;
  for (std::size_t i = 0; i < members_.size(); ++i)
    accelerations.push_back((ends_[i].velocity.linear - momentum_[i].velocity.linear) / restOfStep());
  bends_.assign(members_.size(), 1);
  for (const SourcedRow& sourced : sources_)
    straightenDips(sourced.row, sourced.gap_m, table_.pairs()[at(sourced.pair)].window, restOfStep(),
                   accelerations, bends_);
}

// What the rows' forces are from now on.
void ContactCluster::keepForces() {
  std::vector<RememberedImpulse> known;
  for (std::size_t first = 0, end = 0; first < sources_.size(); first = end) {
    ShapePair& pair = table_.pairs()[at(sources_[first].pair)];
    known.swap(pair.remembered);
    pair.remembered.clear();
    for (; end < sources_.size() && sources_[end].pair == sources_[first].pair; ++end) {
      const ContactRow& row = rows_[end];
      RememberedImpulse now{.id = sources_[end].id,
                            .force_W = rowImpulse(row, row.impulse) / restOfStep(),
                            .n_W = row.n,
                            .arm_a = row.r_a,
                            .arm_b = row.r_b,
                            .torque_W = rowImpulse(row, row.torque) / restOfStep()};
      for (const RememberedImpulse& before : known)
        if (before.id == now.id) {
          now.impulse_W = before.impulse_W;
          now.torque_impulse_W = before.torque_impulse_W;
        }
      pair.remembered.push_back(now);
      if (row.impulse.x() > 0.0) pressed_[at(row.a)] = pressed_[at(row.b)] = 1;
    }
    counters_.work_J += workOfForces(pair, bodies_, time_s_, settings_.step_s);
  }
}

}  // namespace carom
