// A comparison report opened from disk in headless Chromium: every view is chosen by keyboard and by pointer,
// and the page says what it shows. Needs Debian's chromium; without it the test is skipped.
#include "demos/comparison_report.h"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <regex>

#include <gtest/gtest.h>

#include "demos/asset_path.h"
#include "demos/json.h"
#include "png_files.h"
#include "temporary_folder.h"

namespace carom::demos {
namespace {
namespace fs = std::filesystem;

// Presses keys and buttons as a person would, notes after each what can be seen, and leaves the notes in the
// page.
constexpr char kVisitor[] = R"html(<script>
(async () => {
  const notes = [];
  const seen = () => {
    const panes = [...stage.querySelectorAll(".pane")].filter(pane => pane.offsetWidth > 0);
    const shown = panes.map(pane => pane.dataset.of);
    notes.push([document.getElementById("name").textContent, stage.dataset.view, shown.join("+")].join(" "));
  };
  const press = key => {
    document.body.dispatchEvent(new KeyboardEvent("keydown", { key, bubbles: true, cancelable: true }));
    seen();
  };
  const visibleImages = () => [...stage.querySelectorAll(".pane:not([hidden]) img")];
  seen();
  press(" "); press("ArrowRight"); press("ArrowLeft"); press("2");
  const clip = () => stage.querySelector("[data-of=actual]").style.clipPath;
  const before = clip();
  press("ArrowRight");
  notes.push("slider moved " + (clip() !== before));
  press("3"); press("4");
  await Promise.all(visibleImages().map(image => image.decode()));
  const sizes = visibleImages().map(image => image.naturalWidth + "x" + image.naturalHeight);
  notes.push("decoded " + sizes.join(" "));
  press("ArrowDown"); press("3"); press("1"); press("ArrowDown"); press("ArrowDown");
  document.querySelectorAll("#list button")[1].click();
  seen();
  document.querySelector("[role=tab][data-view=difference]").click();
  seen();
  press("z");
  notes.push("zoomed " + visibleImages()[0].style.transform.includes("scale"));
  const box = document.getElementById("passing");
  box.click();
  notes.push("listed " + document.querySelectorAll("#list button").length);
  document.querySelector("#list input").click();
  notes.push(document.getElementById("accept-command").textContent);
  const fetched = performance.getEntriesByType("resource").filter(entry => !entry.name.startsWith("data:"));
  notes.push("outside " + fetched.length);
  document.body.setAttribute("data-notes", JSON.stringify(notes));
})();
</script></body>)html";

std::string outputOf(const std::string& command) {
  std::FILE* pipe = popen(command.c_str(), "r");
  std::string text;
  std::array<char, 4096> chunk{};
  while (std::fgets(chunk.data(), static_cast<int>(chunk.size()), pipe) != nullptr) text += chunk.data();
  pclose(pipe);
  return text;
}

std::vector<std::string> notesIn(const std::string& page) {
  const std::string opening = "data-notes=\"";
  const std::size_t from = page.find(opening);
  if (from == std::string::npos) return {"the visitor's script did not finish"};
  const std::size_t start = from + opening.size();
  const std::string quoted = page.substr(start, page.find('"', start) - start);
  const std::string text = std::regex_replace(quoted, std::regex("&quot;"), "\"");
  std::vector<std::string> notes;
  const Json json = Json::parse(text, "notes");
  for (const Json& note : json.items()) notes.push_back(note.asString());
  return notes;
}

/// A report of four pairs: two that differ, one of another size, one the same; the visitor is let in.
fs::path visitedReport(const TemporaryFolder& folder) {
  const renderer::Raster golden = flatRaster(64, 48, 100);
  std::vector<Comparison> all;
  const auto add = [&](const std::string& name, const renderer::Raster& actual) {
    const fs::path a = writePng(folder.path() / "a" / name, actual),
                   g = writePng(folder.path() / "g" / name, golden);
    all.push_back(compared({name, a, g, true, true}, {}));
  };
  add("same.png", golden);
  add("little.png", changed(golden, 50, 40, 60));
  add("much.png", flatRaster(64, 48, 160));
  add("small.png", flatRaster(32, 24, 100));
  writeComparisonReport(folder.path() / "report.html", all,
                        {"a", "g", {}, 20, 16, false, {}, "carom compare a g --accept "});
  std::string html = readTextFile(folder.path() / "report.html");
  html.replace(html.rfind("</body>"), 7, kVisitor);
  return folder.file("visited.html", html);
}

TEST(ReportInChromium, ShowsEveryViewByKeyboardAndPointer) {
  if (std::system("chromium --version >/dev/null 2>&1") != 0)
    GTEST_SKIP() << "chromium is not installed (Debian: chromium)";
  const TemporaryFolder folder;
  const fs::path page = visitedReport(folder);
  const std::vector<std::string> expected = {
      "small.png swap actual",
      "small.png swap golden",
      "small.png swap actual",
      "small.png swap golden",
      "small.png slider golden+actual",
      "small.png slider golden+actual",
      "slider moved true",
      "small.png slider golden+actual",  // no difference image of different sizes: the key does nothing
      "small.png side golden+actual",
      "decoded 64x48 32x24",
      "much.png side golden+actual+difference",
      "much.png difference difference",
      "much.png swap actual",
      "little.png swap actual",
      "little.png swap actual",  // the last that does not pass
      "much.png swap actual",
      "much.png difference difference",
      "much.png difference difference",
      "zoomed true",
      "listed 4",
      "carom compare a g --accept small.png",
      "outside 0"};
  const std::vector<std::string> notes =
      notesIn(outputOf("timeout 60 chromium --headless --no-sandbox --disable-gpu --user-data-dir=" +
                       (folder.path() / "user").string() + " --virtual-time-budget=5000 --dump-dom file://" +
                       page.string() + " 2>/dev/null"));
  EXPECT_EQ(notes, expected);
}

}  // namespace
}  // namespace carom::demos
