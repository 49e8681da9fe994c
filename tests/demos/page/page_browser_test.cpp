// Pages that play a run, opened from disk in headless Chromium: a known body's pixels lie where the renderer
// puts them and have the colours that it gives them, a link gives its moment, keys and controls do what they
// say, and nothing is asked of anybody. What a frame costs is measured by tests/bench/pages.py. Needs
// Debian's chromium; without it the tests are skipped.
#include "tests/demos/support/program_run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <sstream>

#include "demos/language/scene_choice.h"
#include "demos/language/scene_file.h"
#include "demos/motion/frame_source.h"
#include "demos/scene/camera_path.h"
#include "renderer/frame/frame_renderer.h"
#include "renderer/image/png.h"
#include "renderer/look/surface.h"
#include "tests/demos/support/chromium.h"

namespace carom::demos {
namespace {
namespace fs = std::filesystem;

// WebGL on the CPU: of several seconds of virtual time every frame is drawn.
constexpr char kWebGl[] =
    "--use-angle=swiftshader --enable-unsafe-swiftshader --ignore-gpu-blocklist --window-size=1000,700 "
    "--virtual-time-budget=8000";

constexpr char kScene[] =
    R"({ "format": 1, "duration": 1, "description": "a <die>", "lookFor": "the die turns",
  "materials": { "die": { "color": "#ff00ff", "density": 500 }, "ground": { "checker": true } },
  "bodies": [
    { "name": "floor", "shape": { "box": [30, 30, 1] }, "position": [0, 0, -0.5], "static": true, "material": "ground" },
    { "name": "die", "shape": { "box": [0.6, 0.4, 0.5] }, "position": [0.8, 0.3, 1.5],
      "rotation": { "axis": [1, 2, 0.5], "degrees": 40 }, "angularVelocity": [1, 2, 3], "material": "die" },
    { "name": "ball", "shape": { "sphere": { "radius": 0.3 } }, "position": [-1, 0, 0.8], "linearVelocity": [1, 0, 0] } ],
  "cameras": { "main": { "eye": [3, -4.5, 2.2], "target": [0.2, 0, 0.7], "fovDegrees": 38 },
               "turning": { "orbit": { "target": [0, 0, 0.5], "radius": 5, "height": 2 } } } })";

struct PageInChromium : testing::Test {
  void SetUp() override {
    if (!hasChromium()) GTEST_SKIP() << kNoChromium;
  }
  TemporaryFolder folder;
  fs::path scene = folder.file("die.json", kScene);

  fs::path page() const {
    const fs::path file = folder.path() / "die.html";
    EXPECT_EQ(runCarom({"export", scene.string(), file.string(), "-q"}).code, 0);
    return file;
  }
};

/// What a visitor's script notes once the page has started.
std::vector<std::string> noted(const fs::path& page, const std::string& script, const std::string& options) {
  return notesOf(page,
                 "while (!globalThis.caromStarted) await new Promise(done => setTimeout(done, 10));\n"
                 "await caromStarted;\n" +
                     script,
                 options);
}

/// The middle of the pixels of a body in the renderer's own picture.
Vec2 middleOf(const fs::path& file, const std::string& name, const std::string& camera, double time_s,
              int width, int height) {
  const Scene scene = readSceneFile(file);
  SceneWorld made = makeSceneWorld(scene, std::nullopt);
  const FrameClock clock = FrameClock::still(time_s, scene.rate_hz);
  RunFacts facts;
  FrameSource source(made, clock, facts);
  const FrameState state = source.at(0);
  const CameraPath path(chosenCamera(scene, camera).camera, made, static_cast<double>(width) / height);
  renderer::Settings settings;
  settings.width = width;
  settings.height = height;
  renderer::FrameRenderer pictures(settings, made.drawnSolids());
  pictures.draw(drawnInstances(made, state.bodies), path.at(time_s, state.bodies));
  const renderer::SurfaceImage& surfaces = pictures.surfaces();
  const auto wanted = std::find(made.names.begin(), made.names.end(), name) - made.names.begin();
  Vec2 sum = Vec2::Zero();
  int count = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      if (surfaces.instance[static_cast<std::size_t>(y * width + x)] == wanted) {
        sum += Vec2(x + 0.5, y + 0.5);
        ++count;
      }
  EXPECT_GT(count, 1000);
  return sum / std::max(count, 1);
}

