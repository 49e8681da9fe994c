// Which library makes the GL context, through the program: files that are no libraries stand in the place of
// OSMesa and EGL, as if neither were installed.
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "demos/asset/asset_path.h"
#include "demos/format/json.h"
#include "tests/demos/support/program_run.h"

namespace carom::demos {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

class GlChoice : public testing::Test {
 protected:
  void SetUp() override {
    for (const char* gl : {"osmesa", "egl"})
      if (const ProgramEnd end = runCarom({"doctor", "--gl", gl}); end.code != 0) GTEST_SKIP() << end.err;
  }

  /// The environment in which these cannot be opened.
  static Words without(const TemporaryFolder& folder, const Words& libraries) {
    for (const std::string& library : libraries) std::ofstream{folder.path() / library};
    return {"LD_LIBRARY_PATH=" + folder.path().string()};
  }
  Words withoutOsmesa() const { return without(folder_, {"libOSMesa.so.8"}); }
  Words withoutAny() const { return without(folder_, {"libOSMesa.so.8", "libEGL.so.1"}); }

  static Files frames(const Words& more, const Words& environment, std::string* gl = nullptr) {
    Words words{"render", "contact-edge-edge", "-q", "--fps", "10", "--duration", "0.3", "--size", "96x54",
                "-o",     "f_####.png"};
    words.insert(words.end(), more.begin(), more.end());
    const Program program(words, environment);
    const ProgramEnd end = program.wait();
    EXPECT_EQ(end.code, 0) << end.err;
    if (end.code == 0 && gl != nullptr) {
      const Json json =
          Json::parse(readTextFile(program.folder() / "manifest.json"), "manifest.json").at("gl");
      *gl = json.at("context").asString() + ": " + json.at("reason").asString();
    }
    return framesOf(program.folder());
  }

 private:
  TemporaryFolder folder_;
};

TEST_F(GlChoice, TakesOsmesaFirstAndElseEglAndSaysWhyInTheManifest) {
  std::string gl;
  const Files osmesa = frames({}, {}, &gl);
  EXPECT_EQ(gl, "osmesa: the first choice, and it is here");
  for (const char* workers : {"1", "2"}) {
    EXPECT_TRUE(frames({"--workers", workers}, withoutOsmesa(), &gl) == osmesa);
    EXPECT_EQ(gl, "egl: there is no libOSMesa.so.8 here");
  }
  EXPECT_TRUE(frames({"--gl", "egl"}, {}, &gl) == osmesa);
  EXPECT_EQ(gl, "egl: asked for");
}

TEST_F(GlChoice, DoctorTellsOfBoth) {
  const ProgramEnd both = runCarom({"doctor"}), egl_alone = runCarom({"doctor"}, withoutOsmesa());
  EXPECT_EQ(both.code, 0) << both.err;
  EXPECT_NE(both.out.find("GL context      OSMesa (the first choice"), std::string::npos) << both.out;
  EXPECT_NE(both.out.find("EGL             there as well"), std::string::npos) << both.out;
  EXPECT_EQ(egl_alone.code, 0) << egl_alone.err;
  EXPECT_NE(egl_alone.out.find("GL context      EGL without a surface (there is no libOSMesa.so.8 here)"),
            std::string::npos)
      << egl_alone.out;
}

TEST_F(GlChoice, WithNeitherWhatDrawsEndsWith6InOneLineAndTheRestWorks) {
  const Words none = withoutAny();
  const std::string reason = "there is no libOSMesa.so.8 here; there is no libEGL.so.1 here";
  for (const Words& words : {Words{"render", "resting", "-q"}, {"budget", "resting", "-q"}, {"doctor"}}) {
    const Program program(words, none);
    const ProgramEnd end = program.wait();
    EXPECT_EQ(end.code, 6) << words[0];
    EXPECT_EQ(end.err.rfind("carom: " + reason, 0), 0u) << end.err;
    EXPECT_EQ(end.err.find('\n'), end.err.size() - 1) << end.err;
    EXPECT_TRUE(fs::is_empty(program.folder()));
  }
  const std::string cube = (assetsFolder() / "meshes/gem.obj").string();
  const std::string picture =
      (fs::path(CAROM_SOURCE_DIR) / "tests/package_example/golden/contact-edge-edge/frame_0020.png").string();
  for (const Words& words : {Words{"simulate", "contact-edge-edge", "-q"},
                             {"distance", cube, cube, "--pose-b", "3,0,0"},
                             {"check", "resting"},
                             {"export", "contact-edge-edge", "m.glb", "-q"},
                             {"list"},
                             {"compare", picture, picture}}) {
    const ProgramEnd end = runCarom(words, none);
    EXPECT_EQ(end.code, 0) << words[0] << ": " << end.err;
  }
}

// EGL's picture of every shipped scene is OSMesa's, to the last bit of every file.
TEST_F(GlChoice, EitherDrawsTheSameFilesOfEveryShippedScene) {
  for (const fs::path& scene : shippedScenes()) {
    const auto drawn = [&](const std::string& gl) {
      const Program program({"render", scene.string(), "-q", "--gl", gl, "--frames", "0,3", "--size", "96x54",
                             "-o", "f_####.png"});
      const ProgramEnd end = program.wait();
      EXPECT_EQ(end.code, 0) << scene << end.err;
      return framesOf(program.folder());
    };
    EXPECT_TRUE(drawn("egl") == drawn("osmesa")) << scene;
  }
}

TEST_F(GlChoice, WhereEglKnowsNoSurfacelessDisplayTheSoftwareDeviceDrawsTheSame) {
  const TemporaryFolder folder;
  fs::create_symlink(CAROM_EGL_WITHOUT_SURFACELESS, folder.path() / "libEGL.so.1");
  std::string gl;
  const Files device = frames({"--gl", "egl"}, {"LD_LIBRARY_PATH=" + folder.path().string()}, &gl);
  EXPECT_TRUE(device == frames({"--gl", "osmesa"}, {}));
}

}  // namespace
}  // namespace carom::demos
