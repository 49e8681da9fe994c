// A few hundred of the trials that `stress tunnelling` runs by the hundred thousand.

#include "tests/bench/stress/tunnelling_trials.h"

#include <gtest/gtest.h>

#include <cctype>
#include <string>

namespace carom::bench {
namespace {

class Trials : public testing::TestWithParam<Shot> {};

TEST_P(Trials, NoneOfEightyTunnelsOrOverlapsAndAllMeet) {
  for (std::uint64_t seed = 1; seed <= 80; ++seed) {
    const ShotResult result = TunnellingTrial(GetParam(), seed).run();
    SCOPED_TRACE(testing::Message() << "seed " << seed << " speed " << result.speed << " rate "
                                    << result.rate_hz);
    EXPECT_FALSE(result.tunnelled);
    EXPECT_TRUE(result.met);
    EXPECT_GT(result.smallest_gap_m, 0.0);
  }
}

INSTANTIATE_TEST_SUITE_P(Shots, Trials,
                         testing::Values(Shot::kStaticWall, Shot::kMovingWall, Shot::kHeadOnSquare,
                                         Shot::kHeadOnAskew, Shot::kRodAtPost, Shot::kRodInCage),
                         [](const auto& shot) {
                           std::string name;
                           for (const char c : std::string(kShotNames[static_cast<std::size_t>(shot.param)]))
                             if (std::isalpha(static_cast<unsigned char>(c)) != 0) name += c;
                           return name;
                         });

}  // namespace
}  // namespace carom::bench