// A body of each surface in a row, a slab of each ground before it; level and at rest, at sunset.
std::string sceneOfEveryLook() {
  std::ostringstream materials, bodies;
  const auto add = [&](const char* kind, const std::string& name, const char* box, double x,
                       const char* rest) {
    materials << ", \"" << kind << ' ' << name << "\": { \"" << kind << "\": \"" << name
              << (kind == std::string("surface") && name != "plain" ? "\", \"surfaceScale\": 3 }" : "\" }");
    bodies << ", { \"name\": \"" << kind << ' ' << name << R"(", "static": true, "shape": { "box": )" << box
           << R"( }, "rotation": { "axis": [0, 0, 1], "degrees": 25 }, "position": [)" << x << rest
           << R"(, "material": ")" << kind << ' ' << name << "\" }";
  };
  double x = -6.0;
  for (const std::string& surface : renderer::surfaceNames()) {
    add("surface", surface, "[0.9, 0.8, 1.2]", x, ", 1.5, 0.7]");
    x += 1.5;
  }
  x = -5.2;
  for (const std::string& ground : renderer::groundNames()) {
    if (ground == "concrete") continue;
    add("ground", ground, "[2, 1.6, 0.3]", x, ", -1.2, 0.2]");
    x += 2.6;
  }
  std::ostringstream scene;
  scene
      << R"({ "format": 1, "duration": 0.1, "light": "sunset", "caption": "t = {=time:3} s",
    "materials": { "floor": { "ground": "concrete" })"
      << materials.str() << R"( }, "bodies": [
    { "name": "floor", "shape": { "box": [60, 60, 1] }, "position": [0, 0, -0.5], "static": true, "material": "floor" })"
      << bodies.str()
      << R"( ], "cameras": { "main": { "eye": [0.5, -9, 3.5], "target": [0, 0, 0.6], "fovDegrees": 46 } } })";
  return scene.str();
}

/// The picture of the start that `carom render` draws, and who is seen where.
struct Drawn {
  renderer::Image image;
  std::vector<int> instance;
  std::vector<std::string> names;

  Drawn(const fs::path& file, int width, int height) {
    const Scene scene = readSceneFile(file);
    SceneWorld made = makeSceneWorld(scene, std::nullopt);
    const CameraPath path(chosenCamera(scene, "main").camera, made, static_cast<double>(width) / height);
    renderer::Settings settings{.width = width, .height = height};
    settings.light = scene.light.light;
    renderer::FrameRenderer pictures(settings, made.drawnSolids());
    image = pictures.draw(drawnInstances(made, made.world.states()), path.at(0.0, made.world.states()));
    for (const auto number : pictures.surfaces().instance) instance.push_back(static_cast<int>(number));
    names = made.names;
  }

  /// Whether only that body is seen there and beside it, in colours so alike that no edge is filtered.
  bool isInside(int x, int y) const {
    constexpr int kReach = 2, kAlike = 8;  // Pixels; of 255.
    if (x < kReach || y < kReach || x >= image.width - kReach || y >= image.height - kReach) return false;
    const auto at = [&](int u, int v) { return instance[static_cast<std::size_t>(v * image.width + u)]; };
    for (int v = y - kReach; v <= y + kReach; ++v)
      for (int u = x - kReach; u <= x + kReach; ++u)
        if (at(u, v) != at(x, y) || difference(image.pixel(u, v), image.pixel(x, y)) > kAlike) return false;
    return true;
  }
  /// The most that a channel differs.
  template <typename A, typename B>
  static int difference(const A& a, const B& b) {
    int most = 0;
    for (int c = 0; c < 3; ++c) most = std::max(most, std::abs(int{a[c]} - int{b[c]}));
    return most;
  }
};

