#pragma once
// The candidate pairs of shapes and what is remembered of each from step to step: tracked features, the
// closest features at the current time, and the impulses of its contact points. Internal to the simulation
// floor. Tested through tests/engine/simulation/.

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/broad_phase/pair_finder.h"
#include "engine/contact/contact_manifold.h"
#include "engine/contact/separating_axis.h"
#include "engine/contact/time_of_impact.h"
#include "engine/foundation/crew.h"
#include "engine/simulation/bodies/body.h"
#include "engine/simulation/bodies/phase_clock.h"

namespace carom {

struct RememberedImpulse {
  std::uint64_t id = 0;
  Vec3 impulse_W = Vec3::Zero();  ///< N s on B: what the point took in its last step.
  // What acts at the point for the rest of the step: events may end it, or give it anew.
  Vec3 force_W = Vec3::Zero();  ///< N on B.
  Vec3 n_W = Vec3::Zero();      ///< The contact's normal.
  Vec3 arm_a = Vec3::Zero();    ///< From the centres of mass to where it acts, m.
  Vec3 arm_b = Vec3::Zero();
  // Against turning, likewise.
  Vec3 torque_impulse_W = Vec3::Zero();  ///< N m s on B.
  Vec3 torque_W = Vec3::Zero();          ///< N m on B.
};

/// Where a pair that will not bounce comes down within the step, on the paths that its bodies were to take.
struct Landing {
  double time_s = 0.0;  ///< From the step's beginning.
  ClosestFeatures closest;
  Pose X_WA;
  Pose X_WB;
  Velocity a;  ///< Of the paths, in the mean until then.
  Velocity b;
};

/// Keeps its place in the table as long as the shapes are candidates.
struct ShapePair {
  IndexPair shapes;
  std::uint64_t rank = 0;  ///< Pairs come in the order of their shapes, those added within a step after them.
  int body_a = -1;
  int body_b = -1;
  bool active = false;
  bool near = false;              ///< Within this step its shapes could come near each other.
  bool lands = false;             ///< Its contact rows of this step are made of its landing.
  SeparatingAxis apart;           ///< If it is not near: why.
  std::array<int, 2> apart_at{};  ///< Its places among what is apart of body_a and body_b.
  CollisionWindow window;
  double collision_speed_mps = 0.0;  ///< Slower approaches are lasting contact; set for every step.
  double restitution = 0.0;
  double scale = 1.0;  ///< Of the table's impulses, when it was active last.
  FeaturePair tracked;
  ClosestFeatures closest;                    ///< At the end of the last step, if it is near.
  std::vector<RememberedImpulse> remembered;  ///< Most pairs of a crowd are near and do not touch.

  bool isFree() const { return shapes.a < 0; }  ///< Its place in the table is.
  /// No slow point higher than this can come to the rest gap within the step: where faces are cut off at this
  /// height, the cut holds nothing, and a corner that comes down slowly is held as the corner that it is.
  double lastingHeight(double step_s) const { return window.ceiling + collision_speed_mps * step_s; }
  /// What stays higher has neither contacts nor times of impact within the step.
  double contactHeight(double step_s) const { return std::max(window.manifold, lastingHeight(step_s)); }
  /// Whether a force of its contacts acts.
  bool presses() const {
    return std::ranges::any_of(remembered,
                               [](const RememberedImpulse& acting) { return !acting.force_W.isZero(0.0); });
  }
};

/// The ids of the points that a pair remembers.
struct RememberedPoints {
  explicit RememberedPoints(const ShapePair& pair) {
    for (const RememberedImpulse& remembered : pair.remembered) add(remembered.id);
  }
  RememberedPoints() = default;
  void add(std::uint64_t id) { ids[static_cast<std::size_t>(count++)] = id; }
  FormerPoints view() const& { return {ids.data(), static_cast<std::size_t>(count)}; }
  FormerPoints view() const&& = delete;  // it would outlive what it shows

  int count = 0;
  std::array<std::uint64_t, ContactManifold::kMaxPoints> ids{};
};

/// So many pairs are worked on by one thread: to wait for another takes as long.
inline constexpr std::size_t kFewPairs = 500;

/// What pairs are made of.
struct PairedWorld {
  const std::vector<Body>& bodies;
  const std::vector<Shape>& shapes;
  const WorldSettings& settings;
  Crew& crew;
};

/// Of a shape from its body's centre of mass, in the axes of the world.
struct TurnedBounds {
  Bounds bounds;
  Quat R_WB = Quat::Identity();  ///< The orientation that they were made for.
};

class PairTable {
 public:
  /// The bounds that each shape of the active bodies (ascending) sweeps from its path's start to `end_s`,
  /// with a margin of the collision window. All bodies must be active the first time.
  void updateBounds(const std::vector<Body>& bodies, const std::vector<Shape>& shapes,
                    std::span<const int> active, double end_s, Crew& crew);
  /// Makes the pairs of active bodies those whose bounds overlap, keeping what was remembered, and tells
  /// those that stay apart on the planned paths from those that could come near: these are queried at the
  /// bodies' poses of the last finished step. The pairs of others stay as they are.
  void collect(const PairedWorld& world, StepCounters& counters, PhaseClock* clock);
  /// Pairs that the paths of some bodies could meet and that are not in the table yet are added, and those
  /// that were apart and could come near on them are near from now on, queried at `time_s`.
  void extend(std::span<const int> some, double time_s, const PairedWorld& world, StepCounters& counters);
  /// The pairs of a body that rested are active from now on, until the next `collect`.
  void activate(int body, const std::vector<Body>& bodies, const WorldSettings& settings);
  /// For a step of another length: what was remembered of the impulses, so many times, a power of two.
  void scaleImpulses(double factor);
  /// Bodies whose path leaves the bounds they were paired by, or could bring near what was apart, ascending;
  /// all start where they did then.
  std::span<const int> bodiesThatMeetOthers(const PairedWorld& world, std::span<const int> active,
                                            double end_s);
  /// Queries the closest features of what is near again where a body moved.
  void requery(const PairedWorld& world, StepCounters& counters);

