#pragma once
// Pages opened from disk in headless Chromium, and what a visitor's script notes there. Needs Debian's
// chromium.

#include <regex>
#include <string>
#include <vector>

#include "demos/asset/asset_path.h"
#include "demos/format/json.h"
#include "tests/support/shell.h"
#include "tests/support/temporary_folder.h"

namespace carom::demos {

inline bool hasChromium() {
  return succeeds("chromium --version");
}
inline constexpr char kNoChromium[] = "chromium is not installed (Debian: chromium)";

/// What `script` pushes to `notes`, an array of texts, in a copy of the page that lies beside it; `script`
/// may await. `options` are Chromium's.
inline std::vector<std::string> notesOf(const std::filesystem::path& page, const std::string& script,
                                        const std::string& options = "--virtual-time-budget=5000") {
  std::string html = readTextFile(page);
  html.replace(
      html.rfind("</body>"), 7,
      "<script>(async () => { const notes = [];\n" + script +
          "\ndocument.body.setAttribute(\"data-notes\", JSON.stringify(notes)); })();</script></body>");
  const std::filesystem::path visited = page.parent_path() / ("visited-" + page.filename().string());
  std::ofstream(visited) << html;
  const TemporaryFolder user;
  const std::string shown =
      endOfShell("timeout 60 chromium --headless --no-sandbox --disable-gpu --user-data-dir=" +
                 (user.path() / "user").string() + " " + options + " --dump-dom 'file://" + visited.string() +
                 "' 2>/dev/null")
          .out;
  const std::string opening = "data-notes=\"";
  const std::size_t from = shown.find(opening);
  if (from == std::string::npos) return {"the visitor's script did not finish"};
  const std::size_t start = from + opening.size();
  std::string text = shown.substr(start, shown.find('"', start) - start);
  for (const auto& [entity, character] :
       {std::pair{"&quot;", "\""}, {"&lt;", "<"}, {"&gt;", ">"}, {"&amp;", "&"}})
    text = std::regex_replace(text, std::regex(entity), character);
  std::vector<std::string> notes;
  const Json json = Json::parse(text, "notes");
  for (const Json& note : json.items()) notes.push_back(note.asString());
  return notes;
}

}  // namespace carom::demos
