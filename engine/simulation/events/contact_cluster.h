#pragma once
// What an impulse reaches at one instant: the two bodies of an event and, through contacts, those that they
// press. Contacts join the solve when a body of theirs moves, so that the cost of an event is that of its
// consequences, not of the pile it happens in. The cluster changes no body; the event loop takes its answers.
// Its three solves: the collision (contact_cluster.cpp), the forces of lasting contact for the rest of the
// step (cluster_forces.cpp) and the paths (cluster_paths.cpp).
// Internal to the simulation floor. Tested in tests/physics/piles/pile_test.cpp.

#include <vector>

#include "engine/simulation/bodies/flight_plan.h"
#include "engine/simulation/contacts/contact_assembly.h"
#include "engine/simulation/contacts/contact_rows.h"

namespace carom {

/// Whether two approaches of one instant, m/s and negative, are one collision but for rounding: what is
/// symmetric stays so.
inline bool sameApproach(double separating_mps, double first_mps) {
  constexpr double kSame = 1e-6;
  return std::abs(separating_mps - first_mps) <= kSame * std::abs(first_mps);
}

/// What a cluster keeps of the world's bodies and pairs, by index, from step to step: which cluster they
/// joined last, by number, so that nothing has to be cleared and what rests costs nothing.
struct ClusterMemory {
  std::int64_t number = 0;
  std::vector<std::int64_t> body_joined;
  std::vector<int> body_member;
  std::vector<std::int64_t> pair_joined;
  std::vector<std::int64_t>
      pair_released;                    ///< Likewise: its forces are those of the cluster's rows, or none.
  std::vector<std::int64_t> pair_seen;  ///< Likewise: its closest features at the cluster's time are known.
  std::vector<ClosestFeatures> closest;
};

class ContactCluster {
 public:
  struct Member {
    int body = -1;
    bool collided = false;  ///< Met another fast enough for restitution.
    bool struck = false;    ///< One of an event's two bodies.
    bool expanded = false;  ///< All contacts of the body have joined.
    bool stops = false;     ///< Kinematic, and leaves others no room: solved as if it stopped now.
    Velocity momentum_before;
    Velocity path_before;  ///< The mean over the rest of the step.
  };

  ContactCluster(const LastingWorld& world, const FlightPlanner& planner, StepCounters& counters,
                 ClusterMemory& memory)
      : bodies_(world.bodies),
        shapes_(world.shapes),
        table_(world.table),
        planner_(planner),
        settings_(world.settings),
        counters_(counters),
        most_visits_(tolerance::kVisitsPerBody * static_cast<long>(bodies_.size())),
        number_(memory.number),
        body_joined_(memory.body_joined),
        body_member_(memory.body_member),
        pair_joined_(memory.pair_joined),
        pair_released_(memory.pair_released),
        pair_seen_(memory.pair_seen),
        closest_(memory.closest) {}

  /// Empties the cluster and gives it the pair of an event, found with `closest` at `time_s`.
  void begin(int pair, const ClosestFeatures& closest, double time_s);
  /// The same with a pair that is not an event: its closest features are looked up.
  void begin(int pair, double time_s);
  /// After a collision: gives it the pair of another event of this instant, whose collision comes next; they
  /// are supported together.
  void addEvent(int pair, const ClosestFeatures& closest);
  /// Whether it has room for that: its bodies have not joined, and there are few rows.
  bool hasRoomFor(const ShapePair& pair) const;
  /// The collision at the contacts, between the bodies of the event alone or with all that they press.
  void collide(bool spreads);
  /// What kinematic bodies did by the impulses of the collision, J.
  double workOfCollision() const;
  /// Whether forces of lasting contact act on some member.
  bool meetsCarried() const;
  /// The forces of lasting contact for the rest of the step, after the collision: those that act are taken
  /// over, those of bodies that part end, new ones begin, also at bodies that these reach.
  void support();
  /// Bounds the paths by the contacts: by the end of the step no gap is to close below the rest gap, and
  /// those that are lower reopen. Paths begin as what `path` was set to, those of bodies that join as they
  /// are. `all`: also by those that come in fast and have their own times of impact.
  void boundPaths(bool all);

  /// So much has been solved in this step that impulses spread no further.
  bool isExhausted() const { return visits_ > most_visits_; }

  /// What was solved last: the rows, their bodies being members, and where each came from.
  std::span<const ContactRow> rows() const { return rows_; }
  std::span<const SourcedRow> sources() const { return sources_; }

  /// The closest features of a pair, if the cluster of this time has looked at them; else null.
  const ClosestFeatures* closestSeen(int pair, double time_s) const;

