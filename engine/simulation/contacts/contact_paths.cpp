#include "engine/simulation/contacts/contact_paths.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <utility>

#include "engine/foundation/index.h"
#include "engine/response/sweeps/ordered_pass.h"
#include "engine/simulation/contacts/carried_path.h"
#include "engine/simulation/bodies/path_change.h"

namespace carom {
namespace {

// Where bodies lack room between others: asked for in the next step, and tried to have again, step by step.
constexpr double kLessRoom = 0.8;
constexpr double kMoreRoom = 1.02;
constexpr double kLeastRoom = 0.4;      // of the rest gap, twice the floor
constexpr int kPathSweeps = 2;          // at least
constexpr double kPathResidual = 1e-9;  // m/s: over a step, far below any gap
constexpr double kPathGapShare = 0.01;  // of the smallest rest gap: what a path may be off after a step

void lowerTo(double value, double& smallest) {
  std::atomic_ref<double> shared(smallest);
  double seen = shared.load(std::memory_order_relaxed);
  while (value < seen && !shared.compare_exchange_weak(seen, value, std::memory_order_relaxed)) {
  }
}

class ContactPaths {
 public:
  ContactPaths(const LastingWorld& world, std::span<const std::size_t> islands, StepCounters& counters,
               LastingContacts& contacts)
      : world_(world),
        islands_(islands),
        counters_(counters),
        contacts_(contacts),
        bodies_(contacts.bodiesOf(islands)),
        step_s_(world.settings.step_s) {
    for (const std::size_t island : islands_) {
      const auto of_island = contacts_.pairsOf(contacts_.islands[island]);
      pairs_.insert(pairs_.end(), of_island.begin(), of_island.end());
    }
  }

  void set() {
    contacts_.room.is_ordered.assign(contacts_.islands.size(), 0);
    if (contacts_.room.upward.size() < contacts_.islands.size())
      contacts_.room.upward.resize(contacts_.islands.size());
    beginAtMeans();
    const double residual_mps = kPathGapShare * boundPaths() / step_s_;
    solve(islands_, residual_mps);
    shareRoom(residual_mps);
    std::vector<std::size_t> turning(islands_.begin(), islands_.end());
    for (int round = 0; round < kTurningRounds && raiseForTurning(turning); ++round) {
      rememberPaths();
      solve(turning, residual_mps);
      std::erase_if(turning, [this](std::size_t island) { return takesBackLeap(island); });
    }
    findOpenings();
    takeMomentum();
    carry();
  }

 private:
  // Calls work(pair, rows) for stretches of pairs side by side; `rows` are indices.
  template <typename Work>
  void forPairs(const Work& work) {
    world_.crew.runStretches(pairs_.size(), kFewPairs, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) work(world_.table.pairs()[at(pairs_[k].pair)], pairs_[k]);
    });
  }

