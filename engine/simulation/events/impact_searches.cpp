#include "engine/simulation/events/impact_searches.h"

#include <algorithm>

#include "engine/foundation/index.h"
#include "engine/simulation/events/path_clearing.h"

namespace carom {
namespace {

// Looks that one thread makes: to wait for another takes as long as two or three.
constexpr std::size_t kFewLooks = 16;

SearchCost costOf(const TimeOfImpact& found) {
  return {found.queries, found.states, found.newton_steps, found.work};
}

}  // namespace

ImpactSearches::ImpactSearches(const LastingWorld& world, const ContactCluster& cluster,
                               StepCounters& counters, SearchMemory& memory)
    : bodies_(world.bodies),
      shapes_(world.shapes),
      table_(world.table),
      settings_(world.settings),
      crew_(world.crew),
      cluster_(cluster),
      counters_(counters),
      memory_(memory),
      predictions_(memory.predictions),
      struck_(memory.struck),
      most_work_(std::max(tolerance::kLeastSearchWork,
                          tolerance::kSearchWorkPerBody * static_cast<long>(world.bodies.size()))),
      work_(memory.work) {
  for (const int i : struck_) predictions_[at(i)].impacts = 0;
  struck_.clear();
}

void ImpactSearches::lookAtAll() {
  predictions_.resize(table_.pairs().size());
  const std::vector<int>& pairs = table_.active();
  crew_.runStretches(pairs.size(), kFewPairs, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Prediction& prediction = predictions_[at(pairs[i])];
      prediction.looked = prediction.searched = false;
      const ShapePair& pair = table_.pairs()[at(pairs[i])];
      if (!mayMeet(pair)) continue;
      beginAt(pairs[i], pair.closest);
      carryOn(pairs[i]);
    }
  });
  for (const int i : pairs)
    if (predictions_[at(i)].looked) count(costOf(predictions_[at(i)].found));
}

void ImpactSearches::begin(int index) {
  predictions_.resize(table_.pairs().size());
  ++predictions_[at(index)].version;
  predictions_[at(index)].searched = false;
  const ShapePair& pair = table_.pairs()[at(index)];
  if (mayMeet(pair)) beginAt(index, closestAt(index, beginOf(pair)));
}

void ImpactSearches::look(std::span<const int> pairs) {
  std::vector<SearchCost>& costs = memory_.costs;
  costs.resize(pairs.size());
  crew_.runStretches(pairs.size(), kFewLooks, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) costs[k] = carryOn(pairs[k]);
  });
  for (const SearchCost& cost : costs) count(cost);
}

// Look by look, so that all have come as far where the step's work is spent.
void ImpactSearches::carryToTheirEnds(std::span<const int> pairs) {
  std::vector<int>& pending = memory_.pending;
  pending.assign(pairs.begin(), pairs.end());
  for (;;) {
    std::erase_if(pending, [this](int i) {
      return predictions_[at(i)].found.outcome != TimeOfImpact::Outcome::kPending;
    });
    if (pending.empty() || isSpent()) return;
    look(pending);
  }
}

std::vector<int> ImpactSearches::foreseeLandings() {
  std::vector<int>& followed = memory_.followed;
  std::vector<int> landings;
  followed.clear();
  for (const int i : table_.active())
    if (table_.pairs()[at(i)].restitution == 0.0 && predictions_[at(i)].searched) followed.push_back(i);
  carryToTheirEnds(followed);
  for (const int i : followed) {
    const ShapePair& pair = table_.pairs()[at(i)];
    const TimeOfImpact& found = predictions_[at(i)].found;
    if (found.outcome == TimeOfImpact::Outcome::kClear || found.outcome == TimeOfImpact::Outcome::kPending ||
        isSlow(i))
      continue;
    // By then it goes another way.
    if (found.time_s > std::min(bodies_[at(pair.body_a)].piece_end_s, bodies_[at(pair.body_b)].piece_end_s))
      continue;
    table_.land(i, landingOn(bodies_[at(pair.body_a)].path, bodies_[at(pair.body_b)].path, found));
    landings.push_back(i);
  }
  return landings;
}

void ImpactSearches::strike(int index) {
  if (++predictions_[at(index)].impacts == 1) struck_.push_back(index);
}

