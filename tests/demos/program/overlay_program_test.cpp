// `carom render --overlay` and `carom figures` as a person runs them.

#include <gtest/gtest.h>

#include "demos/figure/figures.h"
#include "demos/overlay/overlay_choice.h"
#include "renderer/image/png.h"
#include "tests/demos/support/program_run.h"

namespace carom::demos {
namespace {

std::string pixels(const std::filesystem::path& file) {
  const renderer::Image image = renderer::readPng(file).image;
  return {image.rgb.begin(), image.rgb.end()};
}

std::vector<std::string> rendered(const std::vector<std::string>& more) {
  std::vector<std::string> words = {"render", "contact-vertex-face", "--size", "320x180", "-q",
                                    "-o",     "f_%02d.png"};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

TEST(OverlayProgram, HelpListsThemAndAMisspeltOneIsAUsageError) {
  const ProgramEnd help = Program({"render", "--overlay", "help"}).wait();
  EXPECT_EQ(help.code, 0);
  EXPECT_EQ(help.out, overlayHelp());
  const ProgramEnd wrong = Program(rendered({"--overlay", "closest,normal"})).wait();
  EXPECT_EQ(wrong.code, 2);
  EXPECT_NE(wrong.err.find("did you mean \"normals\"?"), std::string::npos) << wrong.err;
  const ProgramEnd body = Program(rendered({"--overlay", "closest", "--focus", "cub"})).wait();
  EXPECT_EQ(body.code, 2);
  EXPECT_NE(body.err.find("did you mean \"cube\"?"), std::string::npos) << body.err;
  EXPECT_EQ(Program(rendered({"--focus", "cube"})).wait().code, 2);
}

TEST(OverlayProgram, ResumeDrawsAgainWhenTheOverlaysChangeAndKeepsThemWhenNot) {
  const Program first(rendered({"--overlay", "closest", "--frames", "2-4"}));
  ASSERT_EQ(first.wait().code, 0);
  const std::string output = (first.folder() / "f_%02d.png").string();
  const auto again = [&](const std::string& overlays) {
    return Program({"render", "contact-vertex-face", "--size", "320x180", "--progress=none", "-o", output,
                    "--resume", "--frames", "2-4", "--overlay", overlays})
        .wait()
        .out;
  };
  EXPECT_NE(again("closest").find("(0 drawn, 3 kept)"), std::string::npos);
  EXPECT_NE(again("distance,closest").find("(3 drawn, 0 kept)"), std::string::npos);
  EXPECT_NE(again("closest,distance").find("(0 drawn, 3 kept)"), std::string::npos)
      << "order is no difference";
  const std::string manifest = readTextFile(first.folder() / "manifest.frames-2-4.json");
  EXPECT_NE(manifest.find("\"overlays\": \"closest,distance\""), std::string::npos) << manifest;
}

// Trails and collisions look back: a frame must not depend on which others are drawn, nor on whether they
// come from a recording.
TEST(OverlayProgram, FramesAreTheSameAloneInAllAndFromARecording) {
  const std::string overlays =
      "trails,closest,statistics,modes,labels,support,manifold,normals,window,velocities";
  const Program all(rendered({"--overlay", overlays, "--frames", "0-14"}));
  const Program alone(rendered({"--overlay", overlays, "--frames", "14"}));
  const Program recording({"simulate", "contact-vertex-face", "-q", "-o", "run.carom"});
  ASSERT_EQ(all.wait().code, 0);
  ASSERT_EQ(alone.wait().code, 0);
  ASSERT_EQ(recording.wait().code, 0);
  const std::string run = (recording.folder() / "run.carom").string();
  const Program from({"render", "--from", run, "--size", "320x180", "-q", "-o", "f_%02d.png", "--frames",
                      "14", "--overlay", overlays});
  ASSERT_EQ(from.wait().code, 0) << from.wait().err;
  const std::string wanted = pixels(all.folder() / "f_14.png");
  EXPECT_EQ(pixels(alone.folder() / "f_14.png"), wanted);
  EXPECT_EQ(pixels(from.folder() / "f_14.png"), wanted);
  const ProgramEnd refused =
      Program({"render", "--from", run, "-q", "--overlay", "impulses,closest,timings"}).wait();
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("impulses, timings would"), std::string::npos) << refused.err;
  EXPECT_EQ(std::count(refused.err.begin(), refused.err.end(), '\n'), 1);
}

TEST(OverlayProgram, ImpulsesOfACollisionDoNotDependOnTheFramesChosen) {
  const Program all(rendered({"--overlay", "impulses,bounds,pairs", "--frames", "10-13"}));
  ASSERT_EQ(all.wait().code, 0);
  for (const char* frame : {"11", "12", "13"}) {
    const Program alone(rendered({"--overlay", "impulses,bounds,pairs", "--frames", frame}));
    ASSERT_EQ(alone.wait().code, 0);
    const std::string name = std::string("f_").append(frame).append(".png");
    EXPECT_EQ(pixels(alone.folder() / name), pixels(all.folder() / name)) << frame;
  }
}

TEST(OverlayProgram, TimingsAndOverlaysLeaveTheStateAsItIs) {
  const Program plain(rendered({"--frames", "12"})),
      shown(rendered({"--frames", "12", "--overlay", "timings,impulses"}));
  ASSERT_EQ(plain.wait().code, 0);
  ASSERT_EQ(shown.wait().code, 0);
  const auto state = [](const Program& program) {
    for (const auto& [keyword, text] : renderer::readPng(program.folder() / "f_12.png").text)
      if (keyword == "State") return text;
    return std::string();
  };
  EXPECT_EQ(state(plain), state(shown));
  EXPECT_NE(pixels(plain.folder() / "f_12.png"), pixels(shown.folder() / "f_12.png"));
}

TEST(OverlayProgram, TimedFramesThatAreKeptDoNotDisturbThoseThatAreDrawn) {
  const Program first(rendered({"--overlay", "timings", "--frames", "1-2"}));
  ASSERT_EQ(first.wait().code, 0);
  const std::string output = (first.folder() / "f_%02d.png").string();
  const ProgramEnd end = Program({"render", "contact-vertex-face", "--size", "320x180", "--progress=none",
                                  "-o", output, "--resume", "--frames", "1-4", "--overlay", "timings"})
                             .wait();
  EXPECT_EQ(end.code, 0) << end.err;
  EXPECT_NE(end.out.find("(2 drawn, 2 kept)"), std::string::npos) << end.out;
}

TEST(FiguresProgram, WritesTenFilesOfTheSizeAskedFor) {
  const Program program({"figures", "-o", "out", "--size", "480x270"});
  const ProgramEnd end = program.wait();
  ASSERT_EQ(end.code, 0) << end.err;
  for (int number = 1; number <= kFigures; ++number) {
    char name[32];
    std::snprintf(name, sizeof name, "figure_%02d.png", number);
    const renderer::DecodedPng png = renderer::readPng(program.folder() / "out" / name);
    EXPECT_EQ(png.image.width, 480);
    EXPECT_EQ(png.image.rgb, drawFigure(number, {480, 270}).rgb) << number;
    EXPECT_NE(end.out.find(name), std::string::npos);
  }
  EXPECT_EQ(Program({"figures", "-o", "/proc/none"}).wait().code, 4);
  EXPECT_EQ(Program({"figures", "--size", "12"}).wait().code, 2);
}

}  // namespace
}  // namespace carom::demos
