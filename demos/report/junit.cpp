#include "demos/report/junit.h"

#include "demos/cause/cause_json.h"
#include "demos/format/markup_text.h"

namespace carom::demos {
namespace {

/// The end of the element, with the cause's lines in it where there are some.
std::string details(const Comparison& c, const std::string& kind) {
  std::string text;
  for (const std::string& line : causeLines(c.cause)) text += markupText(line) + "\n";
  return text.empty() ? "/>" : ">" + text + "</" + kind + ">";
}

std::string caseText(const std::string& suite, const Comparison& c, const Gate& gate) {
  const std::string opened =
      "    <testcase classname=\"" + markupText(suite) + "\" name=\"" + markupText(c.pair.name) + "\"";
  if (c.passes()) return opened + "/>\n";
  const std::string kind = c.verdict == Verdict::kUnreadable ? "error" : "failure";
  return opened + ">\n      <" + kind + " type=\"" + verdictName(c.verdict) + "\" message=\"" +
         markupText(comparisonLine(c, gate)) + "\"" + details(c, kind) + "\n    </testcase>\n";
}

}  // namespace

std::string junitText(const std::string& suite, const std::vector<Comparison>& comparisons,
                      const Gate& gate) {
  const Tally tally = tallyOf(comparisons);
  const std::string counts = " tests=\"" + std::to_string(tally.total) + "\" failures=\"" +
                             std::to_string(tally.total - tally.passed - tally.unreadable) + "\" errors=\"" +
                             std::to_string(tally.unreadable) + "\"";
  std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites" + counts +
                     ">\n  <testsuite name=\"" + markupText(suite) + "\"" + counts + " skipped=\"0\">\n";
  for (const Comparison& c : comparisons) text += caseText(suite, c, gate);
  return text + "  </testsuite>\n</testsuites>\n";
}

}  // namespace carom::demos
