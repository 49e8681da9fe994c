// Reports and the index of a suite, opened from disk in headless Chromium: every view is chosen by keyboard
// and by pointer, and the page says what it shows; what is accepted, masked and undone. Needs Debian's
// chromium; without it the tests are skipped.
#include "demos/report/comparison_report.h"

#include <gtest/gtest.h>

#include "demos/regress/regress_index.h"
#include "tests/demos/support/chromium.h"
#include "tests/demos/support/png_files.h"
#include "tests/demos/support/program_run.h"

namespace carom::demos {
namespace {
namespace fs = std::filesystem;

// Presses keys and buttons as a person would, notes after each what can be seen, and leaves the notes in the
// page.
constexpr char kVisitor[] = R"js(
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
)js";

/// A report of four pairs: two that differ, one of another size, one the same.
fs::path reportOfFour(const TemporaryFolder& folder) {
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
  return folder.path() / "report.html";
}

TEST(ReportInChromium, ShowsEveryViewByKeyboardAndPointer) {
  if (!hasChromium()) GTEST_SKIP() << kNoChromium;
  const TemporaryFolder folder;
  const fs::path page = reportOfFour(folder);
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
  EXPECT_EQ(notesOf(page, kVisitor), expected);
}

// Twenty hold their images, of a usual size.
TEST(ReportInChromium, OfAThousandPairsCanBeUsedWithinTwoSeconds) {
  if (!hasChromium()) GTEST_SKIP() << kNoChromium;
  const TemporaryFolder folder;
  const renderer::Raster small = flatRaster(16, 16, 100);
  renderer::Raster large = flatRaster(640, 360, 100);
  for (std::size_t i = 0; i < large.samples.size(); ++i)
    large.samples[i] = static_cast<std::uint16_t>((i / 3 % 640 + i / 1920) & 255);
  std::vector<Comparison> all;
  for (int i = 0; i < 1000; ++i) {
    const std::string name = std::to_string(10000 + i) + ".png";
    const renderer::Raster& golden = i < 20 ? large : small;
    const fs::path a = writePng(folder.path() / "a" / name, changed(golden, 3, 4, i < 20 ? 90 : 40)),
                   g = writePng(folder.path() / "g" / name, golden);
    all.push_back(compared({name, a, g, true, true}, {}));
  }
  const fs::path page = folder.path() / "report.html";
  writeComparisonReport(page, all, {"a", "g", {}, 20, 16, false, {}, "carom compare a g --accept "});
  const std::vector<std::string> notes = quickestNotesOf(page, R"js(
    notes.push("listed " + document.querySelectorAll("#list button").length);
    notes.push(String(Math.round(performance.now())));
  )js",
                                                         2000);
  ASSERT_EQ(notes.size(), 2u) << notes[0];
  EXPECT_EQ(notes[0], "listed 1000");
  EXPECT_LT(std::stoi(notes[1]), 2000) << "ms";
  RecordProperty("ms", notes[1]);
}

