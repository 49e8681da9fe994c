#pragma once
// Why a frame differs from its golden one: what changed in the world, in the look, in the program, or in the
// file, since when, and where in the picture it lies; from the two folders' records, or from the frames'
// texts alone where there is none. Tested in tests/demos/compare/cause_test.cpp.

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "demos/cause/motion_record.h"
#include "demos/compare/comparison.h"
#include "renderer/image/png.h"

namespace carom::demos {

/// The records beside the frames, each read once.
class RecordShelf {
 public:
  /// Null where there is none, or none that can be read; then `problems` says why.
  const MotionRecord* of(const std::filesystem::path& frame);
  const std::vector<std::string>& problems() const { return problems_; }

 private:
  std::map<std::filesystem::path, std::optional<MotionRecord>> records_;
  std::vector<std::string> problems_;
};

/// The cause of a pair that has two whole images and does not pass. Empty when nothing is known.
Cause causeOfDifference(const Comparison& comparison, const Gate& gate, RecordShelf& shelf);

/// Of two frames' texts alone.
Cause causeByText(const renderer::DecodedRaster& actual, const renderer::DecodedRaster& golden);

/// Of two records of one scene without a look at the pictures: what differs in the world up to the first
/// frame whose states differ. Empty: nothing.
Cause causeInRecords(const MotionRecord& actual, const MotionRecord& golden);

}  // namespace carom::demos
