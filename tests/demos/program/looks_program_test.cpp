// Presets, styles, other outputs, cameras, slow motion and stills through the program.
#include "tests/demos/support/program_run.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include "demos/format/json.h"
#include "demos/language/scene_file.h"
#include "demos/motion/frame_states.h"
#include "demos/scene/scene_world.h"
#include "renderer/image/png.h"
#include "tests/oracle/pixel_casting.h"

namespace carom::demos {
namespace {
namespace fs = std::filesystem;

constexpr int kWidth = 160, kHeight = 90;

struct Looks : testing::Test {
  TemporaryFolder folder;

  ProgramEnd render(const std::string& out, std::vector<std::string> more,
                    const std::string& scene = "sliding") {
    std::vector<std::string> all{
        "render", scene, "--size", "160x90", "--progress=none", "-o", (folder.path() / out).string()};
    all.insert(all.end(), more.begin(), more.end());
    const ProgramEnd end = runCarom(all);
    EXPECT_EQ(end.code, 0) << end.err;
    return end;
  }
  Files files(const std::string& out) const {
    Files found;
    for (const auto& entry : fs::directory_iterator(folder.path() / out))
      if (entry.path().extension() == ".png")
        found[entry.path().filename().string()] = readTextFile(entry.path());
    return found;
  }
  Json manifest(const std::string& path) const {
    return Json::parse(readTextFile(folder.path() / path), path);
  }
  fs::path file(const std::string& path) const { return folder.path() / path; }
};

std::vector<oracle::CastBody> castBodies(const SceneWorld& made, std::span<const BodyState> states) {
  std::vector<oracle::CastBody> bodies;
  for (std::size_t i = 0; i < states.size(); ++i) {
    const auto solid = static_cast<std::size_t>(made.world.bodies()[i].solid);
    bodies.push_back({&made.world.solids()[solid], states[i].X_WB});
    if (made.looks[i].checker) bodies.back().endless_top = 0.0;  // shipped grounds are level at zero
  }
  return bodies;
}

/// Pixels of a frame's outputs against rays through the engine's solids.
struct Agreement {
  int pixels = 0;
  int on_bodies = 0;
  int wrong_ids = 0;
  int wrong_depths = 0;
  int wrong_normals = 0;
};
Agreement agreementOf(const fs::path& frame, double metres_per_unit, const oracle::CastView& view,
                      const std::vector<oracle::CastBody>& bodies) {
  const auto raster = [&](const char* output) {
    fs::path path = frame;
    return renderer::readPngRaster(path.replace_extension(std::string(output) + ".png")).raster;
  };
  const renderer::Raster depths = raster("depth"), ids = raster("id"), normals = raster("normal");
  const std::vector<oracle::CastPixel> expected = oracle::castPixels(view, bodies);
  Agreement result;
  for (int y = 0; y < view.height; ++y)
    for (int x = 0; x < view.width; ++x) {
      if (!oracle::awayFromOutlines(expected, view.width, view.height, x, y)) continue;
      const oracle::CastPixel& truth = expected[static_cast<std::size_t>(y * view.width + x)];
      ++result.pixels;
      result.on_bodies += truth.body > 0;
      result.wrong_ids += ids.pixel(x, y)[0] != truth.body + 1;
      const double units = truth.body < 0 ? 65535.0 : std::min(65534.0, truth.hit.t / metres_per_unit);
      result.wrong_depths += !(std::abs(depths.pixel(x, y)[0] - units) <= 1.0);
      if (truth.body < 0) continue;
      Vec3 normal;
      for (int i = 0; i < 3; ++i) normal[i] = (normals.pixel(x, y)[i] - 32768) / 32767.0;
      result.wrong_normals += !((normal - truth.hit.normal).norm() < 1e-3);
    }
  return result;
}

// The bar: at least 10 000 pixels, depths within one unit, ids exactly; here in every scene that has its own
// kinds of shapes, at a time between two steps.
TEST_F(Looks, DepthsIdsAndNormalsAgreeWithRaysThroughTheEnginesSolids) {
  for (const char* name : {"fifty-bodies", "imported-meshes", "multi-contact", "bouncing-ball"}) {
    render(std::string(name) + "/f_%04d.png", {"--aov", "id,normal,depth", "--fps", "7", "--frames", "0,5"},
           name);
    const Json json = manifest(std::string(name) + "/manifest.frames-0,5.json");
    const double metres_per_unit = json.at("outputs").at("depth").at("metresPerUnit").asNumber();
    const Scene scene = readSceneFile(findScene(name));
    SceneWorld made = makeSceneWorld(scene, std::nullopt);
    const FrameClock clock({7.0, scene.rate_hz});
    FrameStates source(made.world, clock, [](const World&) {});
    const renderer::Camera& main = scene.cameras.at("main");
    for (const int frame : {0, 5}) {
      const std::vector<oracle::CastBody> bodies = castBodies(made, source.advanceTo(frame));
      const Agreement found =
          agreementOf(file(std::string(name) + "/f_000" + std::to_string(frame) + ".png"), metres_per_unit,
                      {main.eye, main.target, main.fov_degrees, kWidth, kHeight}, bodies);
      EXPECT_GT(found.pixels, 10000) << name;
      EXPECT_GT(found.on_bodies, 200) << name;
      EXPECT_EQ(found.wrong_ids, 0) << name;
      EXPECT_EQ(found.wrong_depths, 0) << name;
      EXPECT_LE(found.wrong_normals, 2) << name;
    }
    const Json& names = json.at("outputs").at("id").at("names");
    ASSERT_EQ(names.items().size(), made.names.size());
    for (std::size_t i = 0; i < made.names.size(); ++i) EXPECT_EQ(names.items()[i].asString(), made.names[i]);
  }
}

TEST_F(Looks, OtherOutputsLeaveTheFramesAsTheyAreAndAreComparedResumedAndSharded) {
  const std::vector<std::string> few{"--fps", "10", "--duration", "0.6"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.end(), few.begin(), few.end());
    return more;
  };
  render("plain/f_%04d.png", with({}));
  render("all/f_%04d.png", with({"--aov", "depth,id"}));
  const Files plain = files("plain"), all = files("all");
  ASSERT_EQ(plain.size(), 6u);
  ASSERT_EQ(all.size(), 18u);
  for (const auto& [name, bytes] : plain) EXPECT_EQ(all.at(name), bytes);
  EXPECT_EQ(manifest("plain/manifest.json").find("outputs"), nullptr);

