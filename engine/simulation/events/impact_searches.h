#pragma once
// The searches for the next impact of every pair within a step (paper §2.3): begun where the paths of its
// bodies begin, and carried only as far as events come, since most end early, when another event gives one of
// the bodies a new path. Internal to the simulation floor. Tested through tests/engine/simulation/ and
// tests/physics/piles/pile_test.cpp.

#include <span>
#include <vector>

#include "engine/contact/time_of_impact.h"
#include "engine/foundation/index.h"
#include "engine/simulation/contacts/contact_assembly.h"
#include "engine/simulation/events/contact_cluster.h"

namespace carom {

/// The search for a pair's next impact.
struct Prediction {
  int version = 0;        ///< Of its bodies' paths.
  int impacts = 0;        ///< In this step.
  bool searched = false;  ///< Its bodies may meet.
  bool looked = false;    ///< At least once.
  ImpactSearch search;
  TimeOfImpact found;
};

/// What looks took.
struct SearchCost {
  int queries = 0;
  long states = 0;
  int newton_steps = 0;
  long work = 0;
  SearchCost operator-(const SearchCost& before) const {
    return {queries - before.queries, states - before.states, newton_steps - before.newton_steps,
            work - before.work};
  }
};

/// Kept from step to step for its room, and through a step for what its substeps share.
struct SearchMemory {
  std::vector<Prediction> predictions;  ///< By place of the pair.
  std::vector<int> struck;  ///< Pairs with impacts in the last step, whose count is to be forgotten.
  std::vector<int> followed, pending;  ///< Scratch: pairs whose searches are carried to their ends.
  std::vector<SearchCost> costs;
  long work = 0;  ///< Poses evaluated in this step, in all its substeps.
};

class ImpactSearches {
 public:
  /// `cluster`: has seen some pairs already at the time of its event.
  ImpactSearches(const LastingWorld& world, const ContactCluster& cluster, StepCounters& counters,
                 SearchMemory& memory);

  /// The first look at every pair. No event has come yet, so each can be made by itself; most find that the
  /// whole step is clear.
  void lookAtAll();
  /// The search of a pair whose bodies have new paths.
  void begin(int pair);
  /// Carries the searches of some pairs, no pair twice, on by one look each.
  void look(std::span<const int> pairs);
  /// Pairs that will not bounce and would come down within the step, each with its landing.
  std::vector<int> foreseeLandings();

  const Prediction& of(int pair) const { return predictions_[at(pair)]; }
  /// Another impact of the pair.
  void strike(int pair);
  /// Whether all the work that a step may put into searches is done.
  bool isSpent() const { return work_ > most_work_; }

  /// The speed at which a pair parts along its paths, m/s, where its search has come to.
  double separatingSpeed(int pair) const;
  /// Whether what a look has found is no collision: paths meet, while the momenta, which impulses act on, do
  /// not bring the bodies together fast.
  bool isSlow(int pair) const;

 private:
  bool mayMeet(const ShapePair& pair) const;
  double beginOf(const ShapePair& pair) const;
  void beginAt(int pair, const ClosestFeatures& at_begin);
  SearchCost carryOn(int pair);
  void carryToTheirEnds(std::span<const int> pairs);
  void count(const SearchCost& cost);
  MovingPart movingPart(int shape) const;
  ClosestFeatures closestAt(int pair, double time_s);
  double slowestImpact(int pair) const;

  std::vector<Body>& bodies_;
  const std::vector<Shape>& shapes_;
  PairTable& table_;
  const WorldSettings& settings_;
  Crew& crew_;
  const ContactCluster& cluster_;
  StepCounters& counters_;
  SearchMemory& memory_;
  std::vector<Prediction>& predictions_;
  std::vector<int>& struck_;
  long most_work_ = 0;
  long& work_;  ///< See SearchMemory.
};

}  // namespace carom
