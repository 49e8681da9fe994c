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
  const visibleImages = () => [...stage.querySelectorAll(".pane:not([hidden]) img:not([hidden])")];
  seen();
  press(" "); press("ArrowRight"); press("ArrowLeft"); press("2");
  const clip = () => stage.querySelector("[data-of=actual]").style.clipPath;
  const before = clip();
  press("ArrowRight");
  notes.push("slider moved " + (clip() !== before));
  press("3"); press("4");
  await Promise.all(visibleImages().map(loaded));
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

TEST(ConsoleInChromium, TellsOfErrorsAndOfNothingElse) {
  if (!hasChromium()) GTEST_SKIP() << kNoChromium;
  const TemporaryFolder folder;
  const fs::path wrong = folder.file("wrong.html", "<html><body><script>nobody();</script></body></html>");
  EXPECT_NE(consoleOf(wrong).find("nobody is not defined"), std::string::npos) << consoleOf(wrong);
  EXPECT_EQ(consoleOf(folder.file("right.html", "<html><body>a</body></html>")), "");
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
  EXPECT_EQ(consoleOf(page), "");
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
    notes.push(document.getElementById("undo-command").textContent);
  )js");
  const auto runAsWritten = [](const std::string& command) {
    EXPECT_EQ(command.rfind("carom ", 0), 0u) << command;
    EXPECT_TRUE(succeeds("'" CAROM_BINARY "'" + command.substr(5))) << command;
  };
  ASSERT_EQ(notes.size(), 2u);
  const std::string before = readTextFile(folder.path() / "golden/it's b.png");
  runAsWritten(notes[0]);
  EXPECT_EQ(readTextFile(folder.path() / "golden/it's b.png"),
            readTextFile(folder.path() / "actual/it's b.png"));
  EXPECT_NE(readTextFile(folder.path() / "golden/a.png"), readTextFile(folder.path() / "actual/a.png"));
  EXPECT_NE(runCarom(words).out.find("1 of 2 pass"), std::string::npos);
  EXPECT_EQ(notesOf(page, R"js(notes.push(String(document.querySelectorAll("#list input").length)))js"),
            std::vector<std::string>{"1"});
  runAsWritten(notes[1]);
  EXPECT_EQ(readTextFile(folder.path() / "golden/it's b.png"), before);
  EXPECT_NE(runCarom(words).out.find("0 of 2 pass"), std::string::npos);
}

TEST(ReportInChromium, SaysAndShowsWhatIsMaskedAndNoDifferenceBehindIt) {
  if (!hasChromium()) GTEST_SKIP() << kNoChromium;
  const TemporaryFolder folder;
  const renderer::Raster golden = flatRaster(20, 10, 100);
  renderer::Raster actual = changed(golden, 3, 4, 50);
  actual = changed(actual, 12, 4, 50);
  writePng(folder.path() / "actual/a.png", actual);
  writePng(folder.path() / "golden/a.png", golden);
  const fs::path page = folder.path() / "r.html";
  EXPECT_EQ(runCarom({"compare", (folder.path() / "actual").string(), (folder.path() / "golden").string(),
                      "-q", "--mask", "rect:3,4,2,1", "--mask", "rect:0,9,1,1", "--report", page.string()})
                .code,
            1);
  EXPECT_EQ(notesOf(page, R"js(
    document.querySelector("[role=tab][data-view=difference]").click();
    const pixelsOf = async image => {
      await loaded(image);
      const canvas = document.createElement("canvas");
      canvas.width = image.naturalWidth; canvas.height = image.naturalHeight;
      const context = canvas.getContext("2d");
      context.drawImage(image, 0, 0);
      return (x, y) => [...context.getImageData(x, y, 1, 1).data];
    };
    const pane = document.querySelector(".pane[data-of=difference]");
    const at = await pixelsOf(pane.querySelector("img"));
    notes.push("masked as elsewhere " + (String(at(3, 4)) === String(at(0, 0))),
      "other seen " + (String(at(12, 4)) !== String(at(0, 0))));
    const over = pane.querySelector("img.over"), mask = await pixelsOf(over), striped = [];
    for (let y = 0; y < 10; ++y) for (let x = 0; x < 20; ++x) if (mask(x, y)[3] > 0) striped.push(x + "," + y);
    notes.push("striped " + striped.join(" "), "covers it " + (over.offsetWidth === pane.offsetWidth));
    const panes = [...document.querySelectorAll(".pane")];
    document.querySelector("[role=tab][data-view=swap]").click();
    notes.push("over the actual too " + (panes[1].querySelector(".over").offsetWidth > 0));
    notes.push(document.getElementById("note").textContent.split(". ").pop());
    notes.push([...document.querySelectorAll("#paths div")].slice(3).map(fact => fact.textContent).join("; "));
    notes.push(document.getElementById("about").textContent.match(/[0-9]+ pixels? beyond/)[0]);
  )js"),
            (std::vector<std::string>{"masked as elsewhere true", "other seen true", "striped 3,4 4,4 0,9",
                                      "covers it true", "over the actual too true",
                                      "3 pixels, striped, are not looked at.",
                                      "maskedrect:3,4,2,1; maskedrect:0,9,1,1", "1 pixel beyond"}));
  EXPECT_EQ(consoleOf(page), "");
}

// The suite of a project, drawn and compared; then every link of its index is followed.
TEST(IndexInChromium, OfASuiteLeadsToAReportOfEachSceneAndNoneHasAnError) {
  if (!hasChromium()) GTEST_SKIP() << kNoChromium;
  const TemporaryFolder folder;
  const auto writeScene = [&](const std::string& height) {
    folder.file("ball.json", R"({ "format": 1, "duration": 0.2, "bodies": [ { "name": "ball",
      "shape": { "sphere": { "radius": 0.5 } }, "position": [0, 0, )" +
                                 height + R"(] } ],
      "cameras": { "main": { "eye": [6, -9, 5], "target": [0, 0, 1] } } })");
  };
  folder.file("suite.json", R"({ "format": 1, "render": ["--portable", "--size", "64x48", "--fps", "10"],
    "scenes": [ { "name": "ball", "scene": "ball.json" }, { "name": "fixed", "scene": "sliding", "render": ["--duration", "0.2"] } ] })");
  const fs::path out = folder.path() / "out";
  const std::vector<std::string> words = {"regress", folder.path().string(), "-q", "-o", out.string()};
  std::vector<std::string> updating = words;
  updating.push_back("--update");
  writeScene("2");
  ASSERT_EQ(runCarom(updating).code, 0);
  writeScene("2.2");
  ASSERT_EQ(runCarom(words).code, 1);
  EXPECT_EQ(consoleOf(out / "index.html"), "");
  const std::vector<std::string> links = notesOf(out / "index.html", R"js(
    for (const link of document.querySelectorAll("tbody a")) notes.push(decodeURIComponent(new URL(link.href).pathname));
  )js");
  ASSERT_EQ(links, (std::vector<std::string>{(out / "ball/report.html").string(),
                                             (out / "fixed/report.html").string()}));
  const std::string title = R"js(notes.push(document.getElementById("verdict").textContent);)js";
  EXPECT_EQ(notesOf(links[0], title), std::vector<std::string>{"0 of 2 pass, 2 differ"});
  EXPECT_EQ(notesOf(links[1], title), std::vector<std::string>{"2 of 2 pass"});
  for (const std::string& link : links) EXPECT_EQ(consoleOf(link), "") << link;
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
