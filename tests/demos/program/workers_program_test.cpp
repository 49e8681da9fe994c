// `render --workers N` and `--gl` through the program: the same bytes for any number and either back end, and
// whatever happens to a process, whole frames, one line, and nobody left behind.
#include "tests/demos/support/program_run.h"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <functional>
#include <map>
#include <memory>

#include <gtest/gtest.h>

#include "demos/format/json.h"
#include "renderer/gl/offscreen_context.h"
#include "renderer/image/png.h"

namespace carom::demos {
namespace {
namespace fs = std::filesystem;

/// The processes whose parent is `parent`, from /proc; those that have ended and wait to be fetched as well.
std::vector<pid_t> childrenOf(pid_t parent) {
  std::vector<pid_t> children;
  for (const auto& entry : fs::directory_iterator("/proc")) {
    const std::string name = entry.path().filename().string();
    if (name.find_first_not_of("0123456789") != std::string::npos) continue;
    std::ifstream in(entry.path() / "stat");
    const std::string line{std::istreambuf_iterator<char>(in), {}};
    const std::size_t after = line.rfind(')');
    char state = 0;
    int of = 0;
    if (after != std::string::npos && std::sscanf(line.c_str() + after + 1, " %c %d", &state, &of) == 2 &&
        of == parent)
      children.push_back(std::stoi(name));
  }
  return children;
}

bool soon(const std::function<bool()>& holds) {
  for (int i = 0; i < 1500; ++i) {
    if (holds()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

bool hasGone(pid_t process) {
  return ::kill(process, 0) != 0;
}

struct Workers : testing::Test {
  TemporaryFolder folder;

  fs::path out(const std::string& name) const { return folder.path() / name; }
  std::vector<std::string> arguments(const std::string& name, const std::vector<std::string>& more) const {
    std::vector<std::string> all{"render", "fifty-bodies", "--duration",     "0.3", "--fps", "30",
                                 "--size", "96x54",        "--progress=none"};
    if (!name.empty()) all.insert(all.end(), {"-o", (out(name) / "f_%04d.png").string()});
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  std::string render(const std::string& name, const std::vector<std::string>& more) const {
    const ProgramEnd end = runCarom(arguments(name, more));
    EXPECT_EQ(end.code, 0) << end.err;
    return end.out;
  }
  /// Hours of frames, by three workers; returned when some are there.
  std::unique_ptr<Program> longRun() const {
    auto program = std::make_unique<Program>(std::vector<std::string>{
        "render", "resting", "--workers", "3", "--size", "320x180", "--fps", "240", "--duration", "600",
        "--progress", "none", "-o", (out("long") / "f_%04d.png").string()});
    EXPECT_TRUE(soon([&] { return framesIn(out("long")) >= 9; }));
    return program;
  }
  void expectOnlyWholeFrames(std::size_t in_manifest_at_most) const {
    const Json manifest = Json::parse(readTextFile(out("long") / "manifest.json"), "manifest.json");
    std::size_t pictures = 0;
    for (const auto& [name, bytes] : framesOf(out("long"))) {
      EXPECT_EQ(name.find(".partial"), std::string::npos) << name;
      EXPECT_EQ(renderer::readPng(out("long") / name).image.width, 320);
      ++pictures;
    }
    const std::size_t listed = manifest.at("frames").items().size();
    EXPECT_GE(listed, 8u);
    EXPECT_LE(listed, pictures);
    EXPECT_LE(pictures - listed, in_manifest_at_most);
    EXPECT_NE(manifest.text().find("llvmpipe"), std::string::npos);
  }
};

TEST_F(Workers, AnyNumberOfThemGivesTheSameFilesAndRecords) {
  const std::vector<std::string> aov{"--aov", "depth,id"};
  const auto with = [&](const std::string& count) {
    std::vector<std::string> more = aov;
    more.insert(more.end(), {"--workers", count});
    render(count, more);
    return framesOf(out(count));
  };
  const Files one = with("1");
  ASSERT_EQ(one.size(), 27u);
  for (const char* count : {"2", "3", "40"}) EXPECT_TRUE(with(count) == one) << count;
  const auto recordsOf = [&](const std::string& count) {
    const Json manifest = Json::parse(readTextFile(out(count) / "manifest.json"), "manifest.json");
    std::string text = manifest.at("gl").text();
    for (const Json& frame : manifest.at("frames").items())
      for (const char* key : {"frame", "file", "time_s", "step", "stateHash", "pixelHash"})
        text += frame.at(key).text() + " ";
    return text;
  };
  EXPECT_EQ(recordsOf("2"), recordsOf("1"));
  EXPECT_EQ(recordsOf("3"), recordsOf("1"));
}

TEST_F(Workers, EitherBackEndGivesTheSameFiles) {
  try {
    for (const auto backend : {renderer::GlBackend::kEgl, renderer::GlBackend::kOsmesa})
      renderer::createOffscreenContext(renderer::PixelPolicy::kFast, backend);
  } catch (const renderer::NoRenderer& error) {
    GTEST_SKIP() << error.what();
  }
  render("osmesa", {"--gl", "osmesa", "--workers", "2"});
  render("egl", {"--gl", "egl", "--workers", "2"});
  render("egl here", {"--gl", "egl", "--workers", "1"});
  EXPECT_TRUE(framesOf(out("egl")) == framesOf(out("osmesa")));
  EXPECT_TRUE(framesOf(out("egl here")) == framesOf(out("osmesa")));
}

TEST_F(Workers, AStreamIsTheFilesInOrder) {
  render("files", {"--workers", "1"});
  std::string files;
  for (const auto& [name, bytes] : framesOf(out("files"))) files += bytes;
  EXPECT_TRUE(render("", {"-o", "-", "--stream", "png", "--workers", "3"}) == files);
}

TEST_F(Workers, AStreamOfAnotherOutputIsItsFilesInOrder) {
  render("files", {"--workers", "1", "--aov", "depth,id"});
  std::string ids;
  for (const auto& [name, bytes] : framesOf(out("files")))
    if (name.ends_with(".id.png")) ids += bytes;
  ASSERT_FALSE(ids.empty());
  for (const char* workers : {"1", "3"})
    EXPECT_TRUE(render("", {"-o", "-", "--stream", "png", "--aov", "id", "--workers", workers}) == ids);
}

TEST_F(Workers, ResumeKeepsAndRedrawsAsOneProcessWould) {
  render("run", {"--workers", "1"});
  const Files whole = framesOf(out("run"));
  for (const char* gone : {"f_0001.png", "f_0004.png", "f_0005.png"}) fs::remove(out("run") / gone);
  EXPECT_NE(render("run", {"--workers", "2", "--resume"}).find("(3 drawn, 6 kept)"), std::string::npos);
  EXPECT_TRUE(framesOf(out("run")) == whole);
}

TEST_F(Workers, ChosenFramesAndShardsAreThoseOfTheWholeRun) {
  render("whole", {"--workers", "1"});
  render("part", {"--workers", "2", "--frames", "1,4-7"});
  const Files whole = framesOf(out("whole")), part = framesOf(out("part"));
  EXPECT_EQ(part.size(), 5u);
  for (const auto& [name, bytes] : part) EXPECT_TRUE(whole.at(name) == bytes) << name;
}

TEST_F(Workers, ASignalEndsAllOfThemAndLeavesWholeFrames) {
  for (const int number : {SIGINT, SIGTERM}) {
    fs::remove_all(out("long"));
    const auto program = longRun();
    const std::vector<pid_t> workers = childrenOf(program->id());
    EXPECT_EQ(workers.size(), 3u);
    program->signal(number);
    const ProgramEnd end = program->wait();
    EXPECT_EQ(end.code, 128 + number);
    EXPECT_EQ(end.err, "carom: interrupted; what has been written is whole\n");
    for (const pid_t worker : workers) EXPECT_TRUE(hasGone(worker));
    expectOnlyWholeFrames(0);
  }
}

TEST_F(Workers, AKilledOneEndsTheRunInOneLineAndLeavesNobody) {
  const auto program = longRun();
  const std::vector<pid_t> workers = childrenOf(program->id());
  ASSERT_EQ(workers.size(), 3u);
  ::kill(workers[1], SIGKILL);
  const ProgramEnd end = program->wait();
  EXPECT_EQ(end.code, 128 + SIGKILL);
  EXPECT_EQ(end.err,
            "carom: a worker process that draws frames was killed by signal 9; what has been written is "
            "whole\n");
  for (const pid_t worker : workers) EXPECT_TRUE(hasGone(worker));
  expectOnlyWholeFrames(1);  // the killed one's last may have been whole before it could say so
}

TEST_F(Workers, TheyEndWhenTheProgramIsKilled) {
  const auto program = longRun();
  const std::vector<pid_t> workers = childrenOf(program->id());
  ASSERT_EQ(workers.size(), 3u);
  program->signal(SIGKILL);
  EXPECT_EQ(program->wait().code, 128 + SIGKILL);
  const auto isRunning = [](pid_t process) {  // an orphan may stay unfetched where nothing fetches orphans
    std::ifstream in(fs::path("/proc") / std::to_string(process) / "stat");
    const std::string line{std::istreambuf_iterator<char>(in), {}};
    return !line.empty() && line.find(") Z ") == std::string::npos;
  };
  for (const pid_t worker : workers) EXPECT_TRUE(soon([&] { return !isRunning(worker); }));
  for (const auto& [name, bytes] : framesOf(out("long"))) EXPECT_EQ(name.find(".partial"), std::string::npos);
}

TEST_F(Workers, WhatCannotBeWrittenEndsWith4AndTheFilesName) {
  const std::string below_a_file = folder.file("plain", "").string() + "/f_%04d.png";
  const ProgramEnd end = runCarom(arguments("", {"--workers", "2", "-o", below_a_file}));
  EXPECT_EQ(end.code, 4);
  EXPECT_EQ(end.err.rfind("carom: cannot write " + folder.path().string() + "/plain/f_0000.png: ", 0), 0u)
      << end.err;
}

TEST_F(Workers, NoRendererEndsWith6InOneLine) {
  for (const char* count : {"1", "2"}) {
    const ProgramEnd end = runCarom(arguments("none", {"--workers", count}), {"GALLIUM_DRIVER=nonsense"});
    EXPECT_EQ(end.code, 6);
    EXPECT_EQ(end.err,
              "carom: GALLIUM_DRIVER=nonsense is no driver that draws here; accepted: llvmpipe, or unset "
              "it\n");
    EXPECT_FALSE(fs::exists(out("none")));
  }
}

TEST_F(Workers, MoreThan64OrFewerThanNoneAreRefused) {
  for (const char* count : {"-1", "65", "two"}) {
    const ProgramEnd end = runCarom(arguments("none", {"--workers", count}));
    EXPECT_EQ(end.code, 2) << count;
    EXPECT_NE(end.err.find("--workers"), std::string::npos) << end.err;
  }
}

TEST_F(Workers, EveryFileIsValidForAnIndependentChecker) {
  if (std::system("pngcheck -h > /dev/null 2>&1") == 127 << 8) GTEST_SKIP() << "pngcheck is not installed";
  render("run", {"--workers", "2", "--aov", "depth,normal,id"});
  EXPECT_EQ(std::system(("pngcheck -q '" + out("run").string() + "'/*.png > /dev/null").c_str()), 0);
}

}  // namespace
}  // namespace carom::demos
