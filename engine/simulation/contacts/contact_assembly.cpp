#include "engine/simulation/contacts/contact_assembly.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <utility>

#include "engine/foundation/index.h"
#include "engine/response/sweeps/dissection.h"
#include "engine/simulation/contacts/midstep_rows.h"
#include "engine/simulation/contacts/warm_start.h"

namespace carom {
namespace {

// Of the speed that gravity adds in a step: where turning changes less, arms stay. What swings so slowly
// gains energy from its gaps; and what only just stands (an arch near the limit) loses its hold if nothing is
// too slow.
constexpr double kNoticedTurning = 1e-6;
// Pairs of one island, or more, that one thread sweeps: some 30 us of work, ten times what waiting takes.
constexpr std::size_t kPairsOfAPart = 200;
constexpr int kMostLevels = 5;
constexpr int kVisitsOfAnEvent = 10;  // of each row of the island, in the mean; 6 in a pile of 250 boxes

// So many landings of an island of a world of `rows` can be solved as events within a step's budget.
int fewLandings(std::size_t rows) {
  return sweepsInBudget(rows) / kVisitsOfAnEvent;
}

bool givesWay(const ShapePair& pair, const std::vector<Body>& bodies) {
  return bodies[at(pair.body_a)].moves() || bodies[at(pair.body_b)].moves();
}

// Level ones; all where nothing is.
std::vector<Vec3> cutDirections(const Vec3& gravity) {
  if (gravity.isZero(0.0)) return {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
  const TangentBasis level = tangentBasis(gravity.normalized());
  return {level.t1, level.t2};
}

class Assembly {
 public:
  Assembly(const LastingWorld& world, StepCounters& counters, LastingContacts& contacts)
      : world_(world), counters_(counters), contacts_(contacts) {}

  void assemble() {
    seeBodies();
    foreseeLandings();
    findLastingPairs();
    dissectIslands();
    std::sort(lasting_.begin(), lasting_.end());
    makeRows();
    joinRows();
  }

  std::vector<std::size_t> addLandings(std::span<const int> pairs) {
    std::vector<int> ascending(pairs.begin(), pairs.end());
    std::sort(ascending.begin(), ascending.end());
    contacts_.stretches.resize(std::max<std::size_t>(2, contacts_.stretches.size()));
    for (RowStretch& stretch : contacts_.stretches) stretch.clear();
    RowStretch& kept = contacts_.stretches[0];
    RowStretch& made = contacts_.stretches[1];
    keepRows(ascending, kept);
    for (const int pair : pairs) makeRowsOf({-1, -kWhole, 0, pair}, made);
    for (const ContactRow& row : made.rows) applyLoad(row, contacts_.bodies);
    addQueries(made.counters);
    joinRows();
    return islandsOf(ascending);
  }

 private:
  void addQueries(const StepCounters& made) {
    counters_.distance_queries += made.distance_queries;
    counters_.states_walked += made.states_walked;
  }

  // In the order of the rows: those of an island together, those of a crowd by descending part of it.
  struct LastingPair {
    int island = -1;  // at first a body of it
    int from_last_part = -kWhole;
    std::uint64_t rank = 0;
    int pair = -1;
    auto operator<=>(const LastingPair&) const = default;
  };

  // The bodies as the solver takes them.
  void seeBodies() {
    contacts_.bodies.resize(world_.bodies.size());
    contacts_.half_turns.resize(world_.bodies.size());
    const std::span<const int> active = world_.active.list();
    world_.crew.runStretches(active.size(), kFewBodies, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) {
        const std::size_t i = at(active[k]);
        const Body& body = world_.bodies[i];
        ImpulseBody& seen = contacts_.bodies[i];
        HalfTurn& half = contacts_.half_turns[i];
        half = halfTurn(body, world_.settings.step_s, noticedTurning());
        seen = body.impulseBody({half.R_WB, body.X_WB.position}, {body.velocity.linear, half.spin});
        if (!body.resting) continue;
        seen.inverse_mass = 0.0;
        seen.inverse_tensor.setZero();
      }
    });
  }

