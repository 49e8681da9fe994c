#include "demos/against/against_result.h"

#include <array>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "demos/against/paced_frames.h"
#include "engine/foundation/contract.h"

namespace carom::demos {
namespace {

/// Rounds of 20 frames, 1 ms a phase, each time with noise that only adds; `slow` is a phase's factor now.
std::vector<AgainstRound> played(unsigned seed, double slow = 1.0, FramePhase phase = FramePhase::kDraw,
                                 double bias = 0.0) {
  std::mt19937 random(seed);
  const auto noise = [&] { return 1.0 + 0.3 * std::pow(static_cast<double>(random() % 1000) / 1000.0, 4.0); };
  std::vector<AgainstRound> all(kFewestRounds);
  for (AgainstRound& round : all) {
    // Of each process and phase.
    std::array<std::array<double, kFramePhases>, 2> lie;
    for (auto& process : lie)
      for (double& factor : process) factor = 1.0 + bias * static_cast<double>(random() % 1000) / 1000.0;
    for (int i = 0; i < 20; ++i)
      for (std::vector<FrameCost>* side : {&round.now, &round.other}) {
        FrameCost cost;
        cost.state_hash = static_cast<std::uint64_t>(i);
        for (std::size_t p = 0; p < kFramePhases; ++p) {
          cost.phase_ms[p] = noise() * lie[side == &round.now ? 0 : 1][p];
          if (side == &round.now && p == static_cast<std::size_t>(phase)) cost.phase_ms[p] *= slow;
          cost.total_ms += cost.phase_ms[p];
        }
        side->push_back(cost);
      }
  }
  return all;
}

AgainstResult result(const std::vector<AgainstRound>& rounds) {
  return judgedAgainst(rounds, "old/carom", "wall");
}

TEST(Against, AThousandPairsOfTheSameProgramAreNeverSlowerNorFaster) {
  for (unsigned seed = 0; seed < 1000; ++seed) {
    const AgainstResult r = result(played(seed));
    EXPECT_EQ(r.frame.speed, Speed::kSame) << seed;
    for (const SpeedChange& phase : r.phases) EXPECT_EQ(phase.speed, Speed::kSame) << seed << phase.name;
  }
}

// Some processes come to lie badly in memory and are slower in every frame of their round: of five rounds all
// were so for one in sixteen phases.
TEST(Against, AThousandPairsOfTheSameProgramInProcessesOfUnevenLuckAreNeverSlowerNorFaster) {
  for (unsigned seed = 0; seed < 1000; ++seed) {
    const AgainstResult r = result(played(seed, 1.0, FramePhase::kDraw, 0.05));
    EXPECT_EQ(r.frame.speed, Speed::kSame) << seed;
    for (const SpeedChange& phase : r.phases) EXPECT_EQ(phase.speed, Speed::kSame) << seed << phase.name;
  }
}

TEST(Against, APhaseThatTakesLongerIsNamedAndNoOther) {
  for (unsigned seed = 0; seed < 50; ++seed)
    for (const FramePhase slow : {FramePhase::kImpulses, FramePhase::kEncode}) {
      const AgainstResult r = result(played(seed, 1.1, slow));
      for (std::size_t p = 0; p < kFramePhases; ++p)
        EXPECT_EQ(r.phases[p].speed, p == static_cast<std::size_t>(slow) ? Speed::kSlower : Speed::kSame)
            << seed << r.phases[p].name;
    }
  EXPECT_EQ(result(played(1, 0.8)).phases[static_cast<std::size_t>(FramePhase::kDraw)].speed, Speed::kFaster);
}

// A frame that follows one of the same program finds its data in the cache: in A B, B A that is the first of
// each.
TEST(Against, WhoFindsItsDataInTheCacheDoesNotHideWhatIsSlower) {
  std::vector<AgainstRound> rounds = played(5, 1.03, FramePhase::kEncode);
  for (std::size_t r = 0; r < rounds.size(); ++r)
    for (std::size_t i = 0; i < rounds[r].now.size(); ++i) {
      FrameCost& first = (i + r) % 2 == 0 ? rounds[r].now[i] : rounds[r].other[i];
      for (double& phase_ms : first.phase_ms) phase_ms *= 0.8;
      first.total_ms *= 0.8;
    }
  const AgainstResult r = result(rounds);
  for (std::size_t p = 0; p < kFramePhases; ++p)
    EXPECT_EQ(r.phases[p].speed,
              p == static_cast<std::size_t>(FramePhase::kEncode) ? Speed::kSlower : Speed::kSame)
        << r.phases[p].name << " " << r.phases[p].change << " " << r.phases[p].smallest;
}

// Ten frames take less and ten more to pack than the middle one, and now all take 3 % more, but for one that
// has next to nothing to pack: the middle of them all is then another frame's, and takes as long as the one
// before.
TEST(Against, HowMuchOfAFrameAPhaseTakesIsAskedOfPairs) {
  constexpr auto kEncode = static_cast<std::size_t>(FramePhase::kEncode);
  std::vector<AgainstRound> rounds(kFewestRounds);
  for (AgainstRound& round : rounds)
    for (int i = 0; i < 20; ++i)
      for (std::vector<FrameCost>* side : {&round.now, &round.other}) {
        FrameCost cost;
        cost.phase_ms[kEncode] = 0.5 + 0.025 * i;
        if (side == &round.now) cost.phase_ms[kEncode] *= i == 10 ? 0.3 : 1.03;
        cost.total_ms = 10.0 + cost.phase_ms[kEncode];
        side->push_back(cost);
      }
  EXPECT_EQ(result(rounds).phases[kEncode].speed, Speed::kSlower);
}

TEST(Against, OfTheFewestRoundsAllMustAgree) {
  std::vector<AgainstRound> rounds = played(3);
  for (std::size_t r = 1; r < rounds.size(); ++r)
    for (FrameCost& f : rounds[r].now) f.total_ms *= 3.0;
  for (FrameCost& f : rounds[0].now) f.total_ms *= 0.5;
  EXPECT_EQ(result(rounds).frame.speed, Speed::kSame);
}

TEST(Against, OtherStatesAndOtherWorkAreSaid) {
  std::vector<AgainstRound> rounds = played(1);
  for (AgainstRound& round : rounds) {
    round.now[7].state_hash = 99;
    round.now[7].worked(Work::kQueries) = 3;
  }
  const std::vector<std::string> lines = againstLines(result(rounds));
  EXPECT_EQ(lines[1], "states differ from frame 7 on: the two do not simulate the same motion");
  EXPECT_EQ(lines[2], "other work: queries 3, of the other 0");
  EXPECT_EQ(againstLines(result(played(1)))[1], "states equal in every frame");
}

TEST(PacedLine, ComesBackAndAnotherIsRefused) {
  FrameCost cost;
  cost.state_hash = 0xfedcba9876543210u;
  cost.total_ms = 1.25;
  cost.phase_ms[3] = 0.5;
  cost.worked(Work::kBytes) = 12345;
  const FrameCost back = readPacedLine(pacedLine(cost), "x");
  EXPECT_EQ(back.state_hash, cost.state_hash);
  EXPECT_EQ(back.total_ms, cost.total_ms);
  EXPECT_EQ(back.phase_ms, cost.phase_ms);
  EXPECT_EQ(back.work, cost.work);
  EXPECT_THROW(readPacedLine("hello", "x"), InputError);
  EXPECT_THROW(readPacedLine("1 2 0 0 0 0 0 0 0 0 0", "x"), InputError);
}

TEST(PacedLine, OfAProgramThatCountsOtherKindsIsReadAndWhatBothCountIsCompared) {
  const FrameCost older = readPacedLine("1 2 0 0 0 0 0 0 0 0 0 0 steps=4,queries=7,unheard of=3", "x");
  EXPECT_EQ(older.work[static_cast<std::size_t>(Work::kSteps)], 4);
  EXPECT_EQ(older.work[static_cast<std::size_t>(Work::kQueries)], 7);
  EXPECT_EQ(older.work[static_cast<std::size_t>(Work::kRowVisits)], kNotCounted);
  std::vector<AgainstRound> rounds = played(1);
  for (AgainstRound& round : rounds)
    for (FrameCost& f : round.other) f.worked(Work::kRowVisits) = kNotCounted;
  EXPECT_EQ(againstLines(result(rounds))[1], "states equal in every frame");
  EXPECT_EQ(againstLines(result(rounds)).size(), againstLines(result(played(1))).size());
}

}  // namespace
}  // namespace carom::demos