  /// By place; some places may be free.
  std::vector<ShapePair>& pairs() { return pairs_; }
  const std::vector<ShapePair>& pairs() const { return pairs_; }
  /// Of a pair that lands.
  const Landing& landingOf(int place) const { return landings_[static_cast<std::size_t>(place)]; }
  /// The pair lands so in this step.
  void land(int place, const Landing& landing) {
    landings_[static_cast<std::size_t>(place)] = landing;
    pairAt(place).lands = true;
  }
  /// The places of the pairs that the step looks at: those with an active body that could come near each
  /// other. In their order after `collect`.
  const std::vector<int>& active() const { return near_; }
  /// The places of all pairs with an active body whose bounds overlap, in their order after `collect`.
  const std::vector<int>& candidates() const { return active_; }
  /// The places of all pairs, in their order. Cost O(pairs).
  std::vector<int> all() const;
  /// Of all pairs, m; +infinity when there is none. Cost O(active), and where one that rested with the
  /// smallest gap has woken, O(pairs).
  double smallestGap(const std::vector<Body>& bodies, const std::vector<Shape>& shapes) const;
  /// Of a pair, m, apart or not.
  double gapOf(const ShapePair& pair, const std::vector<Body>& bodies,
               const std::vector<Shape>& shapes) const;
  std::size_t count() const { return pairs_.size() - free_.size(); }
  /// By what the impulses that a pair remembers are to be multiplied.
  double impulseScale(const ShapePair& pair) const { return pair.active ? 1.0 : scale_ / pair.scale; }
  /// One a shape: what it was paired by.
  const std::vector<Proxy>& proxies() const { return proxies_; }
  /// The places of the pairs of a body that is not static, in their order, without those that are apart.
  const std::vector<int>& pairsOf(int body) const { return of_body_[static_cast<std::size_t>(body)]; }

 private:
  Bounds boundsAt(int shape, const Pose& X_WB, const std::vector<Shape>& shapes);
  ShapePair makePair(IndexPair shapes_of_pair, const PairedWorld& world) const;
  SeparatingAxis axisOfBounds(const ShapePair& pair, const std::vector<Body>& bodies) const;
  void tellApart(const PairedWorld& world, StepCounters& counters, PhaseClock* clock);
  template <typename Wanted>
  void queryWhere(const Wanted& wanted, std::span<const int> places, const PairedWorld& world,
                  StepCounters& counters);
  void boundPaths(const std::vector<Body>& bodies, std::span<const int> active, double end_s);
  double leastGapOf(const ShapePair& pair, const std::vector<Shape>& shapes) const;
  bool staysApart(const ShapePair& pair, const PairedWorld& world) const;
  bool willStayApart(ShapePair& pair, bool is_queried, const PairedWorld& world) const;
  void enlist(int place, const std::vector<Body>& bodies);
  void unlist(int place, const std::vector<Body>& bodies);
  void setNear(int place, bool near, const std::vector<Body>& bodies);
  void comeNear(int place, double time_s, const PairedWorld& world, StepCounters& counters);
  void pairGrown(int body, double time_s, const PairedWorld& world, StepCounters& counters);
  ShapePair& pairAt(int place) { return pairs_[static_cast<std::size_t>(place)]; }
  const ShapePair& pairAt(int place) const { return pairs_[static_cast<std::size_t>(place)]; }
  bool isBefore(int place, int other) const { return pairAt(place).rank < pairAt(other).rank; }
  int add(ShapePair pair, const std::vector<Body>& bodies);
  void remove(int place, const std::vector<Body>& bodies);
  void restPairs(const PairedWorld& world, StepCounters& counters);
  void takeInExtended(const std::vector<Body>& bodies);

  std::vector<int> first_shape_;  ///< Of each body, and the end.
  std::vector<int> active_bodies_;
  std::vector<int> active_shapes_;
  double end_s_ = 0.0;                       ///< Of the paths that bounds were made for.
  std::vector<TurnedBounds> turned_bounds_;  ///< Of the shapes.
  std::vector<Proxy> proxies_;
  std::vector<Bounds> starts_;          ///< Of the shapes, where the paths start that they were paired by.
  std::vector<PathBound> path_bounds_;  ///< Of the bodies.
  long extension_ = 0;
  std::vector<long> extended_in_, bounded_in_;  ///< In which each body was, and its path bounded, last.
  PairFinder finder_;
  std::vector<ShapePair> pairs_;
  std::vector<Landing> landings_;                ///< One a pair: few land, and all pairs are gone through.
  std::vector<int> free_;                        ///< Places.
  std::vector<int> active_;                      ///< Ascending by shapes after `collect`.
  std::vector<int> near_;                        ///< Of these, those that are near, in the same order.
  std::vector<int> extended_;                    ///< Places of the pairs added since.
  mutable std::optional<double> resting_gap_m_;  ///< The smallest of those that are not active, if known.
  double scale_ = 1.0;                           ///< By what all impulses have been multiplied.
  std::vector<std::vector<int>> of_body_;        ///< Near ones.
  std::vector<std::vector<int>> apart_of_body_;  ///< In no order.
  // Scratch.
  std::vector<int> collected_, extended_bodies_, grown_, asked_, met_;
  std::vector<IndexPair> partners_, known_;
  std::vector<char> stays_apart_, meets_;
};

}  // namespace carom
