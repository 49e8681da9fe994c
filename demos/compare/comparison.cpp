#include "demos/compare/comparison.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <numeric>
#include <optional>
#include <tuple>

#include "demos/compare/cause.h"
#include "demos/compare/picture_mask.h"
#include "engine/foundation/contract.h"
#include "engine/foundation/input_file.h"
#include "renderer/image/png.h"

namespace carom::demos {
namespace {

using renderer::DecodedRaster;

/// The image, or nothing with the reason added to `problem`.
std::optional<DecodedRaster> read(const std::filesystem::path& path, std::string& problem) {
  try {
    return renderer::readPngRaster(path);
  } catch (const InputError& error) {
    if (!problem.empty()) problem += "; ";
    problem += error.what();
  }
  return std::nullopt;
}

/// Frames that were rendered alike are mostly alike to the byte, and then one decoding will do.
bool sameBytes(const std::filesystem::path& a, const std::filesystem::path& b) {
  std::ifstream in_a = tryInputFile(a).stream, in_b = tryInputFile(b).stream;
  if (!in_a.is_open() || !in_b.is_open()) return false;
  std::array<char, 1 << 16> chunk_a, chunk_b;
  do {
    in_a.read(chunk_a.data(), chunk_a.size());
    in_b.read(chunk_b.data(), chunk_b.size());
    if (in_a.gcount() != in_b.gcount()) return false;
    if (!std::equal(chunk_a.begin(), chunk_a.begin() + in_a.gcount(), chunk_b.begin())) return false;
  } while (in_a && in_b);
  return in_a.eof() && in_b.eof();
}

void judge(const DecodedRaster& actual, const DecodedRaster& golden, const Gate& gate, Comparison& result) {
  if (!renderer::comparable(actual.raster, golden.raster)) {
    result.verdict = Verdict::kShape;
    return;
  }
  const int tolerance = gate.toleranceOf(actual.raster.fullScale());
  result.difference = renderer::differenceOf(actual.raster, golden.raster, tolerance);
  if (result.difference.largest == 0) return;
  result.verdict =
      result.difference.pixels_beyond > gate.allowed_pixels ? Verdict::kBeyond : Verdict::kWithin;
}

/// Of two files with the same bytes: the same, if they are whole.
Comparison comparedCopies(const ImagePair& pair) {
  Comparison result;
  result.pair = pair;
  if (const std::optional<DecodedRaster> both = read(pair.golden, result.problem)) {
    result.actual_shape = result.golden_shape = both->raster.shape();
    result.difference.full_scale = both->raster.fullScale();
  } else {
    result.verdict = Verdict::kUnreadable;
  }
  return result;
}

std::string differenceText(const renderer::ImageDifference& d, int tolerance) {
  const std::string scale = std::string("/") + std::to_string(d.full_scale);
  std::string text = "largest " + std::to_string(d.largest) + scale + " at (" + std::to_string(d.largest_x) +
                     ", " + std::to_string(d.largest_y) + ") in " + d.largest_channel + "  " +
                     std::to_string(d.pixels_beyond) + (d.pixels_beyond == 1 ? " pixel" : " pixels") +
                     " beyond " + std::to_string(tolerance) + scale;
  if (d.pixels_beyond == 0) return text;
  const renderer::Tile& t = d.worst_tile;
  return text + "  worst tile " + std::to_string(t.width) + "x" + std::to_string(t.height) + " at (" +
         std::to_string(t.x) + ", " + std::to_string(t.y) + ")";
}

}  // namespace

namespace {

Comparison comparedOnce(const ImagePair& pair, const Gate& gate) {
  if (pair.has_actual && pair.has_golden && sameBytes(pair.actual, pair.golden)) return comparedCopies(pair);
  Comparison result;
  result.pair = pair;
  std::optional<DecodedRaster> actual, golden;
  if (pair.has_actual) actual = read(pair.actual, result.problem);
  if (pair.has_golden) golden = read(pair.golden, result.problem);
  if (actual) result.actual_shape = actual->raster.shape();
  if (golden) result.golden_shape = golden->raster.shape();
  if (!result.problem.empty()) {
    result.verdict = Verdict::kUnreadable;
  } else if (!actual) {
    result.verdict = Verdict::kMissing;
  } else if (!golden) {
    result.verdict = Verdict::kExtra;
  } else {
    DecodedRaster looked_at = *actual;
    if (gate.mask != nullptr) gate.mask->apply(pair, looked_at.raster, golden->raster);
    judge(looked_at, *golden, gate, result);
    if (result.verdict == Verdict::kBeyond) result.cause = causeByText(*actual, *golden);
  }
  return result;
}

/// What makes one golden image nearer than another.
auto distanceOf(const Comparison& c) {
  const double largest = static_cast<double>(c.difference.largest) / c.difference.full_scale;
  return std::make_tuple(-static_cast<int>(c.verdict), c.difference.pixels_beyond, largest);
}

}  // namespace

Comparison compared(const ImagePair& pair, const Gate& gate) {
  Comparison nearest = comparedOnce(pair, gate);
  if (!pair.has_actual || !pair.has_golden) return nearest;
  std::optional<Comparison> damaged;  // it might have been the one that passes
  for (const std::filesystem::path& variant : goldenVariants(pair.golden)) {
    if (nearest.passes()) break;
    ImagePair other = pair;
    other.golden = variant;
    Comparison c = comparedOnce(other, gate);
    if (c.verdict == Verdict::kUnreadable)
      damaged = std::move(c);
    else if (distanceOf(c) < distanceOf(nearest))
      nearest = std::move(c);
  }
  return damaged && !nearest.passes() ? *damaged : nearest;
}

const char* verdictName(Verdict verdict) {
  switch (verdict) {
    case Verdict::kUnreadable:
      return "unreadable";
    case Verdict::kShape:
      return "size differs";
    case Verdict::kMissing:
      return "missing";
    case Verdict::kExtra:
      return "extra";
    case Verdict::kBeyond:
      return "differs";
    case Verdict::kWithin:
      return "within tolerance";
    case Verdict::kSame:
      return "same";
  }
  return "";
}

std::string comparisonLine(const Comparison& c, const Gate& gate) {
  std::string line = verdictName(c.verdict);
  line += "  ";
  switch (c.verdict) {
    case Verdict::kUnreadable:
      line += c.problem;
      break;
    case Verdict::kShape:
      line += shapeText(*c.actual_shape) + ", golden " + shapeText(*c.golden_shape);
      break;
    case Verdict::kMissing:
      line += "no " + c.pair.actual.string();
      break;
    case Verdict::kExtra:
      line += "no " + c.pair.golden.string();
      break;
    case Verdict::kBeyond:
    case Verdict::kWithin:
      line += differenceText(c.difference, gate.toleranceOf(c.difference.full_scale));
      break;
    case Verdict::kSame:
      line += shapeText(*c.golden_shape);
      break;
  }
  return c.cause.known() ? line + "  (" + c.cause.headline + ")" : line;
}

std::vector<std::size_t> bySeverity(const std::vector<Comparison>& comparisons) {
  const auto rank = [&](std::size_t i) {
    const renderer::ImageDifference& d = comparisons[i].difference;
    const double largest = static_cast<double>(d.largest) / d.full_scale;
    return std::make_tuple(comparisons[i].verdict, -d.pixels_beyond, -largest, comparisons[i].pair.name);
  };
  std::vector<std::size_t> order(comparisons.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return rank(i) < rank(j); });
  return order;
}

Tally tallyOf(const std::vector<Comparison>& comparisons) {
  Tally tally;
  for (const Comparison& c : comparisons) {
    ++tally.total;
    tally.passed += c.passes() ? 1 : 0;
    tally.unreadable += c.verdict == Verdict::kUnreadable ? 1 : 0;
    tally.shape += c.verdict == Verdict::kShape ? 1 : 0;
    tally.missing += c.verdict == Verdict::kMissing ? 1 : 0;
    tally.extra += c.verdict == Verdict::kExtra ? 1 : 0;
    tally.beyond += c.verdict == Verdict::kBeyond ? 1 : 0;
  }
  return tally;
}

std::string tallyText(const Tally& tally) {
  std::string text = std::to_string(tally.passed) + " of " + std::to_string(tally.total) + " pass";
  const auto add = [&text](int count, const char* what) {
    if (count > 0) text += ", " + std::to_string(count) + " " + what;
  };
  add(tally.beyond, tally.beyond == 1 ? "differs" : "differ");
  add(tally.shape, "of another size");
  add(tally.missing, "missing");
  add(tally.extra, "extra");
  add(tally.unreadable, "unreadable");
  return text;
}

}  // namespace carom::demos
