#include "demos/format/json.h"

#include <chrono>

#include <gtest/gtest.h>

#include "engine/foundation/contract.h"
#include "tests/support/thrown_message.h"

namespace carom::demos {
namespace {

std::string refusal(const std::string& text) {
  return thrownMessage<InputError>([&text] { Json::parse(text, "f.json"); });
}

TEST(Json, ReadsCommentsAndRemembersLinesAndPaths) {
  const Json json = Json::parse(
      "// head\n{ \"a\": 1, /* two\nlines */ \"b\": [\n  true,\n  { \"c\": 2.5 }\n] }\n", "f.json");
  EXPECT_EQ(json.line(), 2);
  EXPECT_EQ(json.at("a").line(), 2);
  EXPECT_EQ(json.at("b").line(), 3);
  EXPECT_EQ(json.at("b").items()[0].line(), 4);
  const Json& deep = json.at("b").items()[1].at("c");
  EXPECT_EQ(deep.line(), 5);
  EXPECT_EQ(deep.path(), "b[1].c");
  EXPECT_EQ(deep.asNumber(), 2.5);
}

TEST(Json, CountsTheLineOfANumberThatEndsItsLine) {
  const Json json = Json::parse("[1\n,2\n,\n3]", "f.json");
  EXPECT_EQ(json.items()[0].line(), 1);
  EXPECT_EQ(json.items()[1].line(), 2);
  EXPECT_EQ(json.items()[2].line(), 4);
}

TEST(Json, RefusesInOneLineWithFileAndLine) {
  EXPECT_EQ(refusal("{\n \"a\": 1,\n \"a\": 2 }"), "f.json:3: key \"a\" is given twice");
  for (const char* text : {"", "{", "[1,]", "{\"a\": NaN}", "[1e999]", "{} {}", "\"\\x\""}) {
    const std::string message = refusal(text);
    EXPECT_EQ(message.rfind("f.json:1: ", 0), 0u) << text << " -> " << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

TEST(Json, RefusesNestingThatWouldExhaustTheStack) {
  EXPECT_NE(refusal(std::string(100000, '[')).find("nested deeper"), std::string::npos);
}

std::string manyNames(int count) {
  std::string text = "{";
  for (int i = 0; i < count; ++i) text += (i > 0 ? ",\"n" : "\"n") + std::to_string(i) + "\":0";
  return text + "}";
}

// Each name was compared with all before it: 2 x 10^10 comparisons.
TEST(Json, TwoHundredThousandNamesTakeNoMinute) {
  const auto began = std::chrono::steady_clock::now();
  const Json json = Json::parse(manyNames(200000), "f.json");
  EXPECT_EQ(json.members().size(), 200000u);
  EXPECT_NE(thrownMessage<InputError>([&] { json.onlyKeys({"n7"}); }).find("unknown key \"n0\""),
            std::string::npos);
  EXPECT_EQ(thrownMessage<InputError>([&] { json.asNumber(); }).rfind("f.json:1:1: {\"n0\":0,\"n1\":0", 0),
            0u);
  EXPECT_LT(std::chrono::steady_clock::now() - began, std::chrono::seconds(10));
}

// What quotes it would end there.
TEST(Json, RefusesTextThatHoldsAZero) {
  EXPECT_EQ(refusal("[\"a\\u0000b\"]"), "f.json:1: a string holds \\u0000; accepted: text without it");
  EXPECT_EQ(refusal("{\"\\u0000\": 1}"), "f.json:1: a string holds \\u0000; accepted: text without it");
}

TEST(Json, ANameGivenTwiceIsFoundAmongMany) {
  std::string text = manyNames(50000);
  text.back() = ',';
  EXPECT_NE(refusal(text + "\"n31\":1}").find("key \"n31\" is given twice"), std::string::npos);
}

TEST(Json, MoreValuesThanFitInMemoryAreRefused) {
  std::string text = "[";
  for (int i = 0; i < 3000001; ++i) text += "0,";
  EXPECT_NE(refusal(text + "0]").find("more than 3000000 values"), std::string::npos);
}

TEST(Json, ComplainsWithPlaceAboutAValueOfAnotherKind) {
  const Json json = Json::parse("{\"a\":\n [\"x\"]}", "f.json");
  EXPECT_EQ(thrownMessage<InputError>([&] { json.at("a").items()[0].asNumber(); }),
            "f.json:2:3: a[0]: \"x\" is a string; accepted: a finite number");
  EXPECT_EQ(thrownMessage<InputError>([&] { json.at("b"); }), "f.json:1:1: key \"b\" is missing");
  EXPECT_EQ(thrownMessage<InputError>([&] {
              json.onlyKeys({"b", "position"});
            }),
            "f.json:2:2: a: unknown key \"a\"; did you mean \"b\"? accepted: b, position");
}

TEST(Json, NumbersSurviveTheRoundTripBitForBit) {
  for (const double number : {0.1, 1.0 / 3.0, -2.5e-300, 1e22, 123456789.0, 5e-324}) {
    const Json written = Json::object({{"n", number}, {"s", "tab\t\"quote\""}});
    const Json read = Json::parse(written.text(), "f.json");
    EXPECT_EQ(read.at("n").asNumber(), number);
    EXPECT_EQ(read.at("s").asString(), "tab\t\"quote\"");
  }
}

}  // namespace
}  // namespace carom::demos
