// What the list of known failures covers, and what it does not.

#include "tests/explore/open_failures.h"

#include <gtest/gtest.h>

#include "engine/foundation/contract.h"

namespace carom::explore {
namespace {

TEST(OpenFailures, CoverTheirKindAndFamilyUpToTheirFigure) {
  const std::vector<OpenFailure> open = parseOpenFailures(
      "# all of it\nenergy thin 2.5 # impacts of one step act one by one\n\nflight * 1e-5 # second order\n",
      "open.txt");
  ASSERT_EQ(open.size(), 2u);
  EXPECT_EQ(open[0].cause, "impacts of one step act one by one");
  EXPECT_TRUE(open[0].covers("energy", "thin", 2.5));
  EXPECT_FALSE(open[0].covers("energy", "thin", 2.6));
  EXPECT_FALSE(open[0].covers("energy", "stack", 0.1));
  EXPECT_FALSE(open[0].covers("frozen", "thin", 0.1));
  EXPECT_TRUE(open[1].covers("flight", "closed", 1e-6));
}

TEST(OpenFailures, RefuseALineWithoutACause) {
  for (const char* line :
       {"energy thin 2.5", "energy thin # cause", "energy thin 2.5 #", "energy thin 2.5 cause"})
    EXPECT_THROW(parseOpenFailures(line, "open.txt"), InputError) << line;
}

TEST(OpenFailures, OfTheTreeAreReadable) {
  EXPECT_NO_THROW(readOpenFailures(CAROM_SOURCE_DIR "/tests/explore/open.txt"));
}

}  // namespace
}  // namespace carom::explore
