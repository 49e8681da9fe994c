#pragma once
// Random pairs of hulls on random paths, each turned by up to 360 degrees in the step, and the judgement of
// what the search for their time of impact says of them: proven apart to that time by an oracle of its own
// (tests/oracle/sweep_oracle.h), and in the collision window where it reports an impact. Tested in
// tests/bench/queries/random_sweep_test.cpp.

#include <array>
#include <numbers>

#include "engine/contact/time_of_impact.h"
#include "tests/oracle/brute_force_distance.h"
#include "tests/oracle/sweep_oracle.h"
#include "tests/oracle/test_shapes.h"

namespace carom::bench {

struct SweepCounts {
  long sweeps = 0, impacts = 0, stopped = 0;
  long missed = 0;     ///< The oracle saw the floor passed before the time returned.
  long misplaced = 0;  ///< An impact or a stop outside the window.
  long undecided = 0;  ///< The oracle's bound of looks.
  long queries = 0, looks = 0;
  int most_queries = 0;
};

class RandomSweeps {
 public:
  explicit RandomSweeps(std::uint64_t seed) : random_(seed) {
    for (int i = 0; i < kHulls; ++i) {
      const Vec3 axes(1.0, random_.uniform(0.05, 1.0), random_.uniform(0.05, 1.0));
      parts_.push_back({oracle::randomHull(random_, random_.integer(4, 20), axes), 0.0});
    }
  }

  /// One more sweep; whether the search was right.
  bool next() {
    const ConvexPart &a = pick(), &b = pick();
    const Vec3 away = random_.uniform(2.05, 4.0) * random_.direction();
    const auto spin = [&] {
      return Vec3(random_.uniform(0.0, 2.0 * std::numbers::pi) * random_.direction());
    };
    const auto path = [&](const Vec3& position, const Vec3& velocity, const Vec3& acceleration) {
      return Trajectory{0.0, {random_.rotation(), position}, velocity, acceleration, spin()};
    };
    const Vec3 aim = (-away + 1.5 * random_.direction()) * random_.logUniform(0.2, 50.0);
    const Trajectory path_a = path(Vec3::Zero(), Vec3::Zero(), Vec3::Zero());
    const Trajectory path_b = path(away, aim, random_.uniform(0.0, 10.0) * random_.direction());
    return judge(a, path_a, b, path_b);
  }

  const SweepCounts& counts() const { return counts_; }

 private:
  static constexpr int kHulls = 64;
  static constexpr double kEnd = 1.0;  // s; lengths and speeds go with it

  const ConvexPart& pick() { return parts_[static_cast<std::size_t>(random_.integer(0, kHulls - 1))]; }

  bool judge(const ConvexPart& a, const Trajectory& path_a, const ConvexPart& b, const Trajectory& path_b) {
    const CollisionWindow window = collisionWindow(a, b);
    const ImpactSearch search{window, std::sqrt(2.0 * 9.81 * window.ceiling), 0.0, kEnd};
    FeaturePair tracked;
    const ClosestFeatures at_begin = closestFeatures(a, path_a.at(0.0), b, path_b.at(0.0), tracked);
    const TimeOfImpact found =
        timeOfImpact({&a, &path_a, a.core.radiusAbout(Vec3::Zero())},
                     {&b, &path_b, b.core.radiusAbout(Vec3::Zero())}, search, at_begin, tracked);
    const int queries = found.queries + 1;  // with that of the beginning
    ++counts_.sweeps;
    counts_.queries += queries;
    counts_.most_queries = std::max(counts_.most_queries, queries);
    const bool clear = found.outcome == TimeOfImpact::Outcome::kClear;
    counts_.impacts += found.outcome == TimeOfImpact::Outcome::kImpact;
    counts_.stopped += found.outcome == TimeOfImpact::Outcome::kStopped;

    // Half the floor: above zero, and a gap of its own for the oracle to see between.
    const oracle::SweepProof proof =
        oracle::provenApart({&a, &path_a}, {&b, &path_b}, 0.0, found.time_s, 0.5 * window.floor);
    counts_.looks += proof.looks;
    counts_.missed += proof.touched;
    const bool undecided = !proof.touched && proof.proven_s < found.time_s;
    counts_.undecided += undecided;
    bool misplaced = clear && found.time_s != kEnd;
    if (!clear) {
      const double gap = static_cast<double>(oracle::signedGap(oracle::place(a, path_a.at(found.time_s)),
                                                               oracle::place(b, path_b.at(found.time_s))));
      misplaced = gap < window.floor * (1.0 - 1e-6) || gap > window.ceiling * (1.0 + 1e-9);
    }
    counts_.misplaced += misplaced;
    return !proof.touched && !undecided && !misplaced;
  }

  oracle::Random random_;
  std::vector<ConvexPart> parts_;
  SweepCounts counts_;
};

}  // namespace carom::bench