double ImpactSearches::separatingSpeed(int index) const {
  const TimeOfImpact& found = predictions_[at(index)].found;
  const ShapePair& pair = table_.pairs()[at(index)];
  const auto velocityOf = [&](const Body& body, const Vec3& p_W) {
    const Velocity v{body.path.velocityAt(found.time_s), body.path.angularVelocityAt(found.time_s)};
    return v.at(p_W - body.path.positionAt(found.time_s));
  };
  return dot(found.closest.n_W, velocityOf(bodies_[at(pair.body_b)], found.closest.p_B_W) -
                                    velocityOf(bodies_[at(pair.body_a)], found.closest.p_A_W));
}

bool ImpactSearches::isSlow(int index) const {
  const TimeOfImpact& found = predictions_[at(index)].found;
  const ShapePair& pair = table_.pairs()[at(index)];
  const auto velocityOf = [&](const Body& body, const Vec3& p_W) {
    return body.velocityAt(found.time_s).at(p_W - body.path.positionAt(found.time_s));
  };
  const Vec3 parting = velocityOf(bodies_[at(pair.body_b)], found.closest.p_B_W) -
                       velocityOf(bodies_[at(pair.body_a)], found.closest.p_A_W);
  return dot(found.closest.n_W, parting) >= -slowestImpact(index);
}

// What turning brings back again and again lasts: a body that grinds past another would spend thousands of
// events of a step on impacts of a speed that its turning gives it anew.
double ImpactSearches::slowestImpact(int index) const {
  const ShapePair& pair = table_.pairs()[at(index)];
  const Prediction& prediction = predictions_[at(index)];
  if (prediction.impacts <= tolerance::kPairEvents) return pair.collision_speed_mps;
  const double time_s = prediction.found.time_s;
  return std::max(pair.collision_speed_mps,
                  PathClearing::turningSpeed(pair, time_s, settings_.step_s - time_s, bodies_, shapes_));
}

bool ImpactSearches::mayMeet(const ShapePair& pair) const {
  return !bodies_[at(pair.body_a)].path.still() || !bodies_[at(pair.body_b)].path.still();
}

// The later of its bodies' path starts.
double ImpactSearches::beginOf(const ShapePair& pair) const {
  return std::max(bodies_[at(pair.body_a)].path.start_s, bodies_[at(pair.body_b)].path.start_s);
}

// Where its bodies' paths begin. `at_begin`: its closest features there.
void ImpactSearches::beginAt(int index, const ClosestFeatures& at_begin) {
  Prediction& prediction = predictions_[at(index)];
  const ShapePair& pair = table_.pairs()[at(index)];
  prediction.search = {pair.window,      pair.collision_speed_mps, beginOf(pair),
                       settings_.step_s, pair.restitution == 0.0,  pair.lands};
  prediction.found = beginSearch(prediction.search, at_begin);
  prediction.searched = true;
  prediction.looked = false;
}

SearchCost ImpactSearches::carryOn(int index) {
  Prediction& prediction = predictions_[at(index)];
  ShapePair& pair = table_.pairs()[at(index)];
  const SearchCost before = costOf(prediction.found);
  lookFurther(movingPart(pair.shapes.a), movingPart(pair.shapes.b), prediction.search, prediction.found,
              pair.tracked);
  prediction.looked = true;
  return costOf(prediction.found) - before;
}

void ImpactSearches::count(const SearchCost& cost) {
  counters_.distance_queries += cost.queries;
  counters_.states_walked += cost.states;
  counters_.newton_steps += cost.newton_steps;
  work_ += cost.work;
}

MovingPart ImpactSearches::movingPart(int shape) const {
  const Shape& s = shapes_[at(shape)];
  return {s.part, &bodies_[at(s.body)].path, s.reach_m, &bodies_[at(s.body)].X_end};
}

ClosestFeatures ImpactSearches::closestAt(int index, double time_s) {
  ShapePair& pair = table_.pairs()[at(index)];
  if (!(time_s > 0.0)) return pair.closest;
  if (const ClosestFeatures* seen = cluster_.closestSeen(index, time_s)) return *seen;
  const ClosestFeatures closest = closestFeatures(
      *shapes_[at(pair.shapes.a)].part, bodies_[at(pair.body_a)].path.at(time_s),
      *shapes_[at(pair.shapes.b)].part, bodies_[at(pair.body_b)].path.at(time_s), pair.tracked);
  counters_.addQuery(closest.states);
  return closest;
}

}  // namespace carom
