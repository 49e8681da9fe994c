// A query allocates nothing: counted through this program's own operator new. What a pair's memory needs is
// allocated at the first queries that intersect, and kept.

#include <gtest/gtest.h>

#include <cstdlib>
#include <new>

#include "engine/closest_features/vclip.h"
#include "tests/oracle/adversarial_pairs.h"
#include "tests/oracle/allocations.h"

namespace {

void* counted(std::size_t size, std::size_t alignment) {
  ++carom::oracle::allocations;
  const std::size_t whole = (size + alignment - 1) / alignment * alignment;
  if (void* p = std::aligned_alloc(alignment, whole == 0 ? alignment : whole)) return p;
  throw std::bad_alloc();
}

}  // namespace

void* operator new(std::size_t size) {
  return counted(size, __STDCPP_DEFAULT_NEW_ALIGNMENT__);
}
void* operator new[](std::size_t size) {
  return counted(size, __STDCPP_DEFAULT_NEW_ALIGNMENT__);
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  return counted(size, static_cast<std::size_t>(alignment));
}
void* operator new[](std::size_t size, std::align_val_t alignment) {
  return counted(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* p) noexcept {
  std::free(p);
}
void operator delete[](void* p) noexcept {
  std::free(p);
}
void operator delete(void* p, std::size_t) noexcept {
  std::free(p);
}
void operator delete[](void* p, std::size_t) noexcept {
  std::free(p);
}
void operator delete(void* p, std::align_val_t) noexcept {
  std::free(p);
}
void operator delete[](void* p, std::align_val_t) noexcept {
  std::free(p);
}
void operator delete(void* p, std::size_t, std::align_val_t) noexcept {
  std::free(p);
}
void operator delete[](void* p, std::size_t, std::align_val_t) noexcept {
  std::free(p);
}

namespace carom {
namespace {

using oracle::allocationsOf;
using oracle::Family;
using oracle::PosedPair;
using oracle::Random;

// The certificate that builds without NDEBUG check each answer with allocates its lists.
#ifdef NDEBUG
constexpr bool kCountsTheQueryAlone = true;
#else
constexpr bool kCountsTheQueryAlone = false;
#endif

class NoAllocation : public testing::Test {
 protected:
  void SetUp() override {
    if (!kCountsTheQueryAlone) GTEST_SKIP() << "this build certifies each answer, which allocates";
  }
};

ClosestFeatures ask(const PosedPair& p, PairMemory& memory) {
  return closestFeatures(*p.a, p.X_WA, *p.b, p.X_WB, memory);
}

std::vector<PosedPair> pairsOf(oracle::AdversarialPairs& pairs, int per_family) {
  std::vector<PosedPair> all;
  for (int family = 0; family < static_cast<int>(Family::kCount); ++family)
    for (int i = 0; i < per_family; ++i) all.push_back(pairs.next(static_cast<Family>(family)));
  return all;
}

// A pair that meets and parts: B goes once around a small circle at the border of contact, turning.
struct Loop {
  const ConvexPart& a;
  const ConvexPart& b;
  double middle_m;
  double reach_m;

  PosedPair at(int step) const {
    const double angle = 2.0 * std::numbers::pi * step / kSteps;
    return {&a,
            &b,
            Pose{},
            {oracle::turned({1, 0.3, 0.2}, angle),
             Vec3(reach_m * std::cos(angle), 0.2 * reach_m, middle_m + reach_m * std::sin(angle))}};
  }
  static constexpr int kSteps = 720;
};

TEST_F(NoAllocation, TheCounterCounts) {
  // A new-expression may be left out by the compiler; a call is not.
  EXPECT_EQ(allocationsOf([] { ::operator delete(::operator new(1)); }), 1);
  EXPECT_GE(allocationsOf([] { std::vector<double> v(100); }), 1);
}

TEST_F(NoAllocation, ATrackedPairThatStaysApart_AllocatesNothingFromItsFirstQueryOn) {
  Random random(6001);
  const ConvexPart a{oracle::randomHull(random, 62), 0.0}, b{oracle::randomHull(random, 252), 0.0};
  const Loop loop{a, b, 2.5, 0.3};
  PairMemory memory;
  int separated = 0;
  EXPECT_EQ(allocationsOf([&] {
              for (int i = 0; i < Loop::kSteps; ++i)
                separated += ask(loop.at(i), memory).status == Separation::kSeparated;
            }),
            0);
  EXPECT_EQ(separated, Loop::kSteps);
}

TEST_F(NoAllocation, ATrackedPairThatMeetsAndParts_AllocatesNothingOnceItsMemoryHasGrown) {
  Random random(6002);
  const ConvexPart solids[] = {{boxPolyhedron({1, 2, 0.5}), 0.0},
                               {oracle::triangulatedBox({1, 1, 1}), 0.0},
                               {oracle::prism(60, 1.0, 1.0), 0.0},
                               {oracle::randomHull(random, 62), 0.0},
                               {ConvexPolyhedron::segment({0, 0, -0.5}, {0, 0, 0.5}), 0.3}};
  for (const ConvexPart& a : solids)
    for (const ConvexPart& b : solids)
      for (const double middle_m : {1.3, 0.2}) {
        const Loop loop{a, b, middle_m, 0.2};
        PairMemory memory;
        int penetrating = 0;
        const auto goAround = [&] {
          for (int i = 0; i < Loop::kSteps; ++i)
            penetrating += ask(loop.at(i), memory).status == Separation::kPenetrating;
        };
        // Which steps of a lap need the polytope depends on the laps before: its room grows for a few.
        constexpr int kGrowingLaps = 6;
        for (int lap = 0; lap < kGrowingLaps; ++lap) goAround();
        EXPECT_EQ(allocationsOf(goAround), 0);
        EXPECT_TRUE(middle_m > 1.0 || penetrating > 0);
      }
}

TEST_F(NoAllocation, AColdQueryWithOneMemoryForAllPairs_AllocatesNothingOnceEachWasAsked) {
  oracle::AdversarialPairs pairs(6003);
  const std::vector<PosedPair> all = pairsOf(pairs, 200);
  PairMemory memory;
  const auto askAll = [&] {
    for (const PosedPair& p : all) {
      memory.features = {};
      memory.penetration.forget();
      ask(p, memory);
    }
  };
  askAll();
  EXPECT_EQ(allocationsOf(askAll), 0);
}

TEST_F(NoAllocation, AColdQueryByFeaturesAlone_AllocatesNothing) {
  oracle::AdversarialPairs pairs(6004);
  const std::vector<PosedPair> all = pairsOf(pairs, 200);
  const auto askAll = [&] {
    for (const PosedPair& p : all) {
      FeaturePair tracked;
      closestFeatures(*p.a, p.X_WA, *p.b, p.X_WB, tracked);
    }
  };
  EXPECT_EQ(allocationsOf(askAll), 0);
}

// The room for a depth's proof is the pair's own: it comes with the first query that intersects, or whose
// walk from a cold start was so long that the axes were asked.
TEST_F(NoAllocation, AFreshMemoryAllocatesOnlyForADepthOrAWalkOfTwelveStates) {
  constexpr int kLongWalk = 12;
  oracle::AdversarialPairs pairs(6005);
  const std::vector<PosedPair> all = pairsOf(pairs, 200);
  int apart = 0;
  for (const PosedPair& p : all) {
    PairMemory memory;
    ClosestFeatures c;
    const long count = allocationsOf([&] { c = ask(p, memory); });
    const bool clearly_apart = c.distance_m + p.a->radius_m + p.b->radius_m > 1e-6 * p.scale();
    if (!clearly_apart || c.states >= kLongWalk) continue;
    ++apart;
    EXPECT_EQ(count, 0) << "distance " << c.distance_m << ", states " << c.states;
  }
  EXPECT_GT(apart, static_cast<int>(all.size()) / 2);
}

}  // namespace
}  // namespace carom
