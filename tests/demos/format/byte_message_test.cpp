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

TEST(LittleEndianWord, BeginsWithTheLeastByte) {
  const unsigned char bytes[] = {0x01, 0x02, 0xff, 0x04, 0, 0, 0, 0x80};
  EXPECT_EQ(littleEndianWord(bytes, 0), 0u);
  EXPECT_EQ(littleEndianWord(bytes, 2), 0x0201u);
  EXPECT_EQ(littleEndianWord(bytes, 4), 0x04ff0201u);
  EXPECT_EQ(littleEndianWord(bytes, 8), 0x8000000004ff0201u);
}

}  // namespace
}  // namespace carom::demos
