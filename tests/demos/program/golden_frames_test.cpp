// Visual regression of every shipped scene: three frames at 320x180, drawn with pixels that are the same on
// every CPU, against the golden ones under tests/golden/. A failure says whether physics moved or the
// renderer changed, and prints the command that accepts the new frames. What the gate can and cannot see is
// tested beside it.

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include <gtest/gtest.h>

#include "demos/asset/asset_path.h"
#include "demos/language/scene_file.h"
#include "demos/regress/regress_suite.h"
#include "demos/scene/drawn_water.h"
#include "demos/scene/scene_world.h"
#include "renderer/frame/frame_renderer.h"
#include "renderer/image/image_difference.h"
#include "renderer/image/png.h"
#include "renderer/view/projection.h"
#include "tests/demos/support/png_files.h"
#include "tests/demos/support/program_run.h"

namespace carom::demos {
namespace {
namespace fs = std::filesystem;

constexpr int kWidth = 320, kHeight = 180;
constexpr int kTolerance = 2;  // of 255: what `carom compare` lets pass
// Pixels of edges that another Mesa than that of the golden frames may cover otherwise: one in a thousand.
const std::string kEdgePixels = std::to_string(kWidth * kHeight / 1000);

fs::path goldenFolder(const std::string& scene) {
  return fs::path(CAROM_SOURCE_DIR) / "tests" / "golden" / scene;
}

std::string testName(const fs::path& scene) {
  std::string name = scene.stem().string();
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

class GoldenFrames : public testing::TestWithParam<fs::path> {
 protected:
  std::string scene() const { return GetParam().stem().string(); }
  /// Kept after a failure, to look at and to accept. Of each test its own, for they run side by side.
  fs::path drawn() const { return fs::path(CAROM_BINARY).parent_path() / folder_ / scene(); }

  ProgramEnd draw(const std::vector<std::string>& environment = {}) const {
    fs::remove_all(drawn());
    return Program({"render", scene(), "--portable", "--size", "320x180", "--fps", "2", "--duration", "1.5",
                    "-q", "-o", (drawn() / "frame_%04d.png").string()},
                   environment)
        .wait();
  }
  ProgramEnd compare(const std::vector<std::string>& options = {}) const {
    std::vector<std::string> words{"compare", drawn().string(), goldenFolder(scene()).string(), "-q"};
    words.insert(words.end(), options.begin(), options.end());
    return runCarom(words);
  }

  /// Whether the golden frames are of the Mesa that draws here.
  bool isMesaOfGolden() const {
    return mesaOf(drawn() / "frame_0000.png") == mesaOf(goldenFolder(scene()) / "frame_0000.png");
  }

  std::string folder_ = "golden";

 private:
  static std::string mesaOf(const fs::path& frame) {
    for (const auto& [key, value] : renderer::readPngRaster(frame).text)
      if (key == "Renderer") return value.substr(std::min(value.size(), value.find("Mesa")));
    return "";
  }
};

TEST_P(GoldenFrames, AreDrawnAgain) {
  const ProgramEnd drawing = draw();
  ASSERT_EQ(drawing.code, 0) << drawing.err;
  const fs::path report = drawn().parent_path() / (scene() + ".html");
  std::vector<std::string> options{"--report", report.string()};
  if (!isMesaOfGolden()) options.insert(options.end(), {"--allow-pixels", kEdgePixels});
  const ProgramEnd end = compare(options);
  EXPECT_EQ(end.code, 0) << end.out << end.err << "report: " << report.string()
                         << "\naccept with: carom compare " << drawn().string() << ' '
                         << goldenFolder(scene()).string() << " --update";
}

// To the bit where the processor has no fused products.
TEST_P(GoldenFrames, AreTheSameWithoutTheInstructionsOfNewerProcessors) {
  folder_ = "golden-unfused";  // what the C library computes with; portable frames choose Mesa's themselves
  const ProgramEnd drawing = draw({"GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX512F,-AVX2,-FMA"});
  ASSERT_EQ(drawing.code, 0) << drawing.err;
  ProgramEnd end = compare({"--tolerance", "0", "--report", "none"});
  if (!isMesaOfGolden()) {
    const std::string unfused = drawn().string();
    folder_ = "golden-fused";
    ASSERT_EQ(draw().code, 0);
    end = runCarom({"compare", unfused, drawn().string(), "-q", "--tolerance", "0", "--report", "none"});
  }
  EXPECT_EQ(end.code, 0) << end.out << end.err;
}

// The scene's first frame, of the same pixels as the program's.
class FirstFrame {
 public:
  explicit FirstFrame(const fs::path& file)
      : scene_(readSceneFile(file)),
        made_(makeSceneWorld(scene_, std::nullopt)),
        instances_(drawnInstances(made_, made_.world.states())),
        pictures_({kWidth, kHeight, renderer::Light{}, renderer::PixelPolicy::kPortable},
                  made_.world.solids()) {
    const auto main = scene_.cameras.find("main");
    camera_ = (main != scene_.cameras.end() ? main : scene_.cameras.begin())->second;
  }

  std::vector<renderer::Instance> instances() const { return instances_; }
  bool moves(std::size_t body) const { return !made_.world.bodies()[body].is_static; }
  const std::string& name(std::size_t body) const { return made_.names[body]; }
  const renderer::Camera& camera() const { return camera_; }

  renderer::Raster draw(const std::vector<renderer::Instance>& instances) {
    const renderer::Image& image = pictures_.draw(instances, camera_, {}, drawnWater(scene_, 0.0));
    return {image.width, image.height, 3, 8, {image.rgb.begin(), image.rgb.end()}};
  }

 private:
  Scene scene_;
  SceneWorld made_;
  std::vector<renderer::Instance> instances_;
  renderer::FrameRenderer pictures_;
  renderer::Camera camera_;
};

// Each body in turn a quarter of a pixel to the right of where it belongs. One that hides behind others is
// not seen to move, nor one of which a gap shows nothing but the middle of a face, even by pixels.
TEST_P(GoldenFrames, FailWhenAnyBodyInSightMovesByAQuarterPixel) {
  FirstFrame frame(GetParam());
  const renderer::Raster golden = frame.draw(frame.instances());
  const renderer::CameraAxes axes = renderer::cameraAxes(frame.camera());
  const double focal_px = renderer::focalLengthPixels(frame.camera(), kHeight);
  int in_sight = 0;
  // Of a great many bodies every second, third, ...: those between are of the same kind.
  constexpr std::size_t kMany = 120;
  const std::size_t stride = 1 + frame.instances().size() / kMany;
  for (std::size_t i = 0, moving = 0; i < frame.instances().size(); ++i) {
    if (!frame.moves(i) || moving++ % stride != 0) continue;
    std::vector<renderer::Instance> without = frame.instances(), moved = frame.instances();
    without.erase(without.begin() + static_cast<std::ptrdiff_t>(i));
    const auto seen = renderer::differenceOf(frame.draw(without), golden, kTolerance);
    // Out of the picture it may still shift the shadow map, which is fitted to all bodies.
    const auto at =
        renderer::projectToPixel(frame.camera(), kWidth, kHeight, frame.instances()[i].X_WB.position);
    if (seen.pixels_beyond < 30 || !at || at->x() < 0.0 || at->x() > kWidth || at->y() < 0.0 ||
        at->y() > kHeight)
      continue;
    ++in_sight;
    const double depth_m = axes.forward.dot(moved[i].X_WB.position - frame.camera().eye);
    const auto differsMovedBy = [&](double pixels) {
      moved[i].X_WB.position = frame.instances()[i].X_WB.position + pixels * depth_m / focal_px * axes.right;
      return renderer::differenceOf(frame.draw(moved), golden, kTolerance).largest > kTolerance;
    };
    EXPECT_TRUE(differsMovedBy(0.25) || !differsMovedBy(2.0)) << frame.name(i);
  }
  EXPECT_GT(in_sight, 0);
}

INSTANTIATE_TEST_SUITE_P(Scenes, GoldenFrames, testing::ValuesIn(shippedScenes()),
                         [](const auto& scene) { return testName(scene.param); });

std::vector<fs::path> goldenFiles() {
  std::vector<fs::path> files;
  for (const fs::path& scene : shippedScenes())
    for (const auto& entry : fs::directory_iterator(goldenFolder(scene.stem().string())))
      if (entry.path().extension() == ".png") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

/// A copy of a golden frame in a folder of its own, with the fifth row of pixels white, and another `State`
/// where one is given, unsigned: else it would be a file that was changed after it was drawn; what `carom
/// compare` says of it.
ProgramEnd comparedWithChanged(const TemporaryFolder& folder, const fs::path& golden,
                               const std::string& state) {
  renderer::DecodedRaster frame = renderer::readPngRaster(golden);
  const std::size_t row = static_cast<std::size_t>(frame.raster.width * frame.raster.channels);
  std::fill_n(frame.raster.samples.begin() + static_cast<std::ptrdiff_t>(5 * row), row, std::uint16_t{255});
  for (auto& [key, value] : frame.text)
    if (key == "State" && !state.empty()) value = state;
  std::erase_if(frame.text, [](const auto& entry) { return entry.first == "Pixels"; });
  writePng(folder.path() / "actual/frame_0001.png", frame.raster, frame.text);
  fs::create_directory(folder.path() / "golden");
  fs::copy_file(golden, folder.path() / "golden/frame_0001.png", fs::copy_options::overwrite_existing);
  return runCarom({"compare", (folder.path() / "actual").string(), (folder.path() / "golden").string(), "-q",
                   "--report", (folder.path() / "report.html").string()});
}

TEST(GoldenFramesOfAllScenes, AreASuiteForCaromRegress) {
  std::set<std::string> folders, scenes;
  for (const auto& entry : fs::directory_iterator(goldenFolder("")))
    if (entry.is_directory()) folders.insert(entry.path().filename().string());
  const std::vector<std::string> drawn_as = {"--portable", "--size",     "320x180", "--fps",
                                             "2",          "--duration", "1.5"};
  for (const SuiteScene& scene : readSuite(goldenFolder("")).scenes) {
    scenes.insert(scene.name);
    EXPECT_EQ(scene.render, drawn_as) << scene.name;
  }
  EXPECT_EQ(scenes, folders);
}

TEST(GoldenFramesOfAllScenes, HoldTheirStateAndAFailureTellsPhysicsFromRendererAndHowToAcceptIt) {
  const TemporaryFolder folder;
  const std::string paths = (folder.path() / "actual").string() + " " + (folder.path() / "golden").string();
  const std::string advice = "report: " + (folder.path() / "report.html").string() +
                             "; accept with: carom compare " + paths + " --update";
  for (const fs::path& file : goldenFiles()) {
    std::map<std::string, std::string> text;
    for (const auto& [key, value] : renderer::readPngRaster(file).text) text[key] = value;
    ASSERT_EQ(text["State"].size(), 16u) << file;
    if (file.filename() != "frame_0001.png") continue;
    const ProgramEnd renderer_changed = comparedWithChanged(folder, file, "");
    EXPECT_EQ(renderer_changed.code, 1);
    EXPECT_NE(renderer_changed.out.find("(the renderer changed: same state " + text["State"] + ")"),
              std::string::npos)
        << renderer_changed.out;
    const ProgramEnd physics_moved = comparedWithChanged(folder, file, "0123456789abcdef");
    EXPECT_EQ(physics_moved.code, 1);
    EXPECT_NE(physics_moved.out.find("(physics moved: state " + text["State"] + " became 0123456789abcdef)"),
              std::string::npos)
        << physics_moved.out;
    for (const ProgramEnd& end : {renderer_changed, physics_moved})
      EXPECT_NE(end.err.find(advice), std::string::npos) << end.err;
    EXPECT_TRUE(fs::exists(folder.path() / "report.html"));
  }
}

// No golden frame could be taken for another: the gate tells any two apart.
TEST(GoldenFramesOfAllScenes, FailAgainstEachOther) {
  std::vector<renderer::Raster> frames;
  const std::vector<fs::path> files = goldenFiles();
  for (const fs::path& file : files) frames.push_back(renderer::readPngRaster(file).raster);
  ASSERT_EQ(frames.size(), 3 * shippedScenes().size());
  for (std::size_t i = 0; i < frames.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_GT(renderer::differenceOf(frames[i], frames[j], kTolerance).largest, kTolerance)
          << files[i] << " and " << files[j];
}

}  // namespace
}  // namespace carom::demos
