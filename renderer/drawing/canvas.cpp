#include "renderer/drawing/canvas.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numbers>

#include <cairo.h>

#include "engine/foundation/contract.h"

namespace carom::renderer {
namespace {

constexpr double kHaloWidth = 2.4;  // Pixels by which a halo is wider than its line, both sides together.
constexpr double kCapitalMiddleOverEm = 0.365;  // Half the height of DejaVu Sans' capitals.
constexpr Color kHaloColor = {1.0f, 1.0f, 1.0f};

// What is seen of Cairo's errors: out of memory, or a bug.
void requireGood(cairo_t* context) {
  REQUIRE(cairo_status(context) == CAIRO_STATUS_SUCCESS, cairo_status_to_string(cairo_status(context)));
}

cairo_surface_t* newSurface(cairo_format_t format, int width, int height) {
  cairo_surface_t* surface = cairo_image_surface_create(format, width, height);
  const cairo_status_t status = cairo_surface_status(surface);
  REQUIRE(status == CAIRO_STATUS_SUCCESS, cairo_status_to_string(status), width, height);
  return surface;
}

// Nothing is left to the settings of the machine: grey anti-aliasing, outlines as the font designs them.
void fixText(cairo_t* context) {
  cairo_font_options_t* options = cairo_font_options_create();
  cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
  cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
  cairo_font_options_set_subpixel_order(options, CAIRO_SUBPIXEL_ORDER_DEFAULT);
  cairo_set_font_options(context, options);
  cairo_font_options_destroy(options);
}

void setInk(cairo_t* context, const Color& color, double opacity) {
  cairo_set_source_rgba(context, static_cast<double>(color.r), static_cast<double>(color.g),
                        static_cast<double>(color.b), opacity);
}

void tracePath(cairo_t* context, std::span<const Vec2> points, bool closed) {
  cairo_new_path(context);
  for (const Vec2& p : points) cairo_line_to(context, p.x(), p.y());
  if (closed) cairo_close_path(context);
}

// Whole pixels that hold an outline, within an image.
struct PixelBox {
  int left = 0, top = 0, right = 0, bottom = 0;  // Right and bottom are the first outside.
  bool empty() const { return left >= right || top >= bottom; }
};

PixelBox pixelBox(std::span<const Vec2> outline, int width, int height) {
  Vec2 low = outline[0], high = outline[0];
  for (const Vec2& p : outline) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const auto within = [](double x, int most) { return static_cast<int>(std::clamp(x, 0.0, double(most))); };
  return {within(std::floor(low.x()) - 1.0, width), within(std::floor(low.y()) - 1.0, height),
          within(std::ceil(high.x()) + 1.0, width), within(std::ceil(high.y()) + 1.0, height)};
}

}  // namespace

struct Canvas::Impl {
  Impl(int width, int height)
      : surface(newSurface(CAIRO_FORMAT_RGB24, width, height)), context(cairo_create(surface)) {
    cairo_set_antialias(context, CAIRO_ANTIALIAS_GOOD);
    cairo_set_line_cap(context, CAIRO_LINE_CAP_ROUND);
    cairo_set_line_join(context, CAIRO_LINE_JOIN_ROUND);
    fixText(context);
  }
  ~Impl() {
    cairo_destroy(context);
    cairo_surface_destroy(surface);
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  void setFont(const TextStyle& style) const {
    cairo_select_font_face(context, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                           style.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(context, style.size_px);
  }

  cairo_surface_t* surface;
  cairo_t* context;
};

Canvas::Canvas(int width, int height, const Color& background)
    : impl_(std::make_unique<Impl>(width, height)) {
  setInk(impl_->context, background, 1.0);
  cairo_paint(impl_->context);
}

Canvas::Canvas(const Image& image) : impl_(std::make_unique<Impl>(image.width, image.height)) {
  cairo_surface_flush(impl_->surface);
  unsigned char* rows = cairo_image_surface_get_data(impl_->surface);
  const int stride = cairo_image_surface_get_stride(impl_->surface);
  for (int y = 0; y < image.height; ++y) {
    unsigned char* row = rows + static_cast<std::ptrdiff_t>(y) * stride;
    const std::uint8_t* from = image.pixel(0, y);
    for (int x = 0; x < image.width; ++x, from += 3) {
      const std::uint32_t pixel = std::uint32_t{from[0]} << 16 | std::uint32_t{from[1]} << 8 | from[2];
      std::memcpy(row + 4 * x, &pixel, 4);
    }
  }
  cairo_surface_mark_dirty(impl_->surface);
}

Canvas::~Canvas() = default;
Canvas::Canvas(Canvas&&) noexcept = default;
Canvas& Canvas::operator=(Canvas&&) noexcept = default;

int Canvas::width() const {
  return cairo_image_surface_get_width(impl_->surface);
}
int Canvas::height() const {
  return cairo_image_surface_get_height(impl_->surface);
}

void Canvas::line(std::span<const Vec2> points, const Stroke& stroke, bool closed) {
  REQUIRE(points.size() >= 2, points.size());
  cairo_t* context = impl_->context;
  tracePath(context, points, closed);
  if (stroke.halo > 0.0) {
    cairo_set_dash(context, nullptr, 0, 0.0);
    cairo_set_line_width(context, stroke.width_px + kHaloWidth);
    setInk(context, kHaloColor, stroke.halo * stroke.ink.opacity);
    cairo_stroke_preserve(context);
  }
  // Round caps lengthen a dash by the width; what is between dashes stays open.
  const std::array<double, 2> dashes = {stroke.dash_px, stroke.dash_px + stroke.width_px};
  cairo_set_dash(context, dashes.data(), stroke.dash_px > 0.0 ? 2 : 0, 0.0);
  cairo_set_line_width(context, stroke.width_px);
  setInk(context, stroke.ink.color, stroke.ink.opacity);
  cairo_stroke(context);
  requireGood(context);
}

void Canvas::fill(std::span<const Vec2> outline, const Ink& ink) {
  if (outline.size() < 3) return;
  tracePath(impl_->context, outline, true);
  setInk(impl_->context, ink.color, ink.opacity);
  cairo_fill(impl_->context);
  requireGood(impl_->context);
}

void Canvas::fill(std::span<const Vec2> outline, const Ink& ink, const PixelShare& share) {
  if (outline.size() < 3) return;
  const PixelBox box = pixelBox(outline, width(), height());
  if (box.empty()) return;
  cairo_surface_t* mask = newSurface(CAIRO_FORMAT_A8, box.right - box.left, box.bottom - box.top);
  cairo_t* coverage = cairo_create(mask);
  cairo_set_antialias(coverage, CAIRO_ANTIALIAS_GOOD);
  cairo_translate(coverage, -box.left, -box.top);
  tracePath(coverage, outline, true);
  cairo_fill(coverage);
  requireGood(coverage);
  cairo_destroy(coverage);

  cairo_surface_flush(mask);
  unsigned char* rows = cairo_image_surface_get_data(mask);
  const int stride = cairo_image_surface_get_stride(mask);
  for (int y = box.top; y < box.bottom; ++y) {
    unsigned char* row = rows + static_cast<std::ptrdiff_t>(y - box.top) * stride;
    for (int x = box.left; x < box.right; ++x) {
      unsigned char& covered = row[x - box.left];
      if (covered != 0) covered = static_cast<unsigned char>(std::lround(covered * share(x, y)));
    }
  }
  cairo_surface_mark_dirty(mask);
  setInk(impl_->context, ink.color, ink.opacity);
  cairo_mask_surface(impl_->context, mask, box.left, box.top);
  cairo_surface_destroy(mask);
  requireGood(impl_->context);
}

void Canvas::disc(const Vec2& center, double radius_px, const Ink& ink) {
  cairo_new_path(impl_->context);
  cairo_arc(impl_->context, center.x(), center.y(), radius_px, 0.0, 2.0 * std::numbers::pi);
  setInk(impl_->context, ink.color, ink.opacity);
  cairo_fill(impl_->context);
  requireGood(impl_->context);
}

void Canvas::text(const Vec2& at, const std::string& words, const TextStyle& style) {
  cairo_t* context = impl_->context;
  const double share = style.align == Align::kLeft ? 0.0 : style.align == Align::kMiddle ? 0.5 : 1.0;
  const double left = share > 0.0 ? at.x() - share * textWidth(words, style) : at.x();
  impl_->setFont(style);
  cairo_new_path(context);
  cairo_move_to(context, left, at.y() + kCapitalMiddleOverEm * style.size_px);
  if (style.halo > 0.0) {
    cairo_text_path(context, words.c_str());
    cairo_set_dash(context, nullptr, 0, 0.0);
    cairo_set_line_width(context, kHaloWidth + 0.08 * style.size_px);
    setInk(context, kHaloColor, style.halo * style.ink.opacity);
    cairo_stroke(context);
    cairo_move_to(context, left, at.y() + kCapitalMiddleOverEm * style.size_px);
  }
  setInk(context, style.ink.color, style.ink.opacity);
  cairo_show_text(context, words.c_str());
  cairo_new_path(context);
  requireGood(context);
}

double Canvas::textWidth(const std::string& words, const TextStyle& style) const {
  impl_->setFont(style);
  cairo_text_extents_t extents;
  cairo_text_extents(impl_->context, words.c_str(), &extents);
  return extents.x_advance;
}

Image Canvas::image() const {
  cairo_surface_flush(impl_->surface);
  const unsigned char* rows = cairo_image_surface_get_data(impl_->surface);
  const int stride = cairo_image_surface_get_stride(impl_->surface);
  Image image{width(), height(), {}};
  image.rgb.resize(3 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
  std::uint8_t* to = image.rgb.data();
  for (int y = 0; y < image.height; ++y) {
    const unsigned char* row = rows + static_cast<std::ptrdiff_t>(y) * stride;
    for (int x = 0; x < image.width; ++x) {
      std::uint32_t pixel = 0;
      std::memcpy(&pixel, row + 4 * x, 4);
      *to++ = static_cast<std::uint8_t>(pixel >> 16);
      *to++ = static_cast<std::uint8_t>(pixel >> 8);
      *to++ = static_cast<std::uint8_t>(pixel);
    }
  }
  return image;
}

}  // namespace carom::renderer
