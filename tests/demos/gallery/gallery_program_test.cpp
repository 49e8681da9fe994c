// `carom gallery` through the program: its files, what is made again and what is kept, failures with their
// exit codes, and the index in headless Chromium.
#include "tests/demos/support/program_run.h"

#include <gtest/gtest.h>

#include "demos/format/json.h"
#include "demos/frames/folder_claim.h"
#include "demos/gallery/gallery_index.h"
#include "demos/gallery/gallery_scene.h"
#include "renderer/image/png.h"
#include "tests/demos/support/chromium.h"

namespace carom::demos {
namespace {
namespace fs = std::filesystem;

std::string sceneText(const std::string& extra, double height = 1.0) {
  return "{ \"format\": 1, \"duration\": 0.6, " + extra +
         " \"bodies\": [ { \"name\": \"floor\", \"shape\": { \"box\": [9, 9, 1] }, \"position\": [0, 0, "
         "-0.5], "
         "\"static\": true, \"material\": { \"checker\": true } }, { \"name\": \"die\", \"shape\": { "
         "\"box\": [0.6, 0.5, 0.4] }, "
         "\"position\": [0, 0, " +
         std::to_string(height) + "], \"angularVelocity\": [1, 2, 3] } ] }";
}

struct Gallery : testing::Test {
  TemporaryFolder folder;
  fs::path one = folder.file(
      "one.json",
      sceneText("\"description\": \"one <die>\", \"group\": \"machines\", \"lookFor\": \"it turns\","));
  fs::path two = folder.file("two.json", sceneText("\"description\": \"another\",", 2.0));
  fs::path out = folder.path() / "out";

