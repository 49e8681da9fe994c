#include "demos/compare/golden_undo.h"

#include <gtest/gtest.h>

#include "demos/asset/asset_path.h"
#include "engine/foundation/contract.h"
#include "tests/support/temporary_folder.h"

namespace carom::demos {
namespace {
namespace fs = std::filesystem;

TEST(GoldenUndo, PutsBackWhatWasReplacedAndRemovesWhatWasAddedOnce) {
  const TemporaryFolder folder;
  fs::create_directories(folder.path() / "deep");
  folder.file("deep/a.png", "old");
  {
    GoldenUndo undo(folder.path());
    undo.keep(folder.path() / "deep/a.png");
    undo.keep(folder.path() / "b.png");
    undo.commit();
  }
  folder.file("deep/a.png", "new");
  folder.file("b.png", "new");
  EXPECT_EQ(undoUpdate(folder.path()), 2);
  EXPECT_EQ(readTextFile(folder.path() / "deep/a.png"), "old");
  EXPECT_FALSE(fs::exists(folder.path() / "b.png"));
  EXPECT_FALSE(fs::exists(folder.path() / kUndoFolder));
  EXPECT_THROW(undoUpdate(folder.path()), InputError);
}

TEST(GoldenUndo, AnUpdateThatChangesNothingLeavesTheOneBefore) {
  const TemporaryFolder folder;
  folder.file("a.png", "old");
  {
    GoldenUndo undo(folder.path());
    undo.keep(folder.path() / "a.png");
    undo.commit();
  }
  folder.file("a.png", "new");
  GoldenUndo(folder.path()).commit();
  EXPECT_EQ(undoUpdate(folder.path()), 1);
  EXPECT_EQ(readTextFile(folder.path() / "a.png"), "old");
}

TEST(GoldenUndo, OfAListThatLeadsElsewhereTouchesNothing) {
  const TemporaryFolder folder;
  fs::create_directories(folder.path() / "golden" / kUndoFolder);
  folder.file("kept", "kept");
  folder.file("golden/kept.png", "kept");
  for (const char* name : {"../kept", ".", "a/..", "", "/"}) {
    folder.file("golden/.carom-undo/list.json",
                std::string(R"({ "replaced": [], "added": [")") + name + "\"] }");
    EXPECT_THROW(undoUpdate(folder.path() / "golden"), InputError) << name;
    EXPECT_TRUE(fs::exists(folder.path() / "kept")) << name;
    EXPECT_TRUE(fs::exists(folder.path() / "golden/kept.png")) << name;
  }
}

}  // namespace
}  // namespace carom::demos