  for (const char* shard : {"1/2", "2/2"})
    render("shards/f_%04d.png", with({"--aov", "depth,id", "--shard", shard}));
  EXPECT_EQ(files("shards"), all);
  EXPECT_EQ(
      runCarom({"compare", file("shards").string(), file("all").string(), "-q", "--report", "none"}).code, 0);

  // A file that is missing, one that is damaged and one of another frame: three frames are drawn again.
  fs::remove(file("all/f_0001.depth.png"));
  fs::resize_file(file("all/f_0002.id.png"), all.at("f_0002.id.png").size() / 2);
  folder.file("all/f_0003.depth.png", all.at("f_0004.depth.png"));
  const ProgramEnd end = render("all/f_%04d.png", with({"--aov", "depth,id", "--resume"}));
  EXPECT_NE(end.out.find("(3 drawn, 3 kept)"), std::string::npos) << end.out;
  EXPECT_EQ(files("all"), all);
  const Json kept = manifest("all/manifest.json");
  for (const Json& frame : kept.at("frames").items())
    EXPECT_EQ(frame.at("outputs").at("depth").at("pixelHash").asString().size(), 16u);
  for (const Json& frame : kept.at("frames").items()) EXPECT_EQ(frame.at("outputs").members().size(), 2u);
}

TEST_F(Looks, APresetOrStyleMakesFramesOfAnotherStale) {
  const std::vector<std::string> one{"--frames", "0", "--resume"};
  const auto drawn = [&](std::vector<std::string> more) {
    more.insert(more.end(), one.begin(), one.end());
    return render("f/f_%04d.png", more).out.find("(1 drawn, 0 kept)") != std::string::npos;
  };
  EXPECT_TRUE(drawn({}));
  EXPECT_FALSE(drawn({"--preset", "realtime", "--style", "daylight"}));
  EXPECT_TRUE(drawn({"--preset", "fast"}));
  EXPECT_TRUE(drawn({"--style", "print"}));
  EXPECT_FALSE(drawn({"--style", "print"}));
  const Json json = manifest("f/manifest.frames-0.json");
  EXPECT_EQ(json.at("style").asString(), "print");
  EXPECT_EQ(json.find("preset"), nullptr);
}

TEST_F(Looks, SlowMotionShowsExactTimesAndRoundedManyFrames) {
  render("slow/f_%04d.png", {"--speed", "0.1", "--fps", "10", "--duration", "0.33"});
  const Json json = manifest("slow/manifest.json");
  EXPECT_EQ(json.at("fps").asNumber(), 10.0);
  EXPECT_EQ(json.at("speed").asNumber(), 0.1);
  ASSERT_EQ(json.at("frames").items().size(), 33u);
  for (int k = 0; k < 33; ++k)
    EXPECT_DOUBLE_EQ(json.at("frames").items()[static_cast<std::size_t>(k)].at("time_s").asNumber(),
                     k / 100.0);
  // They are the frames of a hundred a second, and those of a recording of that.
  render("many/f_%04d.png", {"--fps", "100", "--duration", "0.33"});
  EXPECT_EQ(files("slow"), files("many"));
  const std::string recording = file("run.carom").string();
  EXPECT_EQ(
      runCarom({"simulate", "sliding", "-q", "--fps", "100", "--duration", "0.33", "-o", recording}).code, 0);
  render("recorded/f_%04d.png", {"--from", recording, "--speed", "0.1"});
  EXPECT_EQ(files("recorded"), files("slow"));
  EXPECT_EQ(manifest("recorded/manifest.json").at("fps").asNumber(), 10.0);
}

TEST_F(Looks, AStillIsTheFrameOfItsTime) {
  render("frames/f_%04d.png", {"--fps", "24", "--frames", "6"});  // 0.25 s: a step of 240 a second
  render("still.png", {"--at", "0.25", "--aov", "depth"});
  const renderer::DecodedPng frame = renderer::readPng(file("frames/f_0006.png"));
  const renderer::DecodedPng still = renderer::readPng(file("still.png"));
  EXPECT_EQ(still.image.rgb, frame.image.rgb);
  EXPECT_TRUE(fs::exists(file("still.depth.png")));
  EXPECT_EQ(manifest("still.manifest.json").at("frames").items().at(0).at("time_s").asNumber(), 0.25);
  EXPECT_FALSE(fs::exists(file("manifest.json")));
  // Between two steps: a frame of a clock whose step does not divide the time.
  render("between/f_%04d.png", {"--fps", "7", "--frames", "3"});
  render("between.png", {"--at", "0.42857142857142855"});
  EXPECT_EQ(renderer::readPng(file("between.png")).image.rgb,
            renderer::readPng(file("between/f_0003.png")).image.rgb);
  EXPECT_NE(renderer::readPng(file("between.png")).image.rgb, still.image.rgb);
}

TEST_F(Looks, MovingCamerasGiveARecordingTheSameBytes) {
  const std::string recording = file("run.carom").string();
  EXPECT_EQ(runCarom({"simulate", "resting", "-q", "--fps", "8", "--duration", "1", "-o", recording}).code,
            0);
  std::string first_body;
  {
    const SceneWorld made = makeSceneWorld(readSceneFile(findScene("resting")), std::nullopt);
    first_body = made.names.back();
  }
  for (const std::string& camera :
       {std::string("orbit"), "follow:" + first_body, std::string("fit"), std::string("auto")}) {
    fs::remove_all(file("a"));
    fs::remove_all(file("b"));
    render("a/f_%04d.png", {"--camera", camera, "--fps", "8", "--duration", "1", "--frames", "2,7"},
           "resting");
    render("b/f_%04d.png", {"--camera", camera, "--from", recording, "--frames", "2,7"}, "resting");
    EXPECT_EQ(files("a"), files("b")) << camera;
    EXPECT_NE(files("a").at("f_0002.png"), files("a").at("f_0007.png")) << camera;
    EXPECT_EQ(manifest("a/manifest.frames-2,7.json").at("camera").asString(), camera);
  }
}

TEST_F(Looks, AShardHasTheFramesOfTheWholeWithACameraThatFramesTheRun) {
  const std::vector<std::string> framed{"--camera", "auto", "--fps", "4", "--duration", "1"};
  std::vector<std::string> part = framed, shorter = framed;
  part.insert(part.end(), {"--shard", "2/2", "--workers", "2"});
  shorter.back() = "0.75";
  render("whole/f_%04d.png", framed);
  render("part/f_%04d.png", part);
  render("shorter/f_%04d.png", shorter);
  Files whole = files("whole");
  for (const auto& [name, bytes] : files("part")) EXPECT_EQ(whole.at(name), bytes) << name;
  for (const auto& [name, bytes] : files("shorter")) EXPECT_EQ(whole.at(name), bytes) << name;
}

TEST_F(Looks, ACaptionIsDrawnUnlessItIsTurnedOffAndIntoPortableFramesOnlyWhenAskedFor) {
  const std::vector<std::string> one{"--frames", "0"};
  const auto pixels = [&](const std::string& out, std::vector<std::string> more) {
    more.insert(more.end(), one.begin(), one.end());
    render(out + "/f_%04d.png", more, "resting");
    return renderer::readPng(file(out + "/f_0000.png")).image;
  };
  const renderer::Image with = pixels("with", {}), without = pixels("without", {"--caption", "off"});
  const auto rowsThatDiffer = [](const renderer::Image& a, const renderer::Image& b) {
    std::vector<int> rows;
    for (int y = 0; y < a.height; ++y)
      if (!std::equal(a.pixel(0, y), a.pixel(0, y) + 3 * a.width, b.pixel(0, y))) rows.push_back(y);
    return rows;
  };
  const std::vector<int> rows = rowsThatDiffer(with, without);
  ASSERT_FALSE(rows.empty());
  EXPECT_GT(rows.front(), kHeight / 2);
  EXPECT_TRUE(manifest("with/manifest.frames-0.json").at("caption").asBoolean());
  EXPECT_EQ(manifest("without/manifest.frames-0.json").find("caption"), nullptr);
  const renderer::Image portable = pixels("portable", {"--portable"});
  EXPECT_EQ(portable.rgb, pixels("off", {"--portable", "--caption", "off"}).rgb);
  EXPECT_FALSE(rowsThatDiffer(portable, pixels("on", {"--portable", "--caption", "on"})).empty());
}

TEST_F(Looks, AnOrbitingCameraIsWhereTheTimeSays) {
  const fs::path scene = folder.file("still.json", R"({ "format": 1, "duration": 6, "bodies": [
      { "name": "post", "shape": { "box": [1, 2, 3] }, "position": [1, 0, 0], "static": true } ],
      "cameras": { "main": { "orbit": { "target": [0, 0, 0], "radius": 9, "degreesPerSecond": 90 } } } })");
  render("round/f_%04d.png", {"--fps", "1"}, scene.string());
  const Json json = manifest("round/manifest.json");
  const auto pixels = [&](std::size_t second) {
    return json.at("frames").items().at(second).at("pixelHash").asString();
  };
  EXPECT_EQ(pixels(4), pixels(0));
  EXPECT_EQ(pixels(5), pixels(1));
  EXPECT_NE(pixels(1), pixels(0));
  EXPECT_NE(pixels(2), pixels(0));
}

