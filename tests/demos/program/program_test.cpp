// The carom program from outside: what it prints where, what it leaves on disk, and its exit codes.
#include "tests/demos/support/program_run.h"

#include <algorithm>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "demos/format/content_hash.h"
#include "demos/format/json.h"
#include "renderer/image/png.h"

namespace carom::demos {
namespace {
namespace fs = std::filesystem;

const std::string kBall =
    "{ \"format\": 1, \"rate\": 500, \"duration\": 0.5, \"bodies\": ["
    "{ \"name\": \"floor\", \"shape\": { \"box\": [9, 9, 1] }, \"position\": [0, 0, -0.5], \"static\": true, "
    "\"material\": { \"checker\": true } },"
    "{ \"name\": \"ball\", \"shape\": { \"sphere\": { \"radius\": 0.5 } }, \"position\": [0, 0, 2], "
    "\"color\": \"#d55e00\" } ] }";

/// One line that starts with the program's name and holds `part`.
TEST(Program, HelpOfEveryCommandShowsAnExample) {
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{"--help"},
                                             {"list", "--help"},
                                             {"render", "--help"},
                                             {"simulate", "--help"},
                                             {"export", "--help"},
                                             {"check", "--help"},
                                             {"compare", "--help"},
                                             {"budget", "--help"},
                                             {"doctor", "--help"}}) {
    const ProgramEnd end = runCarom(arguments);
    EXPECT_EQ(end.code, 0);
    EXPECT_NE(end.out.find("Example: carom "), std::string::npos) << end.out;
    EXPECT_NE(end.out.find("Usage: carom " + (arguments.size() > 1 ? arguments[0] + " [" : "[")),
              std::string::npos)
        << end.out;
    EXPECT_EQ(end.err, "");
  }
  EXPECT_EQ(runCarom({"--version"}).out.rfind("carom 0.", 0), 0u);
}

TEST(Program, HelpAndVersionAreAlsoCommands) {
  EXPECT_EQ(runCarom({"help"}).out, runCarom({"--help"}).out);
  EXPECT_EQ(runCarom({"help", "render"}).out, runCarom({"render", "--help"}).out);
  for (const char* word : {"version", "-V"}) EXPECT_EQ(runCarom({word}).out, runCarom({"--version"}).out);
  EXPECT_EQ(runCarom({"help", "rendr"}).code, 2);
  const std::string help = runCarom({"render", "--help"}).out;
  for (const char* heading : {"What is simulated:", "What is written:", "Which moments:", "How it looks:",
                              "Long jobs:", "What is told:"})
    EXPECT_NE(help.find(heading), std::string::npos) << heading;
}

TEST(Program, EveryOptionStandsUnderAHeading) {
  for (const char* command : {"list", "render", "simulate", "export", "check", "distance", "compare",
                              "regress", "budget", "figures", "doctor", "new"}) {
    const std::string help = runCarom({command, "--help"}).out;
    const std::size_t begin = help.find("Options:"), end = help.find("\n\n", begin);
    ASSERT_NE(begin, std::string::npos) << command;
    const std::string rest = help.substr(begin, end - begin);
    EXPECT_EQ(rest.find("--"), rest.rfind("--")) << command << ": " << rest;  // that of --help alone
  }
}

TEST(Program, SimulateSaysWhatItsCountersMeanAndQuietDoesNot) {
  const std::vector<std::string> words{"simulate", "bouncing-ball", "--duration", "0.1"};
  const std::string told = runCarom(words).err;
  for (const char* counter :
       {"resting:", "smallest_gap_m:", "events:", "stopped_bodies:", "iteration_limits:"})
    EXPECT_NE(told.find(counter), std::string::npos) << counter;
  EXPECT_EQ(runCarom({"simulate", "bouncing-ball", "--duration", "0.1", "-q"}).err, "");
}

