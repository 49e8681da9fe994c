#include "demos/report/comparison_report.h"

#include <algorithm>
#include <array>
#include <optional>

#include "demos/cause/cause_json.h"
#include "demos/compare/picture_mask.h"
#include "demos/format/base64.h"
#include "demos/format/json.h"
#include "demos/report/comparison_page.h"
#include "demos/system/atomic_file.h"
#include "demos/system/interrupt.h"
#include "engine/foundation/contract.h"
#include "renderer/image/png.h"

namespace carom::demos {
namespace {

using renderer::Image;
using renderer::Raster;

/// A script element that holds data: no '<' may stand in it as such.
void writeData(AtomicFile& file, const std::string& id, const Json& json) {
  std::string text = json.text();
  for (std::size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at))
    text.replace(at, 1, "\\u003c");
  file.write("<script type=\"application/json\" id=\"" + id + "\">" + text + "</script>\n");
}

/// The values that become black and white.
struct Range {
  int low = 0;
  int high = 255;
};

bool isAlpha(const Raster& raster, std::size_t sample) {
  const std::size_t channels = static_cast<std::size_t>(raster.channels);
  return raster.channels % 2 == 0 && sample % channels == channels - 1;
}

/// The range that both 16-bit images need, so that they stay comparable by eye.
Range commonRange(const std::optional<Raster>& a, const std::optional<Raster>& b) {
  Range range{65535, 0};
  for (const std::optional<Raster>* raster : {&a, &b}) {
    if (!*raster || (*raster)->bits != 16) continue;
    for (std::size_t i = 0; i < (*raster)->samples.size(); ++i) {
      if (isAlpha(**raster, i)) continue;
      range.low = std::min<int>(range.low, (*raster)->samples[i]);
      range.high = std::max<int>(range.high, (*raster)->samples[i]);
    }
  }
  return range;
}

/// 8 bits as they are; 16 bits with the range stretched from black to white.
Raster shown(const Raster& raster, const Range& range) {
  if (raster.bits == 8) return raster;
  Raster narrow = raster;
  narrow.bits = 8;
  const int width = std::max(1, range.high - range.low);
  for (std::size_t i = 0; i < raster.samples.size(); ++i) {
    const int value = raster.samples[i];
    narrow.samples[i] =
        static_cast<std::uint16_t>(isAlpha(raster, i) ? value / 257 : (value - range.low) * 255 / width);
  }
  return narrow;
}

std::string dataAddress(const Raster& raster) {
  return "data:image/png;base64," + base64(renderer::encodePng(raster));
}

std::string dataAddress(const Image& image) {
  return dataAddress(Raster{image.width, image.height, 3, 8, {image.rgb.begin(), image.rgb.end()}});
}

std::optional<Raster> readAgain(const std::filesystem::path& path,
                                const std::optional<renderer::RasterShape>& shape) {
  if (!shape) return std::nullopt;
  try {
    return renderer::readPngRaster(path).raster;
  } catch (const InputError&) {  // gone since it was compared: the figures stay true, the picture is left out
    return std::nullopt;
  }
}

std::string noteOf(bool has_difference, bool stretched, const Range& range, const ReportPlan& plan) {
  std::string note;
  if (has_difference)
    note = "Difference: |actual \u2212 golden| \u00d7 " + std::to_string(plan.amplify) +
           "; pixels beyond the tolerance are at least a third bright.";
  if (stretched)
    note += " The 16-bit values " + std::to_string(range.low) + " to " + std::to_string(range.high) +
            " are shown from black to white.";
  return note;
}

/// Stripes on the masked pixels and nothing elsewhere; no image where there are none.
std::optional<Raster> maskImage(const std::vector<bool>& masked, int width, int height) {
  constexpr std::array<std::uint16_t, 4> kStripe = {255, 176, 0, 150}, kBetween = {28, 27, 25, 110};
  constexpr int kStripeWidth = 3;  // pixels
  if (std::find(masked.begin(), masked.end(), true) == masked.end()) return std::nullopt;
  Raster image{width, height, 4, 8, std::vector<std::uint16_t>(4 * masked.size(), 0)};
  for (std::size_t i = 0; i < masked.size(); ++i) {
    if (!masked[i]) continue;
    const int x = static_cast<int>(i) % width, y = static_cast<int>(i) / width;
    const auto& color = (x + y) / kStripeWidth % 2 == 0 ? kStripe : kBetween;
    std::copy(color.begin(), color.end(), image.samples.begin() + static_cast<std::ptrdiff_t>(4 * i));
  }
  return image;
}

/// How many pixels of the pair are not looked at, and where these are.
void addMask(const Comparison& c, const PictureMask& mask, const Raster& golden, Json& images) {
  const std::vector<bool> masked = mask.maskedPixels(c.pair, golden.width, golden.height);
  const std::optional<Raster> image = maskImage(masked, golden.width, golden.height);
  if (!image) return;
  images.set("mask", dataAddress(*image));
  images.set("masked", static_cast<double>(std::count(masked.begin(), masked.end(), true)));
}

Json imagesOf(const Comparison& c, const ReportPlan& plan) {
  const std::optional<Raster> actual = readAgain(c.pair.actual, c.actual_shape);
  const std::optional<Raster> golden = readAgain(c.pair.golden, c.golden_shape);
  const Range range = commonRange(actual, golden);
  const bool stretched = (actual && actual->bits == 16) || (golden && golden->bits == 16);
  const bool has_difference = actual && golden && renderer::comparable(*actual, *golden);
  Json images = Json::object();
  if (golden) images.set("golden", dataAddress(shown(*golden, range)));
  if (actual) images.set("actual", dataAddress(shown(*actual, range)));
  if (has_difference) {
    const int tolerance = plan.gate.toleranceOf(actual->fullScale());
    Raster looked_at = *actual;
    if (plan.gate.mask != nullptr) {
      plan.gate.mask->apply(c.pair, looked_at, *golden);
      addMask(c, *plan.gate.mask, *golden, images);
    }
    images.set("difference",
               dataAddress(renderer::differenceImage(looked_at, *golden, {tolerance, plan.amplify})));
  }
  images.set("note", noteOf(has_difference, stretched, range, plan));
  return images;
}

/// What comparisonLine says, without the verdict and the cause, which the page shows apart.
std::string detailOf(const Comparison& c, const Gate& gate) {
  std::string line = comparisonLine(c, gate).substr(std::string(verdictName(c.verdict)).size() + 2);
  if (c.cause.known()) line.resize(line.size() - c.cause.headline.size() - 4);
  return line;
}

Json pairJson(const Comparison& c, bool embedded, const ReportPlan& plan) {
  const renderer::RasterShape frame =
      c.golden_shape ? *c.golden_shape : c.actual_shape.value_or(renderer::RasterShape{16, 9, 3, 8});
  Json pair = Json::object({{"name", c.pair.name},
                            {"verdict", verdictName(c.verdict)},
                            {"passes", c.passes()},
                            {"detail", detailOf(c, plan.gate)},
                            {"width", frame.width},
                            {"height", frame.height},
                            {"embedded", embedded}});
  if (c.cause.known()) pair.set("cause", causeJson(c.cause, CauseDetail::kTracks));
  if (!c.passes() && c.actual_shape) pair.set("acceptable", true);
  if (c.pair.golden.parent_path().extension() == ".variants")
    pair.set("variant", c.pair.golden.filename().string());
  if (plan.updates && !c.passes() && (plan.accepted.empty() || plan.accepted.contains(c.pair.name)))
    pair.set("update", updateName(plannedUpdate(c)));
  if (c.verdict != Verdict::kBeyond && c.verdict != Verdict::kWithin) return pair;
  const renderer::ImageDifference& d = c.difference;
  pair.set("largest", d.largest);
  pair.set("fullScale", d.full_scale);
  pair.set("pixelsBeyond", static_cast<double>(d.pixels_beyond));
  const renderer::Tile& t = d.worst_tile;
  pair.set("tile", Json::object({{"x", t.x}, {"y", t.y}, {"width", t.width}, {"height", t.height}}));
  return pair;
}

std::string gateText(const Gate& gate) {
  std::string text = "\u2264 " + std::to_string(gate.tolerance) + "/255, 16-bit \u2264 " +
                     std::to_string(gate.tolerance16) + "/65535";
  if (gate.allowed_pixels > 0) text += ", but for " + std::to_string(gate.allowed_pixels) + " pixels";
  return text;
}

bool isEmbedded(const Comparison& c, std::size_t rank, const ReportPlan& plan) {
  const bool has_image = c.actual_shape || c.golden_shape;
  return has_image && c.verdict != Verdict::kSame && rank < static_cast<std::size_t>(plan.embedded);
}

}  // namespace

