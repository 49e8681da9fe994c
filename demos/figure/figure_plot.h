#pragma once
// The axes of a plot on a figure's page, and what is drawn in them in the axes' units. Tested in
// tests/demos/figure/figures_test.cpp.

#include <span>
#include <string>

#include "demos/figure/figure_page.h"

namespace carom::demos {

struct PlotRange {
  double low = 0.0;
  double high = 1.0;
};

class Plot {
 public:
  Plot(const renderer::PixelRect& rect, const PlotRange& x, const PlotRange& y) : rect_(rect), x_(x), y_(y) {}

  /// Where a point of the plot is on the page.
  Vec2 pixel(double x, double y) const;
  const renderer::PixelRect& rect() const { return rect_; }

  struct Axes {
    std::string x_name, y_name;
    double x_step = 1.0, y_step = 1.0;  ///< Between ticks.
    int x_digits = 1, y_digits = 1;     ///< After the point.
  };
  void drawAxes(renderer::Canvas& canvas, const Axes& axes, const PageSize& size) const;
  /// A level line with its name at the right end.
  void drawLevel(renderer::Canvas& canvas, double y, const std::string& name, const renderer::Stroke& stroke,
                 const PageSize& size) const;
  /// Through points (x, y), cut off at the plot's borders.
  void drawCurve(renderer::Canvas& canvas, std::span<const Vec2> points,
                 const renderer::Stroke& stroke) const;

 private:
  renderer::PixelRect rect_;
  PlotRange x_, y_;
};

}  // namespace carom::demos