TEST(Program, WrongUsageEndsWith2AndNamesTheNearest) {
  const std::map<std::string, std::vector<std::string>> cases = {
      {"a command is missing", {}},
      {"unknown command \"rendr\"; did you mean \"render\"?", {"rendr", "sliding"}},
      {"unknown option --versoin; did you mean \"--version\"?", {"--versoin"}},
      {"render: unknown option --durtion; did you mean \"--duration\"?",
       {"render", "sliding", "--durtion", "1"}},
      {"render: unexpected argument \"resting\"", {"render", "sliding", "resting"}},
      {"--size 64: accepted: WIDTHxHEIGHT", {"render", "sliding", "--size", "64"}},
      {"--size 1x1: accepted:", {"render", "sliding", "--size", "1x1"}},
      {"--fps 0: accepted: above 0", {"render", "sliding", "--fps", "0"}},
      {"--fps nan: accepted: above 0", {"render", "sliding", "--fps", "nan"}},
      {"--duration -1: accepted: above 0", {"simulate", "sliding", "--duration", "-1"}},
      {"the duration of 0.001 s holds no frame at 30 fps", {"render", "sliding", "--duration", "0.001"}},
      {"the duration of 1e-300 s holds no step", {"simulate", "sliding", "--duration", "1e-300"}},
      {"--set duration=1e400: 1e400 is beyond", {"check", "sliding", "--set", "duration=1e400"}},
      {"--set is for scenes: gem.obj is a mesh", {"check", "gem.obj", "--set", "a=3"}},
      {"--mesh is for scenes: gem.obj is a mesh", {"check", "gem.obj", "--mesh", "none.obj"}},
      {"the duration of 0.5 s holds no frame at 30 fps, of which each takes 3.33 s of it with --speed 100",
       {"render", "sliding", "--duration", "0.5", "--speed", "100"}},
      {"the duration of 0.01 s holds no frame at 30 fps to write",
       {"simulate", "sliding", "--duration", "0.01", "--csv", "x.csv"}},
      {"--seed", {"simulate", "sliding", "--seed", "-1"}},
      {"--seed: Value 1000000001 not in range", {"simulate", "sliding", "--seed", "1000000001"}},
      {"--allow-pixels: Value -1 not in range", {"compare", "a", "b", "--allow-pixels", "-1"}},
      {"--at is one file: f_%04d.png; accepted:", {"render", "sliding", "--at", "0.1", "-o", "f_%04d.png"}},
      {"a moving picture is one file: f_%04d.apng; accepted:", {"render", "sliding", "-o", "f_%04d.apng"}},
      {"--fps is of many frames, -o x.png is one picture",
       {"render", "sliding", "--fps", "10", "-o", "x.png"}},
      {"--duration is of many frames", {"render", "sliding", "--duration", "1", "-o", "x.png"}},
      {"-o x.png: --from has frames; accepted:", {"render", "--from", "r.carom", "-o", "x.png"}},
      {"accepted: without --at", {"render", "sliding", "--states", "-o", "x.png"}},
      {"accepted: without --shard", {"render", "sliding", "--states", "--shard", "1/2"}},
      {"accepted: without a moving picture", {"render", "sliding", "--states", "-o", "x.apng"}},
      {"--camera man: no such camera", {"render", "sliding", "--camera", "man"}},
      {"-o frame.jpg: accepted:", {"render", "sliding", "-o", "frame.jpg"}},
      {"--expect-hash 12: accepted:", {"simulate", "sliding", "--expect-hash", "12"}},
      {"--progress", {"render", "sliding", "--progress", "dots"}},
      {"SCENE", {"render"}},
  };
  for (const auto& [part, arguments] : cases) {
    const ProgramEnd end = runCarom(arguments);
    EXPECT_EQ(end.code, 2) << part;
    EXPECT_EQ(end.out, "");
    expectOneLine(end, part);
  }
}

