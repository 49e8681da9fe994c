// The same bits: scaling all input by a power of two scales every length of an answer bit for bit and leaves
// all else; and a fixed stream of queries has one hash, for every compiler and optimisation level.

#include <gtest/gtest.h>

#include <cstring>
#include <map>

#include "engine/closest_features/vclip.h"
#include "tests/oracle/adversarial_pairs.h"
#include "tests/support/build_effort.h"

namespace carom {
namespace {

using oracle::Family;
using oracle::PosedPair;
using oracle::Random;

constexpr int kShare = inThisBuild(1, 40);

constexpr int kExponents[] = {-20, -3, 1, 10, 20};

bool sameBits(double x, double y) {
  return std::memcmp(&x, &y, sizeof x) == 0;
}
bool sameBits(const Vec3& x, const Vec3& y) {
  return sameBits(x.x(), y.x()) && sameBits(x.y(), y.y()) && sameBits(x.z(), y.z());
}

// ---- scaling ----

// Parts built anew at each scale, once each; at scale 1 too, so that all are built the same way.
class ScaledParts {
 public:
  const ConvexPart& at(const ConvexPart& part, int exponent) {
    const auto key = std::pair{&part, exponent};
    const auto known = parts_.find(key);
    if (known != parts_.end()) return known->second;
    return parts_.emplace(key, oracle::scaledPart(part, std::ldexp(1.0, exponent))).first->second;
  }

 private:
  std::map<std::pair<const ConvexPart*, int>, ConvexPart> parts_;
};

ClosestFeatures askScaled(ScaledParts& parts, const PosedPair& p, int exponent, PairMemory& memory) {
  const double factor = std::ldexp(1.0, exponent);
  const Pose X_WA{p.X_WA.rotation, factor * p.X_WA.position};
  const Pose X_WB{p.X_WB.rotation, factor * p.X_WB.position};
  return closestFeatures(parts.at(*p.a, exponent), X_WA, parts.at(*p.b, exponent), X_WB, memory);
}

void expectScaled(const ClosestFeatures& at_one, const ClosestFeatures& scaled, int exponent) {
  const double factor = std::ldexp(1.0, exponent);
  ASSERT_EQ(at_one.status, scaled.status);
  ASSERT_EQ(at_one.features, scaled.features);
  ASSERT_EQ(at_one.states, scaled.states);
  ASSERT_TRUE(sameBits(at_one.n_W, scaled.n_W));
  ASSERT_TRUE(sameBits(factor * at_one.distance_m, scaled.distance_m))
      << at_one.distance_m << " and " << scaled.distance_m / factor;
  ASSERT_TRUE(sameBits(Vec3(factor * at_one.p_A_W), scaled.p_A_W));
  ASSERT_TRUE(sameBits(Vec3(factor * at_one.p_B_W), scaled.p_B_W));
}

class ScaledFamily : public testing::TestWithParam<int> {};

TEST_P(ScaledFamily, ScalingAllInputByAPowerOfTwo_ScalesTheLengthsAndLeavesTheRest) {
  constexpr int kPairs = 2000 / kShare;
  constexpr int kSteps = 6;
  oracle::AdversarialPairs pairs(5001);
  ScaledParts parts;
  for (int i = 0; i < kPairs; ++i) {
    PosedPair p = pairs.next(static_cast<Family>(GetParam()));
    std::map<int, PairMemory> memories;
    // Cold, then tracked in steps of growing size.
    for (int step = 0; step < kSteps; ++step) {
      PairMemory& at_one = memories[0];
      const ClosestFeatures want = askScaled(parts, p, 0, at_one);
      for (const int exponent : kExponents) {
        SCOPED_TRACE(testing::Message() << "pair " << i << ", step " << step << ", 2^" << exponent);
        const ClosestFeatures got = askScaled(parts, p, exponent, memories[exponent]);
        ASSERT_NO_FATAL_FAILURE(expectScaled(want, got, exponent));
      }
      const double size = 1e-6 * std::pow(10.0, step);
      p.X_WB.position += size * p.scale() * pairs.random().direction();
      p.X_WB.rotation = (oracle::turned(pairs.random().direction(), size) * p.X_WB.rotation).normalized();
    }
  }
}

INSTANTIATE_TEST_SUITE_P(SameBits, ScaledFamily, testing::Range(0, static_cast<int>(Family::kCount)),
                         [](const auto& family) {
                           std::string name = oracle::familyName(static_cast<Family>(family.param));
                           for (char& c : name) c = c == ' ' ? '_' : c;
                           return name;
                         });

// ---- one hash everywhere ----

// FNV-1a, 64 bits.
class Hash {
 public:
  void add(double x) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &x, sizeof bits);
    for (int i = 0; i < 8; ++i) addByte(static_cast<std::uint8_t>(bits >> (8 * i)));
  }
  void add(const Vec3& v) {
    for (int i = 0; i < 3; ++i) add(v[i]);
  }
  void add(int x) { add(static_cast<double>(x)); }
  void add(const ClosestFeatures& c) {
    add(static_cast<int>(c.status));
    add(c.distance_m);
    add(c.p_A_W);
    add(c.p_B_W);
    add(c.n_W);
    for (const Feature& f : {c.features.a, c.features.b}) {
      add(static_cast<int>(f.kind));
      add(f.index);
    }
  }
  std::uint64_t value() const { return value_; }

