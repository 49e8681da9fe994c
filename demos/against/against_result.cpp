#include "demos/against/against_result.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <iterator>

#include "engine/foundation/contract.h"

namespace carom::demos {
namespace {

using TimeOf = std::function<double(const FrameCost&)>;

double medianOf(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// By how many of its logarithms this frame took longer than the other's; phases that took no time at all are
/// tied.
double difference(double now_ms, double other_ms) {
  return now_ms > 0.0 && other_ms > 0.0 ? std::log(now_ms / other_ms) : 0.0;
}

/// Of each two frames (A B, B A), the mean: who draws after itself finds its data in the cache, and is
/// quicker by more than what is sought. A last frame without a second is left out, unless it is the only one.
std::vector<double> differencesOf(const AgainstRound& round, const TimeOf& timeOf) {
  const auto at = [&](std::size_t i) { return difference(timeOf(round.now[i]), timeOf(round.other[i])); };
  if (round.now.size() == 1) return {at(0)};
  std::vector<double> differences;
  for (std::size_t i = 0; i + 1 < round.now.size(); i += 2) differences.push_back(0.5 * (at(i) + at(i + 1)));
  return differences;
}

SpeedChange changeOf(const std::string& name, const std::vector<AgainstRound>& rounds, const TimeOf& timeOf) {
  SpeedChange change;
  change.name = name;
  std::vector<double> now, other, all, medians;
  for (const AgainstRound& round : rounds) {
    std::transform(round.now.begin(), round.now.end(), std::back_inserter(now), timeOf);
    std::transform(round.other.begin(), round.other.end(), std::back_inserter(other), timeOf);
    const std::vector<double> within = differencesOf(round, timeOf);
    all.insert(all.end(), within.begin(), within.end());
    const double median = medianOf(within);
    change.rounds_slower += median > 0.0 ? 1 : 0;
    medians.push_back(median);
  }
  const SignTest test = signTest(all, kFalseAlarm);
  const SignedRankTest by_round = signedRankTest(medians, kFalseAlarm);
  change.now_ms = medianOf(now);
  change.other_ms = medianOf(other);
  change.change = std::expm1(test.median);
  change.smallest =
      std::max({kLeastEffect, std::expm1(test.smallest_effect), std::expm1(by_round.smallest_effect)});
  change.log_chance = std::max(test.log_chance, by_round.log_chance);
  const bool agree = (test.median > 0.0) == (by_round.shift > 0.0);
  if (!test.finds(kFalseAlarm) || !by_round.finds(kFalseAlarm) || !agree ||
      std::abs(change.change) < kLeastEffect)
    return change;
  change.speed = change.change > 0.0 ? Speed::kSlower : Speed::kFaster;
  return change;
}

std::vector<std::string> otherWork(const std::vector<AgainstRound>& rounds) {
  std::vector<std::string> kinds;
  const AgainstRound& round = rounds.front();
  for (std::size_t w = 0; w < kWorkKinds; ++w) {
    std::int64_t now = 0, other = 0;
    bool differs = false;
    if (round.now[0].work[w] == kNotCounted || round.other[0].work[w] == kNotCounted) continue;
    for (std::size_t i = 0; i < round.now.size(); ++i) {
      now += round.now[i].work[w];
      other += round.other[i].work[w];
      differs = differs || round.now[i].work[w] != round.other[i].work[w];
    }
    if (differs)
      kinds.push_back(std::string(kWork[w].name) + " " + std::to_string(now) + ", of the other " +
                      std::to_string(other));
  }
  return kinds;
}

std::string text(const char* format, double value) {
  char buffer[48];
  std::snprintf(buffer, sizeof buffer, format, value);
  return buffer;
}

std::string percent(double share) {
  return std::isfinite(share) ? text("%.2g %%", 100.0 * share) : "anything";
}

/// "p 3e-12": of ten to a power, for there may be no such double.
std::string chanceText(double log_chance) {
  const double tens = log_chance / std::log(10.0), power = std::floor(tens);
  return text("p %.0f", std::floor(std::pow(10.0, tens - power))) + text("e%.0f", power);
}

std::string changeLine(const SpeedChange& c) {
  return std::string(nameOf(c.speed)) + ": " + c.name + " by " + percent(std::abs(c.change)) + ", " +
         text("%.4g ms", c.now_ms) + ", of the other " + text("%.4g ms", c.other_ms) + " (" +
         chanceText(c.log_chance) + ")";
}

Json changeJson(const SpeedChange& c) {
  return Json::object({{"name", c.name},
                       {"verdict", nameOf(c.speed)},
                       {"now_ms", c.now_ms},
                       {"other_ms", c.other_ms},
                       {"change", c.change},
                       {"smallestSeen", std::isfinite(c.smallest) ? Json(c.smallest) : Json()},
                       {"log10Chance", c.log_chance / std::log(10.0)},
                       {"roundsSlower", c.rounds_slower}});
}

}  // namespace

const char* nameOf(Speed speed) {
  switch (speed) {
    case Speed::kSame:
      return "same";
    case Speed::kSlower:
      return "slower";
    case Speed::kFaster:
      return "faster";
  }
  return "?";
}

AgainstResult judgedAgainst(const std::vector<AgainstRound>& rounds, const std::string& other,
                            const std::string& clock) {
  REQUIRE(!rounds.empty() && !rounds.front().now.empty());
  for (const AgainstRound& round : rounds) REQUIRE(round.now.size() == round.other.size());
  AgainstResult result;
  result.other = other;
  result.clock = clock;
  result.rounds = static_cast<int>(rounds.size());
  result.frames = static_cast<int>(rounds.front().now.size());
  result.frame = changeOf("frame", rounds, [](const FrameCost& f) { return f.total_ms; });
  for (std::size_t p = 0; p < kFramePhases; ++p) {
    SpeedChange phase =
        changeOf(kFramePhaseNames[p], rounds, [p](const FrameCost& f) { return f.phase_ms[p]; });
    if (std::abs(phase.change) * phase.other_ms < kLeastOfFrame * result.frame.other_ms)
      phase.speed = Speed::kSame;
    result.phases.push_back(phase);
  }
  const AgainstRound& first = rounds.front();
  for (std::size_t i = 0; i < first.now.size() && result.first_other_state < 0; ++i)
    if (first.now[i].state_hash != first.other[i].state_hash) result.first_other_state = static_cast<int>(i);
  result.work = otherWork(rounds);
  return result;
}

std::vector<std::string> againstLines(const AgainstResult& r) {
  std::vector<std::string> lines;
  lines.push_back(std::to_string(r.rounds) + " rounds of " + std::to_string(r.frames) + " paired frames, " +
                  (r.clock == "cpu" ? "CPU time of all threads" : "wall time") + ", against " + r.other);
  if (r.first_other_state >= 0)
    lines.push_back("states differ from frame " + std::to_string(r.first_other_state) +
                    " on: the two do not simulate the same motion");
  else
    lines.push_back("states equal in every frame");
  for (const std::string& kind : r.work) lines.push_back("other work: " + kind);
  std::vector<SpeedChange> named;
  for (const SpeedChange& phase : r.phases)
    if (phase.speed != Speed::kSame) named.push_back(phase);
  std::stable_sort(named.begin(), named.end(), [](const SpeedChange& a, const SpeedChange& b) {
    return std::abs(a.now_ms - a.other_ms) > std::abs(b.now_ms - b.other_ms);
  });
  for (const SpeedChange& phase : named) lines.push_back(changeLine(phase));
  if (r.frame.speed != Speed::kSame)
    lines.push_back(changeLine(r.frame));
  else
    lines.push_back("same: frame " + text("%.4g ms", r.frame.now_ms) + ", of the other " +
                    text("%.4g ms", r.frame.other_ms) + "; a difference of " + percent(r.frame.smallest) +
                    " would have been seen");
  return lines;
}

Json againstJson(const AgainstResult& r) {
  Json phases = Json::array(), work = Json::array();
  for (const SpeedChange& phase : r.phases) phases.push(changeJson(phase));
  for (const std::string& kind : r.work) work.push(kind);
  Json json = Json::object({{"format", 1},
                            {"against", r.other},
                            {"clock", r.clock},
                            {"rounds", r.rounds},
                            {"frames", r.frames},
                            {"statesEqual", r.first_other_state < 0}});
  if (r.first_other_state >= 0) json.set("firstOtherState", r.first_other_state);
  json.set("otherWork", std::move(work));
  json.set("frame", changeJson(r.frame));
  json.set("phases", std::move(phases));
  return json;
}

}  // namespace carom::demos
