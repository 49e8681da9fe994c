#include "demos/formula/caption_text.h"

#include <gtest/gtest.h>

#include "engine/foundation/contract.h"
#include "tests/support/thrown_message.h"

namespace carom::demos {
namespace {

const CaptionFacts kFacts{
    [](const std::string& name) { return name == "time" ? 1.5 : 20.0; },
    [](const BodyQuantity& of) { return of.body == "crate" && of.quantity == "x" ? -2.25 : 7.0; }};

std::string lineOf(const std::string& text, const std::map<std::string, double>& variables = {}) {
  return captionLine(readCaption(text, variables), kFacts);
}

TEST(CaptionText, ReckonsWhatStandsInBraces) {
  EXPECT_EQ(
      lineOf("v²/2μg = {=v^2/(2*mu*g)} m, measured {body:crate.x} m", {{"v", 3.0}, {"mu", 0.5}, {"g", 9.0}}),
      "v²/2μg = 1.00 m, measured -2.25 m");
  EXPECT_EQ(lineOf("{=1/3:4}{=2/3:0}"), "0.33331");
  EXPECT_EQ(lineOf("t = {=time:1} s, {=energy*2:0} J"), "t = 1.5 s, 40 J");
  EXPECT_EQ(lineOf("no figure"), "no figure");
}

TEST(CaptionText, ReckonsWithBodiesWhoseNamesHaveBracketsAndDots) {
  EXPECT_EQ(lineOf("{=[crate.x]-[row[1].vx]} and {body:left.row[2].speed:0}"), "-9.25 and 7");
}

TEST(CaptionText, TheTimeAndTheEnergiesAreNoVariablesOfAScene) {
  for (const std::string name : {"time", "energy", "kinetic"}) {
    const std::map<std::string, double> set{{name, 5.0}};
    EXPECT_EQ(
        thrownMessage<InputError>([&] { readCaption("t = {=1+" + name + "}", set); }),
        "\"" + name +
            "\" is a variable of the scene and the caption's own figure; accepted: a variable of another "
            "name");
    EXPECT_EQ(lineOf("the " + name + " is {=2*g}", {{name, 5.0}, {"g", 2.0}}), "the " + name + " is 4.00");
  }
}

TEST(CaptionText, ShowsADashForWhatIsNotFiniteInAFrame) {
  EXPECT_EQ(lineOf("{=1/(time-1.5)} s"), "– s");
}

TEST(CaptionText, ShowsNoMinusBeforeNothing) {
  EXPECT_EQ(lineOf("{=-0.001}"), "0.00");
}

TEST(CaptionText, RefusesWhatItCannotReckonAndSaysWhatIsAccepted) {
  const auto refusal = [](const std::string& text) {
    return thrownMessage<InputError>([&] { readCaption(text, {{"mass", 1.0}}); });
  };
  EXPECT_NE(refusal("{=mas}").find("mass"), std::string::npos) << "the nearest name";
  EXPECT_NE(refusal("{=1").find("\"}\" is missing"), std::string::npos);
  EXPECT_NE(refusal("{x}").find("accepted: \"{=arithmetic}\""), std::string::npos);
  EXPECT_NE(refusal("{body:crate.sped}").find("speed"), std::string::npos) << "the nearest quantity";
  EXPECT_NE(refusal("{body:crate}").find("no NAME.quantity"), std::string::npos);
  EXPECT_NE(refusal("{=[crate.x}").find("\"]\" is missing"), std::string::npos);
  EXPECT_NE(refusal("two\nlines").find("one line"), std::string::npos);
  EXPECT_NE(refusal(std::string(401, 'x')).find("at most 400"), std::string::npos);
}

}  // namespace
}  // namespace carom::demos
