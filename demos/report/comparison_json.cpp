#include "demos/report/comparison_json.h"

#include "demos/cause/cause_json.h"

namespace carom::demos {
namespace {

Json shapeJson(const renderer::RasterShape& shape) {
  return Json::object(
      {{"width", shape.width}, {"height", shape.height}, {"channels", shape.channels}, {"bits", shape.bits}});
}

Json differenceJson(const renderer::ImageDifference& d) {
  const renderer::Tile& t = d.worst_tile;
  return Json::object(
      {{"fullScale", d.full_scale},
       {"largest", d.largest},
       {"largestAt", Json::array({d.largest_x, d.largest_y})},
       {"largestChannel", d.largest_channel},
       {"mean", d.mean},
       {"pixelsDifferent", static_cast<double>(d.pixels_different)},
       {"pixelsBeyond", static_cast<double>(d.pixels_beyond)},
       {"worstTile", Json::object({{"x", t.x},
                                   {"y", t.y},
                                   {"width", t.width},
                                   {"height", t.height},
                                   {"pixelsBeyond", static_cast<double>(t.pixels_beyond)}})}});
}

Json pairJson(const Comparison& c) {
  Json json =
      Json::object({{"name", c.pair.name}, {"verdict", verdictName(c.verdict)}, {"passes", c.passes()}});
  if (c.actual_shape) json.set("actual", shapeJson(*c.actual_shape));
  if (c.golden_shape) json.set("golden", shapeJson(*c.golden_shape));
  if (c.verdict >= Verdict::kBeyond) json.set("difference", differenceJson(c.difference));
  if (c.cause.known()) {
    json.set("cause", c.cause.headline);
    json.set("causes", causeJson(c.cause, CauseDetail::kFacts));
  }
  if (!c.problem.empty()) json.set("problem", c.problem);
  return json;
}

Json tallyJson(const Tally& tally) {
  return Json::object({{"total", tally.total},
                       {"passed", tally.passed},
                       {"differ", tally.beyond},
                       {"sizeDiffers", tally.shape},
                       {"missing", tally.missing},
                       {"extra", tally.extra},
                       {"unreadable", tally.unreadable}});
}

}  // namespace

Json comparisonJson(const ComparisonOutcome& outcome) {
  const Tally tally = tallyOf(outcome.comparisons);
  Json pairs = Json::array();
  for (std::size_t i = 0; i < outcome.comparisons.size(); ++i) {
    Json pair = pairJson(outcome.comparisons[i]);
    if (!outcome.updates.empty() && outcome.updates[i] != Update::kNone)
      pair.set("update", updateName(outcome.updates[i]));
    pairs.push(std::move(pair));
  }
  Json json = Json::object(
      {{"passes", tally.passed == tally.total},
       {"gate", Json::object({{"tolerance", outcome.gate.tolerance},
                              {"tolerance16", outcome.gate.tolerance16},
                              {"allowedPixels", static_cast<double>(outcome.gate.allowed_pixels)}})},
       {"counts", tallyJson(tally)}});
  if (!outcome.report.empty()) json.set("report", outcome.report);
  json.set("pairs", std::move(pairs));
  return json;
}

}  // namespace carom::demos