  std::span<const int> eventPairs() const { return event_pairs_; }
  std::size_t size() const { return members_.size(); }
  const Member& member(std::size_t i) const { return members_[i]; }
  /// What impulses have made of member i; what its path is to be.
  const Velocity& momentum(std::size_t i) const { return momentum_[i].velocity; }
  /// What forces make of it by the end of the step; and whether some lasting contact presses it.
  const Velocity& end(std::size_t i) const { return ends_[i].velocity; }
  bool pressed(std::size_t i) const { return pressed_[i] != 0; }
  /// Whether the path may bend with the momentum (carried_path.h).
  bool bends(std::size_t i) const { return bends_[i] != 0; }
  void setPath(std::size_t i, const Velocity& mean) { paths_[i].velocity = members_[i].path_before = mean; }
  /// Whether impulses reach the body, but in a crowd where they go no further: it keeps its path in this
  /// step.
  bool keepsPath(std::size_t i) const { return stops_short_ && !members_[i].expanded; }
  const Velocity& path(std::size_t i) const { return paths_[i].velocity; }
  bool momentumChanged(std::size_t i) const { return differ(momentum(i), members_[i].momentum_before); }
  /// Noticeably, by `support`.
  bool forcesChanged(std::size_t i) const;
  bool pathChanged(std::size_t i) const { return differ(paths_[i].velocity, members_[i].path_before); }

 private:
  enum class Stage : std::uint8_t { kMomentum, kSupport, kPath };

  static bool differ(const Velocity& x, const Velocity& y) {
    return x.linear != y.linear || x.angular != y.angular;
  }
  std::vector<ImpulseBody>& stageBodies() {
    return stage_ == Stage::kMomentum ? momentum_ : stage_ == Stage::kSupport ? ends_ : paths_;
  }
  const std::vector<ImpulseBody>& stageBodies() const {
    return stage_ == Stage::kMomentum ? momentum_ : stage_ == Stage::kSupport ? ends_ : paths_;
  }
  // From now to the end of the step, of a member that has this velocity now.
  Velocity gainedByForces(const Member& member, const Velocity& velocity) const;
  void findEnd(std::size_t i);
  double restOfStep() const { return settings_.step_s - time_s_; }
  bool givesWay(int member) { return stageBodies()[static_cast<std::size_t>(member)].inverse_mass > 0.0; }
  void clear(double time_s);
  int join(int body);
  const ClosestFeatures& look(int pair);
  void addPair(int pair, const ClosestFeatures& closest);
  bool isInternal(int pair);
  bool expandMoved(double noticeable_mps);
  void expand(int body);
  void joinSimultaneous(double approach_mps);
  bool isNear(const ShapePair& pair) const;
  double safeResidual() const;  ///< m/s: what this leaves over cannot use up a gap within the step.
  /// Accuracy beyond the safe residual is bought while the budget of row visits lasts.
  bool canBeCareful() const { return visits_ < tolerance::kSolverRowVisits; }
  double noticeableSpeed() const;  ///< m/s: a change of speed that goes on to who stands behind.
  bool isCrowd() const;
  int mostSweeps() const;  ///< Of one solve.
  void fixPath(std::size_t i);
  void startAgain();
  bool collidesLater(const ContactRow& row, const SourcedRow& sourced) const;
  int presentEvent() const { return event_pairs_.back(); }
  void recallPoints(int event_pair);
  void releaseForces(int pair);
  void releaseDistant(int body);
  void takeOverForces(std::size_t first, std::size_t count);
  void keepForces();
  void keepPlannedForces();
  void findBends();
  bool raiseForTurning(bool all);
  void solveSpreading(double careful_mps);
  bool sweepSpreading(double careful_mps);
  std::vector<int> drivenWithoutRoom() const;
  void stopDriven(std::span<const int> members);
  void solveAtOnce(double enough_mps);
  void pivotPaths();
  bool solvePaths();
  double lowestSpeed(const SourcedRow& sourced) const;
  std::vector<double> findRestitution();

  const std::vector<Body>& bodies_;
  const std::vector<Shape>& shapes_;
  PairTable& table_;
  const FlightPlanner& planner_;
  const WorldSettings& settings_;
  StepCounters& counters_;

  double time_s_ = 0.0;
  long visits_ = 0;  ///< Of rows, in all solves.
  long most_visits_ = 0;
  Stage stage_ = Stage::kMomentum;
  bool stops_short_ = false;  ///< Impulses and forces have been solved as those of a crowd.
  std::vector<Member> members_;
  std::vector<ImpulseBody> momentum_;
  std::vector<ImpulseBody> ends_;       ///< At the end of the step, by the forces that act; in kSupport.
  std::vector<Velocity> planned_ends_;  ///< As they were before the event.
  std::vector<char> pressed_;
  std::vector<char> bends_;
  std::vector<ImpulseBody> paths_;
  std::vector<Velocity> solve_before_;  ///< Velocities when the stage's solve began.
  std::vector<int> event_pairs_;        ///< The last is that of the present event.
  std::vector<SourcedRow> collided_;    ///< Of the events before it.
  std::vector<SourcedRow> sources_;
  std::vector<ContactRow> rows_;
  // See ClusterMemory.
  std::int64_t& number_;
  std::vector<std::int64_t>& body_joined_;
  std::vector<int>& body_member_;
  std::vector<std::int64_t>& pair_joined_;
  std::vector<std::int64_t>& pair_released_;
  std::vector<std::int64_t>& pair_seen_;
  std::vector<ClosestFeatures>& closest_;
};

}  // namespace carom
