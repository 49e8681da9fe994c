#include "engine/foundation/input_file.h"

#include <string>

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "engine/foundation/contract.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/thrown_message.h"

namespace carom {
namespace {
namespace fs = std::filesystem;

struct InputFiles : testing::Test {
  const TemporaryFolder made;
  const fs::path& folder = made.path();
};

TEST_F(InputFiles, AFileAndALinkToItAreRead) {
  std::ofstream(folder / "file") << "text";
  fs::create_symlink("file", folder / "link");
  for (const char* name : {"file", "link"}) {
    std::string word;
    EXPECT_TRUE(openInputFile(folder / name) >> word);
    EXPECT_EQ(word, "text");
  }
}

TEST_F(InputFiles, WhatIsNoFileIsRefusedAtOnceWithItsPathAndTheReason) {
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  fs::create_symlink("self", folder / "self");
  fs::create_symlink("nowhere", folder / "dangling");
  for (const auto& [path, reason] : {std::pair<fs::path, std::string>{folder / "pipe", "it is a pipe"},
                                     {folder / "self", "Too many levels of symbolic links"},
                                     {folder / "dangling", "No such file"},
                                     {folder / "none", "No such file"},
                                     {folder, "it is a folder"},
                                     {"/dev/zero", "it is a device"}}) {
    EXPECT_NE(tryInputFile(path).problem.find(reason), std::string::npos) << tryInputFile(path).problem;
    const std::string said = thrownMessage<InputError>([&path = path] { openInputFile(path); });
    EXPECT_EQ(said.rfind("cannot read '" + path.string() + "': " + reason, 0), 0u) << said;
  }
}

}  // namespace
}  // namespace carom