// 0.04 s at 10 steps a second: the file's fault, of which pictures of its start know nothing.
TEST(Program, ASceneThatHoldsNoStepEndsWith3) {
  const TemporaryFolder folder;
  const std::string scene = folder
                                .file("short.json",
                                      "{ \"format\": 1, \"duration\": 0.04, \"rate\": 10, \"bodies\": [ { "
                                      "\"name\": \"a\", \"shape\": "
                                      "{ \"box\": [1, 1, 1] } } ] }")
                                .string();
  for (const char* command : {"simulate", "check"}) {
    const ProgramEnd end = runCarom({command, scene});
    EXPECT_EQ(end.code, 3) << command;
    EXPECT_EQ(end.out, "") << command;
    expectOneLine(end, "short.json: the duration of 0.04 s holds no step at 10 a second");
    EXPECT_EQ(runCarom({command, scene, "--set", "duration=0.05"}).code, 0) << command;
  }
  EXPECT_EQ(runCarom({"simulate", scene, "--duration", "0.05"}).code, 0);
}

TEST(Program, AMeshThatNoSceneTakesAsItIsIsWarnedOf) {
  const TemporaryFolder folder;
  const std::string mesh =
      folder
          .file("huge.obj", "v 0 0 0\nv 1e7 0 0\nv 0 1e7 0\nv 0 0 1e7\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n")
          .string();
  const ProgramEnd end = runCarom({"check", mesh});
  EXPECT_EQ(end.code, 0) << end.err;
  EXPECT_EQ(end.err.rfind(
                "warning: " + mesh + ": the mesh's longest side is 1e+07 m; accepted: 0.0001 to 100000", 0),
            0u)
      << end.err;
}

TEST(Program, BadScenesAndAssetsEndWith3) {
  const TemporaryFolder folder;
  const std::map<std::string, fs::path> scenes = {
      {"did you mean \"shape\"?",
       folder.file(
           "key.json",
           "{ \"format\": 1, \"bodies\": [ { \"name\": \"a\", \"shap\": { \"box\": [1, 1, 1] } } ] }")},
      {"overlap at the start by 0.5 m",
       folder.file("overlap.json",
                   "{ \"format\": 1, \"bodies\": [ { \"name\": \"a\", \"shape\": { \"box\": [1, 1, 1] }, "
                   "\"repeat\": { \"count\": [2, 1, 1], \"step\": [0.5, 0, 0] } } ] }")},
      {"density 0", folder.file("mass.json",
                                "{ \"format\": 1, \"bodies\": [ { \"name\": \"a\", \"shape\": { \"box\": [1, "
                                "1, 1] }, \"material\": { \"density\": 0 } } ] }")},
      {"flat", folder.file("flat.json",
                           "{ \"format\": 1, \"bodies\": [ { \"name\": \"a\", \"shape\": { \"hull\": { "
                           "\"points\": [[0,0,0],[1,0,0],[0,1,0],[1,1,0]] } } } ] }")},
      {"no such scene file", folder.path() / "none.json"},
      {"did you mean \"sliding\"?", "slidin"},
      {"no such mesh file", folder.path() / "none.stl"},
  };
  for (const auto& [part, scene] : scenes) {
    const ProgramEnd end = runCarom({"check", scene.string()});
    EXPECT_EQ(end.code, 3) << part;
    expectOneLine(end, part);
  }
  EXPECT_EQ(runCarom({"render", (folder.path() / "overlap.json").string()}).code, 3);
  EXPECT_EQ(runCarom({"simulate", "drop-mesh", "--mesh", "none.obj"}).code, 3);
  expectOneLine(runCarom({"check", "sliding", "--hull"}), 3, "takes no --hull: no mesh");
  EXPECT_EQ(runCarom({"check", "drop-mesh", "--hull"}).code, 0);
}