// As a person would: reads the command off the page, runs it, and takes that back.
TEST(ReportInChromium, PrintsACommandThatAcceptsTheChosenAndCanBeUndone) {
  if (!hasChromium()) GTEST_SKIP() << kNoChromium;
  const TemporaryFolder folder;
  const renderer::Raster golden = flatRaster(20, 10, 100);
  for (const char* name : {"a.png", "it's b.png"}) {
    writePng(folder.path() / "actual" / name, changed(golden, 3, 4, 50));
    writePng(folder.path() / "golden" / name, golden);
  }
  const fs::path page = folder.path() / "r.html";
  const std::vector<std::string> words = {"compare",
                                          (folder.path() / "actual").string(),
                                          (folder.path() / "golden").string(),
                                          "-q",
                                          "--report",
                                          page.string()};
  EXPECT_EQ(runCarom(words).code, 1);
  const std::vector<std::string> notes = notesOf(page, R"js(
    for (const box of document.querySelectorAll("#list input")) if (box.title === "accept it's b.png") box.click();
    notes.push(document.getElementById("accept-command").textContent);
  )js");
  ASSERT_EQ(notes[0].rfind("carom ", 0), 0u) << notes[0];
  EXPECT_EQ(std::system(("'" CAROM_BINARY "'" + notes[0].substr(5) + " >/dev/null 2>&1").c_str()), 0)
      << notes[0];
  EXPECT_EQ(readTextFile(folder.path() / "golden/it's b.png"),
            readTextFile(folder.path() / "actual/it's b.png"));
  EXPECT_NE(readTextFile(folder.path() / "golden/a.png"), readTextFile(folder.path() / "actual/a.png"));
  EXPECT_NE(runCarom(words).out.find("1 of 2 pass"), std::string::npos);
  EXPECT_EQ(notesOf(page, R"js(notes.push(String(document.querySelectorAll("#list input").length)))js"),
            std::vector<std::string>{"1"});
  EXPECT_EQ(runCarom({words[0], words[1], words[2], "--undo"}).code, 0);
  EXPECT_NE(runCarom(words).out.find("0 of 2 pass"), std::string::npos);
}

TEST(ReportInChromium, ShowsNoDifferenceBehindAMask) {
  if (!hasChromium()) GTEST_SKIP() << kNoChromium;
  const TemporaryFolder folder;
  const renderer::Raster golden = flatRaster(20, 10, 100);
  renderer::Raster actual = changed(golden, 3, 4, 50);
  actual = changed(actual, 12, 4, 50);
  writePng(folder.path() / "actual/a.png", actual);
  writePng(folder.path() / "golden/a.png", golden);
  const fs::path page = folder.path() / "r.html";
  EXPECT_EQ(runCarom({"compare", (folder.path() / "actual").string(), (folder.path() / "golden").string(),
                      "-q", "--mask", "rect:3,4,1,1", "--report", page.string()})
                .code,
            1);
  EXPECT_EQ(notesOf(page, R"js(
    document.querySelector("[role=tab][data-view=difference]").click();
    const image = document.querySelector(".pane[data-of=difference] img");
    await image.decode();
    const canvas = document.createElement("canvas");
    canvas.width = image.naturalWidth; canvas.height = image.naturalHeight;
    const context = canvas.getContext("2d");
    context.drawImage(image, 0, 0);
    const at = (x, y) => context.getImageData(x, y, 1, 1).data.slice(0, 3).join(" ");
    notes.push("masked as elsewhere " + (at(3, 4) === at(0, 0)), "other seen " + (at(12, 4) !== at(0, 0)));
  )js"),
            (std::vector<std::string>{"masked as elsewhere true", "other seen true"}));
}

TEST(IndexInChromium, LeadsToTheReportsAndHidesWhatPasses) {
  if (!hasChromium()) GTEST_SKIP() << kNoChromium;
  const TemporaryFolder folder;
  std::vector<SceneOutcome> outcomes(3);
  for (std::size_t i = 0; i < 3; ++i) {
    outcomes[i].name = std::vector<std::string>{"fine", "changed", "broken"}[i];
    outcomes[i].code = static_cast<int>(i);
    if (i < 2) outcomes[i].report = fs::path(outcomes[i].name) / "report.html";
  }
  outcomes[2].problem = "no such <scene>";
  const fs::path page = folder.file("index.html", indexPage(outcomes, "golden/suite.json"));
  EXPECT_EQ(notesOf(page, R"js(
    const rows = () => [...document.querySelectorAll("tbody tr")].filter(row => row.offsetHeight > 0);
    notes.push(rows().map(row => row.cells[0].textContent + " " + row.cells[1].textContent).join(", "));
    notes.push([...document.querySelectorAll("tbody a")].map(link => link.getAttribute("href")).join(", "));
    notes.push(rows()[1].cells[3].textContent);
    document.getElementById("failing").click();
    notes.push(String(rows().length));
  )js"),
            (std::vector<std::string>{"changed differs, broken not judged, fine passes",
                                      "changed/report.html, fine/report.html", "no such <scene>", "2"}));
}

}  // namespace
}  // namespace carom::demos
