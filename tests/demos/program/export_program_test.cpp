// `carom export` through the program: what it writes of scenes and recordings, the structure of the .glb
// file, and each way of failing with its exit code and one line.
#include "tests/demos/support/program_run.h"

#include <gtest/gtest.h>

#include "demos/format/json.h"

namespace carom::demos {
namespace {
namespace fs = std::filesystem;

constexpr char kScene[] =
    "{ \"format\": 1, \"rate\": 500, \"duration\": 0.5, \"bodies\": ["
    "{ \"name\": \"floor\", \"shape\": { \"box\": [9, 9, 1] }, \"position\": [0, 0, -0.5], \"static\": true "
    "},"
    "{ \"name\": \"die\", \"shape\": { \"box\": [0.6, 0.5, 0.4] }, \"position\": [0, 0, 0.4], "
    "\"angularVelocity\": [1, 2, 3] } ] }";

struct Export : testing::Test {
  TemporaryFolder folder;
  fs::path scene = folder.file("die.json", kScene);

  std::string path(const std::string& name) const { return (folder.path() / name).string(); }
  std::string text(const std::string& name) const { return readTextFile(folder.path() / name); }
  std::string recording() const {
    const ProgramEnd end = runCarom({"simulate", scene.string(), "-q", "--fps", "24", "-o", path("run.carom"),
                                     "--csv", path("simulated.csv"), "--npy", path("simulated")});
    EXPECT_EQ(end.code, 0) << end.err;
    return path("run.carom");
  }
};

std::uint32_t word(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t k = 0; k < 4; ++k)
    value |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes.at(at + k))) << (8 * k);
  return value;
}

/// One line that holds `part`, and no file left.
void expectRefused(const std::vector<std::string>& arguments, int code, const std::string& part) {
  const Program program(arguments);
  const ProgramEnd end = program.wait();
  EXPECT_EQ(end.code, code) << end.err;
  EXPECT_NE(end.err.find(part), std::string::npos) << end.err;
  EXPECT_EQ(std::count(end.err.begin(), end.err.end(), '\n'), 1) << end.err;
  EXPECT_EQ(end.out, "");
  EXPECT_TRUE(fs::is_empty(program.folder()));
}

TEST_F(Export, AGlbIsAHeaderAJsonChunkAndABinaryChunkOfTheLengthsTheyState) {
  ASSERT_EQ(runCarom({"export", scene.string(), path("die.glb"), "-q"}).code, 0);
  const std::string glb = text("die.glb");
  EXPECT_EQ(glb.substr(0, 4), "glTF");
  EXPECT_EQ(word(glb, 4), 2u);
  EXPECT_EQ(word(glb, 8), glb.size());
  const std::size_t json_length = word(glb, 12);
  EXPECT_EQ(glb.substr(16, 4), "JSON");
  EXPECT_EQ(json_length % 4, 0u);
  const std::size_t binary = 20 + json_length;
  EXPECT_EQ(glb.substr(binary + 4, 4), std::string("BIN\0", 4));
  EXPECT_EQ(binary + 8 + word(glb, binary), glb.size());

  const Json json = Json::parse(glb.substr(20, json_length), "die.glb");
  EXPECT_EQ(json.at("asset").at("version").asString(), "2.0");
  EXPECT_EQ(json.at("buffers").items().at(0).at("byteLength").asNumber(), word(glb, binary));
  const Json& die = json.at("nodes").items().at(2);
  EXPECT_EQ(die.at("name").asString(), "die");
  EXPECT_EQ(die.at("extras").at("density").asNumber(), 1000.0);
  const std::vector<Json>& channels = json.at("animations").items().at(0).at("channels").items();
  ASSERT_EQ(channels.size(), 2u) << "the die moves and turns, the floor does not";
  EXPECT_EQ(channels[0].at("target").at("node").asNumber(), 2.0);
}

TEST_F(Export, ARecordingGivesTheFilesOfTheSimulationByteForByte) {
  const std::string run = recording();
  ASSERT_EQ(runCarom({"export", scene.string(), path("scene.glb"), "-q", "--fps", "24"}).code, 0);
  const ProgramEnd end = runCarom({"export", run, path("run.glb"), "--progress", "none", "--csv",
                                   path("recorded.csv"), "--npy", path("recorded")});
  ASSERT_EQ(end.code, 0) << end.err;
  EXPECT_NE(end.out.find("12 frames at 24 fps, 2 bodies"), std::string::npos) << end.out;
  EXPECT_EQ(text("run.glb"), text("scene.glb"));
  EXPECT_EQ(text("recorded.csv"), text("simulated.csv"));
  for (const char* name : {"times", "positions", "rotations", "linear_velocities", "angular_velocities",
                           "modes", "names", "mode_names"})
    EXPECT_EQ(text(std::string("recorded/") + name + ".npy"),
              text(std::string("simulated/") + name + ".npy"));
}

