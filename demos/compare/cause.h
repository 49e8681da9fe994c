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
#include "demos/cause/picture_evidence.h"
#include "demos/compare/comparison.h"
#include "renderer/image/png.h"

namespace carom::demos {

/// The records beside the frames, each read once.
class RecordShelf {
 public:
  /// What the records say of the pair's frames. Nothing where there is no record, or none that can be read
  /// (then `problems` says why), and where it is not of the frame as it is: a run without a record leaves
  /// that of the run before beside its frames.
  std::optional<RecordedPicture> ofActual(const ImagePair& pair);
  std::optional<RecordedPicture> ofGolden(const ImagePair& pair);
  const std::vector<std::string>& problems() const { return problems_; }

 private:
  const MotionRecord* recordBeside(const std::filesystem::path& frame);
  std::optional<RecordedPicture> pictureOf(const std::filesystem::path& frame, const std::string& name);

  std::map<std::filesystem::path, std::optional<MotionRecord>> records_;
  std::vector<std::string> problems_;
};

/// The cause of a pair that has two whole images and does not pass. Empty when nothing is known.
Cause causeOfDifference(const Comparison& comparison, const Gate& gate, RecordShelf& shelf);

/// Of two frames' texts alone.
Cause causeByText(const renderer::DecodedRaster& actual, const renderer::DecodedRaster& golden);

/// Of the frames of two runs without a look at their pixels: what differs in the world up to the first frame
/// whose states differ. Empty: nothing, or another scene.
Cause causeInRecords(const std::vector<RecordedPictures>& frames);

}  // namespace carom::demos
