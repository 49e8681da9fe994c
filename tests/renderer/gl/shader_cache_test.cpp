#include "renderer/gl/shader_cache.h"

#include <cstdio>
#include <cstdlib>
#include <sstream>

#include <gtest/gtest.h>

namespace carom::renderer {
namespace {

std::string kindOf(const std::string& cpuinfo) {
  std::istringstream text(cpuinfo);
  return processorKind(text);
}

TEST(ShaderCache, AProcessorsKindIsWhatItCanRun) {
  const std::string one =
      "processor\t: 0\nvendor_id\t: GenuineIntel\nmodel\t\t: 85\ncpu MHz\t\t: 2200.1\nflags\t\t: sse4_1 "
      "avx2\n\n"
      "processor\t: 1\nvendor_id\t: Other\n";
  EXPECT_EQ(kindOf(one), "vendor_id\t: GenuineIntel\nmodel\t\t: 85\nflags\t\t: sse4_1 avx2\n");
  std::string faster = one, fewer = one;
  faster.replace(faster.find("2200.1"), 6, "3100.7");
  fewer.erase(fewer.find(" avx2"), 5);
  EXPECT_EQ(kindOf(faster), kindOf(one));
  EXPECT_NE(kindOf(fewer), kindOf(one));
  EXPECT_EQ(kindOf("BogoMIPS : 100\n"), "");
  EXPECT_EQ(kindOf(""), "");
}

// Each in a process of its own: the environment is everybody's.
void endWithFolder(const char* cache_home, const char* vector_width) {
  setenv("XDG_CACHE_HOME", cache_home, 1);
  unsetenv("HOME");
  setenv("LP_NATIVE_VECTOR_WIDTH", vector_width, 1);
  const auto folder = shaderCacheFolder();
  std::fprintf(stderr, "folder %s.", folder ? folder->filename().c_str() : "none");
  std::exit(folder && !std::filesystem::is_directory(*folder) ? 1 : 0);
}

TEST(ShaderCacheDeathTest, IsNoneWhereNothingCanBeKept) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(endWithFolder("", "128"), testing::ExitedWithCode(0), "folder none");
  EXPECT_EXIT(endWithFolder("relative", "128"), testing::ExitedWithCode(0), "folder none");
  EXPECT_EXIT(endWithFolder("/proc/nothing/here", "128"), testing::ExitedWithCode(0), "folder none");
}

}  // namespace
}  // namespace carom::renderer