// The same pixels by one process and by two, kept by --resume, with alpha in the files and the light in their
// text.
TEST_F(Looks, WithoutABackgroundFramesHaveAlphaAndAreResumedAndShared) {
  const std::vector<std::string> options{"--frames", "0-3", "--background", "none", "--light", "sunset"};
  std::vector<std::string> one = options, two = options;
  one.insert(one.end(), {"--workers", "1"});
  two.insert(two.end(), {"--workers", "2"});
  render("one/frame_%04d.png", one);
  render("two/frame_%04d.png", two);
  EXPECT_EQ(files("one"), files("two"));
  const renderer::DecodedRaster frame = renderer::readPngRaster(file("one/frame_0000.png"));
  ASSERT_EQ(frame.raster.channels, 4);
  EXPECT_EQ(frame.raster.pixel(0, 0)[3], 0);  // Sky.
  const auto has = [&](const char* key, const char* value) {
    return std::any_of(frame.text.begin(), frame.text.end(),
                       [&](const auto& pair) { return pair.first == key && pair.second == value; });
  };
  EXPECT_TRUE(has("Background", "none"));
  EXPECT_TRUE(has("Light", "sunset"));
  one.push_back("--resume");
  EXPECT_NE(render("one/frame_%04d.png", one).out.find("0 drawn, 4 kept"), std::string::npos);
}