TEST(Program, CheckListsEveryOverlapWithItsDepthAndPlace) {
  const TemporaryFolder folder;
  const fs::path scene = folder.file(
      "s.json",
      "{ \"format\": 1, \"bodies\": [ { \"name\": \"a\", \"shape\": { \"sphere\": { \"radius\": 0.5 } }, "
      "\"repeat\": { \"count\": [4, 1, 1], \"step\": [0.75, 0, 0] } },"
      " { \"name\": \"b\", \"shape\": { \"sphere\": { \"radius\": 1 } }, \"position\": [-1, 0, 0] } ] }");
  const ProgramEnd end = runCarom({"check", scene.string()});
  EXPECT_EQ(end.code, 3);
  EXPECT_EQ(end.out,
            "\"a[0]\" and \"b\" overlap by 0.5 m at (-0.25, 0, 0)\n"
            "\"a[0]\" and \"a[1]\" overlap by 0.25 m at (0.375, 0, 0)\n"
            "\"a[1]\" and \"a[2]\" overlap by 0.25 m at (1.125, 0, 0)\n"
            "\"a[2]\" and \"a[3]\" overlap by 0.25 m at (1.875, 0, 0)\n");
  expectOneLine(end,
                "\"a[0]\" and \"b\" overlap at the start by 0.5 m at (-0.25, 0, 0) (the deepest of 4 pairs");
}

TEST(Program, UnwritableTargetsEndWith4) {
  const TemporaryFolder folder;
  const fs::path scene = folder.file("ball.json", kBall);
  const std::string below_a_file = (scene / "out").string();
  const ProgramEnd render = runCarom({"render", scene.string(), "--size", "64x36", "--progress", "none", "-o",
                                      below_a_file + "/f_%04d.png"});
  EXPECT_EQ(render.code, 4);
  expectOneLine(render, "cannot write " + below_a_file);
  const ProgramEnd simulate =
      runCarom({"simulate", scene.string(), "--progress", "none", "--csv", below_a_file});
  EXPECT_EQ(simulate.code, 4);
  expectOneLine(simulate, "cannot write " + below_a_file);
}

TEST(Program, NoRendererEndsWith6AndSaysHowToGetOne) {
  const ProgramEnd end = runCarom({"doctor"}, {"MESA_GL_VERSION_OVERRIDE=2.1"});
  EXPECT_EQ(end.code, 6);
  expectOneLine(end, "apt-get install libosmesa6");
}

TEST(Program, AnUnknownDriverEndsWith6AndNoPackageIsBlamed) {
  const ProgramEnd end = runCarom({"doctor"}, {"GALLIUM_DRIVER=nonsense"});
  EXPECT_EQ(end.code, 6);
  expectOneLine(end, "GALLIUM_DRIVER=nonsense is no driver that draws here");
  EXPECT_EQ(end.err.find("apt-get"), std::string::npos) << end.err;
}

TEST(Program, DoctorFindsThisMachineFit) {
  const ProgramEnd end = runCarom({"doctor"});
  EXPECT_EQ(end.code, 0) << end.err;
  for (const char* part :
       {"GL renderer", "GL version", "MSAA limit", "test render     ok", "assimp", "missing         nothing"})
    EXPECT_NE(end.out.find(part), std::string::npos) << part << '\n' << end.out;
}

TEST(Program, RenderLeavesExactlyTheFramesAndTheirManifest) {
  const TemporaryFolder folder;
  const fs::path scene = folder.file("ball.json", kBall);
  const Program program({"render", scene.string(), "--fps", "24", "--size", "64x36", "--progress", "json"});
  const ProgramEnd end = program.wait();
  ASSERT_EQ(end.code, 0) << end.err;
  EXPECT_EQ(end.out.rfind("frames/ball/frame_%04d.png  12 frames", 0), 0u) << end.out;
  EXPECT_EQ(Json::parse(end.err.substr(end.err.rfind('{')), "progress").at("frame").asNumber(), 12.0);

  const fs::path frames = program.folder() / "frames/ball";
  EXPECT_EQ(std::distance(fs::directory_iterator(frames), fs::directory_iterator()), 13);
  const Json manifest = Json::parse(readTextFile(frames / "manifest.json"), "manifest.json");
  EXPECT_TRUE(manifest.at("complete").asBoolean());
  ASSERT_EQ(manifest.at("frames").items().size(), 12u);
  std::set<std::string> pictures;
  for (int k = 0; k < 12; ++k) {
    const Json& frame = manifest.at("frames").items()[static_cast<std::size_t>(k)];
    EXPECT_EQ(frame.at("time_s").asNumber(), k / 24.0);
    const renderer::DecodedPng png = renderer::readPng(frames / frame.at("file").asString());
    EXPECT_EQ(png.image.width, 64);
    EXPECT_EQ(png.image.height, 36);
    EXPECT_EQ(hexText(ContentHash().add(png.image.rgb.data(), png.image.rgb.size()).value()),
              frame.at("pixelHash").asString());
    const std::map<std::string, std::string> text(png.text.begin(), png.text.end());
    EXPECT_EQ(text.at("State"), frame.at("stateHash").asString());
    EXPECT_EQ(text.at("Scene"), "ball " + manifest.at("sceneHash").asString());
    pictures.insert(frame.at("pixelHash").asString());
  }
  EXPECT_EQ(pictures.size(), 12u);  // the ball falls: no two frames are alike
}

