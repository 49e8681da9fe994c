#include "demos/compare/golden_update.h"

#include <gtest/gtest.h>

#include "demos/asset/asset_path.h"
#include "demos/system/exit_code.h"
#include "tests/demos/support/png_files.h"
#include "tests/support/temporary_folder.h"

namespace carom::demos {
namespace {
namespace fs = std::filesystem;

class GoldenUpdate : public testing::Test {
 protected:
  Comparison comparisonOf(bool has_actual, bool has_golden) const {
    return compared({"f.png", actual_, golden_, has_actual, has_golden}, {});
  }
  static Update updated(const Comparison& comparison) {
    const Update update = plannedUpdate(comparison);
    if (writesGolden(update)) replaceGolden(comparison.pair);
    return update;
  }
  TemporaryFolder folder_;
  fs::path actual_ = writePng(folder_.path() / "a/f.png", flatRaster(5, 4, 90), {{"State", "ab"}});
  fs::path golden_ = folder_.path() / "g/sub/f.png";
};

TEST_F(GoldenUpdate, ReplacesByteForByteWhatTheGateRefuses) {
  writePng(golden_, flatRaster(5, 4, 10));
  EXPECT_EQ(updated(comparisonOf(true, true)), Update::kReplaced);
  EXPECT_EQ(readTextFile(golden_), readTextFile(actual_));
  EXPECT_EQ(std::distance(fs::directory_iterator(golden_.parent_path()), fs::directory_iterator()), 1);
}

TEST_F(GoldenUpdate, TakesARecordOnlyWhereItIsAnother) {
  const ImagePair pair{"f.png", actual_, golden_, true, true};
  fs::create_directories(golden_.parent_path());
  EXPECT_FALSE(hasOtherRecord(pair)) << "there is none";
  folder_.file("a/states.carom", "now");
  EXPECT_TRUE(hasOtherRecord(pair));
  updateRecord(pair);
  EXPECT_FALSE(hasOtherRecord(pair));
  folder_.file("a/states.carom", "then");
  EXPECT_TRUE(hasOtherRecord(pair));
}

TEST_F(GoldenUpdate, AddsANewFileAndItsFolder) {
  EXPECT_EQ(updated(comparisonOf(true, false)), Update::kAdded);
  EXPECT_EQ(readTextFile(golden_), readTextFile(actual_));
}

TEST_F(GoldenUpdate, LeavesWhatPassesAsItIs) {
  writePng(golden_, flatRaster(5, 4, 91));
  const std::string before = readTextFile(golden_);
  EXPECT_EQ(updated(comparisonOf(true, true)), Update::kNone);
  EXPECT_EQ(readTextFile(golden_), before);
}

TEST_F(GoldenUpdate, NeverDeletesAndNeverTakesABrokenImage) {
  writePng(golden_, flatRaster(5, 4, 10));
  const std::string before = readTextFile(golden_);
  EXPECT_EQ(updated(comparisonOf(false, true)), Update::kRefused);
  truncateFile(actual_);
  EXPECT_EQ(updated(comparisonOf(true, true)), Update::kRefused);
  EXPECT_EQ(readTextFile(golden_), before);
}

TEST_F(GoldenUpdate, RepairsABrokenGoldenImage) {
  writePng(golden_, flatRaster(5, 4, 90));
  truncateFile(golden_);
  EXPECT_EQ(updated(comparisonOf(true, true)), Update::kReplaced);
  EXPECT_EQ(readTextFile(golden_), readTextFile(actual_));
}

TEST_F(GoldenUpdate, ATargetThatCannotBeWrittenIsSaidAndKept) {
  const Comparison c = compared({"f.png", actual_, actual_ / "f.png", true, false}, {});  // below a file
  EXPECT_THROW(updated(c), CannotWrite);
}

}  // namespace
}  // namespace carom::demos