// Where the die's magenta is, after the picture's size.
constexpr char kLookForMagenta[] = R"js(
  const lookForMagenta = () => {
    carom.draw();
    const { gl } = carom.graphics, { width, height } = carom.view, pixels = new Uint8Array(4 * width * height);
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    let x = 0, y = 0, count = 0;
    for (let at = 0; at < pixels.length; at += 4) {
      if (Math.min(pixels[at], pixels[at + 2]) < pixels[at + 1] + 40) continue;
      const place = at / 4;
      x += place % width + 0.5;
      y += height - Math.floor(place / width) - 0.5;
      ++count;
    }
    return [width, height, x / count, y / count];
  };
  carom.setPlaying(false);
)js";

TEST_F(PageInChromium, ABodyIsWhereTheRendererPutsIt) {
  const std::vector<std::string> notes = noted(page(), std::string(kLookForMagenta) + R"js(
    for (const [time, camera] of [[0.4, "main"], [0.7, "main"], [0.25, "turning"]]) {
      carom.chooseCamera(camera);
      carom.seek(time);
      const [width, height, x, y] = lookForMagenta();
      notes.push(String(width), String(height), String(x), String(y));
      notes.push(String(carom.graphics.pick(carom.view, x, y)), String(carom.graphics.gl.getError()));
    }
  )js",
                                               kWebGl);
  ASSERT_EQ(notes.size(), 18u) << notes[0];
  const std::array<std::pair<double, std::string>, 3> moments = {
      {{0.4, "main"}, {0.7, "main"}, {0.25, "turning"}}};
  for (std::size_t i = 0; i < moments.size(); ++i) {
    const int width = std::stoi(notes[6 * i]), height = std::stoi(notes[6 * i + 1]);
    ASSERT_GE(10 * width, 14 * height) << "in a wide picture the page's camera is the scene's";
    const Vec2 seen(std::stod(notes[6 * i + 2]), std::stod(notes[6 * i + 3]));
    const Vec2 wanted = middleOf(scene, "die", moments[i].second, moments[i].first, width, height);
    EXPECT_LE((seen - wanted).norm(), 1.5) << seen.transpose() << " and " << wanted.transpose();
    EXPECT_EQ(notes[6 * i + 4], "1") << "a click there is on the die";
    EXPECT_EQ(notes[6 * i + 5], "0") << "an error of WebGL";
  }
}

struct Count {
  int pixels = 0, equal = 0;
  double sum = 0.0;
};

/// Of each body and of the sky, by name: how a page's first picture, which is in the notes of kTakePicture,
/// is that of `carom render`, away from edges.
std::map<std::string, Count> comparedToRender(const std::vector<std::string>& notes, const fs::path& scene) {
  std::map<std::string, Count> counts;
  if (notes.size() != 5u) return counts;
  const int width = std::stoi(notes[0]), height = std::stoi(notes[1]);
  const Drawn drawn(scene, width, height);
  const auto shown = [&](int x, int y) {
    const std::size_t at = 8 * static_cast<std::size_t>((height - 1 - y) * width + x);
    std::array<int, 3> color{};
    for (std::size_t c = 0; c < 3; ++c) color[c] = std::stoi(notes[4].substr(at + 2 * c, 2), nullptr, 16);
    return color;
  };
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      if (!drawn.isInside(x, y)) continue;
      const int who = drawn.instance[static_cast<std::size_t>(y * width + x)];
      Count& count = counts[who < 0 ? "sky" : drawn.names[static_cast<std::size_t>(who)]];
      const int difference = Drawn::difference(shown(x, y), drawn.image.pixel(x, y));
      ++count.pixels;
      count.equal += difference <= 3 ? 1 : 0;
      count.sum += difference;
    }
  return counts;
}

constexpr char kTakePicture[] = R"js(
  carom.setPlaying(false);
  carom.seek(0);
  carom.draw();
  const { gl } = carom.graphics, { width, height } = carom.view, pixels = new Uint8Array(4 * width * height);
  gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
  notes.push(String(width), String(height), String(gl.getError()), document.getElementById("caption").textContent,
             Array.from(pixels, byte => byte.toString(16).padStart(2, "0")).join(""));
)js";