  std::vector<std::string> words(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> all = {"gallery",    one.string(), two.string(), "-o",    out.string(),
                                    "--progress", "none",       "--size",     "160x90"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  Json manifest() const { return Json::parse(readTextFile(out / "gallery.json"), "gallery.json"); }
};

TEST_F(Gallery, HoldsAPageAndPicturesOfEachScene) {
  const ProgramEnd end = runCarom(words());
  ASSERT_EQ(end.code, 0) << end.err;
  EXPECT_NE(end.out.find("2 scenes"), std::string::npos) << end.out;
  EXPECT_NE(end.out.find("(2 made, 0 kept)"), std::string::npos) << end.out;
  EXPECT_EQ(end.err, "");
  for (const char* name : {"one", "two"}) {
    EXPECT_LE(fs::file_size(out / galleryPicture(name)), kMostPictureBytes);
    EXPECT_EQ(readTextFile(out / galleryPicture(name)).substr(1, 3), "PNG");
    EXPECT_NE(readTextFile(out / galleryPicture(name)).find("acTL"), std::string::npos);
    EXPECT_EQ(readTextFile(out / galleryStill(name)).find("acTL"), std::string::npos);
    EXPECT_NE(readTextFile(out / galleryPage(name)).find("<!doctype html>"), std::string::npos);
  }
  const std::string index = readTextFile(out / "index.html");
  for (const char* part :
       {"Machines", "one &lt;die", "it turns", "carom render one.json", "scenes/one.html", ">More<"})
    EXPECT_NE(index.find(part), std::string::npos) << part;
  EXPECT_FALSE(fs::exists(out / ".making"));
}

/// The mean over all pixels of what their channels differ by; of 255.
double meanDifference(const fs::path& a, const fs::path& b) {
  const renderer::Image one = renderer::readPng(a).image, other = renderer::readPng(b).image;
  EXPECT_EQ(one.rgb.size(), other.rgb.size());
  double sum = 0.0;
  for (std::size_t i = 0; i < std::min(one.rgb.size(), other.rgb.size()); ++i)
    sum += std::abs(int{one.rgb[i]} - int{other.rgb[i]});
  return sum / static_cast<double>(one.rgb.size());
}

// The light, the ground, the surfaces, and what is drawn in place of bodies.
TEST_F(Gallery, ShowsAScenesLooksAsRenderDoes) {
  folder.file("leaf.obj", "v -2 0 -1\nv 2 0 -1\nv 0 0 2\nf 1 2 3\n");
  const std::string bodies = R"("bodies": [
    { "name": "floor", "shape": { "box": [9, 9, 1] }, "position": [0, 0, -0.5], "static": true,
      "material": { "ground": "sand" } },
    { "name": "sign", "shape": { "box": [0.2, 0.2, 0.2] }, "position": [0, 1, 2],
      "visual": { "file": "leaf.obj" } },
    { "name": "die", "shape": { "box": [1, 1, 1] }, "position": [0, -1.5, 0.7],
      "material": { "surface": "wood" } } ],
    "cameras": { "main": { "eye": [3, -9, 3], "target": [0, 0, 1] } } })";
  for (const char* light : {R"("day")", R"("sunset")", R"({ "like": "overcast", "exposure": 0.4 })"}) {
    one = folder.file("one.json",
                      R"({ "format": 1, "duration": 0.1, "light": )" + std::string(light) + ", " + bodies);
    const ProgramEnd end = runCarom({"gallery", one.string(), "-o", out.string(), "-q", "--size", "320x180"});
    ASSERT_EQ(end.code, 0) << end.err;
    const fs::path drawn = folder.path() / "drawn.png";
    ASSERT_EQ(
        runCarom({"render", one.string(), "--at", "0", "--size", "320x180", "-q", "-o", drawn.string()}).code,
        0);
    EXPECT_LT(meanDifference(out / galleryStill("one"), drawn), 1.5)
        << light << ": a palette has 255 colours";
  }
}

TEST_F(Gallery, MakesAgainOnlyWhatIsAnother) {
  ASSERT_EQ(runCarom(words()).code, 0);
  const std::string page = readTextFile(out / galleryPage("one"));
  EXPECT_NE(runCarom(words()).out.find("(0 made, 2 kept)"), std::string::npos);
  folder.file("two.json", sceneText("\"description\": \"another\",", 2.5));
  EXPECT_NE(runCarom(words()).out.find("(1 made, 1 kept)"), std::string::npos) << "its scene changed";
  std::ofstream(out / galleryPicture("one")) << "damaged";
  EXPECT_NE(runCarom(words()).out.find("(1 made, 1 kept)"), std::string::npos) << "its picture was damaged";
  EXPECT_EQ(readTextFile(out / galleryPage("one")), page) << "the same bytes as before";
  EXPECT_NE(runCarom(words({"--fps", "10"})).out.find("(2 made, 0 kept)"), std::string::npos);
  std::ofstream(out / "gallery.json") << "not JSON";
  EXPECT_NE(runCarom(words({"--fps", "10"})).out.find("(2 made, 0 kept)"), std::string::npos);
}

TEST_F(Gallery, RemovesWhatItWroteOfOtherScenesAndNothingElse) {
  ASSERT_EQ(runCarom(words()).code, 0);
  std::ofstream(out / "pictures/mine.png") << "mine";
  std::ofstream(out / galleryPage("two"), std::ios::app) << "edited";
  ASSERT_EQ(runCarom({"gallery", one.string(), "-o", out.string(), "-q", "--size", "160x90"}).code, 0);
  EXPECT_TRUE(fs::exists(out / galleryPage("one")));
  EXPECT_FALSE(fs::exists(out / galleryPicture("two")));
  EXPECT_FALSE(fs::exists(out / galleryStill("two")));
  EXPECT_TRUE(fs::exists(out / galleryPage("two"))) << "somebody has written to it";
  EXPECT_TRUE(fs::exists(out / "pictures/mine.png"));
  EXPECT_EQ(manifest().at("scenes").items().size(), 1u);
}

TEST_F(Gallery, TakesNoFolderWithAnIndexPageOfSomebodyElse) {
  fs::create_directories(out);
  std::ofstream(out / "index.html") << "mine";
  expectOneLine(runCarom(words()), 4, "it is there already");
  EXPECT_EQ(readTextFile(out / "index.html"), "mine");
}

TEST_F(Gallery, TakesNoFolderThatAnotherIsMaking) {
  {
    const FolderClaim another({out, "gallery", 1});
    const ProgramEnd end = runCarom(words());
    EXPECT_EQ(end.code, 4) << end.err;
    EXPECT_NE(end.err.find("another carom is writing"), std::string::npos) << end.err;
  }
  EXPECT_EQ(runCarom(words()).code, 0);
}

TEST_F(Gallery, ASceneThatFailsIsNamedAndTheOthersAreThere) {
  folder.file("two.json", "{ \"format\": 1, \"bodies\": [] }");
  const ProgramEnd end = runCarom(words());
  EXPECT_EQ(end.code, 3);
  EXPECT_NE(end.err.find("two: "), std::string::npos) << end.err;
  EXPECT_NE(end.err.find("a scene needs at least one body"), std::string::npos) << end.err;
  EXPECT_EQ(std::count(end.err.begin(), end.err.end(), '\n'), 1) << end.err;
  EXPECT_NE(end.out.find("1 scene"), std::string::npos) << end.out;
  EXPECT_NE(readTextFile(out / "index.html").find("scenes/one.html"), std::string::npos);
}

TEST_F(Gallery, RefusesWhatCannotBe) {
  const auto refused = [](const std::vector<std::string>& arguments, int code, const std::string& part) {
    const ProgramEnd end = runCarom(arguments);
    EXPECT_EQ(end.code, code) << end.err;
    EXPECT_NE(end.err.find(part), std::string::npos) << end.err;
    EXPECT_EQ(std::count(end.err.begin(), end.err.end(), '\n'), 1) << end.err;
  };
  refused({"gallery", one.string(), "nowhere", "-o", out.string()}, 3, "nowhere");
  fs::create_directories(folder.path() / "other");
  fs::copy_file(one, folder.path() / "other" / "one.json");
  refused({"gallery", one.string(), (folder.path() / "other" / "one.json").string(), "-o", out.string()}, 2,
          "two scenes are called \"one\"");
  refused({"gallery", one.string(), "-o", (one / "in").string(), "-q"}, 4, "cannot write");
  refused({"gallery", one.string(), "--fps", "0"}, 2, "--fps 0: accepted");
  refused({"gallery", one.string(), "--size", "5x5"}, 2, "--size 5x5: accepted");
  refused({"gallery", "--part"}, 2, "--part makes the files of one scene");
}

TEST_F(Gallery, GoesOnWhereItWasInterrupted) {
  ASSERT_EQ(runCarom({"gallery", one.string(), "-o", out.string(), "-q", "--size", "160x90"}).code, 0);
  const fs::path slow = folder.file("slow.json", R"({ "format": 1, "duration": 900, "bodies": [
    { "name": "die", "shape": { "box": [0.6, 0.5, 0.4] } } ] })");
  Program program(
      {"gallery", one.string(), slow.string(), "-o", out.string(), "--progress", "none", "--size", "160x90"});
  program.awaitHandler(SIGINT);
  for (int i = 0; i < 500 && !fs::exists(out / ".making" / "slow.json"); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  program.signal(SIGINT);
  EXPECT_EQ(program.wait().code, 130);
  EXPECT_FALSE(fs::exists(out / ".making"));
  EXPECT_FALSE(fs::exists(out / galleryPage("slow")));
  EXPECT_NE(runCarom(words()).out.find("(1 made, 1 kept)"), std::string::npos);
}

