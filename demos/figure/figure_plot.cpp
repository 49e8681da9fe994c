#include "demos/figure/figure_plot.h"

#include <array>
#include <cmath>
#include <vector>

namespace carom::demos {
Vec2 Plot::pixel(double x, double y) const {
  const Vec2 size = rect_.high - rect_.low;
  return {rect_.low.x() + size.x() * (x - x_.low) / (x_.high - x_.low),
          rect_.high.y() - size.y() * (y - y_.low) / (y_.high - y_.low)};
}

void Plot::drawAxes(renderer::Canvas& canvas, const Axes& axes, const PageSize& size) const {
  const double em = 0.8 * size.em(), width = 0.6 * size.line_px();
  const renderer::Stroke frame{{figure_color::kInk}, width}, grid{{figure_color::kFaint, 0.25}, 0.5 * width};
  const renderer::Ink ink{figure_color::kInk};
  const auto line = [&](const Vec2& a, const Vec2& b, const renderer::Stroke& stroke) {
    const std::array<Vec2, 2> ends = {a, b};
    canvas.line(ends, stroke);
  };
  for (double i = std::ceil(x_.low / axes.x_step - 1e-9); i * axes.x_step <= x_.high + 1e-9 * axes.x_step;
       ++i) {
    const double x = i * axes.x_step;
    line(pixel(x, y_.low), pixel(x, y_.high), grid);
    canvas.text(pixel(x, y_.low) + Vec2(0.0, em), decimalText(x, axes.x_digits),
                {em, ink, renderer::Align::kMiddle});
  }
  for (double i = std::ceil(y_.low / axes.y_step - 1e-9); i * axes.y_step <= y_.high + 1e-9 * axes.y_step;
       ++i) {
    const double y = i * axes.y_step;
    line(pixel(x_.low, y), pixel(x_.high, y), grid);
    canvas.text(pixel(x_.low, y) - Vec2(0.5 * em, 0.0), decimalText(y, axes.y_digits),
                {em, ink, renderer::Align::kRight});
  }
  line(pixel(x_.low, y_.low), pixel(x_.high, y_.low), frame);
  line(pixel(x_.low, y_.low), pixel(x_.low, y_.high), frame);
  canvas.text(pixel(x_.high, y_.low) + Vec2(0.0, 2.3 * em), axes.x_name, {em, ink, renderer::Align::kRight});
  canvas.text(pixel(x_.low, y_.high) + Vec2(0.0, -1.2 * em), axes.y_name, {em, ink, renderer::Align::kLeft});
}

void Plot::drawLevel(renderer::Canvas& canvas, double y, const std::string& name,
                     const renderer::Stroke& stroke, const PageSize& size) const {
  const std::array<Vec2, 2> ends = {pixel(x_.low, y), pixel(x_.high, y)};
  canvas.line(ends, stroke);
  canvas.text(ends[1] + Vec2(0.5 * size.em(), 0.0), name, {0.85 * size.em(), {stroke.ink.color}});
}

// A segment that crosses a border ends there.
void Plot::drawCurve(renderer::Canvas& canvas, std::span<const Vec2> points,
                     const renderer::Stroke& stroke) const {
  const auto inside = [&](const Vec2& p) {
    return p.x() >= x_.low && p.x() <= x_.high && p.y() >= y_.low && p.y() <= y_.high;
  };
  constexpr int kHalvings = 30;
  const auto border = [&](Vec2 in, Vec2 out) {
    for (int i = 0; i < kHalvings; ++i) (inside(0.5 * (in + out)) ? in : out) = 0.5 * (in + out);
    return pixel(in.x(), in.y());
  };
  std::vector<Vec2> run;
  const auto flush = [&] {
    if (run.size() > 1) canvas.line(run, stroke);
    run.clear();
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool here = inside(points[i]);
    const bool before = i > 0 && inside(points[i - 1]);
    if (i > 0 && here && !before) run.push_back(border(points[i], points[i - 1]));
    if (i > 0 && !here && before) run.push_back(border(points[i - 1], points[i]));
    if (here) run.push_back(pixel(points[i].x(), points[i].y()));
    if (!here) flush();
  }
  flush();
}

}  // namespace carom::demos
