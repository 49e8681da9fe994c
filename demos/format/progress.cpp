#include "demos/format/progress.h"

#include <chrono>
#include <cmath>
#include <ostream>

#include <unistd.h>

#include "demos/format/formatted.h"
#include "demos/format/json.h"

namespace carom::demos {
namespace {

constexpr double kRedrawEvery_s = 0.1;
constexpr double kLineEvery_s = 1.0;

struct Pace {
  double per_second = 0.0;
  double remaining_s = 0.0;
};

Pace paceOf(int count, int total, double elapsed_s) {
  if (elapsed_s <= 0.0 || count <= 0) return {};
  const double per_second = count / elapsed_s;
  return {per_second, (total - count) / per_second};
}

}  // namespace

ProgressStyle progressStyle(const std::string& name, bool quiet) {
  if (quiet || name == "none") return ProgressStyle::kNone;
  if (name == "json") return ProgressStyle::kJson;
  return ::isatty(STDERR_FILENO) != 0 ? ProgressStyle::kTerminal : ProgressStyle::kLines;
}

Progress::Progress(const Plan& plan, ProgressStyle style, std::ostream& out, Seconds now)
    : plan_(plan), style_(style), out_(out), now_(std::move(now)), started_s_(now_()) {}

Progress::~Progress() {
  if (style_ == ProgressStyle::kTerminal && shown_s_) out_ << "\r\033[K" << std::flush;
}

void Progress::done(int count) {
  if (style_ == ProgressStyle::kNone) return;
  const double now_s = now_();
  const double every_s = style_ == ProgressStyle::kTerminal ? kRedrawEvery_s : kLineEvery_s;
  const bool due = now_s - shown_s_.value_or(started_s_) >= every_s || count == plan_.total;
  if (!due) return;
  shown_s_ = now_s;
  const double elapsed_s = now_s - started_s_;
  switch (style_) {
    case ProgressStyle::kTerminal:
      out_ << '\r' << line(count, elapsed_s) << "\033[K";
      break;
    case ProgressStyle::kLines:
      out_ << line(count, elapsed_s) << '\n';
      break;
    case ProgressStyle::kJson:
      out_ << json(count, elapsed_s) << '\n';
      break;
    case ProgressStyle::kNone:
      break;
  }
  out_.flush();
}

std::string Progress::line(int count, double elapsed_s) const {
  const Pace pace = paceOf(count, plan_.total, elapsed_s);
  return formatted("%s %d/%d  %d %%  %.1f %s  eta %.0f s", plan_.unit.c_str(), count, plan_.total,
                   static_cast<int>(100.0 * count / plan_.total), pace.per_second,
                   plan_.unit == "frame" ? "fps" : "per s", std::ceil(pace.remaining_s));
}

std::string Progress::json(int count, double elapsed_s) const {
  const Pace pace = paceOf(count, plan_.total, elapsed_s);
  return Json::object({{plan_.unit, count},
                       {"total", plan_.total},
                       {"perSecond", pace.per_second},
                       {"elapsed_s", elapsed_s},
                       {"eta_s", pace.remaining_s}})
      .text();
}

double steadySeconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace carom::demos