// The shaders are the same texts. What differs on a page: normals are rounded to a tenth of a degree, corners
// to a 65535th of a side, light is a polynomial of the framebuffer there and a power here, four samples a
// pixel stand for the filter of edges, and the shadow map has twice the texels. Away from edges the first
// three are left.
TEST_F(PageInChromium, SurfacesGroundsAndLightAreThoseOfAFrame) {
  scene = folder.file("die.json", sceneOfEveryLook());
  const std::vector<std::string> notes = noted(page(), kTakePicture, kWebGl);
  ASSERT_EQ(notes.size(), 5u) << notes[0];
  EXPECT_EQ(notes[2], "0") << "an error of WebGL";
  EXPECT_EQ(notes[3], "t = 0.000 s");
  const std::map<std::string, Count> counts = comparedToRender(notes, scene);
  EXPECT_EQ(counts.size(), 1u + renderer::surfaceNames().size() + renderer::groundNames().size());
  for (const auto& [name, count] : counts) {
    EXPECT_GT(count.pixels, 100) << name;
    EXPECT_GE(count.equal, 0.97 * count.pixels) << name << ": " << count.pixels << " pixels";
    EXPECT_LE(count.sum, 1.0 * count.pixels) << name << ": the mean difference";
  }
}

/// A picture of 6 x 4 squares of different colours, each of `side` pixels.
std::string squaresPng(int side) {
  renderer::Image image{6 * side, 4 * side, {}};
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const int u = x / side, v = y / side;
      for (const int channel : {40 * u + 20, 60 * v + 30, 255 - 40 * ((u + 2 * v) % 6)})
        image.rgb.push_back(static_cast<std::uint8_t>(channel));
    }
  const std::vector<std::uint8_t> bytes = renderer::encodeSmallPng(image);
  return std::string(bytes.begin(), bytes.end());
}

/// A cube of 1 m about its middle whose upper face and +x, -y sides are covered, the last by a picture that
/// is there three times and a half.
void writeCoveredCube(const TemporaryFolder& folder) {
  folder.file("large.png", squaresPng(40));
  folder.file("small.png", squaresPng(8));
  folder.file("cube.mtl",
              "newmtl plain\nKd 0.9 0.6 0.2\nnewmtl large\nKd 1 1 1\nmap_Kd large.png\n"
              "newmtl small\nKd 0.9 0.9 1\nmap_Kd small.png\n");
  folder.file("cube.obj", R"(mtllib cube.mtl
v -0.5 -0.5 -0.5
v 0.5 -0.5 -0.5
v 0.5 0.5 -0.5
v -0.5 0.5 -0.5
v -0.5 -0.5 0.5
v 0.5 -0.5 0.5
v 0.5 0.5 0.5
v -0.5 0.5 0.5
vt 0 0
vt 1 0
vt 1 1
vt 0 1
vt -0.5 0
vt 3 0
vt 3 1
vt -0.5 1
usemtl plain
f 4 3 2 1
f 3 4 8 7
f 4 1 5 8
usemtl large
f 5/1 6/2 7/3 8/4
f 2/1 3/2 7/3 6/4
usemtl small
f 1/5 2/6 6/7 5/8
)");
}