// What moves is blurred, what rests is not, and any number of workers shows the same.
TEST_F(Looks, AnOpenShutterIsTheSameForAnyWorkers) {
  const std::vector<std::string> options{"--frames", "6-9", "--preset", "quality"};
  std::vector<std::string> sharp = options, one = options, two = options;
  one.insert(one.end(), {"--shutter", "180", "--workers", "1"});
  two.insert(two.end(), {"--shutter", "180", "--workers", "2"});
  render("sharp/frame_%04d.png", sharp);
  render("one/frame_%04d.png", one);
  render("two/frame_%04d.png", two);
  EXPECT_EQ(files("one"), files("two"));
  EXPECT_NE(files("one"), files("sharp"));
}

TEST(LooksRefuse, InOneLineWithWhatIsAccepted) {
  const std::map<std::string, std::vector<std::string>> cases = {
      {"--preset", {"--preset", "fancy"}},
      {"--style", {"--style", "dark"}},
      {"unknown output \"depths\"; did you mean \"depth\"?", {"--aov", "depths"}},
      {"--background none with --sheet: accepted: PNG frames", {"--background", "none", "--sheet", "2x2"}},
      {"--background none with --overlay", {"--background", "none", "--overlay", "modes"}},
      {"--background none with --style print", {"--background", "none", "--style", "print"}},
      {"--shutter with --preset realtime: accepted: --preset quality", {"--shutter", "180"}},
      {"--shutter with --at", {"--shutter", "180", "--preset", "quality", "--at", "1"}},
      {"--light", {"--light", "noon"}},
      {"--speed 0: accepted: 0.001 to 1000", {"--speed", "0"}},
      {"--speed nan: accepted: 0.001", {"--speed", "nan"}},
      {"holds more than 10000000 frames", {"--speed", "0.001", "--fps", "1000", "--duration", "3600"}},
      {"--at -1: accepted: 0 to 3600", {"--at", "-1"}},
      {"accepted with --at: a name that ends in .png", {"--at", "1", "-o", "still.jpg"}},
      {"--frames excludes --at", {"--at", "1", "--frames", "0"}},
      {"--speed excludes --at", {"--at", "1", "--speed", "0.5"}},
      {"accepted with --stream: one of depth", {"--aov", "id,depth", "-o", "-", "--stream", "ppm"}},
      {"accepted with --aov: png or ppm", {"--aov", "id", "-o", "-", "--stream", "rgb24"}},
      {"accepted: with frames", {"--aov", "id", "--ffmpeg", "a.mp4"}},
      {"no such body in", {"--camera", "follow:nobody"}},
      {"did you mean \"orbit\"?", {"--camera", "orbti"}},
  };
  for (const auto& [part, more] : cases) {
    std::vector<std::string> arguments{"render", "sliding"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProgramEnd end = runCarom(arguments);
    EXPECT_EQ(end.code, 2) << part;
    EXPECT_EQ(std::count(end.err.begin(), end.err.end(), '\n'), 1) << end.err;
    EXPECT_NE(end.err.find(part), std::string::npos) << part << ": " << end.err;
  }
}

}  // namespace
}  // namespace carom::demos
