// Each place is visited once, in the order that was given, however large the elements and however few.

#include "engine/foundation/visit.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace carom {
namespace {

TEST(Visit, LooksAtThePlacesThatAreGiven_InTheirOrder) {
  struct Wide {
    int value = 0;
    std::array<char, 1000> rest{};
  };
  std::vector<Wide> all(50);
  for (std::size_t i = 0; i < all.size(); ++i) all[i].value = static_cast<int>(i);
  for (const int count : {0, 1, 5, 6, 7, 40}) {
    std::vector<int> places, seen;
    for (int i = 0; i < count; ++i) places.push_back(i * 37 % 50);
    visit(std::span(all), places, [&](std::size_t i, const Wide& wide) {
      EXPECT_EQ(i, seen.size());
      seen.push_back(wide.value);
    });
    EXPECT_EQ(seen, places);
  }
}

}  // namespace
}  // namespace carom
