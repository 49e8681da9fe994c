#include "demos/regress/regress_index.h"

#include <algorithm>

#include "demos/format/markup_text.h"

namespace carom::demos {
namespace {

constexpr char kTop[] = R"html(<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>carom regress</title>
<style>
:root { color-scheme: light dark; --ink: #1c1b19; --paper: #fbfaf7; --soft: #6d6a63; --line: #dedbd3; --bad: #a5331c; --good: #2f6d3b; }
@media (prefers-color-scheme: dark) { :root { --ink: #ecebe6; --paper: #1a1a18; --soft: #9c988f; --line: #3a3935; --bad: #ff8d70; --good: #8fd19b; } }
body { margin: 0; padding: 32px; font: 15px/1.5 system-ui, sans-serif; color: var(--ink); background: var(--paper); }
h1 { font-size: 28px; margin: 0 0 4px; } p { color: var(--soft); margin: 0 0 20px; }
table { border-collapse: collapse; width: 100%; max-width: 1100px; }
td, th { text-align: left; padding: 7px 14px 7px 0; border-bottom: 1px solid var(--line); vertical-align: top; }
.bad { color: var(--bad); } .good { color: var(--good); } a { color: inherit; }
label { display: inline-block; margin-bottom: 12px; } tr[hidden] { display: none; }
</style>
</head>
<body>
)html";

constexpr char kBottom[] = R"html(<script>
"use strict";
const box = document.getElementById("failing");
box.addEventListener("change", () => {
  for (const row of document.querySelectorAll("tbody tr")) row.hidden = box.checked && row.dataset.passes === "true";
});
</script>
</body>
</html>
)html";

bool passes(const SceneOutcome& o) {
  return o.code == 0;
}

std::string countsOf(const SceneOutcome& o) {
  if (o.comparison.kind() == Json::Kind::kNull) return "";
  const Json& counts = o.comparison.at("counts");
  return std::to_string(static_cast<int>(counts.at("passed").asNumber())) + " of " +
         std::to_string(static_cast<int>(counts.at("total").asNumber()));
}

}  // namespace

std::string suiteSummary(const std::vector<SceneOutcome>& outcomes) {
  int passed = 0, differ = 0, broken = 0;
  for (const SceneOutcome& o : outcomes) ++(passes(o) ? passed : o.code == 1 ? differ : broken);
  std::string text = std::to_string(passed) + " of " + std::to_string(outcomes.size()) + " scenes pass";
  if (differ > 0) text += ", " + std::to_string(differ) + (differ == 1 ? " differs" : " differ");
  if (broken > 0) text += ", " + std::to_string(broken) + " could not be judged";
  return text;
}

std::string sceneLine(const SceneOutcome& o) {
  if (passes(o)) return "";
  if (o.comparison.kind() == Json::Kind::kNull) return o.problem;
  for (const Json& pair : o.comparison.at("pairs").items()) {
    const Json* cause = pair.find("cause");
    if (cause != nullptr && !pair.at("passes").asBoolean())
      return pair.at("name").asString() + ": " + cause->asString();
  }
  return o.problem;
}

std::string indexPage(const std::vector<SceneOutcome>& outcomes, const std::string& suite) {
  std::vector<const SceneOutcome*> order;
  for (const SceneOutcome& o : outcomes) order.push_back(&o);
  std::stable_sort(order.begin(), order.end(),
                   [](const SceneOutcome* a, const SceneOutcome* b) { return passes(*a) < passes(*b); });
  std::string page = kTop;
  const bool all = std::all_of(outcomes.begin(), outcomes.end(), passes);
  page += std::string("<h1 class=\"") + (all ? "good" : "bad") + "\">" + markupText(suiteSummary(outcomes)) +
          "</h1>\n<p>" + markupText(suite) +
          "</p>\n<label><input type=\"checkbox\" id=\"failing\"> only those that do not pass</label>\n"
          "<table><thead><tr><th>scene</th><th>verdict</th><th>frames that "
          "pass</th><th>cause</th></tr></thead><tbody>\n";
  for (const SceneOutcome* o : order) {
    const std::string name = markupText(o->name);
    page +=
        std::string("<tr data-passes=\"") + (passes(*o) ? "true" : "false") + "\"><td>" +
        (o->report.empty() ? name
                           : "<a href=\"" + markupText(o->report.generic_string()) + "\">" + name + "</a>") +
        "</td><td class=\"" +
        (passes(*o)     ? "good\">passes"
         : o->code == 1 ? "bad\">differs"
                        : "bad\">not judged") +
        "</td><td>" + countsOf(*o) + "</td><td>" + markupText(sceneLine(*o)) + "</td></tr>\n";
  }
  return page + "</tbody></table>\n" + kBottom;
}

Json suiteJson(const std::vector<SceneOutcome>& outcomes) {
  Json scenes = Json::array();
  for (const SceneOutcome& o : outcomes) {
    Json scene = Json::object({{"name", o.name}, {"passes", passes(o)}, {"exitCode", o.code}});
    if (!o.problem.empty()) scene.set("problem", o.problem);
    if (!sceneLine(o).empty()) scene.set("cause", sceneLine(o));
    if (!o.report.empty()) scene.set("report", o.report.generic_string());
    if (o.comparison.kind() != Json::Kind::kNull) scene.set("comparison", o.comparison);
    scenes.push(std::move(scene));
  }
  const bool all = std::all_of(outcomes.begin(), outcomes.end(), passes);
  return Json::object(
      {{"format", 1}, {"passes", all}, {"summary", suiteSummary(outcomes)}, {"scenes", std::move(scenes)}});
}

std::string suiteJunit(const std::vector<SceneOutcome>& outcomes) {
  std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n";
  for (const SceneOutcome& o : outcomes) {
    if (!o.junit.empty()) {
      text += o.junit;
      continue;
    }
    text += "  <testsuite name=\"" + markupText(o.name) + "\" tests=\"1\" failures=\"0\" errors=\"" +
            (passes(o) ? "0" : "1") + "\" skipped=\"0\">\n    <testcase classname=\"" + markupText(o.name) +
            "\" name=\"frames\">" +
            (passes(o) ? "" : "<error type=\"not judged\" message=\"" + markupText(o.problem) + "\"/>") +
            "</testcase>\n  </testsuite>\n";
  }
  return text + "</testsuites>\n";
}

}  // namespace carom::demos