TEST_F(Export, APageIsOneFileAndTheSameEachTime) {
  const ProgramEnd end = runCarom({"export", scene.string(), path("die.html"), "--progress", "none"});
  ASSERT_EQ(end.code, 0) << end.err;
  EXPECT_NE(end.out.find("30 frames at 60 fps, 2 bodies"), std::string::npos) << end.out;
  const ProgramEnd quiet = runCarom({"export", scene.string(), path("again/die.html"), "-q"});
  EXPECT_EQ(quiet.code, 0);
  EXPECT_EQ(quiet.out + quiet.err, "");
  EXPECT_EQ(text("die.html"), text("again/die.html"));
  EXPECT_LT(text("die.html").size(), 200000u);
  const std::string run = recording();
  ASSERT_EQ(runCarom({"export", run, path("run.html"), "-q"}).code, 0);
  EXPECT_NE(text("run.html").find("<!doctype html>"), std::string::npos);
}

TEST_F(Export, ARecordingWhoseSceneMovedIsToldWhereItIs) {
  const std::string run = recording();
  fs::rename(scene, folder.path() / "moved.json");
  expectRefused({"export", run, "a.glb"}, 3, "is not there; accepted: export --scene with where it is now");
  EXPECT_EQ(runCarom({"export", run, path("a.glb"), "-q", "--scene", path("moved.json")}).code, 0);
  expectRefused({"export", run, "a.glb", "--scene", "resting"}, 3, "recorded from scene hash");
}

TEST_F(Export, ADamagedRecordingIsBadInput) {
  const std::string run = recording();
  fs::resize_file(run, fs::file_size(run) / 2);
  expectRefused({"export", run, "a.glb"}, 3, "the recording is truncated after frame");
  const fs::path other = folder.file("other.carom", "not a recording");
  expectRefused({"export", other.string(), "a.glb"}, 3,
                "no recording: accepted: a file that simulate -o wrote");
  expectRefused({"export", "missing.carom", "a.glb"}, 3, "missing.carom: no such scene or recording");
}

TEST_F(Export, OptionsThatCannotBeCarriedOutAreUsageErrors) {
  const std::string run = recording();
  expectRefused({"export", scene.string()}, 2,
                "nothing to write; accepted: a .glb or .html file, --csv FILE or --npy");
  expectRefused({"export", scene.string(), "a.gltf"}, 2,
                "a.gltf: accepted: a name that ends in .glb or .html");
  expectRefused({"export", run, "a.glb", "--fps", "30"}, 2, "--fps is for scenes");
  expectRefused({"export", run, "a.glb", "--seed", "3"}, 2, "--seed is for scenes");
  expectRefused({"export", run, "a.glb", "--duration", "3"}, 2, "--duration is for scenes");
  expectRefused({"export", scene.string(), "a.glb", "--scene", run}, 2, "--scene is for recordings");
  expectRefused({"export", scene.string(), "a.glb", "--fps", "nan"}, 2, "--fps nan: accepted");
  expectRefused({"export", scene.string(), "a.glb", "--duration", "0.001"}, 2, "holds no frame to export");
  expectRefused({"export", "fifty-bodies", "a.glb", "--duration", "3600", "--fps", "1000"}, 2,
                "do not fit into a .glb file");
  expectRefused({"export", "fifty-bodies", "a.html", "--duration", "3600"}, 2, "do not fit into a page");
}

TEST_F(Export, WhatCannotBeWrittenIsNamed) {
  expectRefused({"export", scene.string(), path("die.json/a.glb"), "-q"}, 4, "cannot write");
  expectRefused({"export", scene.string(), path("die.json/a.html"), "-q"}, 4, "cannot write");
  expectRefused({"export", scene.string(), "--npy", path("die.json/a"), "-q"}, 4, "cannot write");
}

TEST_F(Export, AnInterruptLeavesNothing) {
  Program program({"export", "fifty-bodies", "a.glb", "--csv", "a.csv", "--npy", "arrays", "--duration",
                   "3000", "--progress", "none"});
  for (int i = 0; i < 500 && !fs::exists(program.folder() / "arrays"); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  program.signal(SIGINT);
  EXPECT_EQ(program.wait().code, 130);
  for (const auto& entry : fs::recursive_directory_iterator(program.folder()))
    EXPECT_TRUE(entry.is_directory()) << entry.path();
}

// Khronos' validator, where node finds it: npm install gltf-validator, and its folder in NODE_PATH.
TEST_F(Export, KhronosValidatorFindsNothingInAnyShippedScene) {
  if (std::system("node -e \"require('gltf-validator')\" 2>/dev/null") != 0)
    GTEST_SKIP() << "needs node with Khronos' gltf-validator in NODE_PATH";
  std::string files;
  for (const fs::path& shipped : shippedScenes()) {
    const std::string file = path(shipped.stem().string() + ".glb");
    ASSERT_EQ(runCarom({"export", shipped.string(), file, "-q", "--duration", "0.5"}).code, 0) << shipped;
    files += " " + file;
  }
  const fs::path script = folder.file("validate.js", R"(
const validator = require("gltf-validator"), fs = require("fs");
(async () => {
  for (const file of process.argv.slice(2)) {
    const { issues } = await validator.validateBytes(new Uint8Array(fs.readFileSync(file)));
    if (issues.numErrors + issues.numWarnings === 0) continue;
    console.error(file, JSON.stringify(issues.messages));
    process.exitCode = 1;
  }
})();
)");
  EXPECT_EQ(std::system(("node " + script.string() + files).c_str()), 0);
}

}  // namespace
}  // namespace carom::demos
