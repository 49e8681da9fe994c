// Long jobs through the program: shards, resumed, streamed and recorded runs give the frames of a single run
// byte for byte, whatever happened on the way; and each way of failing has its exit code and one line.
#include "tests/demos/support/program_run.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <map>
#include <random>

#include <gtest/gtest.h>
#include <poll.h>
#include <sys/inotify.h>

#include "demos/format/json.h"
#include "demos/system/atomic_file.h"
#include "renderer/image/png.h"

namespace carom::demos {
namespace {
namespace fs = std::filesystem;

/// A ball that falls and turns beside a block that rests; the step does not divide a frame of 24 fps.
std::string sceneText(const std::string& color = "#d55e00") {
  return "{ \"format\": 1, \"rate\": 500, \"duration\": 0.5, \"bodies\": ["
         "{ \"name\": \"floor\", \"shape\": { \"box\": [9, 9, 1] }, \"position\": [0, 0, -0.5], "
         "\"static\": true, \"material\": { \"checker\": true } },"
         "{ \"name\": \"block\", \"shape\": { \"box\": [1, 1, 1] }, \"position\": [2, 0, 0.51] },"
         "{ \"name\": \"die\", \"shape\": { \"box\": [0.6, 0.5, 0.4] }, \"position\": [0, 0, 1], "
         "\"angularVelocity\": [1, 2, 3], \"color\": \"" +
         color + "\" } ] }";
}

constexpr int kFrames = 12;

struct LongJob : testing::Test {
  TemporaryFolder folder;
  fs::path scene = folder.file("ball.json", sceneText());

