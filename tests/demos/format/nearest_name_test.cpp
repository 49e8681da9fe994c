#include "demos/format/nearest_name.h"

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

TEST(NearestName, OfManyCandidatesOnlySomeAreListed) {
  std::vector<std::string> names;
  for (int i = 0; i < 200000; ++i) names.push_back(std::string("n").append(std::to_string(i)));
  const std::string text = acceptedNames("m12045", names);
  EXPECT_EQ(text.rfind("; did you mean \"n12045\"? accepted: n0, n1, ", 0), 0u) << text;
  EXPECT_NE(text.find(" and 199940 more"), std::string::npos) << text;
  EXPECT_LT(text.size(), 1000u);
}

// The table of distances of two names this long would have 10^12 entries.
TEST(NearestName, ANameOfAMillionLettersIsNoSlip) {
  const std::vector<std::string> names{std::string(1000000, 'a')};
  EXPECT_EQ(nearestName(std::string(1000001, 'a'), names), "");
  EXPECT_EQ(nearestName("a", names), "");
}

}  // namespace
}  // namespace carom::demos