TEST_F(PageInChromium, BodiesAreDrawnAsTheyLookWithTheirPictures) {
  writeCoveredCube(folder);
  scene = folder.file("die.json", R"({ "format": 1, "duration": 0.1, "gravity": [0, 0, 0], "bodies": [
    { "name": "floor", "shape": { "box": [30, 30, 1] }, "position": [0, 0, -0.5], "static": true,
      "material": { "ground": "concrete" } },
    { "name": "covered", "shape": { "mesh": { "file": "cube.obj" } }, "position": [-1.7, 0, 1],
      "rotation": { "axis": [0, 0, 1], "degrees": -30 } },
    { "name": "tinted", "shape": { "mesh": { "file": "cube.obj" } }, "position": [0, 0.4, 1],
      "rotation": { "axis": [0, 0, 1], "degrees": -40 }, "material": { "color": "#80c0ff" } },
    { "name": "seen", "shape": { "sphere": { "radius": 0.1 } }, "position": [1.5, 0, 1],
      "rotation": { "axis": [0, 0, 1], "degrees": -50 }, "material": { "surface": "wood" },
      "visual": { "file": "cube.obj", "fit": 1.2 } },
    { "name": "glass", "shape": { "sphere": { "radius": 0.2 } }, "position": [-0.7, -1.3, 0.6],
      "rotation": { "axis": [0, 0, 1], "degrees": -20 }, "material": { "surface": "glass" },
      "visual": { "file": "cube.obj", "fit": 0.5 } },
    { "name": "plain", "shape": { "box": [0.5, 0.5, 0.5] }, "position": [0.3, -1.2, 1] } ],
    "cameras": { "main": { "eye": [0.6, -5, 3.2], "target": [0, 0, 0.6], "fovDegrees": 44 } } })");
  const std::vector<std::string> notes = noted(page(), kTakePicture, kWebGl);
  ASSERT_EQ(notes.size(), 5u) << notes[0];
  EXPECT_EQ(notes[2], "0") << "an error of WebGL";
  const std::map<std::string, Count> counts = comparedToRender(notes, scene);
  EXPECT_EQ(counts.size(), 6u + counts.count("sky"));
  for (const auto& [name, count] : counts) {
    EXPECT_GT(count.pixels, 1000) << name;
    EXPECT_GE(count.equal, 0.97 * count.pixels) << name << ": " << count.pixels << " pixels";
    EXPECT_LE(count.sum, 1.0 * count.pixels) << name << ": the mean difference";
  }
}

TEST_F(PageInChromium, ALinkGivesItsMomentAndPlayingWritesOne) {
  const std::vector<std::string> notes = noted(page(), R"js(
    const state = () => notes.push([carom.time.toFixed(3), carom.free ? "free" : carom.recording.cameras[carom.camera].name,
      carom.speed, [...carom.chosen].sort().join("+"), carom.selected, carom.playing].join(" "));
    state();
    location.hash = "#t=0.25&camera=turning&speed=0.5&overlays=contacts,modes&body=ball";
    await new Promise(done => setTimeout(done, 100));
    state();
    location.hash = "#t=9&camera=free&eye=1,-8,3&target=0,0,1&speed=77&overlays=nonsense&body=nobody";
    await new Promise(done => setTimeout(done, 100));
    state();
    notes.push(JSON.stringify(carom.cameraNow()));
    carom.chooseCamera("main");
    carom.setSpeed(0.25);
    carom.seek(0.1);
    carom.setPlaying(true);
    carom.advance(0.5);  // virtual time has no frames of its own
    carom.writeLinkNow(performance.now());
    const written = new URLSearchParams(location.hash.slice(1));
    notes.push(written.get("camera"), written.get("speed"), written.get("t"));
    carom.setPlaying(false);
    carom.seekByHand(0.5);
    carom.writeLinkNow(performance.now());
    notes.push(location.hash);
  )js",
                                               kWebGl);
  const std::vector<std::string> expected = {"0.000 main 1   true",  // no link: it plays
                                             "0.250 turning 0.5 contacts+modes 2 false",
                                             "0.983 free 4  2 false",
                                             "{\"eye\":[1,-8,3],\"target\":[0,0,1],\"fov\":40}",
                                             "main",
                                             "0.25",
                                             "0.225",
                                             "#t=0.5&camera=main&speed=0.25&body=ball"};
  ASSERT_EQ(notes.size(), expected.size()) << notes[0];
  // The first moment plays on while it is looked at.
  EXPECT_EQ(notes[0].substr(notes[0].find(' ')), expected[0].substr(expected[0].find(' ')));
  for (std::size_t i = 1; i < expected.size(); ++i) EXPECT_EQ(notes[i], expected[i]);
}

