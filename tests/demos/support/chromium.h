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

/// What Chromium prints of the page as it is when it has been opened; nothing where it cannot be. `options`
/// are Chromium's, `streams` the shell's. A container's root has no sandbox, and its shared memory may be
/// small.
inline std::string openedPage(const std::string& address, const std::string& options,
                              const std::string& streams = "2>/dev/null") {
  const TemporaryFolder user;
  return endOfShell(
             "timeout 60 chromium --headless --no-sandbox --disable-gpu --disable-dev-shm-usage "
             "--user-data-dir=" +
             (user.path() / "user").string() + " " + options + " --dump-dom '" + address + "' " + streams)
      .out;
}

/// What the console tells while the page is opened: its errors, and what its scripts and its policy of
/// contents refuse.
inline std::string consoleOf(const std::filesystem::path& page) {
  return openedPage("file://" + page.string(), "--enable-logging=stderr --virtual-time-budget=5000",
                    "2>&1 >/dev/null | grep ':CONSOLE' || true");
}

/// Whether it opens an empty page: it may be installed where nothing lets it start.
inline bool hasChromium() {
  static const bool has = openedPage("about:blank", "").find("<html") != std::string::npos;
  return has;
}
inline constexpr char kNoChromium[] = "there is no chromium that opens a page (Debian: chromium)";

/// What `script` pushes to `notes`, an array of texts, in a copy of the page that lies beside it, and the
/// error that ends it; `script` may await, an image by `loaded(image)`: virtual time goes on while one is
/// decoded. `options` are Chromium's.
inline std::vector<std::string> notesOf(const std::filesystem::path& page, const std::string& script,
                                        const std::string& options = "--virtual-time-budget=5000") {
  std::string html = readTextFile(page);
  html.replace(
      html.rfind("</body>"), 7,
      "<script>(async () => { const notes = [];\n"
      "const loaded = image => image.complete || new Promise(done => image.addEventListener('load', done));\n"
      "try {" +
          script +
          "\n} catch (error) { notes.push(String(error)); }"
          "\ndocument.body.setAttribute(\"data-notes\", JSON.stringify(notes)); })();</script></body>");
  const std::filesystem::path visited = page.parent_path() / ("visited-" + page.filename().string());
  std::ofstream(visited) << html;
  const std::string shown = openedPage("file://" + visited.string(), options);
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

/// By Chromium's own and real clock: the notes of an opening whose last note is less than `enough_ms`, or
/// else of the quickest of a few. What else the machine does only adds to them.
inline std::vector<std::string> quickestNotesOf(const std::filesystem::path& page, const std::string& script,
                                                int enough_ms) {
  constexpr int kOpenings = 5;
  std::vector<std::string> quickest = notesOf(page, script, "");
  for (int i = 1; i < kOpenings && quickest.size() > 1 && std::stoi(quickest.back()) >= enough_ms; ++i) {
    const std::vector<std::string> notes = notesOf(page, script, "");
    if (notes.size() > 1 && std::stoi(notes.back()) < std::stoi(quickest.back())) quickest = notes;
  }
  return quickest;
}

}  // namespace carom::demos
