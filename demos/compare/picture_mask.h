#pragma once
// Parts of a picture that a comparison does not look at: bodies, rectangles, and what another image marks.
//   body:NAME      the pixels on that body, then or now, and two around them, where edges are smoothed and
//                  contact darkens; from the records beside the frames (states.carom)
//   rect:X,Y,W,H   pixels
//   png:FILE       the pixels that are not black in that image of the frames' size
// Tested in tests/demos/compare/picture_mask_test.cpp.

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "demos/compare/cause.h"
#include "demos/compare/image_pairs.h"
#include "renderer/image/raster.h"

namespace carom::demos {

class PictureMask {
 public:
  /// Throws UsageError for a text that is none of the above, InputError for a file that is no image. `shelf`
  /// must outlive this.
  PictureMask(const std::vector<std::string>& texts, RecordShelf& shelf);
  ~PictureMask();
  PictureMask(const PictureMask&) = delete;
  PictureMask& operator=(const PictureMask&) = delete;

  bool any() const { return !rules_.empty(); }
  /// As they were given.
  const std::vector<std::string>& texts() const { return texts_; }
  /// Whether each pixel is masked, row by row. REQUIRES a size that both images of the pair have. From any
  /// thread. Throws InputError where a body is masked and the frame has no record, where an image is of
  /// another size, where a rectangle lies beyond the picture, and where nothing is left to compare.
  std::vector<bool> maskedPixels(const ImagePair& pair, int width, int height) const;
  /// Makes the masked pixels of `actual` those of `golden`, where the two are comparable; it then has the
  /// channels in which they are compared. From any thread. Throws InputError as maskedPixels.
  void apply(const ImagePair& pair, renderer::Raster& actual, const renderer::Raster& golden) const;

 private:
  struct Rule;
  void maskBody(const std::string& body, const ImagePair& pair, std::vector<bool>& masked, int width) const;

  std::vector<std::string> texts_;
  std::vector<Rule> rules_;
  RecordShelf& shelf_;
  mutable std::mutex reading_;  // of the shelf
};

}  // namespace carom::demos
