// Whole numbers and columns come back as they were, and small numbers take few bytes.
#include "demos/page/byte_stream.h"

#include <gtest/gtest.h>

#include "tests/demos/support/whole_reader.h"

namespace carom::demos {
namespace {

TEST(ByteStream, GivesNumbersBackUpToTheLargest) {
  const std::vector<std::int64_t> numbers = {0,
                                             1,
                                             -1,
                                             63,
                                             -63,
                                             64,
                                             -64,
                                             65,
                                             8191,
                                             -8192,
                                             std::int64_t{1} << 40,
                                             -(std::int64_t{1} << 40),
                                             kMostWhole,
                                             -kMostWhole};
  ByteStream stream;
  for (const std::int64_t number : numbers) stream.add(number);
  WholeReader reader(stream.bytes());
  for (const std::int64_t number : numbers) EXPECT_EQ(reader.whole(), number);
  EXPECT_TRUE(reader.atEnd());
}

TEST(ByteStream, LimitsWhatJavaScriptCannotHold) {
  ByteStream stream;
  stream.add(INT64_MAX);
  stream.add(INT64_MIN + 1);
  WholeReader reader(stream.bytes());
  EXPECT_EQ(reader.whole(), kMostWhole);
  EXPECT_EQ(reader.whole(), -kMostWhole);
}

TEST(ByteStream, AColumnAtConstantSpeedTakesAByteANumber) {
  std::vector<std::int64_t> column;
  for (int i = 0; i < 100; ++i) column.push_back(123456 - 7890 * i);
  ByteStream stream;
  stream.addColumn(column);
  EXPECT_LE(stream.bytes().size(), 100u + 5u);
  EXPECT_EQ(WholeReader(stream.bytes()).column(100), column);
}

TEST(ByteStream, LogarithmsAreWithinTheirShare) {
  for (const double value : {1e-9, 0.00123, 1.0, 777.7, 1e12})
    EXPECT_NEAR(std::exp2(static_cast<double>(byLogarithm(value)) / 128.0) / value, 1.0, 3e-3);
  EXPECT_EQ(byLogarithm(0.0), byLogarithm(1e-15));
}

TEST(ByteStream, PacksTheSameBytesToTheSameText) {
  const std::string bytes(100000, 'x');
  EXPECT_EQ(packedBase64(bytes), packedBase64(bytes));
  EXPECT_LT(packedBase64(bytes).size(), 1000u);
  EXPECT_EQ(packedBase64("").substr(0, 2), "eN") << "a zlib stream begins with 78 da";
}

}  // namespace
}  // namespace carom::demos
