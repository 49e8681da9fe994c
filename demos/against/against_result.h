#pragma once
// Two programs that took turns frame by frame: whether this one is slower or faster than the other, in which
// phase, and the smallest difference that would have been seen. A verdict takes three things: an exact sign
// test over all turns and their reverse (A B, B A), an exact signed-rank test over the rounds of fresh
// processes, and a size above what the layout of memory alone is known to do. Frames of a round share two
// processes, and where their data come to lie, and on which processor each runs, makes one of them slower by
// a few percent throughout: so the median of a round is one difference more, and the number of rounds decides
// what can be told.
// Tested in tests/demos/against/against_result_test.cpp.

#include <string>
#include <vector>

#include "demos/against/sign_test.h"
#include "demos/against/signed_rank.h"
#include "demos/format/json.h"
#include "demos/motion/frame_cost.h"

namespace carom::demos {

/// A false "slower" comes once in a million.
inline constexpr double kFalseAlarm = 1e-6;
/// The fewest rounds that can tell at that chance: 2^-20 is the first below it.
inline constexpr int kFewestRounds = 21;
/// Differences below this share of the phase's time are told, but no verdict: where a page of memory comes to
/// lie makes as much.
inline constexpr double kLeastEffect = 0.005;
/// Nor is a phase named for less than this share of a frame.
inline constexpr double kLeastOfFrame = 0.001;

/// One round: fresh processes of both, the same frames in turns.
struct AgainstRound {
  std::vector<FrameCost> now, other;
};

enum class Speed { kSame, kSlower, kFaster };
const char* nameOf(Speed speed);

struct SpeedChange {
  std::string name;     ///< A phase's, or "frame".
  double now_ms = 0.0;  ///< Medians over all frames of all rounds.
  double other_ms = 0.0;
  double change = 0.0;    ///< Of a frame's time, the median of the pairs: 0.02 is 2 % slower.
  double smallest = 0.0;  ///< The smallest change that would have been found.
  double log_chance = 0.0;
  int rounds_slower = 0;  ///< Rounds whose median pair is slower.
  Speed speed = Speed::kSame;
};

struct AgainstResult {
  std::string other;  ///< The other program, as it was given.
  std::string clock;
  int rounds = 0;
  int frames = 0;  ///< A round.
  SpeedChange frame;
  std::vector<SpeedChange> phases;
  int first_other_state = -1;     ///< The first frame whose states differ; -1: none does.
  std::vector<std::string> work;  ///< Kinds of work that differ, in words.
};

/// There must be a round, and each must have as many frames of both.
AgainstResult judgedAgainst(const std::vector<AgainstRound>& rounds, const std::string& other,
                            const std::string& clock);

/// "slower: frame by 2.1 % (p 1e-14)...", a line each; the last is the verdict.
std::vector<std::string> againstLines(const AgainstResult& result);
Json againstJson(const AgainstResult& result);

}  // namespace carom::demos
