// REQUIRE passes what holds and prints what does not.

#include "engine/foundation/contract.h"

#include <gtest/gtest.h>

#include "tests/support/thrown_message.h"

namespace carom {
namespace {

TEST(Require, LetsATrueConditionPass) {
  EXPECT_NO_THROW(REQUIRE(1 + 1 == 2));
  EXPECT_NO_THROW(REQUIRE(1 + 1 == 2, 1, 2));
}

TEST(Require, NamesTheConditionThePlaceAndTheValues) {
  const double gap_m = -0.25;
  const int body = 7;
  const std::string message = thrownMessage<ContractViolation>([&] { REQUIRE(gap_m > 0.0, gap_m, body); });
  EXPECT_NE(message.find("gap_m > 0.0"), std::string::npos) << message;
  EXPECT_NE(message.find("contract_test.cpp:"), std::string::npos) << message;
  EXPECT_NE(message.find("-0.25 7"), std::string::npos) << message;
  EXPECT_EQ(message.find('\n'), std::string::npos) << "one line: " << message;
}

TEST(Require, IsAStatementThatAnElseMayFollow) {
  bool reached_else = false;
  if (false)
    REQUIRE(false);
  else
    reached_else = true;
  EXPECT_TRUE(reached_else);
}

TEST(PrintValues, ShowsADoubleToTheLastBit) {
  EXPECT_EQ(printValues(0.1 + 0.2), " 0.30000000000000004");
}

TEST(InputError, IsNotAContractViolation) {
  EXPECT_THROW(throw InputError("mass 0: want a positive number"), std::runtime_error);
  static_assert(!std::is_base_of_v<std::logic_error, InputError>);
}

}  // namespace
}  // namespace carom
