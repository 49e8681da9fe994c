#include "demos/compare/image_pairs.h"

#include <gtest/gtest.h>

#include "demos/system/exit_code.h"
#include "engine/foundation/contract.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/thrown_message.h"

namespace carom::demos {
namespace {
namespace fs = std::filesystem;

class Folders : public testing::Test {
 protected:
  void add(const std::string& name) const {
    const fs::path path = folder_.path() / name;
    fs::create_directories(path.parent_path());
    std::ofstream(path) << name;
  }
  fs::path at(const std::string& name) const { return folder_.path() / name; }
  std::string names(const ComparedPaths& paths) const {
    std::string all;
    for (const ImagePair& pair : imagePairs(paths))
      all += pair.name + (pair.has_actual ? "a" : "-") + (pair.has_golden ? "g " : "- ");
    return all;
  }
  TemporaryFolder folder_;
};

TEST_F(Folders, PairFilesOfTheSameRelativeNameInByteOrder) {
  for (const char* name : {"a/f_10.png", "a/f_2.png", "a/sub/x.PNG", "a/note.txt", "a/.f_3.png.77.partial",
                           "g/f_2.png", "g/sub/x.PNG", "g/Z.png", "g/manifest.json"})
    add(name);
  EXPECT_EQ(names({at("a"), at("g")}), "Z.png-g f_10.pnga- f_2.pngag sub/x.PNGag ");
  EXPECT_EQ(imagePairs({at("a"), at("g")})[3].golden, at("g/sub/x.PNG"));
}

TEST_F(Folders, WhatLiesInALinkedFolderIsPairedAndNoLoopIsFollowed) {
  for (const char* name : {"a/f.png", "elsewhere/x.png", "g/f.png", "g/sub/x.png"}) add(name);
  fs::create_directory_symlink("../elsewhere", at("a/sub"));
  fs::create_directory_symlink("..", at("elsewhere/up"));
  fs::create_directory_symlink(".", at("a/again"));
  EXPECT_EQ(names({at("a"), at("g")}), "f.pngag sub/x.pngag ");
}

TEST_F(Folders, TwoFilesArePairedWhateverTheirNames) {
  add("new.png");
  add("old.png");
  EXPECT_EQ(names({at("new.png"), at("old.png")}), "old.pngag ");
}

TEST_F(Folders, NothingToCompareIsAnErrorNotASuccess) {
  add("a/x.txt");
  add("g/y.txt");
  EXPECT_NE(thrownMessage<InputError>([&] {
              imagePairs({at("a"), at("g")});
            }).find("nothing to compare"),
            std::string::npos);
}

TEST_F(Folders, APathThatIsNotThereIsNamed) {
  add("a/x.png");
  for (const ComparedPaths& paths : {ComparedPaths{at("none"), at("a")}, ComparedPaths{at("a"), at("none")},
                                     ComparedPaths{at("none"), at("a"), true}}) {
    const std::string message = thrownMessage<InputError>([&] { imagePairs(paths); });
    EXPECT_NE(message.find(at("none").string() + "': no such file or folder"), std::string::npos) << message;
  }
  EXPECT_EQ(names({at("a"), at("none"), true}), "x.pnga- ");
}

TEST_F(Folders, AFileAgainstAFolderIsWrongUsage) {
  add("a/x.png");
  EXPECT_NE(thrownMessage<UsageError>([&] {
              imagePairs({at("a"), at("a/x.png")});
            }).find("a file and a folder"),
            std::string::npos);
}

}  // namespace
}  // namespace carom::demos
