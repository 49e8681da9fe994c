// Every answer of 10^6 random queries and of 4000 and more pairs of each adversarial family is certified; a
// sample of them is measured against the exhaustive oracles in long double. Seeds are fixed, so the number
// that a failure prints names its query for good.

#include <gtest/gtest.h>

#include <algorithm>

#include "engine/closest_features/certificate.h"
#include "tests/bench/queries/true_gap.h"
#include "tests/oracle/adversarial_pairs.h"
#include "tests/support/build_effort.h"

namespace carom {
namespace {

using oracle::Family;
using oracle::PosedPair;
using oracle::Random;

constexpr int kShare = inThisBuild(1, 40);

struct Counts {
  int asked = 0, penetrating = 0, measured = 0;
  double worst = 0.0;  // of an error to its bound
};

void recordCounts(const Counts& counts) {
  testing::Test::RecordProperty("asked", counts.asked);
  testing::Test::RecordProperty("penetrating", counts.penetrating);
  testing::Test::RecordProperty("measured", counts.measured);
  testing::Test::RecordProperty("worst_error_to_bound", testing::PrintToString(counts.worst));
}

PosedPair swapped(const PosedPair& p) {
  return {p.b, p.a, p.X_WB, p.X_WA};
}

// The same answer is certified with the memory the query left.
void expectCertified(const PosedPair& p, PairMemory& memory, Counts& counts, ClosestFeatures& c) {
  c = closestFeatures(*p.a, p.X_WA, *p.b, p.X_WB, memory);
  ++counts.asked;
  counts.penetrating += c.status == Separation::kPenetrating;
  ASSERT_FALSE(c.reached_limit);
  ASSERT_TRUE(c.p_A_W.allFinite() && c.p_B_W.allFinite() && c.n_W.allFinite());
  const Certificate certificate = certify(c, *p.a, p.X_WA, *p.b, p.X_WB, &memory);
  const double bound = certifiedError(*p.a, p.X_WA, *p.b, p.X_WB);
  ASSERT_LE(certificate.error_m, bound) << "distance " << c.distance_m;
  const bool faces = p.a->core.faceCount() > 0 || p.b->core.faceCount() > 0;
  ASSERT_TRUE(certificate.complete || !faces) << "distance " << c.distance_m;
  counts.worst = std::max(counts.worst, certificate.error_m / bound);
}

// How much the exhaustive distance of two cores costs, in pairs of features.
double costOf(const PosedPair& p) {
  const auto edges = [](const ConvexPart& part) { return static_cast<double>(part.core.edgeCount()); };
  return edges(*p.a) * edges(*p.b);
}

void expectMeasured(bench::PartPlacer& placer, const PosedPair& p, const ClosestFeatures& c, Counts& counts) {
  ++counts.measured;
  const bench::JudgedPart a = placer.at(*p.a, p.X_WA), b = placer.at(*p.b, p.X_WB);
  const double bound = certifiedError(*p.a, p.X_WA, *p.b, p.X_WB);
  ASSERT_NEAR(static_cast<double>(bench::trueGap(a, b)), c.distance_m, bound);
}

// ---- 10^6 random queries ----

// Hulls of 4 to 252 vertices, 1e-3 to 100 metres large.
std::vector<ConvexPart> randomSolids(Random& random, int count) {
  std::vector<ConvexPart> solids;
  for (int i = 0; i < count; ++i) {
    const int vertices = i == 0 ? 4 : i == 1 ? 252 : static_cast<int>(random.logUniform(4.0, 253.0));
    const Vec3 axes(1.0, random.uniform(0.2, 1.0), random.uniform(0.2, 1.0));
    const double size_m = i == 2 ? 1e-3 : i == 3 ? 100.0 : random.logUniform(1e-3, 100.0);
    solids.push_back({oracle::randomHull(random, vertices, size_m * axes), 0.0});
  }
  return solids;
}

// A flight of one pair near each other, anywhere up to 10^4 metres from the origin. Steps are a part of the
// pair's size; one of size zero turns the bodies in place.
class Flight {
 public:
  Flight(Random& random, const std::vector<ConvexPart>& solids) : random_(random) {
    const auto pick = [&]() -> const ConvexPart& {
      return solids[static_cast<std::size_t>(random.integer(0, static_cast<int>(solids.size()) - 1))];
    };
    pair_.a = &pick();
    pair_.b = &pick();
    reaches_m_ = pair_.a->core.radius() + pair_.b->core.radius();
    const Vec3 home = (random.integer(0, 3) == 0 ? random.uniform(0.0, 1e4) : 0.0) * random.direction();
    home_ = home;
    const double step = random.logUniform(1e-6, 0.1);
    turn_a_ = oracle::turned(random.direction(), step);
    turn_b_ = oracle::turned(random.direction(), step);
    drift_m_ = random.uniform(0.0, 1.0) * step * reaches_m_ * random.direction();
    startAnew();
  }
  void startAnew() {
    pair_.X_WA = {random_.rotation(), home_ + random_.uniform(0.0, 0.5) * reaches_m_ * random_.direction()};
    pair_.X_WB = {random_.rotation(),
                  pair_.X_WA.position + random_.uniform(0.1, 2.0) * reaches_m_ * random_.direction()};
  }
  void step() {
    pair_.X_WA.rotation = (turn_a_ * pair_.X_WA.rotation).normalized();
    pair_.X_WB.rotation = (turn_b_ * pair_.X_WB.rotation).normalized();
    pair_.X_WB.position += drift_m_;
  }
  const PosedPair& pair() const { return pair_; }

