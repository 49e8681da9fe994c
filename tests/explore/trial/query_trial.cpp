#include "tests/explore/trial/query_trial.h"

#include <cmath>
#include <numbers>
#include <sstream>

#include "engine/foundation/contract.h"
#include "tests/oracle/brute_force_distance.h"
#include "tests/oracle/test_shapes.h"

namespace carom::explore {
namespace {

using oracle::Random;

constexpr int kQueries = 200;
constexpr int kBruteForceEvery = 23;
constexpr double kSame = 1e-12;   // of the pair's size, with and without memory
constexpr double kTruth = 1e-10;  // of the pair's size, against brute force: a needle's slopes round

ConvexPart anyPart(Random& random) {
  switch (random.integer(-2, 6)) {
    case -2:
    case -1:
    case 0:
      return {boxPolyhedron(Vec3::Ones()), 0.0};
    case 1:
      return {boxPolyhedron(Vec3(1.0, 0.5, 0.25) * random.integer(1, 2)), 0.0};
    case 2:
      return {boxPolyhedron(Vec3(1.0, random.logUniform(1e-3, 1.0), random.logUniform(1e-3, 0.1))), 0.0};
    case 3:
      return {oracle::randomHull(random, random.integer(4, 20)), 0.0};
    case 4:
      return {oracle::prism(random.integer(3, 9), 0.5, random.uniform(0.1, 1.5)), 0.0};
    case 5:
      return {ConvexPolyhedron::point(Vec3::Zero()), random.uniform(0.1, 0.6)};
    default:
      return {ConvexPolyhedron::segment({0, 0, -0.4}, {0, 0, 0.4}), random.uniform(0.05, 0.4)};
  }
}

double reachOf(const ConvexPart& part) {
  return part.core.radiusAbout(Vec3::Zero()) + part.radius_m;
}

Pose latticePose(Random& random) {
  Pose X;
  for (int i = 0; i < 3; ++i) X.position[i] = 0.125 * random.integer(-10, 10);
  // The quarter and half turns have exact quaternions but for those about two axes.
  constexpr double kHalf = std::numbers::sqrt2 / 2;
  static const Quat kTurns[] = {Quat(1, 0, 0, 0),         Quat(0, 1, 0, 0),         Quat(0, 0, 1, 0),
                                Quat(0, 0, 0, 1),         Quat(kHalf, kHalf, 0, 0), Quat(kHalf, 0, kHalf, 0),
                                Quat(kHalf, 0, 0, kHalf), Quat(0.5, 0.5, 0.5, 0.5)};
  X.rotation = kTurns[random.integer(0, 7)];
  return X;
}

std::string shownAnswer(const ClosestFeatures& answer) {
  std::ostringstream out;
  out.precision(17);
  out << (answer.status == Separation::kSeparated  ? "separated"
          : answer.status == Separation::kTouching ? "touching"
                                                   : "penetrating")
      << ' ' << answer.distance_m;
  return out.str();
}

}  // namespace

QuerySequence randomQueries(std::uint64_t seed) {
  Random random(seed * 0x9e3779b97f4a7c15ull + 1);
  QuerySequence sequence;
  sequence.a = anyPart(random);
  sequence.b = anyPart(random);
  const double reach = reachOf(sequence.a) + reachOf(sequence.b);
  const int manner = random.integer(0, 3);  // all kinds of moves, or one alone
  Pose X = latticePose(random);
  Vec3 drift = Vec3::Zero(), turn = Vec3::Zero();
  for (int i = 0; i < kQueries; ++i) {
    const int move = manner == 0 ? random.integer(0, 9) : manner == 1 ? 0 : manner == 2 ? 3 : 6;
    if (move <= 2) {
      X = latticePose(random);
    } else if (move <= 5) {
      X.rotation = random.rotation();
      const Vec3 away = random.direction();
      X.position = random.uniform(0.0, 1.5) * reach * away;
    } else if (move <= 8 || sequence.X_AB.empty()) {
      if (i % 20 == 0) {
        const double pace = random.logUniform(1e-6, 0.1);
        drift = pace * reach * random.direction();
        turn = pace * random.direction();
        if (manner == 3) {
          const Vec3 away = random.direction();
          X.position = random.uniform(0.3, 1.0) * reach * away;
          X.rotation = random.rotation();
        }
      }
      X.position += drift;
      X.rotation = (Quat(Eigen::AngleAxisd(turn.norm(), turn.normalized())) * X.rotation).normalized();
    } else {
      X = sequence.X_AB[static_cast<std::size_t>(random.integer(0, i - 1))];
    }
    sequence.X_AB.push_back(X);
  }
  return sequence;
}

ClosestFeatures askEngine(const ConvexPart& a, const ConvexPart& b, const Pose& X_AB, PairMemory& memory) {
  return closestFeatures(a, Pose{}, b, X_AB, memory);
}

TrialOutcome tryQueries(const QuerySequence& sequence, const Query& query) {
  TrialOutcome outcome;
  Findings findings;
  const double reach = reachOf(sequence.a) + reachOf(sequence.b);
  PairMemory memory;
  int step = 0;
  try {
    for (const Pose& X : sequence.X_AB) {
      ++step;
      ++outcome.totals.queries;
      const double size = reach + X.position.norm();
      const ClosestFeatures warm = query(sequence.a, sequence.b, X, memory);
      PairMemory fresh;
      const ClosestFeatures cold = query(sequence.a, sequence.b, X, fresh);
      const std::string both = "with memory " + shownAnswer(warm) + ", without " + shownAnswer(cold);
      const bool finite = std::isfinite(warm.distance_m) && warm.n_W.allFinite() && warm.p_A_W.allFinite() &&
                          warm.p_B_W.allFinite();
      if (!finite) {
        findings.add("query-nan", 1.0, step, both);
        continue;
      }
      const double off = std::abs(warm.distance_m - cold.distance_m) / size;
      if (!(off <= kSame)) findings.add("query-memory", off, step, both);
      if (warm.status != cold.status) findings.add("query-status", std::max(off, 1e-300), step, both);
      if (step % kBruteForceEvery != 0) continue;
      const auto truth = static_cast<double>(
          oracle::signedGap(oracle::place(sequence.a, Pose{}), oracle::place(sequence.b, X)));
      // Two flat cores that meet have no depth that the oracle knows.
      const bool flat = sequence.a.core.faceCount() == 0 && sequence.b.core.faceCount() == 0;
      const double wrong = std::abs(cold.distance_m - truth) / size;
      if (!flat && !(wrong <= kTruth))
        findings.add("query-truth", wrong, step, shownAnswer(cold) + ", brute force " + shown(truth));
    }
  } catch (const ContractViolation& violation) {
    findings.add("abort", 1.0, step, violation.what());
  }
  outcome.findings = findings.list();
  return outcome;
}

QuerySequence shrunkQueries(QuerySequence sequence, const std::string& kind, const Query& query) {
  const auto fails = [&](const QuerySequence& s) {
    for (const Finding& f : tryQueries(s, query).findings)
      if (f.kind == kind) return true;
    return false;
  };
  for (std::size_t chunk = sequence.X_AB.size() / 2; chunk > 0; chunk /= 2)
    for (std::size_t at = 0; at + chunk <= sequence.X_AB.size();) {
      QuerySequence less = sequence;
      const auto begin = less.X_AB.begin() + static_cast<std::ptrdiff_t>(at);
      less.X_AB.erase(begin, begin + static_cast<std::ptrdiff_t>(chunk));
      if (fails(less))
        sequence = std::move(less);
      else
        at += chunk;
    }
  return sequence;
}

std::string queryText(const QuerySequence& sequence) {
  std::ostringstream out;
  out.precision(17);
  for (const ConvexPart* part : {&sequence.a, &sequence.b}) {
    out << "part radius " << part->radius_m << " corners";
    for (const Vec3& v : part->core.vertices()) out << "  " << v.x() << ' ' << v.y() << ' ' << v.z();
    out << '\n';
  }
  for (const Pose& X : sequence.X_AB)
    out << "pose of b  position " << X.position.x() << ' ' << X.position.y() << ' ' << X.position.z()
        << "  rotation " << X.rotation.w() << ' ' << X.rotation.x() << ' ' << X.rotation.y() << ' '
        << X.rotation.z() << '\n';
  return out.str();
}

}  // namespace carom::explore
