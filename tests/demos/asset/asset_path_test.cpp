#include "demos/asset/asset_path.h"

#include <gtest/gtest.h>

#include "engine/foundation/contract.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/thrown_message.h"

namespace carom::demos {
namespace {

TEST(AssetPath, FindsAShippedSceneByNameAndAnyByPath) {
  EXPECT_EQ(findScene("sliding").filename(), "sliding.json");
  const TemporaryFolder folder;
  const auto path = folder.file("own.json", "{}");
  EXPECT_EQ(findScene(path.string()), path);
}

TEST(AssetPath, NamesTheNearestScene) {
  EXPECT_EQ(thrownMessage<InputError>([] {
              findScene("slidimg");
            }).rfind("unknown scene \"slidimg\"; did you mean \"sliding\"? accepted: ", 0),
            0u);
  EXPECT_EQ(thrownMessage<InputError>([] { findScene("no/such.json"); }), "no/such.json: no such scene file");
}

// A file of holes, which takes no room on the disk.
TEST(AssetPath, AFileTooLargeForTheMemoryIsNotRead) {
  const TemporaryFolder folder;
  const auto file = folder.file("holes.json", "{}");
  std::filesystem::resize_file(file, std::uintmax_t{3} << 30);
  EXPECT_EQ(thrownMessage<InputError>([&file] { readTextFile(file); }),
            file.string() + ": has 3072 MB; accepted: at most 256");
}

TEST(AssetPath, TheEnvironmentHasTheFirstWord) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.path() / "scenes");
  ASSERT_EQ(setenv("CAROM_ASSETS", folder.path().c_str(), 1), 0);
  EXPECT_EQ(assetsFolder(), folder.path());
  EXPECT_TRUE(shippedScenes().empty());
  ASSERT_EQ(setenv("CAROM_ASSETS", "/nowhere/at/all", 1), 0);
  EXPECT_THROW(assetsFolder(), InputError);
  unsetenv("CAROM_ASSETS");
  EXPECT_EQ(assetsFolder(), std::filesystem::path(CAROM_SOURCE_DIR) / "assets");
}

}  // namespace
}  // namespace carom::demos
