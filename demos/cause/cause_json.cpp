#include "demos/cause/cause_json.h"

#include <algorithm>
#include <cmath>

#include "demos/format/formatted.h"

namespace carom::demos {
namespace {

constexpr std::size_t kMostMoved = 3;

Json trackJson(const std::vector<Vec3>& track) {
  Json json = Json::array();
  for (const Vec3& p : track)
    for (const double x : p) json.push(std::round(1e5 * x) / 1e5);
  return json;
}

std::string movedText(const MovedBody& body) {
  std::string text = body.name + " by " + formatted("%.3g", body.distance_m) + " m";
  if (body.turn_degrees >= 0.05) text += " and " + formatted("%.3g", body.turn_degrees) + " degrees";
  if (body.since_s >= 0.0) text += " since " + formatted("%.3g", body.since_s) + " s";
  return text;
}

}  // namespace

Json causeJson(const Cause& cause, CauseDetail detail) {
  Json changes = Json::array(), moved = Json::array(), pixels = Json::array(), lines = Json::array();
  for (const Change& c : cause.changes)
    changes.push(Json::object({{"part", c.part}, {"name", c.name}, {"text", c.text}}));
  for (const MovedBody& b : cause.moved) {
    Json body =
        Json::object({{"name", b.name}, {"distance_m", b.distance_m}, {"turn_degrees", b.turn_degrees}});
    if (b.since_s >= 0.0) body.set("since_s", b.since_s);
    if (detail == CauseDetail::kTracks && !b.golden.empty()) {
      body.set("golden", trackJson(b.golden));
      body.set("actual", trackJson(b.actual));
    }
    moved.push(std::move(body));
  }
  for (const BodyPixels& p : cause.pixels)
    pixels.push(Json::object({{"name", p.name}, {"pixels", static_cast<double>(p.pixels)}}));
  for (const std::string& line : causeLines(cause)) lines.push(line);
  Json json = Json::object({{"headline", cause.headline}, {"changes", std::move(changes)}});
  if (cause.since_s >= 0.0) json.set("since_s", cause.since_s);
  if (!cause.first_event.empty()) json.set("firstEvent", cause.first_event);
  json.set("moved", std::move(moved));
  json.set("pixels", std::move(pixels));
  if (!cause.evidence.empty()) json.set("evidence", cause.evidence);
  json.set("lines", std::move(lines));
  return json;
}

std::vector<std::string> causeLines(const Cause& cause) {
  std::vector<std::string> lines;
  if (cause.since_s >= 0.0)
    lines.push_back("the states differ since " + formatted("%.3g", cause.since_s) + " s");
  if (!cause.first_event.empty()) lines.push_back("first event that differs: at " + cause.first_event);
  if (!cause.moved.empty()) {
    std::string text = "moved: ";
    for (std::size_t i = 0; i < std::min(cause.moved.size(), kMostMoved); ++i)
      text += (i == 0 ? "" : "; ") + movedText(cause.moved[i]);
    if (cause.moved.size() > kMostMoved)
      text += "; and " + std::to_string(cause.moved.size() - kMostMoved) + " more";
    lines.push_back(text);
  }
  if (!cause.evidence.empty()) lines.push_back(cause.evidence);
  return lines;
}

}  // namespace carom::demos
