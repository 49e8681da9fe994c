#include "demos/format/content_hash.h"

#include <set>
#include <vector>

#include <gtest/gtest.h>

namespace carom::demos {
namespace {

TEST(ContentHash, EveryBitOfAFrameCounts) {
  std::vector<unsigned char> bytes(1003, 0x5a);  // not a multiple of the word
  std::set<std::uint64_t> seen{ContentHash().add(bytes.data(), bytes.size()).value()};
  for (std::size_t i = 0; i < bytes.size(); ++i)
    for (int bit = 0; bit < 8; ++bit) {
      bytes[i] = static_cast<unsigned char>(bytes[i] ^ (1 << bit));
      seen.insert(ContentHash().add(bytes.data(), bytes.size()).value());
      bytes[i] = static_cast<unsigned char>(bytes[i] ^ (1 << bit));
    }
  EXPECT_EQ(seen.size(), 1003u * 8u + 1u);
}

TEST(ContentHash, BlocksDoNotRunTogether) {
  EXPECT_NE(ContentHash().add("ab").add("c").value(), ContentHash().add("a").add("bc").value());
  EXPECT_NE(ContentHash().add(std::string(1, '\0')).value(), ContentHash().add("").value());
}

TEST(ContentHash, StaysTheSameFromRunToRun) {
  EXPECT_EQ(hexText(ContentHash().add("carom").value()), "ec8d6d5c6803f53a");
  EXPECT_EQ(hexText(0x0123456789abcdefull), "0123456789abcdef");
}

}  // namespace
}  // namespace carom::demos
