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
#include "engine/contact/time_of_impact.h"
#include "engine/foundation/crew.h"
#include "engine/simulation/bodies/body.h"
#include "engine/simulation/bodies/body_bounds.h"
#include "engine/simulation/bodies/phase_clock.h"
#include "engine/simulation/contacts/body_pair.h"

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

/// Two shapes that could come near each other within the step. Keeps its place in the table as long as they
/// could.
struct ShapePair : MeetingTerms {
  IndexPair shapes;
  std::uint64_t rank = 0;  ///< Pairs come in the order of their shapes, those added within a step after them.
  int body_a = -1;
  int body_b = -1;
  int of_bodies = -1;  ///< The place of the pair of its bodies.
  bool active = false;
  bool lands = false;  ///< Its contact rows of this step are made of its landing.
  double scale = 1.0;  ///< Of the table's impulses, when it was active last.
  /// The share of the rest gap that its bodies seem to have room for between others; negative: so much, and
  /// in this step no gap opens.
  double room = 1.0;
  FeaturePair tracked;
  ClosestFeatures closest;                    ///< At the end of the last step.
  std::vector<RememberedImpulse> remembered;  ///< Most pairs of a crowd are near and do not touch.

  bool isFree() const { return shapes.a < 0; }  ///< Its place in the table is.
  /// Whether it is near enough, for its speed, to be solved as lasting contact in a step.
  bool lasts(double step_s) const { return closest.distance_m <= lastingHeight(step_s); }
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

/// Shapes that the table keeps in view, near or not.
struct Candidate {
  IndexPair shapes;
  int body_a = -1;
  int body_b = -1;
  double gap_m = 0.0;
};

class PairTable {
 public:
  /// The bounds that each of the active bodies (ascending) sweeps from its path's start to `end_s`, with a
  /// margin of the collision window. All bodies must be active the first time.
  void updateBounds(const std::vector<Body>& bodies, const std::vector<Shape>& shapes,
                    std::span<const int> active, double end_s, Crew& crew);
  /// Pairs active bodies whose bounds overlap, keeping what was remembered, and tells which of their shapes
  /// could come near each other on the planned paths: these are queried at the bodies' poses of the last
  /// finished step. The pairs of others stay as they are.
  void collect(const PairedWorld& world, StepCounters& counters, PhaseClock* clock);
  /// Pairs that the paths of some bodies could meet and that are not in the table yet are added, and shapes
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

  /// What is near, by place; some places may be free.
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
  /// The places of all pairs, in their order. Cost O(pairs).
  std::vector<int> all() const;
  /// Of bodies, by place; some places may be free.
  const std::vector<BodyPair>& bodyPairs() const { return body_pairs_; }
  /// The places of those with an active body.
  const std::vector<int>& activeBodyPairs() const { return active_pairs_; }
  /// Ascending by shapes. Cost O(pairs), with a query for each that is apart.
  std::vector<Candidate> candidates(const std::vector<Body>& bodies, const std::vector<Shape>& shapes) const;
  /// Of all candidates, m; +infinity when there is none. Cost O(active), and where one that rested with the
  /// smallest gap has woken, O(pairs).
  double smallestGap(const std::vector<Body>& bodies, const std::vector<Shape>& shapes) const;
  /// By what the impulses that a pair remembers are to be multiplied.
  double impulseScale(const ShapePair& pair) const { return pair.active ? 1.0 : scale_ / pair.scale; }
  /// One a body: what it was paired by.
  const std::vector<Proxy>& proxies() const { return proxies_; }
  /// The places of the pairs of a body that is not static, in their order.
  const std::vector<int>& pairsOf(int body) const { return of_body_[static_cast<std::size_t>(body)]; }

 private:
  /// What is apart and was asked for its closest features.
  struct Asked {
    int of_bodies = -1;
    std::size_t index = 0;
    ClosestFeatures closest;
  };
  /// Of one thread.
  struct ListScratch {
    std::vector<int> shapes_a, shapes_b;
    std::vector<Bounds> a, b;
    std::vector<IndexPair> found, near;
    std::vector<ApartPieces> apart;
  };

  BodyPair& bodyPairAt(int place) { return body_pairs_[static_cast<std::size_t>(place)]; }
  const BodyPair& bodyPairAt(int place) const { return body_pairs_[static_cast<std::size_t>(place)]; }
  ShapePair& pairAt(int place) { return pairs_[static_cast<std::size_t>(place)]; }
  const ShapePair& pairAt(int place) const { return pairs_[static_cast<std::size_t>(place)]; }
  const PathBound& pathOf(int body) const { return path_bounds_[static_cast<std::size_t>(body)]; }
  bool isBefore(int place, int other) const { return pairAt(place).rank < pairAt(other).rank; }
  void boundPaths(const std::vector<Body>& bodies, std::span<const int> active, double end_s);