TEST_F(PageInChromium, KeysAndControlsDoWhatTheySay) {
  const std::vector<std::string> notes = noted(page(), R"js(
    const key = (name, shift = false) => document.body.dispatchEvent(
      new KeyboardEvent("keydown", { key: name, shiftKey: shift, bubbles: true, cancelable: true }));
    key(" ");
    notes.push("plays " + carom.playing);
    key("Home"); key("ArrowRight"); key("ArrowRight"); key("ArrowLeft");
    notes.push("frame " + carom.frame);
    key("ArrowRight", true);
    notes.push("frame " + carom.frame);
    key("ArrowDown");
    notes.push("speed " + carom.speed);
    key("c");
    notes.push(document.getElementById("camera").value);
    key("a");
    notes.push(document.getElementById("camera").value);
    key("1"); key("3");
    notes.push([...carom.chosen].join("+"));
    key("n");
    carom.draw();
    notes.push(document.getElementById("card-name").textContent, String(document.getElementById("card").hidden));
    document.getElementById("follow").click();
    carom.seek(0.9);
    carom.draw();
    const from = carom.recording.positionOf(1), to = carom.view.target;
    notes.push("follows " + (Math.hypot(...from.map((x, i) => x - to[i])) < 1e-6));
    key("Escape");
    notes.push(String(document.getElementById("card").hidden));
    document.getElementById("time").value = 12;
    document.getElementById("time").dispatchEvent(new Event("input"));
    notes.push("frame " + carom.frame, document.getElementById("name").textContent,
               document.querySelector(".look").textContent, String(document.querySelectorAll("pre")[1].textContent.includes("lookFor")));
    const touch = document.getElementById("touch"), before = carom.cameraNow().eye;
    const point = (kind, x, y, id) => touch.dispatchEvent(new PointerEvent(kind,
      { pointerId: id, clientX: x, clientY: y, button: 0, buttons: 1, bubbles: true, pointerType: "touch" }));
    touch.setPointerCapture = () => {};
    point("pointerdown", 300, 300, 1); point("pointerdown", 400, 300, 2); point("pointermove", 500, 300, 2);
    point("pointerup", 500, 300, 2); point("pointerup", 300, 300, 1);
    const length = ({ eye, target }) => Math.hypot(...eye.map((x, i) => x - target[i]));
    notes.push("pinch " + (length(carom.cameraNow()) < Math.hypot(...before.map((x, i) => x - carom.cameraNow().target[i]))));
  )js",
                                               kWebGl);
  const std::vector<std::string> expected = {"plays false", "frame 1",       "frame 31",       "speed 0.5",
                                             "turning",     "free",          "contacts+modes", "die",
                                             "false",       "follows true",  "true",           "frame 12",
                                             "die",         "the die turns", "true",           "pinch true"};
  EXPECT_EQ(notes, expected);
}

TEST_F(PageInChromium, AsksNobodyForAnythingAndComplainsOfNothing) {
  const fs::path file = page();
  // Before the page's own script: what goes wrong, and what the browser does not let through.
  std::string html = readTextFile(file);
  html.replace(
      html.find("<style>"), 0,
      "<script>window.problems = []; for (const kind of ['error', 'warn']) { const old = console[kind]; "
      "console[kind] = (...words) => { problems.push(kind + ' ' + words.join(' ')); old(...words); }; } "
      "addEventListener('error', event => problems.push(event.message)); "
      "addEventListener('unhandledrejection', event => problems.push(String(event.reason))); "
      "addEventListener('securitypolicyviolation', event => problems.push(event.blockedURI));</script>");
  std::ofstream(file) << html;
  const std::vector<std::string> notes = noted(file, R"js(
    for (const name of ["contacts", "impulses", "modes", "gaps", "regions", "velocities", "trails", "names"]) carom.setOverlay(name, true);
    carom.select(1);
    for (let frame = 0; frame < carom.recording.frames; frame += 7) { carom.seek(frame / carom.recording.fps); carom.draw(); }
    const fetched = performance.getEntriesByType("resource").filter(entry => !entry.name.startsWith("data:"));
    notes.push("outside " + fetched.length, "problems " + problems.join("; "), String(carom.graphics.gl.getError()));
    const ink = carom.ink.context.getImageData(0, 0, carom.view.width, carom.view.height).data;
    notes.push("inked " + ink.some(channel => channel > 0));
  )js",
                                               kWebGl);
  EXPECT_EQ(notes, (std::vector<std::string>{"outside 0", "problems ", "0", "inked true"}));
}

TEST_F(PageInChromium, StandsStillForWhoPrefersThat) {
  EXPECT_EQ(noted(page(), "notes.push(String(carom.playing));",
                  std::string(kWebGl) + " --force-prefers-reduced-motion"),
            std::vector<std::string>{"false"});
}

}  // namespace
}  // namespace carom::demos