  // Those that come down within the step on the paths that their bodies are likely to take, where they may be
  // a crowd.
  void foreseeLandings() {
    const std::vector<int>& active = world_.table.active();
    enum : char { kNo, kApproaches, kForeseen };
    std::vector<char> landings(active.size(), kNo);
    world_.crew.runStretches(active.size(), kFewPairs, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const ShapePair& pair = world_.table.pairs()[at(active[i])];
        landings[i] = pair.lands ? kForeseen : comesDown(pair) ? kApproaches : kNo;
      }
    });
    const auto none = std::count(landings.begin(), landings.end(), kNo);
    if (static_cast<std::ptrdiff_t>(landings.size()) - none <= fewLandings(rememberedRows())) return;
    findNear();
    world_.crew.runStretches(active.size(), kFewPairs, [&](std::size_t begin, std::size_t end) {
      StepCounters made;
      for (std::size_t i = begin; i < end; ++i) {
        const ShapePair& pair = world_.table.pairs()[at(active[i])];
        if (landings[i] != kApproaches || isInDoubt(pair.body_a) || isInDoubt(pair.body_b)) continue;
        if (const std::optional<Landing> landing = foreseenLanding(pair, made))
          world_.table.land(active[i], *landing);
      }
      std::atomic_ref(counters_.distance_queries) += made.distance_queries;
      std::atomic_ref(counters_.states_walked) += made.states_walked;
      std::atomic_ref(counters_.newton_steps) += made.newton_steps;
    });
  }

  // At least as many as this step's pairs had in the last one.
  std::size_t rememberedRows() const {
    std::size_t rows = 0;
    for (const int i : world_.table.active()) rows += world_.table.pairs()[at(i)].remembered.size();
    return rows;
  }

  // Which bodies are near enough to others to be held by them.
  void findNear() {
    std::vector<char>& near = contacts_.room.near;
    near.resize(world_.bodies.size());
    for (const int i : world_.active.list()) near[at(i)] = 0;
    for (const int i : world_.table.active()) {
      const ShapePair& pair = world_.table.pairs()[at(i)];
      if (pair.lasts(world_.settings.step_s)) near[at(pair.body_a)] = near[at(pair.body_b)] = 1;
    }
  }

  // Whether nobody knows yet what holds the body.
  bool isInDoubt(int body) const {
    return moves(body) && contacts_.room.near[at(body)] != 0 &&
           world_.bodies[at(body)].contact_force.isZero(0.0);
  }

  // What is held goes on as it was held in the last step; planned alone, it would sink.
  Trajectory likelyPath(int index) const {
    const Body& body = world_.bodies[at(index)];
    Trajectory path = body.path;
    if (!moves(index) || body.contact_force.isZero(0.0)) return path;
    const Vec3 acceleration = body.acceleration + body.contact_force / body.inertia.mass_kg;
    path.velocity = body.velocity.linear + 0.5 * world_.settings.step_s * acceleration;
    path.acceleration.setZero();
    return path;
  }

  // Whether a pair that will not bounce approaches so fast at its closest points that it could.
  bool comesDown(const ShapePair& pair) const {
    if (pair.restitution > 0.0 || !givesWay(pair, world_.bodies)) return false;
    const auto meanAt = [&](int index, const Vec3& p_W) {
      const Body& body = world_.bodies[at(index)];
      return Velocity{body.velocity.linear, body.path.spin}.at(p_W - body.X_WB.position);
    };
    const double step_s = world_.settings.step_s;
    const double parting = dot(
        pair.closest.n_W, meanAt(pair.body_b, pair.closest.p_B_W) - meanAt(pair.body_a, pair.closest.p_A_W));
    // So much nearer at most, with what gravity and loads add.
    const double pull = pullBetween(world_.bodies[at(pair.body_a)].pull, world_.bodies[at(pair.body_b)].pull);
    const double nearer = step_s * (0.5 * step_s * pull - parting);
    return nearer > step_s * pair.collision_speed_mps &&
           pair.closest.distance_m - nearer < pair.window.landing;
  }

  std::optional<Landing> foreseenLanding(const ShapePair& pair, StepCounters& made) const {
    const double step_s = world_.settings.step_s;
    const Trajectory a = likelyPath(pair.body_a), b = likelyPath(pair.body_b);
    const Pose X_WA = a.at(step_s), X_WB = b.at(step_s);
    const auto movingPart = [&](int shape, const Trajectory& path, const Pose& X_end) {
      const Shape& s = world_.shapes[at(shape)];
      return MovingPart{s.part, &path, s.reach_m, &X_end};
    };
    FeaturePair tracked = pair.tracked;
    const TimeOfImpact found = timeOfImpact(
        movingPart(pair.shapes.a, a, X_WA), movingPart(pair.shapes.b, b, X_WB),
        {pair.window, pair.collision_speed_mps, 0.0, step_s, true, false}, pair.closest, tracked);
    made.distance_queries += found.queries;
    made.states_walked += found.states;
    made.newton_steps += found.newton_steps;
    const auto pieceEnd = [&](int body) { return world_.bodies[at(body)].piece_end_s; };
    // By its piece's end a kinematic body goes another way.
    if (found.outcome != TimeOfImpact::Outcome::kImpact ||
        found.time_s > std::min(pieceEnd(pair.body_a), pieceEnd(pair.body_b)))
      return std::nullopt;
    return landingOn(a, b, found);
  }

  // Those of what moves. What the others remember is over, but what resting pairs remember they keep.
  void findLastingPairs() {
    const std::vector<int>& active = world_.table.active();
    std::vector<char> lasts(active.size(), 0);
    contacts_.room.bearings.find(world_.table, pairedWorld(), world_.active.list());
    world_.crew.runStretches(active.size(), kFewPairs, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        ShapePair& pair = world_.table.pairs()[at(active[i])];
        if (!givesWay(pair, world_.bodies)) continue;
        const bool last = pair.lands || lastsAsItLies(active[i]);
        lasts[i] = last ? 1 : 0;
        if (last) continue;
        pair.remembered.clear();
        pair.room = 1.0;
      }
    });
    Islands& islands = contacts_.room.joined;
    islands.part(static_cast<int>(world_.bodies.size()));
    std::vector<int> landings;
    std::size_t rows = 0;  // as many as the step before had
    for (std::size_t i = 0; i < lasts.size(); ++i) {
      if (!lasts[i]) continue;
      const ShapePair& pair = world_.table.pairs()[at(active[i])];
      const bool a_moves = moves(pair.body_a);
      if (a_moves && moves(pair.body_b)) islands.join(pair.body_a, pair.body_b);
      lasting_.push_back({a_moves ? pair.body_a : pair.body_b, -kWhole, pair.rank, active[i]});
      if (pair.lands) landings.push_back(active[i]);
      rows += pair.remembered.size();
    }
    for (LastingPair& pair : lasting_) pair.island = islands.of(pair.island);
    keepCrowded(std::move(landings), rows);
  }

  // The landings of the others are events; they last, or not, as they lie now.
  void keepCrowded(std::vector<int> landings, std::size_t rows) {
    if (landings.empty()) return;
    crowdedLandings(landings, world_, rows, contacts_.room.joined);
    std::sort(landings.begin(), landings.end());
    std::erase_if(lasting_, [&](const LastingPair& lasting) {
      ShapePair& pair = world_.table.pairs()[at(lasting.pair)];
      if (pair.lands || !std::binary_search(landings.begin(), landings.end(), lasting.pair) ||
          lastsAsItLies(lasting.pair))
        return false;
      pair.remembered.clear();
      return true;
    });
  }

  bool lastsAsItLies(int index) const {
    return world_.table.pairs()[at(index)].lasts(world_.settings.step_s) &&
           !contacts_.room.bearings.isInternal(index, world_.table, pairedWorld());
  }

  PairedWorld pairedWorld() const { return {world_.bodies, world_.shapes, world_.settings, world_.crew}; }

  double noticedTurning() const {
    return kNoticedTurning * world_.settings.gravity.norm() * world_.settings.step_s;
  }

  bool moves(int body) const { return world_.bodies[at(body)].moves(); }

  // Crowds, so that several threads can sweep them.
  void dissectIslands() {
    if (lasting_.size() < 2 * kPairsOfAPart) return;
    std::vector<std::size_t> pairs_of(world_.bodies.size(), 0);  // by island
    for (const LastingPair& pair : lasting_) ++pairs_of[at(pair.island)];
    if (*std::max_element(pairs_of.begin(), pairs_of.end()) < 2 * kPairsOfAPart) return;
    std::vector<int> island_of(world_.bodies.size(), -1);
    for (const LastingPair& lasting : lasting_) {
      const ShapePair& pair = world_.table.pairs()[at(lasting.pair)];
      for (const int body : {pair.body_a, pair.body_b})
        if (moves(body)) island_of[at(body)] = lasting.island;
    }
    const std::vector<Vec3> directions = cutDirections(world_.settings.gravity);
    std::vector<int> part_of(world_.bodies.size(), kNoPart);
    std::vector<int> members;
    for (std::size_t island = 0; island < pairs_of.size(); ++island) {
      if (pairs_of[island] < 2 * kPairsOfAPart) continue;
      members.clear();
      for (std::size_t i = 0; i < island_of.size(); ++i)
        if (island_of[i] == static_cast<int>(island)) members.push_back(static_cast<int>(i));
      const int levels =
          std::min(kMostLevels, static_cast<int>(std::bit_width(pairs_of[island] / kPairsOfAPart)) - 1);
      dissect({contacts_.bodies, directions, levels}, members, part_of);
    }
    for (LastingPair& lasting : lasting_) {
      if (pairs_of[at(lasting.island)] < 2 * kPairsOfAPart) continue;
      const ShapePair& pair = world_.table.pairs()[at(lasting.pair)];
      lasting.from_last_part = -commonPart(part_of[at(pair.body_a)], part_of[at(pair.body_b)]);
    }
  }

  // Every stretch of pairs makes its own; where they stand in the end is known when all are made.
  void makeRows() {
    const std::size_t stretches = std::clamp<std::size_t>(lasting_.size() / kFewPairs, 1, kMostStretches);
    contacts_.stretches.resize(stretches);
    world_.crew.run(static_cast<int>(stretches), [&](int k) {
      RowStretch& stretch = contacts_.stretches[at(k)];
      stretch.clear();
      for (std::size_t i = lasting_.size() * at(k) / stretches; i < lasting_.size() * (at(k) + 1) / stretches;
           ++i)
        makeRowsOf(lasting_[i], stretch);
    });
    for (const RowStretch& stretch : contacts_.stretches) addQueries(stretch.counters);
  }

  void makeRowsOf(const LastingPair& lasting, RowStretch& stretch) {
    const double step_s = world_.settings.step_s;
    ShapePair& pair = world_.table.pairs()[at(lasting.pair)];
    const Body& a = world_.bodies[at(pair.body_a)];
    const Body& b = world_.bodies[at(pair.body_b)];
    std::vector<SourcedRow>& rows = stretch.of_pair;
    rows.clear();
    if (pair.lands)
      appendLandingRows(lasting.pair, pair, rows);
    else
      appendLastingRows(lasting.pair, pair, stretch);
    warmStart(pair, a.liesStill() && b.liesStill(), rows);
    pair.remembered.clear();
    if (rows.empty()) return;
    stretch.pairs.push_back({lasting.pair, pair.body_a, pair.body_b, rows.size()});
    for (SourcedRow& sourced : rows) {
      ContactRow& row = sourced.row;
      row.part = -lasting.from_last_part;
      row.lowest_speed += gapSpeeds(sourced.gap_m, pair, step_s, row.impulse.x() > 0.0).momentum;
      stretch.rows.push_back(row);
      stretch.sources.push_back(sourced);
    }
  }

  // Where the bodies are when the step begins, seen from its middle.
  void appendLastingRows(int index, const ShapePair& pair, RowStretch& stretch) {
    const double step_s = world_.settings.step_s;
    const RememberedPoints remembered(pair);
    const RowRequest request{.pair = index,
                             .row_a = pair.body_a,
                             .row_b = pair.body_b,
                             .closest = &pair.closest,
                             .X_WA = world_.bodies[at(pair.body_a)].X_WB,
                             .X_WB = world_.bodies[at(pair.body_b)].X_WB,
                             .former = remembered.view(),
                             .height_m = pair.lastingHeight(step_s)};
    std::vector<SourcedRow>& rows = stretch.of_pair;
    appendRows(request, pair, world_.bodies, world_.shapes, contacts_.bodies, rows);
    // A point that comes in fast (the far edge of a falling box) lands, or has its own time of impact and
    // restitution; so will one that bounces up.
    std::erase_if(rows, [&](const SourcedRow& sourced) {
      const double speed = rowVelocity(sourced.row, contacts_.bodies).x();
      return speed < -pair.collision_speed_mps ||
             (pair.restitution > 0.0 && speed > pair.collision_speed_mps);
    });
    const MidStep mid{.bodies = world_.bodies,
                      .shapes = world_.shapes,
                      .solver_bodies = contacts_.bodies,
                      .half_step_s = 0.5 * step_s,
                      .noticed_mps = noticedTurning(),
                      .half_turns = contacts_.half_turns};
    if (!moveToMidStep(request, pair, mid, rows, stretch.counters)) rows.clear();  // it has times of impact
  }

  // Where the bodies come down. There the gap is known, and how it goes on changing with the velocities. They
  // act from the beginning of the step: so long before counts as if the gap were larger by what it lost.
  void appendLandingRows(int index, const ShapePair& pair, std::vector<SourcedRow>& rows) {
    const Landing& landing = world_.table.landingOf(index);
    const RememberedPoints remembered(pair);
    appendRows({.pair = index,
                .row_a = pair.body_a,
                .row_b = pair.body_b,
                .closest = &landing.closest,
                .X_WA = landing.X_WA,
                .X_WB = landing.X_WB,
                .former = remembered.view(),
                .height_m = pair.lastingHeight(world_.settings.step_s),
                .struck = true},
               pair, world_.bodies, world_.shapes, contacts_.bodies, rows);
    for (SourcedRow& sourced : rows) {
      const ContactRow& row = sourced.row;
      const Vec3 parting = landing.b.at(row.r_b) - landing.a.at(row.r_a);
      sourced.gap_m -= landing.time_s * dot(row.n, parting);
    }
  }

  // The rows of all other pairs, which have been solved; what those of `pairs`, which ascend, gave is given
  // back.
  void keepRows(std::span<const int> pairs, RowStretch& kept) {
    std::vector<int> meeting;
    for (const int i : pairs) {
      const ShapePair& pair = world_.table.pairs()[at(i)];
      for (const int body : {pair.body_a, pair.body_b})
        if (moves(body)) meeting.push_back(body);
    }
    std::sort(meeting.begin(), meeting.end());
    const auto meets = [&](int body) { return std::binary_search(meeting.begin(), meeting.end(), body); };
    kept.rows.reserve(contacts_.rows.size());
    kept.sources.reserve(contacts_.rows.size());
    for (const LastingContacts::PairRows& of_pair : contacts_.pair_rows) {
      const ShapePair& pair = world_.table.pairs()[at(of_pair.pair)];
      const bool is_met = meets(pair.body_a) || meets(pair.body_b);
      if (is_met && std::binary_search(pairs.begin(), pairs.end(), of_pair.pair)) {
        for (std::size_t i = of_pair.begin; i < of_pair.end; ++i)
          takeBackLoad(contacts_.rows[i], contacts_.bodies);
        continue;
      }
      kept.pairs.push_back({of_pair.pair, pair.body_a, pair.body_b, of_pair.end - of_pair.begin});
      for (std::size_t i = of_pair.begin; i < of_pair.end; ++i) {
        kept.rows.push_back(contacts_.rows[i]);
        kept.rows.back().seen_stir = is_met ? -1.0 : 0.0;
        kept.sources.push_back(contacts_.sources[i]);
      }
    }
  }

  // Those with the rows that have just been made, of `pairs`, which ascend.
  std::vector<std::size_t> islandsOf(std::span<const int> pairs) const {
    std::vector<std::size_t> islands;
    for (std::size_t i = 0; i < contacts_.islands.size(); ++i) {
      // The rows kept come first in their island, those just made last.
      const auto of_island = contacts_.pairsOf(contacts_.islands[i]);
      if (std::binary_search(pairs.begin(), pairs.end(), of_island.back().pair)) islands.push_back(i);
    }
    return islands;
  }

  // Rows of one island stand together; each island is solved on its own, so that one that converges slowly
  // does not keep the others sweeping. Pairs without rows may have parted islands.
  void joinRows() {
    Islands& islands = contacts_.room.joined;
    islands.part(static_cast<int>(world_.bodies.size()));
    for (const RowStretch& stretch : contacts_.stretches)
      for (const RowStretch::Pair& pair : stretch.pairs)
        if (moves(pair.body_a) && moves(pair.body_b)) islands.join(pair.body_a, pair.body_b);
    struct Origin {  // of a pair's rows
      int island = -1;
      std::size_t stretch = 0;
      std::size_t first = 0;
      std::size_t count = 0;
      int pair = -1;
      auto operator<=>(const Origin&) const = default;
    };
    std::vector<Origin> origins;
    for (std::size_t k = 0; k < contacts_.stretches.size(); ++k) {
      std::size_t first = 0;
      for (const RowStretch::Pair& pair : contacts_.stretches[k].pairs) {
        const int island = islands.of(moves(pair.body_a) ? pair.body_a : pair.body_b);
        origins.push_back({island, k, first, pair.rows, pair.pair});
        first += pair.rows;
      }
    }
    std::sort(origins.begin(), origins.end());
    contacts_.pair_rows.clear();
    contacts_.islands.clear();
    std::size_t rows = 0;
    for (std::size_t i = 0; i < origins.size(); ++i) {
      if (i == 0 || origins[i].island != origins[i - 1].island)
        contacts_.islands.push_back(
            {rows, rows, i, i, world_.settings.gravity.norm() * world_.settings.step_s});
      contacts_.pair_rows.push_back({origins[i].pair, rows, rows + origins[i].count});
      rows += origins[i].count;
      contacts_.islands.back().row_end = rows;
      contacts_.islands.back().pair_end = i + 1;
      push(contacts_.islands.back(), world_.table.pairs()[at(origins[i].pair)]);
    }
    contacts_.rows.resize(rows);
    contacts_.sources.resize(rows);
    world_.crew.runStretches(origins.size(), kFewPairs, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const RowStretch& from = contacts_.stretches[origins[i].stretch];
        const auto copy = [&](const auto& all, auto& rows_of_world) {
          std::copy_n(all.begin() + static_cast<std::ptrdiff_t>(origins[i].first), origins[i].count,
                      rows_of_world.begin() + static_cast<std::ptrdiff_t>(contacts_.pair_rows[i].begin));
        };
        copy(from.rows, contacts_.rows);
        copy(from.sources, contacts_.sources);
      }
    });
  }

  void push(LastingContacts::Island& island, const ShapePair& pair) const {
    for (const int body : {pair.body_a, pair.body_b})
      island.push_mps =
          std::max(island.push_mps, world_.bodies[at(body)].pull.most_mps2 * world_.settings.step_s);
  }

  static constexpr std::size_t kMostStretches = 64;

  LastingWorld world_;
  StepCounters& counters_;
  LastingContacts& contacts_;
  std::vector<LastingPair> lasting_;
};

}  // namespace