 private:
  Random& random_;
  PosedPair pair_;
  double reaches_m_ = 0.0;
  Vec3 home_, drift_m_;
  Quat turn_a_, turn_b_;
};

TEST(CertifiedPairs, AMillionRandomQueriesAreRight_ColdAndTracked) {
  constexpr int kQueries = 1'000'000 / kShare;
  constexpr int kFlight = 50;
  Random random(4001);
  const std::vector<ConvexPart> solids = randomSolids(random, 64);
  bench::PartPlacer placer;
  Counts counts;
  ClosestFeatures c;
  while (counts.asked < kQueries) {
    Flight flight(random, solids);
    const bool tracked = random.integer(0, 1) == 1;
    PairMemory memory;
    for (int i = 0; i < kFlight; ++i) {
      SCOPED_TRACE(counts.asked);
      ASSERT_NO_FATAL_FAILURE(expectCertified(flight.pair(), memory, counts, c));
      if (i == kFlight - 1 && counts.asked % 1000 == 0 && costOf(flight.pair()) < 10000.0) {
        ASSERT_NO_FATAL_FAILURE(expectMeasured(placer, flight.pair(), c, counts));
      }
      if (tracked) {
        flight.step();
      } else {
        flight.startAnew();
        memory.features = {};
        memory.penetration.forget();
      }
    }
  }
  EXPECT_GT(counts.penetrating, kQueries / 10);
  EXPECT_LT(counts.penetrating, 9 * (kQueries / 10));
  recordCounts(counts);
}

// ---- closing in ----

// Two solids in general poses are moved together along their normal, to every gap down to rounding: the way
// between the witnesses gets short, and its direction with it, which must not cost the normal.
TEST(CertifiedPairs, AtEveryGapDownToRounding_TheAnswerIsRight) {
  Random random(4003);
  std::vector<ConvexPart> solids{{boxPolyhedron({1.0, 2.0, 0.5}), 0.0},
                                 {oracle::triangulatedBox({1.0, 1.0, 1.0}), 0.0},
                                 {oracle::dodecahedron(), 0.0},
                                 {oracle::prism(60, 1.0, 0.5), 0.0},
                                 {ConvexPolyhedron::segment({0, 0, -1}, {0, 0, 1}), 0.0}};
  for (const int n : {4, 8, 20, 62}) solids.push_back({oracle::randomHull(random, n), 0.0});
  Counts counts;
  ClosestFeatures c;
  for (int i = 0; i < 20000 / kShare; ++i) {
    const Flight flight(random, solids);
    PosedPair p = flight.pair();
    FeaturePair none;
    const ClosestFeatures apart = closestFeatures(*p.a, p.X_WA, *p.b, p.X_WB, none);
    if (apart.status != Separation::kSeparated) continue;
    for (double gap = 0.1; gap > 1e-16; gap *= 0.1) {
      SCOPED_TRACE(testing::Message() << "pair " << i << ", gap " << gap);
      p.X_WB.position = flight.pair().X_WB.position - (apart.distance_m - gap) * apart.n_W;
      PairMemory memory;
      ASSERT_NO_FATAL_FAILURE(expectCertified(p, memory, counts, c));
    }
  }
  EXPECT_GT(counts.asked, 100'000 / kShare);
  recordCounts(counts);
}

// ---- adversarial families ----

class CertifiedFamily : public testing::TestWithParam<int> {};

// Cold; swapped, tracked from the features of the first; and after a step below and one above tolerance.
TEST_P(CertifiedFamily, EveryAnswerIsRight_ColdAndTracked) {
  constexpr int kPairs = 4000 / kShare;
  constexpr int kMeasured = 300;       // of the cold ones
  constexpr double kCostly = 50000.0;  // of these only every tenth has its distance measured
  oracle::AdversarialPairs pairs(4002);
  bench::PartPlacer placer;
  Counts counts;
  ClosestFeatures c;
  for (int i = 0; i < kPairs; ++i) {
    SCOPED_TRACE(i);
    PosedPair p = pairs.next(static_cast<Family>(GetParam()));
    PairMemory memory;
    ASSERT_NO_FATAL_FAILURE(expectCertified(p, memory, counts, c));
    const bool in_turn = i % std::max(1, kPairs / kMeasured) == 0;
    if (in_turn && (c.status == Separation::kPenetrating || costOf(p) < kCostly || i % 10 == 0)) {
      ASSERT_NO_FATAL_FAILURE(expectMeasured(placer, p, c, counts));
    }
    for (const double step : {1e-16, 1e-5}) {
      p.X_WB.position += step * p.scale() * pairs.random().direction();
      p.X_WB.rotation = oracle::turned(pairs.random().direction(), step) * p.X_WB.rotation;
      ASSERT_NO_FATAL_FAILURE(expectCertified(p, memory, counts, c));
    }
    PairMemory from_other_side;
    from_other_side.features = {c.features.b, c.features.a};
    ASSERT_NO_FATAL_FAILURE(expectCertified(swapped(p), from_other_side, counts, c));
  }
  recordCounts(counts);
}

INSTANTIATE_TEST_SUITE_P(ClosestFeatures, CertifiedFamily,
                         testing::Range(0, static_cast<int>(Family::kCount)), [](const auto& family) {
                           std::string name = oracle::familyName(static_cast<Family>(family.param));
                           std::replace(name.begin(), name.end(), ' ', '_');
                           return name;
                         });

}  // namespace
}  // namespace carom