 private:
  void addByte(std::uint8_t byte) { value_ = (value_ ^ byte) * 0x100000001b3u; }
  std::uint64_t value_ = 0xcbf29ce484222325u;
};

// Of arithmetic and square roots alone: other functions differ between the library and a compiler's folding.
std::vector<ConvexPart> plainSolids(Random& random) {
  std::vector<ConvexPart> solids{{boxPolyhedron({1.0, 0.5, 2.0}), 0.0},
                                 {oracle::triangulatedBox({1.0, 1.0, 1.0}), 0.0},
                                 {oracle::coplanarGrid(3, {1.0, 1.5, 0.75}), 0.0},
                                 {oracle::octahedron(), 0.0},
                                 {oracle::tetrahedron(), 0.125},
                                 {oracle::dodecahedron(), 0.0},
                                 {ConvexPolyhedron::point({0.1, 0.2, 0.3}), 0.5},
                                 {ConvexPolyhedron::segment({0, 0, -1}, {0, 0.25, 1}), 0.25}};
  for (const int n : {8, 20, 62, 252}) solids.push_back({oracle::randomHull(random, n, {1, 0.8, 0.5}), 0.0});
  return solids;
}

// A small turn about an axis of any length.
Quat turnedALittle(const Vec3& half_tangent) {
  return Quat(1.0, half_tangent.x(), half_tangent.y(), half_tangent.z()).normalized();
}

Quat quarterTurns(Random& random) {
  const Quat turns[] = {Quat(1, 0, 0, 0), Quat(1, 1, 0, 0), Quat(1, 0, 1, 0), Quat(1, 0, 0, 1)};
  const int first = random.integer(0, 3);
  const int second = random.integer(0, 3);
  return (turns[first] * turns[second]).normalized();
}

Vec3 latticePoint(Random& random) {
  Vec3 p;
  for (int i = 0; i < 3; ++i) p[i] = 0.125 * random.integer(-14, 14);
  return p;
}

// The poses that a pair starts from: general ones, or axis-aligned on a lattice. Numbers are drawn one after
// the other: in which order a call's arguments are drawn would be the compiler's choice.
void pose(Random& random, Pose& X_WA, Pose& X_WB) {
  if (random.integer(0, 2) > 0) {
    X_WA = random.pose(0.5);
    X_WB = random.pose(4.0);
    X_WB.position += X_WA.position;
    return;
  }
  X_WA.rotation = quarterTurns(random);
  X_WA.position = latticePoint(random);
  X_WB.rotation = quarterTurns(random);
  X_WB.position = X_WA.position + latticePoint(random);
}

// A stream of 20 000 queries: 800 pairs, each cold and then tracked in small and growing steps.
std::uint64_t hashOfTheStream() {
  Random random(5002);
  const std::vector<ConvexPart> solids = plainSolids(random);
  const auto pick = [&]() -> const ConvexPart& {
    return solids[static_cast<std::size_t>(random.integer(0, static_cast<int>(solids.size()) - 1))];
  };
  Hash hash;
  for (int i = 0; i < 800; ++i) {
    const ConvexPart& a = pick();
    const ConvexPart& b = pick();
    Pose X_WA, X_WB;
    pose(random, X_WA, X_WB);
    PairMemory memory;
    double size = 0x1p-24;
    for (int step = 0; step < 25; ++step, size *= 2.0) {
      const ClosestFeatures c = closestFeatures(a, X_WA, b, X_WB, memory);
      hash.add(c);
      X_WB.position += std::min(size, 0x1p-6) * random.direction();
      X_WB.rotation = turnedALittle(std::min(size, 0x1p-6) * random.direction()) * X_WB.rotation;
    }
  }
  return hash.value();
}

TEST(SameBits, AStreamOfQueriesHasOneHashForEveryCompilerAndOptimisation) {
  EXPECT_EQ(hashOfTheStream(), 0x7abc855316184ad3u)
      << "a change of the search may change the bits: then set the new hash";
}

}  // namespace
}  // namespace carom