Landing landingOn(const Trajectory& a, const Trajectory& b, const TimeOfImpact& found) {
  const double t = found.time_s;
  const auto mean = [&](const Trajectory& path) {
    return Velocity{path.meanVelocity(path.start_s, t), path.angularVelocityAt(t)};
  };
  return {t, found.closest, a.at(t), b.at(t), mean(a), mean(b)};
}

std::vector<int> crowdedLandings(std::span<const int> pairs, const LastingWorld& world, std::size_t rows,
                                 Islands& islands) {
  const auto moves = [&](int body) { return world.bodies[at(body)].moves(); };
  const auto islandOf = [&](int index) {
    const ShapePair& pair = world.table.pairs()[at(index)];
    return at(islands.of(moves(pair.body_a) ? pair.body_a : pair.body_b));
  };
  std::vector<int> landings(world.bodies.size(), 0);  // by island
  for (const int pair : pairs) ++landings[islandOf(pair)];
  const int few = fewLandings(rows);
  std::vector<int> crowded;
  for (const int pair : pairs)
    if (landings[islandOf(pair)] > few)
      crowded.push_back(pair);
    else
      world.table.pairs()[at(pair)].lands = false;
  return crowded;
}

std::vector<int> LastingContacts::bodiesOf(std::span<const std::size_t> some) {
  room.listed.resize(bodies.size(), 0);
  std::vector<int> found;
  for (const std::size_t island : some)
    for (const PairRows& pair : pairsOf(islands[island]))
      for (const int body : {rows[pair.begin].a, rows[pair.begin].b})
        if (std::exchange(room.listed[at(body)], 1) == 0) found.push_back(body);
  for (const int body : found) room.listed[at(body)] = 0;
  std::sort(found.begin(), found.end());
  return found;
}

void assembleContacts(const LastingWorld& world, StepCounters& counters, LastingContacts& contacts) {
  Assembly(world, counters, contacts).assemble();
}

std::vector<std::size_t> addLandings(const LastingWorld& world, std::span<const int> pairs,
                                     StepCounters& counters, LastingContacts& contacts) {
  return Assembly(world, counters, contacts).addLandings(pairs);
}

}  // namespace carom