  int addBodyPair(IndexPair bodies_of_pair, const PairedWorld& world);
  void removeBodyPair(int place, const std::vector<Body>& bodies);
  void pairBodies(std::span<const IndexPair> wanted, const PairedWorld& world);
  void restPairs(const PairedWorld& world);
  void takeInExtended(const std::vector<Body>& bodies);

  static ClosestFeatures closestNow(const IndexPair& of, FeaturePair& tracked,
                                    const std::vector<Body>& bodies, const std::vector<Shape>& shapes);
  RelativeMotion motionOf(const BodyPair& pair, const RelativePose& since) const;
  bool staysListed(const BodyPair& pair, double height_m) const;
  bool keepsRoom(const BodyPair& pair, double height_m) const;
  SeparatingAxis axisOfBounds(const IndexPair& of, const std::vector<Shape>& shapes) const;
  GapBound boundOf(const ApartPieces& apart, const std::vector<Shape>& shapes) const;
  void list(BodyPair& pair, bool keeps_all, const PairedWorld& world, ListScratch& scratch);
  void takeListed(BodyPair& pair, bool keeps_all, const PairedWorld& world, ListScratch& scratch);
  void lookAt(BodyPair& pair, double height_m, const PairedWorld& world);
  std::size_t fewBodyPairs() const;
  void lookAtAll(const PairedWorld& world);
  void measure(BodyPair& pair);
  bool standsOff(ApartPieces& apart, const ClosestFeatures& closest, const BodyPair& pair,
                 const PairedWorld& world) const;
  void tellApart(const PairedWorld& world);
  void askApart(const PairedWorld& world, StepCounters& counters, PhaseClock* clock);
  void countCandidates(StepCounters& counters);

  int makeNear(int of_bodies, std::size_t index, const ClosestFeatures& closest, const PairedWorld& world);
  void add(ShapePair pair, int place, const std::vector<Body>& bodies);
  void remove(int place, const std::vector<Body>& bodies);
  bool meetsOthers(const BodyPair& pair, const PairedWorld& world) const;
  void pairGrown(int body, double time_s, const PairedWorld& world);
  void growPairs(std::span<const int> some, double time_s, const PairedWorld& world);
  void comeNear(int of_bodies, double time_s, const PairedWorld& world, StepCounters& counters);

  std::vector<int> active_bodies_;
  double end_s_ = 0.0;  ///< Of the paths that bounds were made for.
  BodyBounds bounds_;
  // Of the bodies: ...
  std::vector<Proxy> proxies_;
  std::vector<Bounds> starts_;  ///< ... where the paths start that they were paired by, ...
  std::vector<PathBound> path_bounds_;
  std::vector<std::vector<int>> of_body_;        ///< ... their pairs of shapes, ...
  std::vector<std::vector<int>> pairs_of_body_;  ///< ... and of bodies.
  long extension_ = 0;
  std::vector<long> extended_in_, bounded_in_;  ///< In which each body was, and its path bounded, last.
  PairFinder finder_;
  std::vector<BodyPair> body_pairs_;
  std::vector<int> free_body_pairs_;  ///< Places.
  std::vector<int> active_pairs_;     ///< Of bodies; ascending after `collect`.
  std::vector<ShapePair> pairs_;
  std::vector<Landing> landings_;  ///< One a pair: few land, and all pairs are gone through.
  std::vector<int> free_;          ///< Places.
  std::vector<int> near_;          ///< Those that are active, ascending by shapes after `collect`.
  std::vector<int> extended_;      ///< Places of the pairs added since.
  std::size_t resting_candidates_ = 0;
  std::size_t listed_ = 0;                       ///< Candidates of active pairs.
  mutable std::optional<double> resting_gap_m_;  ///< The smallest of those that are not active, if known.
  double scale_ = 1.0;                           ///< By what all impulses have been multiplied.
  // Scratch.
  std::vector<int> collected_, extended_bodies_, partners_, paired_, met_, grown_;
  std::vector<Asked> asked_;
  std::vector<ApartPieces> told_apart_;  ///< Of what was near.
  std::vector<char> meets_;
  ListScratch scratch_;
};

}  // namespace carom
