// Frames with Mesa's cache of compiled shaders, and without.

#include <gtest/gtest.h>

#include "tests/demos/support/program_run.h"

namespace carom::demos {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> cachedFiles(const fs::path& home) {
  std::vector<fs::path> files;
  if (!fs::exists(home / "carom")) return files;
  for (const auto& entry : fs::recursive_directory_iterator(home / "carom"))
    if (entry.is_regular_file()) files.push_back(entry.path());
  return files;
}

// Its one frame; nothing may be said about the cache.
std::string frameWith(const std::vector<std::string>& environment) {
  const Program render(
      {"render", "contact-edge-edge", "-q", "--size", "160x90", "--frames", "0", "-o", "f_%04d.png"},
      environment);
  const ProgramEnd end = render.wait();
  EXPECT_EQ(end.code, 0) << end.err;
  EXPECT_EQ(end.err, "");
  return readTextFile(render.folder() / "f_0000.png");
}

TEST(ShaderCache, DrawsTheSameFrameFilledEmptyDamagedAndNowhere) {
  const std::string expected = frameWith({"MESA_SHADER_CACHE_DISABLE=true"});
  ASSERT_FALSE(expected.empty());
  const TemporaryFolder home;
  const std::string variable = "XDG_CACHE_HOME=" + home.path().string();
  // Mesa writes in a thread of the lowest priority and drops at the end what is not written yet.
  std::vector<fs::path> filled;
  for (int run = 0; run < 20 && filled.size() <= 2; ++run) {
    EXPECT_EQ(frameWith({variable}), expected);
    filled = cachedFiles(home.path());
  }
  EXPECT_GT(filled.size(), 2u);
  EXPECT_EQ(frameWith({variable}), expected);
  for (const fs::path& file : filled) {
    if (file.filename() == "index") continue;
    std::fstream bytes(file, std::ios::in | std::ios::out | std::ios::binary);
    bytes.seekp(static_cast<std::streamoff>(fs::file_size(file) / 2));
    bytes << "damaged";
  }
  EXPECT_EQ(frameWith({variable}), expected);
  EXPECT_EQ(frameWith({"XDG_CACHE_HOME=/proc/nothing"}), expected);
}

TEST(ShaderCache, IsNotForPortablePixels) {
  const TemporaryFolder home;
  const Program render(
      {"render", "contact-edge-edge", "-q", "--portable", "--size", "160x90", "--frames", "0"},
      {"XDG_CACHE_HOME=" + home.path().string()});
  EXPECT_EQ(render.wait().code, 0);
  EXPECT_TRUE(cachedFiles(home.path()).empty());
}

}  // namespace
}  // namespace carom::demos
