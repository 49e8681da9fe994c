#include "demos/nearest_name.h"

#include <vector>

#include <gtest/gtest.h>

namespace carom::demos {
namespace {

const std::vector<std::string> kScenes = {"sliding", "resting", "multi-contact", "bouncing-ball"};

TEST(NearestName, CountsInsertionsDeletionsSubstitutionsAndSwaps) {
  EXPECT_EQ(editDistance("", "box"), 3);
  EXPECT_EQ(editDistance("kitten", "sitting"), 3);  // the textbook pair
  EXPECT_EQ(editDistance("form", "from"), 1);       // one swap, not two substitutions
  EXPECT_EQ(editDistance("Box", "box"), 0);
  EXPECT_EQ(editDistance("sliding", "sldiing"), editDistance("sldiing", "sliding"));
}

TEST(NearestName, FindsTheOneThatWasMeant) {
  EXPECT_EQ(nearestName("slidng", kScenes), "sliding");
  EXPECT_EQ(nearestName("multicontact", kScenes), "multi-contact");
}

TEST(NearestName, SaysNothingWhenNoneIsNear) {
  EXPECT_EQ(nearestName("waterfall", kScenes), "");
  EXPECT_EQ(acceptedNames("waterfall", kScenes),
            "; accepted: sliding, resting, multi-contact, bouncing-ball");
  EXPECT_EQ(acceptedNames("restin", kScenes),
            "; did you mean \"resting\"? accepted: sliding, resting, multi-contact, bouncing-ball");
}

}  // namespace
}  // namespace carom::demos
