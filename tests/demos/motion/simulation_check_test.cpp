#include "demos/motion/simulation_check.h"

#include <gtest/gtest.h>

#include "demos/system/exit_code.h"
#include "tests/support/thrown_message.h"

namespace carom::demos {
namespace {

TEST(SimulationCheck, KeepsTheSmallestGapAndRefusesAClosedOne) {
  World world{WorldSettings()};
  EXPECT_TRUE(world.start().empty());
  RunFacts facts;
  Audit audit;
  for (const double gap : {0.5, 0.001, 0.2}) {
    audit.smallest_gap_m = gap;
    checkStep(world, audit, {}, facts);
  }
  EXPECT_EQ(facts.smallest_gap_m, 0.001);
  audit.smallest_gap_m = 0.0;
  EXPECT_EQ(thrownMessage<SimulationInvalid>([&] { checkStep(world, audit, {}, facts); }),
            "the simulation is invalid after step 0 (0 s): the smallest gap is 0 m; it must stay above 0");
}

}  // namespace
}  // namespace carom::demos
