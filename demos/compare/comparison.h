#pragma once
// One pair of images judged by the gate: what became of it, how far apart, and whether it was the physics
// that moved or the renderer that changed, from the identity that each frame carries in its text chunks.
// Tested in tests/demos/compare/comparison_test.cpp.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "demos/cause/cause_facts.h"
#include "demos/compare/image_pairs.h"
#include "renderer/image/image_difference.h"

namespace carom::demos {

class PictureMask;

/// No pixel's channel may differ by more. The 16-bit images are depth and ids: data, where a neighbour's id
/// is one step away.
struct Gate {
  int tolerance = 2;                ///< Of 8-bit images, in steps of 1/255.
  int tolerance16 = 0;              ///< Of 16-bit images, in steps of 1/65535.
  std::int64_t allowed_pixels = 0;  ///< This many pixels of an image may differ by more all the same.

  const PictureMask* mask = nullptr;  ///< What is not looked at; none: all is.

  int toleranceOf(int full_scale) const { return full_scale == 255 ? tolerance : tolerance16; }
};

/// From worst to best, as reports sort.
enum class Verdict {
  kUnreadable,  ///< One of the files is no whole PNG.
  kShape,       ///< Width, height or bits differ: never equal.
  kMissing,     ///< Golden, but not in ACTUAL.
  kExtra,       ///< In ACTUAL, but not golden.
  kBeyond,      ///< More pixels than allowed are beyond the tolerance.
  kWithin,      ///< Not the same, but the gate lets it pass.
  kSame
};

struct Comparison {
  ImagePair pair;
  Verdict verdict = Verdict::kSame;
  std::optional<renderer::RasterShape> actual_shape;  ///< Nothing when there is no such readable image.
  std::optional<renderer::RasterShape> golden_shape;
  renderer::ImageDifference difference;  ///< Of kBeyond, kWithin and kSame.
  Cause cause;                           ///< Of a difference; empty when unknown.
  std::string problem;                   ///< Of kUnreadable.

  bool passes() const { return verdict == Verdict::kWithin || verdict == Verdict::kSame; }
};

/// Reads both images and judges them; of several accepted golden images (`goldenVariants`) against the one
/// that comes nearest, which the pair then names. Never throws for an unreadable file: that is a verdict.
Comparison compared(const ImagePair& pair, const Gate& gate);

/// "unreadable", "size differs", "missing", "extra", "differs", "within tolerance", "same"
const char* verdictName(Verdict verdict);

/// One line about a pair without its name: "differs  largest 62/255 at (120, 44) in red  841 pixels beyond
/// ...".
std::string comparisonLine(const Comparison& comparison, const Gate& gate);

/// Indices from worst to best: verdict, pixels beyond, largest difference, name.
std::vector<std::size_t> bySeverity(const std::vector<Comparison>& comparisons);

/// How many of each verdict.
struct Tally {
  int total = 0;
  int passed = 0;
  int unreadable = 0;
  int shape = 0;
  int missing = 0;
  int extra = 0;
  int beyond = 0;
};
Tally tallyOf(const std::vector<Comparison>& comparisons);
/// "98 of 100 pass, 1 differs, 1 missing"
std::string tallyText(const Tally& tally);

}  // namespace carom::demos
