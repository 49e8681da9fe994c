#include "engine/simulation/events/path_clearing.h"

#include <algorithm>
#include <optional>

#include "engine/contact/approach.h"
#include "engine/foundation/index.h"
#include "engine/foundation/tolerances.h"
#include "engine/response/one_point/impulse.h"
#include "engine/response/sweeps/principal_pivoting.h"
#include "engine/simulation/bodies/path_change.h"

namespace carom {
namespace {

// Of the speed that a row misses: a sweep gives more than that, so that what is wedged converges.
constexpr double kOverRelaxed = 1.3;
// Of what a gap misses to the rest gap: so much is opened over the rest of the step.
constexpr double kOpened = 0.5;
// Of the rest gap: a place that misses less has been led apart.
constexpr double kSlack = 0.05;
// Radians: of what turns by less, the rows have seen the end of the arc to 1 %.
constexpr double kMuch = 0.25;
// Rows visited in one solve, at most: 0.1 ms.
constexpr int kVisits = 2000;
// Rows that are pivoted, at most: where they are given up, bodies are led into others and frozen, so that it
// may cost some milliseconds.
constexpr std::size_t kMostLedRows = 128;

// What a body's path does in the mean over the rest of the step.
Velocity meanMotion(const Body& body, double time_s, double rest_s) {
  return {body.path.meanVelocity(time_s, rest_s), body.path.angularVelocityAt(time_s)};
}

}  // namespace

void PathClearing::beginStep() {
  for (const Place& place : places_)
    for (const int body : {place.body_a, place.body_b}) places_of_[at(body)].clear();
  places_.clear();
  gathered_.clear();
}

double PathClearing::turningSpeed(const ShapePair& pair, double time_s, double rest_s,
                                  const std::vector<Body>& bodies, const std::vector<Shape>& shapes) {
  const auto motionOf = [&](int body) { return meanMotion(bodies[at(body)], time_s, rest_s); };
  return mostClosing({motionOf(pair.body_a), shapes[at(pair.shapes.a)].reach_m},
                     {motionOf(pair.body_b), shapes[at(pair.shapes.b)].reach_m}, rest_s) /
         rest_s;
}

void PathClearing::add(int index, const TimeOfImpact& found, double rest_s, bool holds_turning,
                       const PairTable& table, const std::vector<Body>& bodies) {
  const ShapePair& pair = table.pairs()[at(index)];
  const double missing_m = pair.window.rest - found.closest.distance_m;
  Place place;
  place.pair = index;
  place.body_a = pair.body_a;
  place.body_b = pair.body_b;
  place.n_W = found.closest.n_W;
  place.p_A_W = found.closest.p_A_W;
  place.p_B_W = found.closest.p_B_W;
  place.wanted_mps =
      std::clamp(kOpened * missing_m / rest_s, -kSlowShare * pair.collision_speed_mps, tolerance::kGapSpeed);
  place.slack_mps = kSlack * pair.window.rest / rest_s;
  const double fastest =
      std::max(bodies[at(pair.body_a)].path.fastestSpin(), bodies[at(pair.body_b)].path.fastestSpin());
  const bool turns_by_much = rest_s * fastest > kMuch;
  place.features = found.closest.features;
  places_of_.resize(bodies.size());
  const std::vector<int>&of_a = places_of_[at(place.body_a)], &of_b = places_of_[at(place.body_b)];
  const std::vector<int>& known = of_a.size() < of_b.size() ? of_a : of_b;
  const auto isOfPair = [&](int former) { return places_[at(former)].pair == index; };
  place.turned = (turns_by_much || holds_turning) && std::ranges::any_of(known, [&](int former) {
                   return isOfPair(former) && cameBack(places_[at(former)], found.time_s, bodies);
                 });
  const auto same = std::ranges::find_if(
      known, [&](int former) { return isOfPair(former) && places_[at(former)].features == place.features; });
  last_added_ = same == known.end() ? static_cast<int>(places_.size()) : *same;
  if (same != known.end()) {
    places_[at(last_added_)] = place;
    return;
  }
  places_.push_back(place);
  for (const int body : {place.body_a, place.body_b}) places_of_[at(body)].push_back(last_added_);
}

// Whether nothing else has led the bodies of a place since they were led apart there.
bool PathClearing::cameBack(const Place& place, double time_s, const std::vector<Body>& bodies) const {
  for (const int body : {place.body_a, place.body_b})
    if (canBeLed(bodies[at(body)]) && bodies[at(body)].path.start_s > place.led_s) return false;
  return place.led_s < time_s;
}

void PathClearing::gather(std::vector<int>& members, double time_s, const std::vector<Body>& bodies) {
  gathered_.clear();
  is_member_.resize(bodies.size(), 0);
  is_gathered_.resize(places_.size(), 0);
  for (const int member : members) is_member_[at(member)] = 1;
  for (std::size_t k = 0; k < members.size(); ++k)
    for (const int index : places_of_[at(members[k])]) {
      if (is_gathered_[at(index)]) continue;
      is_gathered_[at(index)] = 1;
      gathered_.push_back(index);
      const Place& place = places_[at(index)];
      const int other = place.body_a == members[k] ? place.body_b : place.body_a;
      // Of one instant, events come in the order of their ranks: another's path may begin a rounding later.
      if (is_member_[at(other)] || !canBeLed(bodies[at(other)]) || bodies[at(other)].path.start_s > time_s)
        continue;
      is_member_[at(other)] = 1;
      members.push_back(other);
    }
  for (const int member : members) is_member_[at(member)] = 0;
  for (const int index : gathered_) is_gathered_[at(index)] = 0;
  std::ranges::sort(gathered_);  // rows in the order in which places were added
}

void PathClearing::setPaths(const std::vector<int>& members, double time_s, double rest_s,
                            const std::vector<Body>& bodies) {
  paths_.clear();
  path_of_.resize(bodies.size(), -1);
  for (const int i : touched_) path_of_[at(i)] = -1;
  touched_.clear();
  for (const int i : members) addPath(i, time_s, rest_s, bodies);
  before_ = paths_;
}

int PathClearing::addPath(int index, double time_s, double rest_s, const std::vector<Body>& bodies) {
  const Body& body = bodies[at(index)];
  path_of_[at(index)] = static_cast<int>(paths_.size());
  touched_.push_back(index);
  paths_.push_back(body.impulseBody(body.path.at(time_s), meanMotion(body, time_s, rest_s)));
  return path_of_[at(index)];
}

// The path of a member, or of who goes on as it does.
int PathClearing::pathOf(int index, double time_s, double rest_s, const std::vector<Body>& bodies) {
  if (path_of_[at(index)] >= 0) return path_of_[at(index)];
  ImpulseBody& path = paths_[at(addPath(index, time_s, rest_s, bodies))];
  path.inverse_mass = 0.0;
  path.inverse_tensor.setZero();
  return path_of_[at(index)];
}

// Of two that turning brought back together, the one that turns faster does not.
void PathClearing::holdTurning(const Row& row) {
  const double spin_a = paths_[at(row.a)].velocity.angular.norm();
  const double spin_b = paths_[at(row.b)].velocity.angular.norm();
  const auto hold = [&](ImpulseBody& path) {
    if (path.inverse_mass == 0.0) return;
    path.velocity.angular.setZero();
    path.inverse_tensor.setZero();
  };
  if (spin_a >= spin_b) hold(paths_[at(row.a)]);
  if (spin_b >= spin_a) hold(paths_[at(row.b)]);
}

void PathClearing::setRows(double time_s, double rest_s, const std::vector<Body>& bodies) {
  rows_.clear();
  for (const int index : gathered_) {
    Place& place = places_[at(index)];
    Row& row = rows_.emplace_back();
    row.place = &place;
    row.a = pathOf(place.body_a, time_s, rest_s, bodies);
    row.b = pathOf(place.body_b, time_s, rest_s, bodies);
    row.r_a = place.p_A_W - paths_[at(row.a)].center;
    row.r_b = place.p_B_W - paths_[at(row.b)].center;
    if (place.turned) holdTurning(row);
  }
  for (Row& row : rows_)
    row.response =
        dot(row.place->n_W,
            collisionMatrix(paths_[at(row.a)], paths_[at(row.b)], row.r_a, row.r_b) * row.place->n_W);
}

double PathClearing::partingOf(const Row& row) const {
  return dot(row.place->n_W, paths_[at(row.b)].velocity.at(row.r_b) - paths_[at(row.a)].velocity.at(row.r_a));
}

bool PathClearing::sweepRows() {
  const int most = 1 + (rows_.size() > 1 ? kVisits / static_cast<int>(rows_.size()) : 0);
  bool apart = false;
  for (int sweep = 0; sweep < most && !apart; ++sweep) {
    apart = true;
    for (Row& row : rows_) {
      if (!(row.response > 0.0)) continue;
      const double missing = row.place->wanted_mps - partingOf(row);
      apart = apart && missing <= row.place->slack_mps;
      const double impulse = std::max(-row.impulse, kOverRelaxed * missing / row.response);
      row.impulse += impulse;
      push(row, impulse);
    }
  }
  return apart || rows_.size() == 1;
}

bool PathClearing::pivotRows() {
  std::vector<ContactRow> rows(rows_.size());
  Eigen::VectorXd slack(static_cast<Eigen::Index>(rows_.size()));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Row& row = rows_[i];
    rows[i].a = row.a;
    rows[i].b = row.b;
    rows[i].n = row.place->n_W;
    rows[i].r_a = row.r_a;
    rows[i].r_b = row.r_b;
    rows[i].lowest_speed = row.place->wanted_mps;
    slack[static_cast<Eigen::Index>(i)] = row.place->slack_mps;
  }
  return carom::pivotRows(rows, paths_, slack, kMostLedRows);
}