TEST(Program, SameSceneSamePixels) {
  const TemporaryFolder folder;
  const fs::path scene = folder.file("ball.json", kBall);
  std::vector<std::string> hashes[2];
  for (auto& run : hashes) {
    const Program program({"render", scene.string(), "--size", "64x36", "-q"});
    const ProgramEnd end = program.wait();
    EXPECT_EQ(end.err, "");
    const Json manifest =
        Json::parse(readTextFile(program.folder() / "frames/ball/manifest.json"), "manifest.json");
    for (const Json& frame : manifest.at("frames").items())
      run.push_back(frame.at("stateHash").asString() + frame.at("pixelHash").asString());
  }
  EXPECT_EQ(hashes[0].size(), 15u);
  EXPECT_EQ(hashes[0], hashes[1]);
}

/// Waits until some frames are there, sends the signal, and looks at what is left.
void expectCleanStop(int number) {
  const Program program(
      {"render", "resting", "--size", "64x36", "--fps", "240", "--duration", "600", "--progress", "none"});
  const fs::path frames = program.folder() / "frames/resting";
  for (int i = 0; i < 3000 && framesIn(frames) < 6; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  program.signal(number);
  const ProgramEnd end = program.wait();
  EXPECT_EQ(end.code, 128 + number);
  expectOneLine(end, "interrupted");
  const Json manifest = Json::parse(readTextFile(frames / "manifest.json"), "manifest.json");
  EXPECT_FALSE(manifest.at("complete").asBoolean());
  std::size_t pictures = 0;
  for (const auto& entry : fs::directory_iterator(frames)) {
    EXPECT_EQ(entry.path().string().find(".partial"), std::string::npos);
    if (entry.path().extension() != ".png") continue;
    EXPECT_EQ(renderer::readPng(entry.path()).image.width, 64);
    ++pictures;
  }
  EXPECT_GE(pictures, 6u);
  EXPECT_EQ(manifest.at("frames").items().size(), pictures);
}

TEST(Program, InterruptLeavesOnlyWholeFrames) {
  expectCleanStop(SIGINT);
}
TEST(Program, TerminationLeavesOnlyWholeFrames) {
  expectCleanStop(SIGTERM);
}

TEST(Program, SimulatePrintsAHashThatCanBeExpected) {
  const TemporaryFolder folder;
  const std::string scene = folder.file("ball.json", kBall).string();
  const ProgramEnd first = runCarom({"simulate", scene, "--progress", "none"});
  ASSERT_EQ(first.code, 0) << first.err;
  EXPECT_EQ(first.err, "");
  const std::string hash = first.out.substr(0, 16);
  EXPECT_NE(first.out.find("\nsteps=250 time_s=0.5 bodies=2 "), std::string::npos) << first.out;
  EXPECT_EQ(runCarom({"simulate", scene, "--expect-hash", hash}).code, 0);
  const ProgramEnd differs = runCarom({"simulate", scene, "-q", "--expect-hash", "0123456789abcdef"});
  EXPECT_EQ(differs.code, 1);
  EXPECT_EQ(differs.out, first.out);
  expectOneLine(differs, "state hash " + hash + " differs from the expected 0123456789abcdef");
}

constexpr const char* kManyCrates = R"({ "format": 1, "rate": 60, "duration": 0.1,
  "materials": { "stone": { "staticFriction": 0.5 } },
  "bodies": [
    { "name": "floor", "shape": { "box": [40, 40, 1] }, "position": [0, 0, -0.5], "static": true, "material": "stone" },
    { "name": "crate", "shape": { "box": [0.5, 0.5, 0.5] }, "position": [-4, -4, 0.2505], "material": "stone",
      "linearVelocity": [0.5, 0, 0], "repeat": { "count": [16, 16, 4], "step": [0.5005, 0.5005, 0.5005] } }
  ] })";