void writeComparisonReport(const std::filesystem::path& path, const std::vector<Comparison>& comparisons,
                           const ReportPlan& plan) {
  AtomicFile file(path);
  file.write(kPageTop);
  const std::vector<std::size_t> order = bySeverity(comparisons);
  Json pairs = Json::array();
  for (std::size_t rank = 0; rank < order.size(); ++rank) {
    const Comparison& c = comparisons[order[rank]];
    const bool embedded = isEmbedded(c, rank, plan);
    pairs.push(pairJson(c, embedded, plan));
    if (!embedded) continue;
    throwIfInterrupted();
    writeData(file, "images-" + std::to_string(rank), imagesOf(c, plan));
  }
  const auto fact = [](const char* term, const std::string& text) { return Json::array({term, text}); };
  Json about = Json::array(
      {fact("actual", plan.actual), fact("golden", plan.golden), fact("each channel", gateText(plan.gate))});
  if (plan.gate.mask != nullptr)
    for (const std::string& mask : plan.gate.mask->texts()) about.push(fact("masked", mask));
  writeData(file, "facts",
            Json::object({{"summary", tallyText(tallyOf(comparisons))},
                          {"about", std::move(about)},
                          {"embedded", plan.embedded},
                          {"accept", plan.accept_command},
                          {"undo", plan.undo_command},
                          {"pairs", std::move(pairs)}}));
  file.write(kPageBottom);
  file.commit();
}

}  // namespace carom::demos
