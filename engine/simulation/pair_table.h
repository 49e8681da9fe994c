#pragma once
// The candidate pairs of shapes and what is remembered of each from step to step: tracked features, the
// closest features at the current time, and the impulses of its contact points. Internal to the simulation
// floor. Tested through tests/engine/simulation/.

#include <array>
#include <cstdint>
#include <vector>

#include "engine/broad_phase/pair_finder.h"
#include "engine/contact/contact_manifold.h"
#include "engine/contact/time_of_impact.h"
#include "engine/foundation/crew.h"
#include "engine/simulation/body.h"

namespace carom {

struct RememberedImpulse {
  std::uint64_t id = 0;
  Vec3 impulse_W = Vec3::Zero();  ///< N s on B: what the point took in its last step.
  // What acts at the point for the rest of the step: events may end it, or give it anew.
  Vec3 force_W = Vec3::Zero();  ///< N on B.
  Vec3 arm_a = Vec3::Zero();    ///< From the centres of mass to where it acts, m.
  Vec3 arm_b = Vec3::Zero();
  // Against turning, likewise.
  Vec3 torque_impulse_W = Vec3::Zero();  ///< N m s on B.
  Vec3 torque_W = Vec3::Zero();          ///< N m on B.
};

struct ShapePair {
  IndexPair shapes;
  int body_a = -1;
  int body_b = -1;
  CollisionWindow window;
  double restitution = 0.0;
  double collision_speed_mps = 0.0;  ///< Slower approaches are lasting contact; set for every step.
  FeaturePair tracked;
  ClosestFeatures closest;                    ///< At the end of the last step.
  std::vector<RememberedImpulse> remembered;  ///< Most pairs of a crowd are near and do not touch.
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

class PairTable {
 public:
  /// The bounds each shape sweeps from its path's start to `end_s`, with a margin of the collision window.
  void updateBounds(const std::vector<Body>& bodies, const std::vector<Shape>& shapes, double end_s,
                    Crew& crew);
  /// Makes the pairs those whose bounds overlap, keeping what was remembered; new ones are queried at the
  /// bodies' poses of the last finished step.
  void collect(const std::vector<Body>& bodies, const std::vector<Shape>& shapes,
               const WorldSettings& settings, StepCounters& counters, PhaseClock* clock);
  /// Pairs that the body's path could meet and that are not in the table yet are added, queried at `time_s`.
  void extend(int body, double time_s, const std::vector<Body>& bodies, const std::vector<Shape>& shapes,
              const WorldSettings& settings, StepCounters& counters, PhaseClock* clock);
  /// For a step of another length: what was remembered of the impulses, so many times.
  void scaleImpulses(double factor);
  /// Whether some body's path leaves the bounds it was paired by; all start where they did then.
  bool pathsLeaveBounds(const std::vector<Body>& bodies, const std::vector<Shape>& shapes, double end_s,
                        Crew& crew) const;
  /// Queries the closest features again where a body moved.
  void requery(const std::vector<Body>& bodies, const std::vector<Shape>& shapes, Crew& crew,
               StepCounters& counters);

  std::vector<ShapePair>& pairs() { return pairs_; }
  const std::vector<ShapePair>& pairs() const { return pairs_; }
  /// One a shape: what it was paired by.
  const std::vector<Proxy>& proxies() const { return proxies_; }
  /// The pairs of a body, by index.
  const std::vector<int>& pairsOf(int body) const { return of_body_[static_cast<std::size_t>(body)]; }

 private:
  ShapePair makePair(IndexPair shapes_of_pair, const std::vector<Body>& bodies,
                     const std::vector<Shape>& shapes, const WorldSettings& settings) const;
  void link(std::size_t pair);

  std::vector<Proxy> proxies_;
  std::vector<Bounds> starts_;  ///< Of the shapes, where the paths start that they were paired by.
  PairFinder finder_;
  std::vector<ShapePair> pairs_;  ///< Ascending by shapes, but for those added within a step.
  std::vector<std::vector<int>> of_body_;
  std::vector<int> partners_;  ///< Scratch of `extend`.
};

}  // namespace carom