void PathClearing::push(const Row& row, double impulse) {
  paths_[at(row.a)].apply(-impulse * row.place->n_W, row.r_a);
  paths_[at(row.b)].apply(impulse * row.place->n_W, row.r_b);
}

// Who is not led, the first `led` paths being, and presses others together fastest, or half as fast: what
// slides by presses by rounding.
void PathClearing::findWedging(std::size_t led) {
  const auto pushOfA = [&](const Row& row) {
    return at(row.a) < led ? 0.0 : dot(row.place->n_W, paths_[at(row.a)].velocity.at(row.r_a));
  };
  const auto pushOfB = [&](const Row& row) {
    return at(row.b) < led ? 0.0 : -dot(row.place->n_W, paths_[at(row.b)].velocity.at(row.r_b));
  };
  double most = 0.0;
  for (const Row& row : rows_) most = std::max({most, pushOfA(row), pushOfB(row)});
  if (!(most > 0.0)) return;
  for (const Row& row : rows_) {
    if (pushOfA(row) >= 0.5 * most) wedging_.push_back(touched_[at(row.a)]);
    if (pushOfB(row) >= 0.5 * most) wedging_.push_back(touched_[at(row.b)]);
  }
}

std::span<const ImpulseBody> PathClearing::solve(const std::vector<int>& members, double time_s,
                                                 double rest_s, const std::vector<Body>& bodies) {
  const auto begin = [&] {
    setPaths(members, time_s, rest_s, bodies);
    setRows(time_s, rest_s, bodies);
  };
  begin();
  wedging_.clear();
  if (!sweepRows() || !staysNear(before_, paths_)) {
    begin();
    if (!pivotRows() ||
        !staysNear(before_,
                   paths_)) {  // nothing keeps all of them apart: at least the one that was added last
      findWedging(members.size());
      gathered_.assign(1, last_added_);
      begin();
      sweepRows();
    }
  }
  for (const Row& row : rows_) row.place->led_s = time_s;
  return {paths_.data(), members.size()};
}

}  // namespace carom
