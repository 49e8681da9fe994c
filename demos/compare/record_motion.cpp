#include "demos/compare/record_motion.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>

#include "demos/format/formatted.h"

namespace carom::demos {
namespace {

constexpr std::size_t kMostTracks = 12;  // bodies whose motion is told

std::map<std::string, std::size_t> indices(const MotionRecord& record) {
  std::map<std::string, std::size_t> found;
  for (std::size_t i = 0; i < record.bodies.size(); ++i) found[record.bodies[i].name] = i;
  return found;
}

struct Event {
  double time_s = 0.0;
  std::string text;
};

std::string pairText(const MotionRecord& record, int a, int b) {
  return record.bodies[static_cast<std::size_t>(a)].name + " and " +
         record.bodies[static_cast<std::size_t>(b)].name;
}

std::string timeText(double time_s) {
  return formatted("%.3g", time_s) + " s: ";
}

std::optional<Event> firstStrike(const MotionRecord& actual, const MotionRecord& golden, double until_s) {
  const std::size_t most = std::max(actual.strikes.size(), golden.strikes.size());
  for (std::size_t i = 0; i < most; ++i) {
    const RecordedStrike* a = i < actual.strikes.size() ? &actual.strikes[i] : nullptr;
    const RecordedStrike* g = i < golden.strikes.size() ? &golden.strikes[i] : nullptr;
    const std::string pair_a = a ? pairText(actual, a->body_a, a->body_b) : "";
    const std::string pair_g = g ? pairText(golden, g->body_a, g->body_b) : "";
    if (a && g && pair_a == pair_g && a->time_s == g->time_s && a->impulse_Ns == g->impulse_Ns) continue;
    const auto soon = [&](const RecordedStrike* s) { return s != nullptr && s->time_s <= until_s; };
    if (!soon(a) && !soon(g)) return std::nullopt;
    // A list that was cut short says nothing of what follows.
    const bool cut = (a == nullptr && !actual.strikes.empty() && i % 500 == 0) ||
                     (g == nullptr && !golden.strikes.empty() && i % 500 == 0);
    if (cut) return std::nullopt;
    if (a && g && pair_a == pair_g)
      return Event{std::min(a->time_s, g->time_s),
                   timeText(a->time_s) + pair_a + " collide with " + formatted("%.3g", a->impulse_Ns) +
                       " N s, was " + formatted("%.3g", g->impulse_Ns) + " N s" +
                       (a->time_s == g->time_s ? "" : " at " + formatted("%.3g", g->time_s) + " s")};
    const bool golden_first = !soon(a) || (soon(g) && g->time_s <= a->time_s);
    if (golden_first)
      return Event{g->time_s, timeText(g->time_s) + pair_g + " no longer collide (was " +
                                  formatted("%.3g", g->impulse_Ns) + " N s)"};
    return Event{a->time_s, timeText(a->time_s) + pair_a + " collide with " +
                                formatted("%.3g", a->impulse_Ns) + " N s, and did not"};
  }
  return std::nullopt;
}

std::map<std::string, double> touchesByName(const MotionRecord& record, const RecordedMoment& moment) {
  std::map<std::string, double> touches;
  for (const RecordedTouch& t : moment.touches) touches[pairText(record, t.body_a, t.body_b)] = t.impulse_Ns;
  return touches;
}

/// Calls `look(actual moment, golden moment)` for the moments after the same number of steps, until it says
/// that it has seen enough.
template <typename Look>
void forCommonMoments(const MotionRecord& actual, const MotionRecord& golden, const Look& look) {
  if (actual.step_s != golden.step_s) return;
  std::size_t a = 0, g = 0;
  while (a < actual.moments.size() && g < golden.moments.size()) {
    if (actual.moments[a].step < golden.moments[g].step) {
      ++a;
    } else if (golden.moments[g].step < actual.moments[a].step) {
      ++g;
    } else if (!look(actual.moments[a++], golden.moments[g++])) {
      return;
    }
  }
}

std::optional<Event> firstTouch(const MotionRecord& actual, const MotionRecord& golden, double until_s) {
  std::optional<Event> found;
  forCommonMoments(actual, golden, [&](const RecordedMoment& a, const RecordedMoment& g) {
    if (a.time_s > until_s) return false;
    const auto is = touchesByName(actual, a), was = touchesByName(golden, g);
    // Of all contacts that differ at this moment the one by the most.
    double most = -1.0;
    const auto tell = [&](double difference, const std::string& text) {
      if (difference <= most) return;
      most = difference;
      found = Event{a.time_s, timeText(a.time_s) + text};
    };
    for (const auto& [pair, impulse] : was) {
      const auto at = is.find(pair);
      if (at == is.end())
        tell(impulse, pair + " no longer touch (was " + formatted("%.3g", impulse) + " N s)");
      else if (at->second != impulse)
        tell(std::abs(at->second - impulse), pair + " press with " + formatted("%.3g", at->second) +
                                                 " N s, was " + formatted("%.3g", impulse) + " N s");
    }
    for (const auto& [pair, impulse] : is)
      if (!was.contains(pair))
        tell(impulse, pair + " touch with " + formatted("%.3g", impulse) + " N s, and did not");
    return !found.has_value();
  });
  return found;
}

double turnBetween(const RoundedPose& a, const RoundedPose& b) {
  double dot = 0.0, norm_a = 0.0, norm_b = 0.0;
  for (std::size_t i = 3; i < 7; ++i) {
    dot += static_cast<double>(a[i]) * static_cast<double>(b[i]);
    norm_a += static_cast<double>(a[i]) * static_cast<double>(a[i]);
    norm_b += static_cast<double>(b[i]) * static_cast<double>(b[i]);
  }
  if (norm_a == 0.0 || norm_b == 0.0) return 0.0;
  constexpr double kDegrees = 57.29577951308232;
  return 2.0 * std::acos(std::min(1.0, std::abs(dot) / std::sqrt(norm_a * norm_b))) * kDegrees;
}

std::vector<Vec3> trackOf(const MotionRecord& record, std::size_t body, const RecordedShot& shot) {
  std::vector<Vec3> track;
  for (const RecordedMoment& moment : record.moments)
    if (moment.time_s <= shot.time_s)
      track.push_back(positionOf(moment.poses[body], record.length_quantum_m));
  track.push_back(positionOf(shot.poses[body], record.length_quantum_m));
  return track;
}

}  // namespace

int firstDifferentStep(const MotionRecord& actual, const MotionRecord& golden) {
  if (actual.step_s != golden.step_s) return -1;
  const long long stride =
      std::lcm(static_cast<long long>(actual.print_stride), static_cast<long long>(golden.print_stride));
  for (long long step = 0;; step += stride) {
    const auto a = static_cast<std::size_t>(step / actual.print_stride);
    const auto g = static_cast<std::size_t>(step / golden.print_stride);
    if (a >= actual.prints.size() || g >= golden.prints.size()) return -1;
    if (actual.prints[a] != golden.prints[g]) return static_cast<int>(step);
  }
}

std::string firstEvent(const MotionRecord& actual, const MotionRecord& golden, double until_s) {
  const std::optional<Event> strike = firstStrike(actual, golden, until_s);
  const std::optional<Event> touch = firstTouch(actual, golden, until_s);
  if (touch && (!strike || touch->time_s < strike->time_s)) return touch->text;
  return strike ? strike->text : "";
}

std::vector<MovedBody> movedBodies(const RecordedPicture& actual, const RecordedPicture& golden) {
  const auto was = indices(golden.record), is = indices(actual.record);
  const double quantum_a = actual.record.length_quantum_m, quantum_g = golden.record.length_quantum_m;
  std::vector<MovedBody> moved;
  for (const auto& [name, a] : is) {
    const auto at = was.find(name);
    if (at == was.end()) continue;
    const RoundedPose &pose_a = actual.shot.poses[a], &pose_g = golden.shot.poses[at->second];
    const Vec3 shift = positionOf(pose_a, quantum_a) - positionOf(pose_g, quantum_g);
    const bool same = quantum_a == quantum_g && pose_a == pose_g;
    if (same) continue;
    moved.push_back({name, shift.norm(), turnBetween(pose_a, pose_g), -1.0, {}, {}});
  }
  std::stable_sort(moved.begin(), moved.end(),
                   [](const MovedBody& a, const MovedBody& b) { return a.distance_m > b.distance_m; });
  for (std::size_t i = 0; i < std::min(moved.size(), kMostTracks); ++i) {
    moved[i].golden = trackOf(golden.record, was.at(moved[i].name), golden.shot);
    moved[i].actual = trackOf(actual.record, is.at(moved[i].name), actual.shot);
  }
  forCommonMoments(actual.record, golden.record, [&](const RecordedMoment& a, const RecordedMoment& g) {
    if (a.time_s > actual.shot.time_s) return false;
    bool searching = false;
    for (MovedBody& body : moved) {
      if (body.since_s >= 0.0) continue;
      searching = true;
      if (a.poses[is.at(body.name)] != g.poses[was.at(body.name)]) body.since_s = a.time_s;
    }
    return searching;
  });
  return moved;
}

}  // namespace carom::demos
