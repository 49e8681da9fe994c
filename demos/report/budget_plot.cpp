#include "demos/report/budget_plot.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "demos/budget/frame_statistics.h"
#include "demos/budget/replays.h"
#include "demos/format/formatted.h"
#include "demos/format/markup_text.h"
#include "engine/foundation/contract.h"

namespace carom::demos {
namespace {

constexpr double kWidth = 1040.0, kLeft = 56.0, kRight = 760.0, kTop = 46.0, kBottom = 340.0;
constexpr double kLine = 18.0;    // from one line of text to the next
constexpr double kLabels = 13.0;  // likewise, of labels that would else lie over each other
constexpr std::size_t kSlowest = 5;
/// One a phase; apart in grey and for every common kind of colour vision, in the order of the stack.
constexpr std::array<const char*, kFramePhases> kColors = {"#1b4f72", "#2e86c1", "#85c1e9", "#b9770e",
                                                           "#f0b27a", "#7d6608", "#1e8449", "#7dcea0",
                                                           "#884ea0", "#aab7b8"};

/// A round number of about a fifth of the height.
double tickOf(double most) {
  const double power = std::pow(10.0, std::floor(std::log10(most / 5.0)));
  for (const double step : {1.0, 2.0, 5.0})
    if (step * power >= most / 5.0) return step * power;
  return 10.0 * power;
}

struct Scale {
  double most_ms = 1.0;
  std::size_t frames = 1;
  double x(std::size_t frame) const {
    return kLeft + (kRight - kLeft) * (static_cast<double>(frame) + 0.5) / static_cast<double>(frames);
  }
  double y(double ms) const { return kBottom - (kBottom - kTop) * std::min(1.0, ms / most_ms); }
};

std::string stackText(const BudgetPlot& plot, const Scale& scale) {
  std::string text;
  std::vector<double> below(plot.frames.size(), 0.0);
  for (std::size_t p = 0; p < kFramePhases; ++p) {
    std::string forth, back;
    double mean = 0.0;
    for (std::size_t i = 0; i < plot.frames.size(); ++i) {
      back = formatted("%.2f,%.2f ", scale.x(i), scale.y(below[i])) + back;
      below[i] += plot.frames[i].phase_ms[p];
      mean += plot.frames[i].phase_ms[p] / static_cast<double>(plot.frames.size());
      forth += formatted("%.2f,%.2f ", scale.x(i), scale.y(below[i]));
    }
    text += formatted("<polygon fill=\"%s\" points=\"", kColors[p]) + forth + back + "\"/>\n";
    const double y = kTop + kLine * static_cast<double>(kFramePhases - 1 - p);
    text += formatted(
        "<rect x=\"%.0f\" y=\"%.0f\" width=\"11\" height=\"11\" fill=\"%s\"/><text x=\"%.0f\" y=\"%.0f\">%s",
        kRight + 62.0, y, kColors[p], kRight + 79.0, y + 10.0, kFramePhaseNames[p]);
    text += formatted(" %.3g ms</text>\n", mean);
  }
  return text;
}

std::string axesText(const BudgetPlot& plot, const Scale& scale) {
  std::string text;
  const double tick = tickOf(scale.most_ms);
  for (double ms = 0.0; ms <= scale.most_ms; ms += tick)
    text += formatted(
        "<line class=\"grid\" x1=\"%.0f\" x2=\"%.0f\" y1=\"%.2f\" y2=\"%.2f\"/>"
        "<text class=\"end\" x=\"%.0f\" y=\"%.2f\">%g</text>\n",
        kLeft, kRight, scale.y(ms), scale.y(ms), kLeft - 6.0, scale.y(ms) + 4.0, ms);
  text += formatted("<text class=\"end\" x=\"%.0f\" y=\"%.0f\">ms</text>", kLeft - 6.0, kTop - 10.0);
  text += formatted(
      "<text x=\"%.0f\" y=\"%.0f\">0 s</text><text class=\"end\" x=\"%.0f\" y=\"%.0f\">%.3g s</text>\n",
      kLeft, kBottom + 18.0, kRight, kBottom + 18.0, plot.frames.back().time_s);
  return text;
}

std::string linesText(const BudgetPlot& plot, const Scale& scale) {
  std::string text;
  const std::vector<double> totals = totals_ms(plot.frames);
  double label_y = 0.0;
  for (const double percent : {99.0, 95.0, 50.0}) {
    if (static_cast<int>(totals.size()) < framesNeeded(percent)) continue;
    const double y = scale.y(percentile(totals, percent));
    label_y = std::max(y + 4.0, label_y + kLabels);
    text += formatted(
        "<line class=\"tick\" x1=\"%.0f\" x2=\"%.0f\" y1=\"%.2f\" y2=\"%.2f\"/><text x=\"%.0f\" "
        "y=\"%.2f\">p%g</text>\n",
        kRight, kRight + 8.0, y, y, kRight + 11.0, label_y, percent);
  }
  if (!plot.other_ms.empty()) {
    text += "<polyline class=\"other\" points=\"";
    for (std::size_t i = 0; i < std::min(plot.other_ms.size(), plot.frames.size()); ++i)
      text += formatted("%.2f,%.2f ", scale.x(i), scale.y(plot.other_ms[i]));
    text += "\"/>\n";
  }
  if (plot.budget_ms > 0.0 && plot.budget_ms <= scale.most_ms)
    text += formatted(
        "<line class=\"deadline\" x1=\"%.0f\" x2=\"%.0f\" y1=\"%.2f\" y2=\"%.2f\"/>"
        "<text class=\"end deadline-name\" x=\"%.0f\" y=\"%.2f\">deadline %g ms</text>\n",
        kLeft, kRight, scale.y(plot.budget_ms), scale.y(plot.budget_ms), kRight - 4.0,
        scale.y(plot.budget_ms) - 5.0, plot.budget_ms);
  for (const FrameCost& f : slowestFrames(plot.frames, kSlowest)) {
    const double x = scale.x(static_cast<std::size_t>(f.frame)), y = scale.y(f.total_ms);
    text += formatted(
        "<path class=\"mark\" d=\"M%.2f %.2fl-4 -8h8z\"><title>frame %d, %.3g s, %.4g ms</title></path>\n", x,
        y - 2.0, f.frame, f.time_s, f.total_ms);
  }
  return text;
}

constexpr char kStyle[] = R"(<style>
svg { background: #fff; color: #1c1b19; font: 12px system-ui, sans-serif; }
text { fill: currentColor; } .end { text-anchor: end; } .title { font-size: 15px; font-weight: 600; }
.grid { stroke: currentColor; stroke-opacity: .15; } .tick { stroke: currentColor; }
.deadline { stroke: #c0392b; stroke-width: 1.5; stroke-dasharray: 6 4; } .deadline-name { fill: #c0392b; }
.other { fill: none; stroke: currentColor; stroke-width: 1.3; } .mark { fill: #c0392b; }
@media (prefers-color-scheme: dark) { svg { background: #1a1a18; color: #ecebe6; }
  .deadline { stroke: #ff8d70; } .deadline-name, .mark { fill: #ff8d70; } }
@media print { svg { background: #fff; color: #000; } }
</style>
)";

}  // namespace

std::string plotSvg(const BudgetPlot& plot) {
  REQUIRE(!plot.frames.empty());
  Scale scale;
  scale.frames = plot.frames.size();
  for (const FrameCost& f : plot.frames) scale.most_ms = std::max(scale.most_ms, 1.08 * f.total_ms);
  for (const double ms : plot.other_ms) scale.most_ms = std::max(scale.most_ms, 1.08 * ms);
  // A deadline far above the frames would press them flat: it is drawn where it can be seen beside them.
  if (plot.budget_ms <= 3.0 * scale.most_ms) scale.most_ms = std::max(scale.most_ms, 1.08 * plot.budget_ms);
  std::vector<std::string> notes = plot.notes;
  if (!plot.other_ms.empty()) notes.push_back("line: " + plot.other);
  const double height = kBottom + 36.0 + kLine * static_cast<double>(notes.size());
  std::string text = formatted(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %.0f %.0f\" role=\"img\">\n", kWidth, height);
  text += "<title>" + markupText(plot.title) + "</title>\n" + kStyle;
  text +=
      formatted("<text class=\"title\" x=\"%.0f\" y=\"22\">", kLeft) + markupText(plot.title) + "</text>\n";
  text += axesText(plot, scale) + stackText(plot, scale) + linesText(plot, scale);
  for (std::size_t i = 0; i < notes.size(); ++i)
    text +=
        formatted("<text x=\"%.0f\" y=\"%.0f\">", kLeft, kBottom + 40.0 + kLine * static_cast<double>(i)) +
        markupText(notes[i]) + "</text>\n";
  return text + "</svg>\n";
}

std::string plotPage(const BudgetPlot& plot) {
  return "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>" +
         markupText(plot.title) +
         "</title>\n<style>:root { color-scheme: light dark; } body { margin: 0; padding: 24px; }\n"
         "@media (prefers-color-scheme: dark) { body { background: #1a1a18; } }</style>\n</head>\n<body>\n" +
         plotSvg(plot) + "</body>\n</html>\n";
}

}  // namespace carom::demos