TEST(Program, ThreadsChangeNoBitOfALargeIsland) {
  const TemporaryFolder folder;
  const std::string scene = folder.file("crates.json", kManyCrates).string();
  const auto simulated = [&](const std::vector<std::string>& options) {
    std::vector<std::string> arguments{"simulate", scene, "-q"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const ProgramEnd end = runCarom(arguments);
    EXPECT_EQ(end.code, 0) << end.err;
    return end.out;
  };
  const std::string alone = simulated({"--threads", "1"});
  EXPECT_EQ(simulated({"--threads", "2"}), alone);
  EXPECT_EQ(simulated({"--threads", "5"}), alone);
  EXPECT_EQ(simulated({}), alone);
}

TEST(Program, SimulateWritesTrajectoryAndAuditRows) {
  const TemporaryFolder folder;
  const std::string scene = folder.file("ball.json", kBall).string();
  const Program program({"simulate", scene, "-q", "--fps", "24", "--csv", "run.csv", "--audit", "audit.csv"});
  ASSERT_EQ(program.wait().code, 0);
  const std::string csv = readTextFile(program.folder() / "run.csv");
  EXPECT_EQ(csv.rfind("frame,time_s,body,px,py,pz,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz,mode\n", 0), 0u);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 12 * 2);
  EXPECT_NE(csv.find("\n0,0,\"ball\",0,0,2,1,0,0,0,"), std::string::npos);
  const std::string audit = readTextFile(program.folder() / "audit.csv");
  EXPECT_EQ(std::count(audit.begin(), audit.end(), '\n'), 1 + 250);
}

TEST(Program, ListNamesEveryShippedScene) {
  const ProgramEnd end = runCarom({"list", "--json"});
  ASSERT_EQ(end.code, 0) << end.err;
  EXPECT_EQ(Json::parse(end.out, "list").items().size(), shippedScenes().size());
  const ProgramEnd lines = runCarom({"list"});
  EXPECT_EQ(static_cast<std::size_t>(std::count(lines.out.begin(), lines.out.end(), '\n')),
            shippedScenes().size());
}

TEST(Program, CheckSaysInALineWhatASceneHoldsAndInOneWhatAMeshBecame) {
  const ProgramEnd mesh = runCarom({"check", std::string(CAROM_SOURCE_DIR) + "/assets/meshes/hammer.obj"});
  EXPECT_EQ(mesh.code, 0);
  EXPECT_NE(mesh.out.find(": ok  2 parts  16 vertices  12 faces  volume 0.08652"), std::string::npos)
      << mesh.out;
  const ProgramEnd scene =
      runCarom({"check", "drop-mesh", "--mesh", std::string(CAROM_SOURCE_DIR) + "/assets/meshes/hammer.obj"});
  EXPECT_EQ(scene.code, 0) << scene.err;
  EXPECT_EQ(std::count(scene.out.begin(), scene.out.end(), '\n'), 2);
  EXPECT_NE(scene.out.find("  \"mesh\": hammer.obj: 2 surfaces in 2 convex pieces of "), std::string::npos)
      << scene.out;
  const ProgramEnd hull = runCarom({"check", "drop-mesh", "--mesh",
                                    std::string(CAROM_SOURCE_DIR) + "/assets/meshes/hammer.obj", "--hull"});
  EXPECT_NE(hull.out.find("hammer.obj: the convex hulls of 2 meshes of "), std::string::npos) << hull.out;
}

}  // namespace
}  // namespace carom::demos
