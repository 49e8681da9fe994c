#include "demos/report/junit.h"

#include <gtest/gtest.h>

namespace carom::demos {
namespace {

Comparison made(const std::string& name, Verdict verdict) {
  Comparison c;
  c.pair = {name, "actual/" + name, "golden/" + name, true, true};
  c.verdict = verdict;
  c.actual_shape = c.golden_shape = renderer::RasterShape{4, 3, 3, 8};
  return c;
}

TEST(Junit, HoldsOneCaseAPairInTheGivenOrder) {
  Comparison broken = made("c.png", Verdict::kUnreadable);
  broken.problem = "cannot decode 'c.png'";
  EXPECT_EQ(
      junitText("golden", {made("a.png", Verdict::kSame), made("b.png", Verdict::kMissing), broken}, {}),
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<testsuites tests=\"3\" failures=\"1\" errors=\"1\">\n"
      "  <testsuite name=\"golden\" tests=\"3\" failures=\"1\" errors=\"1\" skipped=\"0\">\n"
      "    <testcase classname=\"golden\" name=\"a.png\"/>\n"
      "    <testcase classname=\"golden\" name=\"b.png\">\n"
      "      <failure type=\"missing\" message=\"missing  no actual/b.png\"/>\n"
      "    </testcase>\n"
      "    <testcase classname=\"golden\" name=\"c.png\">\n"
      "      <error type=\"unreadable\" message=\"unreadable  cannot decode 'c.png'\"/>\n"
      "    </testcase>\n"
      "  </testsuite>\n"
      "</testsuites>\n");
}

TEST(Junit, NamesThatAreMarkupOrNoTextStayWellFormed) {
  const auto name = [](const std::string& text) {
    const std::string xml = junitText("s", {made(text, Verdict::kSame)}, {});
    const std::size_t from = xml.find("classname=\"s\" name=\"") + 20;
    return xml.substr(from, xml.find("\"/>", from) - from);
  };
  EXPECT_EQ(name("a<b>&\"c\".png"), "a&lt;b>&amp;&quot;c&quot;.png");
  EXPECT_EQ(name("line\nbell\a"), "line bell ");
  EXPECT_EQ(name("Kl\u00f6tzchen \U0001F600"), "Kl\u00f6tzchen \U0001F600");
  EXPECT_EQ(name("\xff\xc0\x80 \xed\xa0\x80 \xe2\x82"), "??? ??? ??");  // stray, overlong, surrogate, cut off
}

}  // namespace
}  // namespace carom::demos
