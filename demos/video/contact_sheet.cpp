#include "demos/video/contact_sheet.h"

#include <algorithm>
#include <sstream>

#include "demos/format/formatted.h"
#include "demos/system/exit_code.h"
#include "engine/foundation/contract.h"
#include "renderer/drawing/canvas.h"
#include "renderer/image/png.h"

namespace carom::demos {
namespace {

constexpr int kMostASide = 64;

int extent(int pictures, int size_px) {
  return pictures * size_px + (pictures + 1) * ContactSheet::kGap_px;
}

/// The corner of the n-th picture.
int offset(int n, int size_px) {
  return ContactSheet::kGap_px + n * (size_px + ContactSheet::kGap_px);
}

}  // namespace

SheetShape readSheet(const std::string& text) {
  SheetShape sheet;
  char cross = 0, rest = 0;
  std::istringstream in(text);
  const bool parsed =
      static_cast<bool>(in >> sheet.columns >> cross >> sheet.rows) && cross == 'x' && !(in >> rest);
  const auto fits = [](int count) { return count >= 1 && count <= kMostASide; };
  if (!parsed || !fits(sheet.columns) || !fits(sheet.rows) || sheet.pictures() < 2)
    throw UsageError("--sheet " + text + ": accepted: COLUMNSxROWS such as 4x3, each 1 to " +
                     std::to_string(kMostASide) + ", two pictures at least");
  return sheet;
}

std::vector<int> sheetFrames(const SheetShape& sheet, int frame_count) {
  const int places = sheet.pictures();
  if (places > frame_count)
    throw UsageError("--sheet has " + std::to_string(places) + " places, the run " +
                     std::to_string(frame_count) + (frame_count == 1 ? " frame" : " frames") +
                     "; accepted: a smaller sheet, or a higher --fps");
  std::vector<int> frames;
  for (std::int64_t i = 0; i < places; ++i)
    frames.push_back(static_cast<int>((2 * i * (frame_count - 1) + places - 1) / (2 * (places - 1))));
  return frames;
}

ContactSheet::ContactSheet(const SheetShape& sheet, int width, int height)
    : sheet_(sheet), width_(width), height_(height) {
  pictures_ = {extent(sheet.columns, width), extent(sheet.rows, height), {}};
  if (std::max(pictures_.width, pictures_.height) > renderer::kMaxPngSide)
    throw UsageError("the sheet has " + std::to_string(pictures_.width) + " x " +
                     std::to_string(pictures_.height) + " pixels; accepted: " +
                     std::to_string(renderer::kMaxPngSide) + " a side; --size is that of each picture");
  pictures_.rgb.assign(
      3 * static_cast<std::size_t>(pictures_.width) * static_cast<std::size_t>(pictures_.height), 255);
}

void ContactSheet::add(std::span<const std::uint8_t> rgb, double time_s) {
  const int place = static_cast<int>(times_s_.size());
  REQUIRE(place < sheet_.pictures(), place);
  const std::size_t row_bytes = 3 * static_cast<std::size_t>(width_);
  const int left = offset(place % sheet_.columns, width_), top = offset(place / sheet_.columns, height_);
  for (int y = 0; y < height_; ++y) {
    const std::span<const std::uint8_t> row = rgb.subspan(row_bytes * static_cast<std::size_t>(y), row_bytes);
    std::copy(row.begin(), row.end(),
              pictures_.rgb.begin() + (pictures_.pixel(left, top + y) - pictures_.rgb.data()));
  }
  times_s_.push_back(time_s);
}

renderer::Image ContactSheet::image() const {
  renderer::Canvas canvas(pictures_);
  const double size_px = std::max(11.0, height_ / 14.0);
  const renderer::TextStyle style{.size_px = size_px, .ink = {{0.1f, 0.1f, 0.1f}}, .bold = true, .halo = 0.8};
  for (std::size_t i = 0; i < times_s_.size(); ++i) {
    const int place = static_cast<int>(i);
    canvas.text({offset(place % sheet_.columns, width_) + 0.5 * size_px,
                 offset(place / sheet_.columns, height_) + size_px},
                formatted("%.2f s", times_s_[i]), style);
  }
  return canvas.image();
}

}  // namespace carom::demos