TEST_F(Gallery, IndexFindsScenesByWordsInChromium) {
  if (!hasChromium()) GTEST_SKIP() << kNoChromium;
  ASSERT_EQ(runCarom(words()).code, 0);
  const std::vector<std::string> notes = notesOf(out / "index.html", R"js(
    const shown = () => [...document.querySelectorAll(".card")].filter(card => card.offsetHeight > 0)
      .map(card => card.querySelector("h3").textContent).join("+");
    notes.push(shown());
    const search = document.getElementById("search");
    const type = text => { search.value = text; search.dispatchEvent(new Event("input")); };
    type("TURNS die");
    notes.push(shown(), [...document.querySelectorAll("#groups a")].filter(link => !link.hidden).map(link => link.textContent).join());
    type("unheard of");
    notes.push(shown(), String(document.getElementById("none").hidden));
    document.getElementById("clear").click();
    notes.push(shown());
    const images = [...document.images];
    for (const image of images) { image.loading = "eager"; await image.decode(); }
    notes.push(images.map(image => image.naturalWidth + "x" + image.naturalHeight).join());
    document.getElementById("still").click();
    notes.push(images.map(image => image.getAttribute("src")).join());
  )js");
  const std::vector<std::string> expected = {
      "One+Two", "One",     "Machines 1",    "",
      "false",   "One+Two", "160x90,160x90", "pictures/one.still.png,pictures/two.still.png"};
  EXPECT_EQ(notes, expected);
}

// The clock is Chromium's own and real: from the start of navigation until all of the index has been read and
// can be used, with as many scenes as a large gallery has.
TEST_F(Gallery, IndexCanBeUsedWithinASecondOfOpening) {
  if (!hasChromium()) GTEST_SKIP() << kNoChromium;
  ASSERT_EQ(runCarom(words()).code, 0);
  std::vector<GalleryEntry> entries;
  for (int i = 0; i < 60; ++i) {
    entries.push_back(galleryEntry(manifest().at("scenes").items().at(static_cast<std::size_t>(i % 2))));
    entries.back().group = i < 30 ? "machines" : "more";
  }
  std::ofstream(out / "index.html") << galleryIndex(entries);
  const std::vector<std::string> notes = quickestNotesOf(out / "index.html", R"js(
    notes.push(String(document.querySelectorAll(".card").length), String(Math.round(performance.now())));
  )js",
                                                         1000);
  ASSERT_EQ(notes.size(), 2u) << notes[0];
  EXPECT_EQ(notes[0], "60");
  EXPECT_LT(std::stoi(notes[1]), 1000) << "ms";
  RecordProperty("ms", notes[1]);
}

}  // namespace
}  // namespace carom::demos