  // The same for bodies: work(index).
  template <typename Work>
  void forBodies(const Work& work) {
    world_.crew.runStretches(bodies_.size(), kFewBodies, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) work(at(bodies_[i]));
    });
  }

  // A pair that what turns in its island may be raised by.
  struct Turning {
    LastingContacts::PairRows rows;
    std::size_t island = 0;
    bool raised = false;
  };

  void beginAtMeans() {
    contacts_.paths.resize(world_.bodies.size());
    forBodies([&](std::size_t i) {
      contacts_.paths[i] = contacts_.bodies[i];
      Velocity& mean = contacts_.paths[i].velocity;
      if (world_.bodies[i].is_kinematic) {
        mean.linear -= 0.5 * contacts_.gained[i].linear;
        mean.angular -= 0.5 * contacts_.gained[i].angular;
      }
      if (!contacts_.touched[i]) return;
      mean.linear = 0.5 * (world_.bodies[i].velocity.linear + mean.linear);
      mean.angular = meanSpin(world_.bodies[i], contacts_.half_turns[i], mean.angular, step_s_);
    });
    contacts_.room.ways.resize(world_.bodies.size());
    forBodies([&](std::size_t i) { contacts_.room.ways[i] = contacts_.paths[i].velocity; });
  }

  // Makes the rows bounds on paths, without impulses yet. Returns the smallest rest gap, m.
  double boundPaths() {
    contacts_.momentum.resize(contacts_.rows.size());
    double smallest = std::numeric_limits<double>::infinity();
    forPairs([&](ShapePair& pair, const LastingContacts::PairRows& rows) {
      pair.room = std::min(kMoreRoom * std::abs(pair.room), 1.0);
      for (std::size_t i = rows.begin; i < rows.end; ++i) {
        ContactRow& row = contacts_.rows[i];
        contacts_.momentum[i] = {row.impulse, row.lowest_speed, {}};
        boundPath(i, pair);
        row.impulse.setZero();
      }
      lowerTo(pair.window.rest, smallest);
    });
    return smallest;
  }

  // What has too little room between others cannot open its gaps on all sides by as much as they rest at: for
  // this step nothing of it opens, and less is asked for in the next. What has no solution would lead the
  // bodies away together.
  void shareRoom(double residual_mps) {
    std::vector<std::size_t> islands(islands_.begin(), islands_.end());
    std::erase_if(islands, [&](std::size_t island) { return !leavesGaps(island); });
    for (const std::size_t island : islands) {
      for (ContactRow& row : contacts_.rowsOf(contacts_.islands[island])) row.impulse.setZero();
      for (const int i : contacts_.bodiesOf(std::span(&island, 1)))
        contacts_.paths[at(i)].velocity = contacts_.room.ways[at(i)];
    }
    if (!islands.empty()) solve(islands, residual_mps);
  }

  // The pairs of bodies with a row that misses its bound open no gap. Whether one of them was to.
  bool leavesGaps(std::size_t island) {
    const auto pairs = contacts_.pairsOf(contacts_.islands[island]);
    const std::vector<int> wedged = bodiesThatMiss(pairs);
    if (wedged.empty()) return false;
    const auto isWedged = [&](int body) { return std::binary_search(wedged.begin(), wedged.end(), body); };
    bool leaves = false;
    for (const LastingContacts::PairRows& of_pair : pairs) {
      ShapePair& pair = world_.table.pairs()[at(of_pair.pair)];
      if (!isWedged(pair.body_a) && !isWedged(pair.body_b)) continue;
      pair.room = -std::max(kLessRoom * std::abs(pair.room), kLeastRoom);
      for (std::size_t i = of_pair.begin; i < of_pair.end; ++i) {
        leaves |= contacts_.rows[i].lowest_speed > 0.0;
        boundPath(i, pair);
      }
    }
    return leaves;
  }

  // Those of a row that opens by less than half of what it was to, or closes by more than the band of its
  // gap; ascending.
  std::vector<int> bodiesThatMiss(std::span<const LastingContacts::PairRows> pairs) const {
    std::vector<int> bodies;
    for (const LastingContacts::PairRows& of_pair : pairs) {
      const ShapePair& pair = world_.table.pairs()[at(of_pair.pair)];
      const double least_mps = 2.0 * kPathGapShare * pair.window.rest / step_s_;
      const double most_mps = tolerance::kRestBand * pair.window.rest / step_s_;
      for (std::size_t i = of_pair.begin; i < of_pair.end; ++i) {
        const double opening_mps = contacts_.rows[i].lowest_speed;
        const double missed =
            opening_mps > 0.0 ? std::clamp(0.5 * opening_mps, least_mps, most_mps) : most_mps;
        if (-rowMiss(contacts_.rows[i], contacts_.paths).x() <= missed) continue;
        for (const int body : {pair.body_a, pair.body_b})
          if (contacts_.paths[at(body)].inverse_mass > 0.0) bodies.push_back(body);
        break;
      }
    }
    std::sort(bodies.begin(), bodies.end());
    return bodies;
  }

  void boundPath(std::size_t row, const ShapePair& pair) {
    const bool presses = contacts_.momentum[row].impulse.x() > 0.0;
    contacts_.rows[row].lowest_speed = gapSpeeds(contacts_.sources[row].gap_m, pair, step_s_, presses).path;
  }

  void rememberPaths() {
    contacts_.room.led_from.resize(world_.bodies.size());
    forBodies([&](std::size_t i) { contacts_.room.led_from[i] = contacts_.paths[i].velocity; });
  }

  // An island that raising for turning has led farther than standing still would goes back to where it was:
  // the search finds where its bodies meet, and they are led apart there.
  bool takesBackLeap(std::size_t island) {
    const std::vector<int> members = contacts_.bodiesOf(std::span(&island, 1));
    PathChange change;
    for (const int i : members)
      change.add(contacts_.paths[at(i)], contacts_.room.led_from[at(i)], contacts_.paths[at(i)].velocity);
    if (change.staysNear()) return false;
    for (const int i : members) contacts_.paths[at(i)].velocity = contacts_.room.led_from[at(i)];
    return true;
  }

  // What presses, and where paths open it.
  void findOpenings() {
    const std::vector<Velocity>& ways = contacts_.room.ways;
    forPairs([&](const ShapePair& pair, const LastingContacts::PairRows& rows) {
      const double noise_mps = openingNoise(pair.window, step_s_);
      const PairMotions motions{contacts_.paths[at(pair.body_a)].velocity,
                                contacts_.paths[at(pair.body_b)].velocity, ways[at(pair.body_a)],
                                ways[at(pair.body_b)]};
      for (std::size_t i = rows.begin; i < rows.end; ++i) {
        const ContactRow& row = contacts_.rows[i];
        MomentumPart& momentum = contacts_.momentum[i];
        momentum.opening =
            openingPower({row.n, row.r_a, row.r_b}, momentum.impulse.x() / step_s_, motions, noise_mps);
      }
    });
  }

  void takeMomentum() {
    forPairs([&](const ShapePair&, const LastingContacts::PairRows& rows) {
      for (std::size_t i = rows.begin; i < rows.end; ++i) {
        contacts_.rows[i].impulse = contacts_.momentum[i].impulse;
        contacts_.rows[i].lowest_speed = contacts_.momentum[i].lowest_speed;
      }
    });
  }

  // Leaves of the islands those of which some row has been raised; whether there are any.
  bool raiseForTurning(std::vector<std::size_t>& islands) {
    std::vector<Turning> pairs;
    for (const std::size_t island : islands)
      for (const LastingContacts::PairRows& of_pair : contacts_.pairsOf(contacts_.islands[island]))
        pairs.push_back({of_pair, island});
    world_.crew.runStretches(pairs.size(), kFewPairs, [&](std::size_t begin, std::size_t end) {
      StepCounters counters;
      for (std::size_t k = begin; k < end; ++k) {
        const LastingContacts::PairRows& rows = pairs[k].rows;
        pairs[k].raised = carom::raiseForTurning(
            {world_.bodies, world_.shapes, 0.0, step_s_}, world_.table.pairs()[at(rows.pair)],
            contacts_.paths, std::span(contacts_.rows).subspan(rows.begin, rows.end - rows.begin), counters);
      }
      std::atomic_ref(counters_.distance_queries) += counters.distance_queries;
      std::atomic_ref(counters_.states_walked) += counters.states_walked;
    });
    islands.clear();
    for (const Turning& pair : pairs)
      if (pair.raised && (islands.empty() || islands.back() != pair.island)) islands.push_back(pair.island);
    return !islands.empty();
  }

  // Without friction. Where few sweeps do not do, one pass from the supports upwards leaves only what is
  // wedged.
  void solve(std::span<const std::size_t> islands, double coarse_residual_mps) {
    std::vector<std::size_t> coarse;
    const auto solveIsland = [&](std::size_t island, int sweeps, bool again) {
      const SolverReport report = solveContacts(contacts_.rowsOf(contacts_.islands[island]), contacts_.paths,
                                                {.sweeps = again ? sweeps : std::max(kPathSweeps, sweeps),
                                                 .residual_mps = kPathResidual,
                                                 .friction = false,
                                                 .careful_sweeps = sweeps,
                                                 .coarse_residual_mps = coarse_residual_mps,
                                                 .crew = &world_.crew});
      if (again) std::erase(coarse, island);
      if (report.residual_mps > coarse_residual_mps) coarse.push_back(island);
      return report;
    };
    const auto enough = [](std::size_t) { return kPathResidual; };
    counters_.row_visits += solveWithinBudget(contacts_, islands, enough, solveIsland);
    for (const std::size_t island : coarse) passUpwards(island);
  }

  // What lies on what does not change while paths are sought.
  void passUpwards(std::size_t island) {
    const std::span<ContactRow> rows = contacts_.rowsOf(contacts_.islands[island]);
    ContactRoom& room = contacts_.room;
    if (std::exchange(room.is_ordered[island], 1) == 0)
      room.upward[island].order(rows, contacts_.paths, -world_.settings.gravity, room.of_order);
    room.upward[island].make(rows, contacts_.paths, &world_.crew);
  }

  void carry() {
    std::vector<Body>& bodies = world_.bodies;
    forBodies([&](std::size_t i) {
      if (!contacts_.touched[i]) return;
      bodies[i].travel = Travel::kCarried;
      const HalfTurn& half = contacts_.half_turns[i];
      const Velocity& after = contacts_.bodies[i].velocity;
      driveEvenly(bodies[i], {bodies[i].velocity,
                              {after.linear - bodies[i].velocity.linear, after.angular - half.spin},
                              half.R_WB,
                              half.spin,
                              step_s_});
    });
    counters_.projected_paths += static_cast<int>(
        std::ranges::count_if(bodies_, [&](int i) { return contacts_.touched[at(i)] != 0; }));
    findBends();
    forBodies([&](std::size_t i) {
      if (contacts_.touched[i])
        carryAlong(bodies[i], contacts_.paths[i].velocity, step_s_, contacts_.room.bends[i] != 0);
    });
    for (const LastingContacts::PairRows& of_pair : pairs_)
      for (std::size_t i = of_pair.begin; i < of_pair.end; ++i) {
        bodies[at(contacts_.rows[i].a)].opening_W += contacts_.momentum[i].opening.of_a_W;
        bodies[at(contacts_.rows[i].b)].opening_W += contacts_.momentum[i].opening.of_b_W;
      }
  }

  // Whose paths may bend.
  void findBends() {
    std::vector<char>& bends = contacts_.room.bends;
    std::vector<Vec3>& accelerations = contacts_.room.accelerations;
    bends.resize(world_.bodies.size());
    accelerations.resize(world_.bodies.size());
    forBodies([&](std::size_t i) {
      bends[i] = contacts_.touched[i];
      accelerations[i] = world_.bodies[i].travels() ? world_.bodies[i].acceleration : Vec3(Vec3::Zero());
    });
    forPairs([&](const ShapePair& pair, const LastingContacts::PairRows& rows) {
      for (std::size_t i = rows.begin; i < rows.end; ++i)
        straightenDips(contacts_.rows[i], contacts_.sources[i].gap_m, pair.window, step_s_, accelerations,
                       bends);
    });
  }

  LastingWorld world_;
  std::span<const std::size_t> islands_;
  std::vector<LastingContacts::PairRows> pairs_;  ///< Theirs.
  StepCounters& counters_;
  LastingContacts& contacts_;
  std::vector<int> bodies_;  ///< Of the islands.
  double step_s_;
};

}  // namespace

void setContactPaths(const LastingWorld& world, std::span<const std::size_t> islands, StepCounters& counters,
                     LastingContacts& contacts) {
  ContactPaths(world, islands, counters, contacts).set();
}

}  // namespace carom