  std::vector<std::string> arguments(const std::string& out,
                                     const std::vector<std::string>& more = {}) const {
    std::vector<std::string> all{"render", scene.string(), "--fps", "24", "--size", "64x36", "-q"};
    if (!out.empty()) all.insert(all.end(), {"-o", (folder.path() / out / "f_%04d.png").string()});
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  ProgramEnd render(const std::string& out, const std::vector<std::string>& more = {}) const {
    const ProgramEnd end = runCarom(arguments(out, more));
    EXPECT_EQ(end.code, 0) << end.err;
    return end;
  }
  /// The line that it ends with when it is not quiet.
  std::string report(const std::string& out, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> all = arguments(out);
    std::replace(all.begin(), all.end(), std::string("-q"), std::string("--progress=none"));
    if (std::count(more.begin(), more.end(), "--size") > 0) {
      const auto size = std::find(all.begin(), all.end(), "--size");
      all.erase(size, size + 2);
    }
    all.insert(all.end(), more.begin(), more.end());
    return runCarom(all).out;
  }
  Files files(const std::string& out) const { return framesOf(folder.path() / out); }
  Json manifest(const std::string& out, const std::string& name = "manifest.json") const {
    return Json::parse(readTextFile(folder.path() / out / name), name);
  }
  fs::path frame(const std::string& out, const std::string& number) const {
    return folder.path() / out / ("f_" + number + ".png");
  }
  /// The line of the program run by a shell with `before` (limits) and `after` (where output goes).
  ProgramEnd shell(const std::string& before, const std::vector<std::string>& words,
                   const std::string& after = "> out") const {
    std::string line = "cd '" + folder.path().string() + "'; " + before + " exec '" CAROM_BINARY "'";
    for (const std::string& word : words) line += " '" + word + "'";
    const int code = exitCodeOf(std::system((line + " 2> err " + after).c_str()));
    return {code, "", readTextFile(folder.path() / "err")};
  }
};

TEST_F(LongJob, ShardsAtOnceAreTheSingleRunByteForByte) {
  render("single");
  std::vector<std::unique_ptr<Program>> shards;
  for (int i = 1; i <= 8; ++i)
    shards.push_back(std::make_unique<Program>(arguments("shards", {"--shard", std::to_string(i) + "/8"})));
  for (const auto& shard : shards) EXPECT_EQ(shard->wait().code, 0);
  EXPECT_EQ(files("single").size(), static_cast<std::size_t>(kFrames));
  EXPECT_EQ(files("shards"), files("single"));
  std::size_t frames = 0;
  for (int i = 1; i <= 8; ++i) {
    const Json json = manifest("shards", "manifest.shard-" + std::to_string(i) + "-of-8.json");
    EXPECT_TRUE(json.at("complete").asBoolean());
    frames += json.at("frames").items().size();
  }
  EXPECT_EQ(frames, static_cast<std::size_t>(kFrames));

  // The whole, resumed, draws nothing and writes the manifest of all.
  EXPECT_NE(report("shards", {"--resume"}).find("(0 drawn, 12 kept)"), std::string::npos);
  const Json whole = manifest("shards");
  const Json single = manifest("single");
  for (std::size_t k = 0; k < kFrames; ++k)
    for (const char* key : {"file", "stateHash", "pixelHash"})
      EXPECT_EQ(whole.at("frames").items().at(k).at(key).asString(),
                single.at("frames").items().at(k).at(key).asString());
}

TEST_F(LongJob, AnotherSceneIsRefusedAFolderThatFramesAreBeingDrawnIn) {
  folder.file("other.json", sceneText("#0072b2"));
  const std::string out = (folder.path() / "out/f_%04d.png").string();
  const auto drawn = [&](const std::string& name, const std::vector<std::string>& more) {
    std::vector<std::string> all{"render", (folder.path() / name).string(), "--size", "64x36", "-q", "-o"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  const Program running(drawn("ball.json", {out, "--fps", "24", "--duration", "600"}));
  while (framesIn(folder.path() / "out") == 0) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  expectOneLine(runCarom(drawn("other.json", {out, "--fps", "24"})), 4,
                "another carom is writing other frames there; accepted: another folder");
  expectOneLine(runCarom(drawn("ball.json", {out, "--fps", "25"})), 4, "cannot write to");
  expectOneLine(runCarom(drawn("ball.json", {out, "--fps", "24", "--resume", "--overlay", "closest"})), 4,
                "cannot write to");
  // Another still, another folder, and another part of the same run are nobody's business.
  EXPECT_EQ(runCarom(drawn("other.json", {(folder.path() / "out/still.png").string(), "--at", "0"})).code, 0);
  EXPECT_EQ(runCarom(drawn("other.json", {(folder.path() / "b/f_%04d.png").string(), "--fps", "24"})).code,
            0);
  EXPECT_EQ(runCarom(drawn("ball.json", {out, "--fps", "24", "--resume", "--shard", "2/2"})).code, 0);
  running.signal(SIGKILL);
  running.wait();
  for (int turn = 0; turn < 500; ++turn) {  // its workers finish the frames they are at
    if (runCarom(drawn("other.json", {out, "--fps", "24"})).code == 0) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  EXPECT_EQ(files("b").at("f_0003.png"), files("out").at("f_0003.png"));
}

TEST_F(LongJob, ChosenFramesAreThoseOfTheWholeRun) {
  render("single");
  render("part", {"--frames", "0-2,5,6-11x4"});
  Files expected = files("single");
  for (const char* other : {"0003", "0004", "0007", "0008", "0009", "0011"})
    expected.erase("f_" + std::string(other) + ".png");
  EXPECT_EQ(files("part"), expected);
  EXPECT_EQ(manifest("part", "manifest.frames-0-2,5,6-11x4.json").at("framesPlanned").asNumber(), 6.0);
  EXPECT_FALSE(fs::exists(folder.path() / "part/manifest.json"));
}

TEST_F(LongJob, MoreShardsThanFramesIsNoError) {
  render("few", {"--shard", "20/20"});
  EXPECT_TRUE(manifest("few", "manifest.shard-20-of-20.json").at("frames").items().empty());
}

TEST_F(LongJob, ResumeRedrawsWhatIsMissingStaleTruncatedOrDamagedAndNothingElse) {
  render("frames");
  const Files whole = files("frames");
  fs::remove(frame("frames", "0001"));
  fs::resize_file(frame("frames", "0002"), whole.at("f_0002.png").size() / 2);
  fs::resize_file(frame("frames", "0003"), 0);
  std::string damaged = whole.at("f_0004.png");
  damaged[damaged.size() / 2] = static_cast<char>(damaged[damaged.size() / 2] ^ 4);
  folder.file("frames/f_0004.png", damaged);
  folder.file("frames/f_0005.png", whole.at("f_0006.png"));
  folder.file("frames/f_0007.png", whole.at("f_0007.png") + "x");
  const auto untouched = fs::last_write_time(frame("frames", "0008"));
  EXPECT_NE(report("frames", {"--resume"}).find("(6 drawn, 6 kept)"), std::string::npos);
  EXPECT_EQ(files("frames"), whole);
  EXPECT_EQ(fs::last_write_time(frame("frames", "0008")), untouched);
  EXPECT_TRUE(manifest("frames").at("complete").asBoolean());
  EXPECT_TRUE(manifest("frames").at("frames").items().at(8).at("kept").asBoolean());
  EXPECT_FALSE(manifest("frames").at("frames").items().at(7).at("kept").asBoolean());
}

TEST_F(LongJob, ResumeTakesNoPortableFrameForOneOfThisCpuNorTheOtherWayRound) {
  render("frames", {"--portable", "--caption", "off"});
  EXPECT_NE(report("frames", {"--resume", "--caption", "off"}).find("(12 drawn, 0 kept)"), std::string::npos);
  EXPECT_NE(report("frames", {"--resume", "--portable"}).find("(12 drawn, 0 kept)"), std::string::npos);
}

TEST_F(LongJob, AfterEditingTheSceneExactlyTheStaleFramesAreRedrawn) {
  render("frames");
  folder.file("ball.json", sceneText("#0072b2"));
  render("frames", {"--frames", "0-4"});
  EXPECT_NE(report("frames", {"--resume"}).find("(7 drawn, 5 kept)"), std::string::npos);
  render("fresh");
  EXPECT_EQ(files("frames"), files("fresh"));
  EXPECT_NE(report("frames", {"--resume", "--size", "64x40"}).find("(12 drawn, 0 kept)"), std::string::npos);
  EXPECT_NE(report("frames", {"--resume", "--size", "64x40", "--duration", "0.6"}).find("(2 drawn, 12 kept)"),
            std::string::npos);
}

TEST_F(LongJob, KilledAtRandomMomentsAndResumedIsTheSingleRun) {
  render("single");
  const Files whole = files("single");
  const auto begin = std::chrono::steady_clock::now();  // of a run that finds its shaders compiled
  render("timed");
  const std::chrono::duration<double> length = std::chrono::steady_clock::now() - begin;
  const unsigned seed = std::random_device{}();
  RecordProperty("seed", std::to_string(seed));
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  constexpr int kRounds = 20;
  int killed = 0;
  for (int round = 0; round < kRounds; ++round) {
    const Program program(arguments("killed", {"--resume"}));
    std::this_thread::sleep_for(std::uniform_real_distribution<>(0.05, 0.5)(random) * length);
    program.signal(SIGKILL);
    killed += program.wait().code == 128 + SIGKILL;
    if (!fs::exists(folder.path() / "killed")) continue;
    // So that there is work left, however late it was killed.
    for (const char* undone : {"0002", "0006", "0011"}) fs::remove(frame("killed", undone));
    for (const auto& [name, bytes] : files("killed")) {
      if (name[0] != '.') {
        EXPECT_TRUE(bytes == whole.at(name)) << name;
      }
    }
  }
  EXPECT_GE(killed, kRounds / 2);
  render("killed", {"--resume"});
  EXPECT_EQ(files("killed"), whole);
}

/// The files that appear in a folder, counted from the first look on.
class Creations {
 public:
  explicit Creations(const fs::path& folder) : descriptor_(inotify_init1(IN_CLOEXEC | IN_NONBLOCK)) {
    if (inotify_add_watch(descriptor_, folder.c_str(), IN_CREATE) < 0)
      throw std::runtime_error("cannot watch " + folder.string());
  }
  Creations(const Creations&) = delete;
  Creations& operator=(const Creations&) = delete;
  ~Creations() { close(descriptor_); }

  /// Returns once n more files have appeared; throws after a minute without one.
  void await(int n) {
    for (int seen = 0; seen < n; seen += count()) {
      pollfd waited{descriptor_, POLLIN, 0};
      if (poll(&waited, 1, 60000) <= 0) throw std::runtime_error("no file appears");
    }
  }
  /// Those that have appeared by now are not counted by `await`.
  void forget() {
    while (count() > 0) continue;
  }

 private:
  /// One reading may bring several.
  int count() const {
    alignas(inotify_event) std::array<char, 4096> events;
    const ssize_t bytes = read(descriptor_, events.data(), events.size());
    int creations = 0;
    for (ssize_t at = 0; at < bytes; ++creations) {
      inotify_event event;
      std::memcpy(&event, events.data() + at, sizeof event);
      at += static_cast<ssize_t>(sizeof event + event.len);
    }
    return creations;
  }

  int descriptor_;
};

// Killed as a file appears: before it is whole, most of the time. On a busy machine the kill may come late,
// even after the end of the run; such rounds prove nothing and count for nothing.
TEST_F(LongJob, KilledWhileAFrameIsBeingWrittenLeavesNoTruncatedFile) {
  const auto large = [this](const std::string& out) {
    return std::vector<std::string>{
        "render",   scene.string(), "--fps",    "16", "--size",
        "1280x720", "-q",           "--resume", "-o", (folder.path() / out / "f_%04d.png").string()};
  };
  ASSERT_EQ(runCarom(large("single")).code, 0);
  const Files whole = files("single");
  fs::create_directory(folder.path() / "killed");
  Creations creations(folder.path() / "killed");
  int half_written = 0;
  for (int round = 0; round < 100 && half_written < 3; ++round) {
    for (const auto& [name, bytes] : whole) fs::remove(folder.path() / "killed" / name);
    creations.forget();
    const Program program(large("killed"));
    creations.await(1 + round % 3);
    program.signal(SIGKILL);
    const ProgramEnd end = program.wait();
    const Files left = files("killed");
    if (end.code == 0) {
      EXPECT_EQ(left, whole);
      continue;
    }
    EXPECT_EQ(end.code, 128 + SIGKILL) << end.err;
    for (const auto& [name, bytes] : left)
      if (name[0] == '.')
        half_written += bytes.size() < whole.begin()->second.size() / 2;
      else
        EXPECT_TRUE(bytes == whole.at(name)) << name;
  }
  EXPECT_GT(half_written, 0);
  ASSERT_EQ(runCarom(large("killed")).code, 0);
  EXPECT_EQ(files("killed"), whole);
}

TEST_F(LongJob, ResumeTidiesUpAfterTheKilledButNotAfterTheLiving) {
  render("frames");
  const std::string dead = ".0123abcd.partial";
  folder.file("frames/.f_0003.png" + dead, "half");
  folder.file("frames/.manifest.json" + dead, "half");
  folder.file("frames/.states.carom" + dead, "half");
  folder.file("frames/.other.png" + dead, "of somebody else");
  const TemporaryFile living(folder.path() / "frames" / "f_0004.png", TemporaryFile::Ending::kPartial);
  render("frames", {"--resume"});
  const Files left = files("frames");
  EXPECT_EQ(left.size(), kFrames + 2u);
  EXPECT_TRUE(left.contains(living.path().filename().string()));
  EXPECT_TRUE(left.contains(".other.png" + dead));
}

TEST_F(LongJob, AStreamIsTheFilesOneAfterAnotherAndNothingElse) {
  render("single");
  std::string pngs;
  std::string pixels;
  std::string ppms;
  for (const auto& [name, bytes] : files("single")) {
    pngs += bytes;
    const std::vector<std::uint8_t> rgb = renderer::readPng(folder.path() / "single" / name).image.rgb;
    pixels.append(rgb.begin(), rgb.end());
    ppms += "P6\n64 36\n255\n";
    ppms.append(rgb.begin(), rgb.end());
  }
  const auto streamed = [&](const std::string& format) {
    const ProgramEnd end = runCarom(arguments("", {"-o", "-", "--stream", format}));
    EXPECT_EQ(end.code, 0);
    EXPECT_EQ(end.err, "");
    return end.out;
  };
  EXPECT_TRUE(streamed("png") == pngs);
  EXPECT_TRUE(streamed("rgb24") == pixels);
  EXPECT_TRUE(streamed("ppm") == ppms);
  const ProgramEnd told = runCarom({"render", scene.string(), "--fps", "24", "--size", "64x36", "-v",
                                    "--progress", "json", "-o", "-", "--stream", "rgb24"});
  EXPECT_TRUE(told.out == pixels);  // however much is told, it goes to stderr
  EXPECT_NE(told.err.find("12 frames"), std::string::npos);
}

/// What the process holds in memory now, in kB.
long resident_kB(pid_t process) {
  const std::string status = readTextFile("/proc/" + std::to_string(process) + "/status");
  return std::stol(status.substr(status.find("VmRSS:") + 6));
}

// Measured with 10 000 frames: the same.
TEST_F(LongJob, AStreamTakesNoMoreMemoryHoweverLong) {
  constexpr std::size_t kFrameBytes = 3 * 32 * 32, kMany = 1200, kWarm = 200;
  constexpr long kFlat_kB = 5000;
  int ends[2];
  ASSERT_EQ(pipe2(ends, O_CLOEXEC), 0);
  const Program program({"render", scene.string(), "-q", "--fps", "500", "--duration", "2.4", "--size",
                         "32x32", "-o", "-", "--stream", "rgb24"},
                        {}, {ends[1]});
  close(ends[1]);
  std::vector<char> chunk(kFrameBytes);
  std::size_t received = 0;
  long warm_kB = 0, last_kB = 0;
  for (ssize_t got = 1; got > 0; received += static_cast<std::size_t>(got)) {
    if (warm_kB == 0 && received >= kWarm * kFrameBytes) warm_kB = resident_kB(program.id());
    if (received < (kMany - 50) * kFrameBytes) last_kB = resident_kB(program.id());
    got = read(ends[0], chunk.data(), chunk.size());
    ASSERT_GE(got, 0);
  }
  close(ends[0]);
  EXPECT_EQ(program.wait().code, 0);
  EXPECT_EQ(received, kMany * kFrameBytes);
  EXPECT_GT(warm_kB, 1000);
  EXPECT_NEAR(static_cast<double>(last_kB), static_cast<double>(warm_kB), kFlat_kB);
}

TEST_F(LongJob, AReaderThatGoesAwayEndsItWith141AndOneLine) {
  const std::string line = "exec '" CAROM_BINARY "' render '" + scene.string() +
                           "' -q --size 256x144 --duration 60 -o - --stream ppm 2> '" +
                           (folder.path() / "err").string() + "'";
  std::FILE* reader = popen(line.c_str(), "r");
  ASSERT_NE(reader, nullptr);
  char head[3] = {};
  EXPECT_EQ(std::fread(head, 1, 2, reader), 2u);
  EXPECT_STREQ(head, "P6");
  const int code = exitCodeOf(pclose(reader));
  expectOneLine({code, "", readTextFile(folder.path() / "err")}, 128 + SIGPIPE,
                "the reader of standard output closed the pipe");
}

TEST_F(LongJob, AFullDiskEndsItWith4AndLeavesNothingPartial) {
  expectOneLine(shell("", arguments("", {"-o", "-", "--stream", "rgb24"}), "> /dev/full"), 4,
                "cannot write to standard output: No space left on device");
  expectOneLine(shell("ulimit -f 1;", arguments("limited")), 4, "f_0000.png: File too large");
  EXPECT_FALSE(fs::exists(folder.path() / "limited"));
  // The shaders that are kept for the next time are a file as well, written before the first frame.
  expectOneLine(shell("ulimit -f 1; XDG_CACHE_HOME=\"$PWD/none-kept\"", arguments("limited")), 4,
                "f_0000.png: File too large");
  EXPECT_FALSE(fs::exists(folder.path() / "limited"));
  expectOneLine(shell("ulimit -f 2;", {"simulate", scene.string(), "-q", "-o", "run.carom"}), 4,
                "cannot write run.carom: File too large");
  EXPECT_FALSE(fs::exists(folder.path() / "run.carom"));
  for (const auto& entry : fs::directory_iterator(folder.path()))
    EXPECT_EQ(entry.path().string().find(".partial"), std::string::npos) << entry.path();
}

TEST_F(LongJob, ARecordingDrawsTheFramesOfTheScene) {
  render("single");
  const std::string recording = (folder.path() / "run.carom").string();
  const ProgramEnd plain = runCarom({"simulate", scene.string(), "-q"});
  const ProgramEnd recorded = runCarom({"simulate", scene.string(), "-q", "--fps", "24", "-o", recording});
  ASSERT_EQ(recorded.code, 0) << recorded.err;
  EXPECT_EQ(recorded.out, plain.out);  // observing changes nothing
  const auto drawn = [&](const std::vector<std::string>& more) {
    std::vector<std::string> all{"render", "--from", recording, "--size", "64x36", "-q"};
    all.insert(all.end(), more.begin(), more.end());
    return runCarom(all);
  };
  const std::string out = (folder.path() / "replayed/f_%04d.png").string();
  ASSERT_EQ(drawn({"-o", out, "--shard", "2/2"}).code, 0);
  ASSERT_EQ(drawn({"-o", out, "--resume"}).code, 0);
  EXPECT_EQ(files("replayed"), files("single"));

  // The scene may move, but not change.
  fs::rename(scene, folder.path() / "moved.json");
  expectOneLine(drawn({"-o", out}), 3, "is not there; accepted: render SCENE --from");
  folder.file("ball.json", sceneText("#0072b2"));
  expectOneLine(drawn({"-o", out}), 3, "recorded from scene hash");
}

TEST_F(LongJob, BrokenRecordingsEndWith3BeforeAnythingIsWritten) {
  const std::string recording = (folder.path() / "run.carom").string();
  ASSERT_EQ(runCarom({"simulate", scene.string(), "-q", "-o", recording}).code, 0);
  fs::resize_file(recording, fs::file_size(recording) - 3);
  const std::vector<std::string> from{"render", "--from", recording, "-o",
                                      (folder.path() / "none/f_%d.png").string()};
  expectOneLine(runCarom(from), 3, "run.carom: the recording is truncated after frame 14");
  folder.file("run.carom", "nothing of ours");
  expectOneLine(runCarom(from), 3, "run.carom: no recording");
  EXPECT_FALSE(fs::exists(folder.path() / "none"));
}

TEST_F(LongJob, CombinationsThatMakeNoSenseEndWith2) {
  const std::vector<std::pair<std::string, std::vector<std::string>>> cases = {
      {"--frames 0-12: ", {"--frames", "0-12"}},
      {"--shard 9/8: accepted: i/n", {"--shard", "9/8"}},
      {"--stream", {"-o", "-"}},
      {"accepted together only", {"--stream", "ppm"}},
      {"--stream jpg: accepted: ppm, png or rgb24", {"-o", "-", "--stream", "jpg"}},
      {"--resume excludes", {"-o", "-", "--stream", "ppm", "--resume"}},
      {"excludes", {"--ffmpeg", "v.mp4", "-o", "f_%d.png"}},
      {"excludes --from", {"--from", "run.carom", "--seed", "2"}},
      {"excludes", {"--from", "run.carom"}}};
  for (const auto& [part, more] : cases) expectOneLine(runCarom(arguments("", more)), 2, part);
}

TEST_F(LongJob, AVideoNeedsFfmpegAndSaysSo) {
  const ProgramEnd end = runCarom(arguments("", {"--ffmpeg", (folder.path() / "v.mp4").string()}),
                                  {"PATH=" + folder.path().string()});
  expectOneLine(end, 4, "the program ffmpeg, which is not installed");
  EXPECT_FALSE(fs::exists(folder.path() / "v.mp4"));
}

TEST_F(LongJob, AVideoGetsEveryPixelOfEveryFrame) {
  fs::create_directory(folder.path() / "bin");
  const fs::path ffmpeg =
      folder.file("bin/ffmpeg", "#!/bin/sh\nfor out in \"$@\"; do :; done\nexec cat > \"$out\"\n");
  fs::permissions(ffmpeg, fs::perms::owner_all);
  const fs::path video = folder.path() / "v.mp4";
  const ProgramEnd end = runCarom(arguments("", {"--ffmpeg", video.string()}),
                                  {"PATH=" + ffmpeg.parent_path().string() + ":/usr/bin:/bin"});
  ASSERT_EQ(end.code, 0) << end.err;
  EXPECT_TRUE(readTextFile(video) == runCarom(arguments("", {"-o", "-", "--stream", "rgb24"})).out);
}

}  // namespace
}  // namespace carom::demos
