// A page is one file of a stated size that names nothing outside itself, has every part of the player, and is
// the same for the same run.
#include "demos/page/player_page.h"

#include <gtest/gtest.h>

#include <regex>

#include "demos/motion/frame_source.h"
#include "demos/page/web_source.h"

namespace carom::demos {
namespace {

std::string pageOf(const std::string& name, double duration_s,
                   const std::optional<std::string>& description = std::nullopt) {
  SceneChoice choice;
  choice.scene = name;
  choice.duration_s = duration_s;
  Scene scene = chosenScene(choice);
  if (description) scene.description = *description;
  SceneWorld made = makeSceneWorld(scene, std::nullopt);
  const FrameClock clock({60.0, scene.rate_hz});
  const int frames = clock.frameCount(scene.duration_s);
  PlayerPage page(
      scene, made,
      {.fps = 60.0, .frames = frames, .recorded = false, .command = "carom </script>", .index = ""});
  RunFacts facts;
  FrameSource source(made, clock, facts);
  for (int frame = 0; frame < frames; ++frame) page.add(frame, source.at(frame).bodies);
  return page.html();
}

TEST(PlayerPage, OfFiftyBodiesAndFiveSecondsHasAtMostAMegabyte) {
  EXPECT_LE(pageOf("fifty-bodies", 5.0).size(), 1000000u);
}

TEST(PlayerPage, IsTheSameForTheSameRunAndNamesNothingOutside) {
  const std::string page = pageOf("sliding", 1.0);
  EXPECT_EQ(pageOf("sliding", 1.0), page);
  const std::regex outside(
      R"((src|href|action|data)\s*=\s*["']?(https?:|//|file:)|url\(|@import|import\s*\(|fetch\s*\(|XMLHttpRequest|WebSocket|sendBeacon|EventSource)");
  std::smatch found;
  EXPECT_FALSE(std::regex_search(page, found, outside)) << found.str();
  EXPECT_EQ(page.find("http://"), std::string::npos);
  EXPECT_EQ(page.find("https://"), std::string::npos);
  EXPECT_NE(page.find("default-src 'none'"), std::string::npos) << "and the browser is told so";
}

TEST(PlayerPage, HasTheWholePlayerAndNoMarkLeft) {
  const std::string page = pageOf("sliding", 0.1);
  for (const char* mark :
       {"/*STYLE*/", "/*SCRIPT*/", "<!--DATA-->", "<!--TITLE-->", "<!--SHADERS-->", "<!--DESCRIPTION-->"})
    EXPECT_EQ(page.find(mark), std::string::npos) << mark;
  EXPECT_EQ(page.find("\nimport "), std::string::npos);
  EXPECT_EQ(page.find("\nexport "), std::string::npos);
  for (const WebSource& source : playerSources()) {
    const std::string name(source.name);
    if (name.ends_with(".glsl")) {
      EXPECT_NE(page.find("id=\"glsl-" + name.substr(0, name.size() - 5) + "\""), std::string::npos) << name;
    }
    if (!name.ends_with(".js")) continue;
    // The first line of each module is in the script.
    EXPECT_NE(page.find(std::string(source.text.substr(0, source.text.find('\n')))), std::string::npos)
        << name;
  }
  EXPECT_EQ(std::count(page.begin(), page.end(), '\0'), 0);
}

TEST(PlayerPage, WhatIsWrittenInASceneIsNoMark) {
  const std::string page = pageOf("sliding", 0.1, "/*STYLE*/ and /*SCRIPT*/");
  EXPECT_NE(page.find("content=\"/*STYLE*/ and /*SCRIPT*/\""), std::string::npos);
}

TEST(PageParts, StandWhereTheirMarksStood) {
  EXPECT_EQ(withParts("<a><!--A--></a>/*B*/.", {{"<!--A-->", "/*B*/"}, {"/*B*/", "<!--A-->"}}),
            "<a>/*B*/</a><!--A-->.");
}

TEST(BundledScript, LeavesOutImportsAndTakesExportsAsNames) {
  const std::vector<WebSource> sources = {
      {"a.js", "export const a = 1;\n"}, {"b.js", "import { a } from \"./a.js\";\n\nconst exporting = a;\n"}};
  EXPECT_EQ(bundledScript(sources, {"a.js", "b.js"}), "const a = 1;\n\nconst exporting = a;\n");
}

TEST(PageCameras, BeginWithTheOneThatIsTakenAndEndWithAll) {
  SceneChoice choice;
  choice.scene = "sliding";
  const std::vector<NamedCamera> cameras = pageCameras(chosenScene(choice));
  EXPECT_EQ(cameras.front().name, "main");
  EXPECT_EQ(cameras.back().name, "fit");
}

}  // namespace
}  // namespace carom::demos
