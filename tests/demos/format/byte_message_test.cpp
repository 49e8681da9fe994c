#include "demos/format/byte_message.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace carom::demos {
namespace {

enum class Fruit : std::uint8_t { kApple, kPear };

TEST(ByteMessage, ValuesComeOutAsTheyWentInToTheBit) {
  const double denormal = std::numeric_limits<double>::denorm_min();
  const std::vector<std::uint8_t> bytes{0, 255, 10};
  MessageWriter message;
  message.put(-3).put(denormal).put(-0.0).put(std::string("a\0b", 3)).put(Fruit::kPear);
  message.put(true).put(std::span<const std::uint8_t>(bytes)).put(std::string());

  MessageReader reader(message.bytes());
  EXPECT_EQ(reader.take<int>(), -3);
  EXPECT_EQ(reader.take<double>(), denormal);
  EXPECT_TRUE(std::signbit(reader.take<double>()));
  EXPECT_EQ(reader.takeText(), std::string("a\0b", 3));
  EXPECT_EQ(reader.take<Fruit>(), Fruit::kPear);
  EXPECT_TRUE(reader.take<bool>());
  EXPECT_EQ(reader.takeBytes(), bytes);
  EXPECT_EQ(reader.takeText(), "");
}

TEST(ByteMessage, TakingMoreThanThereIsIsABug) {
  MessageWriter message;
  message.put(std::size_t{5});  // the length of a text that is not there
  EXPECT_THROW(MessageReader(message.bytes()).takeText(), ContractViolation);
}

}  // namespace
}  // namespace carom::demos
