#include "demos/compare/cause.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <set>

#include "demos/cause/picture_evidence.h"
#include "demos/compare/picture_mask.h"
#include "demos/format/content_hash.h"
#include "engine/foundation/contract.h"

namespace carom::demos {
namespace {

constexpr std::size_t kMostNamed = 3;     // bodies in one line
constexpr std::size_t kMostTracks = 12;   // bodies whose motion is told
constexpr std::size_t kMostChanges = 40;  // a wholly other world is not told body by body

std::string shortNumber(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

/// "crate, crate[1], crate[2] and 4 more"
std::string namesText(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), kMostNamed); ++i)
    text += (i == 0 ? "" : ", ") + names[i];
  if (names.size() > kMostNamed) text += " and " + std::to_string(names.size() - kMostNamed) + " more";
  return text;
}

std::string factOf(const Facts& facts, const std::string& name) {
  for (const auto& [known, text] : facts)
    if (known == name) return text;
  return "";
}

/// A fact that is not as it was; an empty text: there is none.
struct FactChange {
  std::string name, golden, actual;
};
std::vector<FactChange> changedFacts(const Facts& actual, const Facts& golden) {
  std::vector<FactChange> changes;
  for (const auto& [name, was] : golden)
    if (factOf(actual, name) != was) changes.push_back({name, was, factOf(actual, name)});
  for (const auto& [name, is] : actual) {
    const bool known =
        std::any_of(golden.begin(), golden.end(), [&n = name](const auto& f) { return f.first == n; });
    if (!known) changes.push_back({name, "", is});
  }
  return changes;
}

std::string changeText(const std::string& what, const FactChange& c) {
  if (c.actual.empty()) return what + " is no longer there (" + c.golden + ")";
  if (c.golden.empty()) return what + " is new (" + c.actual + ")";
  return what + " is " + c.actual + ", was " + c.golden;
}

/// Bodies by name, for indices shift where one is missing.
std::map<std::string, const RecordedBody*> byName(const MotionRecord& record) {
  std::map<std::string, const RecordedBody*> bodies;
  for (const RecordedBody& body : record.bodies) bodies[body.name] = &body;
  return bodies;
}
std::map<std::string, std::size_t> indices(const MotionRecord& record) {
  std::map<std::string, std::size_t> found;
  for (std::size_t i = 0; i < record.bodies.size(); ++i) found[record.bodies[i].name] = i;
  return found;
}

double distanceOf(const std::string& actual, const std::string& golden) {
  double a[3] = {}, g[3] = {};
  if (std::sscanf(actual.c_str(), "%lf %lf %lf", a, a + 1, a + 2) != 3 ||
      std::sscanf(golden.c_str(), "%lf %lf %lf", g, g + 1, g + 2) != 3)
    return 0.0;
  return std::hypot(a[0] - g[0], a[1] - g[1], a[2] - g[2]);
}

/// What is the same for several bodies is one change.
class BodyChanges {
 public:
  void add(const std::string& part, const std::string& body, const FactChange& change) {
    const std::string key = part + '\n' + change.name + '\n' + change.golden + '\n' + change.actual;
    auto [at, is_new] = order_.try_emplace(key, groups_.size());
    if (is_new) groups_.push_back({part, change, {}});
    groups_[at->second].bodies.push_back(body);
  }
  std::vector<Change> told() const {
    std::vector<Change> changes;
    for (const Group& g : groups_) changes.push_back({g.part, g.bodies.front(), text(g)});
    return changes;
  }

 private:
  struct Group {
    std::string part;
    FactChange change;
    std::vector<std::string> bodies;
  };
  static std::string text(const Group& g) {
    const std::string names = namesText(g.bodies);
    if (g.part == "mesh") return "the shape of " + names + " changed";
    if (g.change.name == "position")
      return names + " starts " + shortNumber(distanceOf(g.change.actual, g.change.golden)) +
             " m away from where it was (" + g.change.actual + ", was " + g.change.golden + ")";
    return changeText(g.change.name + " of " + names, g.change);
  }
  std::map<std::string, std::size_t> order_;
  std::vector<Group> groups_;
};

void addPresence(const MotionRecord& actual, const MotionRecord& golden, std::vector<Change>& changes) {
  const auto is = byName(actual), was = byName(golden);
  std::vector<std::string> missing, added;
  for (const RecordedBody& body : golden.bodies)
    if (!is.contains(body.name)) missing.push_back(body.name);
  for (const RecordedBody& body : actual.bodies)
    if (!was.contains(body.name)) added.push_back(body.name);
  const auto tell = [&](const std::vector<std::string>& names, const char* one, const char* many) {
    if (!names.empty())
      changes.push_back({"body", names.front(), namesText(names) + (names.size() == 1 ? one : many)});
  };
  tell(missing, " is missing", " are missing");
  tell(added, " is new", " are new");
}

/// What differs in the bodies: in how they move, and in how they look alone.
void addBodies(const MotionRecord& actual, const MotionRecord& golden, std::vector<Change>& world,
               std::vector<Change>& look) {
  const auto was = byName(golden);
  BodyChanges moving, looking;
  for (const RecordedBody& body : actual.bodies) {
    const auto at = was.find(body.name);
    if (at == was.end()) continue;
    const RecordedBody& old = *at->second;
    const std::vector<FactChange> shape = changedFacts(body.shape, old.shape);
    // Another shape has another centre of mass, where the pose is.
    if (!shape.empty()) moving.add("mesh", body.name, {"shape", "", ""});
    if (shape.empty())
      for (const FactChange& c : changedFacts(body.motion, old.motion)) moving.add("body", body.name, c);
    for (const FactChange& c : changedFacts(body.stuff, old.stuff)) moving.add("material", body.name, c);
    for (const FactChange& c : changedFacts(body.look, old.look)) looking.add("material", body.name, c);
  }
  for (const Change& c : moving.told()) world.push_back(c);
  for (const Change& c : looking.told()) look.push_back(c);
}

std::string vectorText(const Vec3& v) {
  return shortNumber(v.x()) + ' ' + shortNumber(v.y()) + ' ' + shortNumber(v.z());
}

void addCamera(const renderer::Camera& actual, const renderer::Camera& golden, std::vector<Change>& look) {
  const auto add = [&](const std::string& text) { look.push_back({"camera", "camera", text}); };
  if (actual.eye != golden.eye)
    add("the camera stands " + shortNumber((actual.eye - golden.eye).norm()) + " m away from where it was (" +
        vectorText(actual.eye) + ", was " + vectorText(golden.eye) + ")");
  if (actual.target != golden.target)
    add("the camera looks at " + vectorText(actual.target) + ", was " + vectorText(golden.target));
  if (actual.fov_degrees != golden.fov_degrees)
    add("the camera's field of view is " + shortNumber(actual.fov_degrees) + " degrees, was " +
        shortNumber(golden.fov_degrees));
  if (actual.aperture_m != golden.aperture_m)
    add("the camera's aperture is " + shortNumber(actual.aperture_m) + " m, was " +
        shortNumber(golden.aperture_m) + " m");
  if (actual.focus_m != golden.focus_m && actual.aperture_m > 0.0)
    add("the camera is in focus at " + shortNumber(actual.focus_m) + " m, was " +
        shortNumber(golden.focus_m) + " m");
}

std::string partOfLook(const std::string& fact) {
  if (fact.starts_with("light")) return "light";
  if (fact == "size" || fact == "renderer" || fact == "program") return fact;
  if (fact.starts_with("color of ")) return "material";
  return "preset";
}

/// The source file's part of the program.
std::string partOfSource(const std::string& file) {
  if (file.starts_with("engine/")) return "engine";
  if (!file.starts_with("renderer/")) return "program";
  for (const char* encoder : {"png", "quick_deflate"})
    if (file.find(encoder) != std::string::npos) return "encoder";
  for (const char* shader : {"shader", "glsl", "pass", "shadow_map", "backdrop", "edge_filter"})
    if (file.find(shader) != std::string::npos) return "shader";
  return "renderer";
}

std::vector<Change> changedSources(const MotionRecord& actual, const MotionRecord& golden, bool of_engine) {
  std::vector<Change> changes;
  for (const FactChange& c : changedFacts(actual.sources, golden.sources)) {
    const std::string part = partOfSource(c.name);
    if ((part == "engine") != of_engine) continue;
    const char* what = c.actual.empty() ? " is gone" : c.golden.empty() ? " is new" : " changed";
    changes.push_back({part, c.name, c.name + what});
  }
  // The renderer draws; the program only hands it what is compared above.
  std::stable_partition(changes.begin(), changes.end(), [](const Change& c) { return c.part != "program"; });
  return changes;
}

/// The first step after which the states differ, of those of which both have a print; -1: none, or not known.
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

struct Event {
  double time_s = 0.0;
  std::string text;
};

std::string pairText(const MotionRecord& record, int a, int b) {
  return record.bodies[static_cast<std::size_t>(a)].name + " and " +
         record.bodies[static_cast<std::size_t>(b)].name;
}

std::string timeText(double time_s) {
  return shortNumber(time_s) + " s: ";
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
                   timeText(a->time_s) + pair_a + " collide with " + shortNumber(a->impulse_Ns) +
                       " N s, was " + shortNumber(g->impulse_Ns) + " N s" +
                       (a->time_s == g->time_s ? "" : " at " + shortNumber(g->time_s) + " s")};
    const bool golden_first = !soon(a) || (soon(g) && g->time_s <= a->time_s);
    if (golden_first)
      return Event{g->time_s, timeText(g->time_s) + pair_g + " no longer collide (was " +
                                  shortNumber(g->impulse_Ns) + " N s)"};
    return Event{a->time_s, timeText(a->time_s) + pair_a + " collide with " + shortNumber(a->impulse_Ns) +
                                " N s, and did not"};
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
        tell(impulse, pair + " no longer touch (was " + shortNumber(impulse) + " N s)");
      else if (at->second != impulse)
        tell(std::abs(at->second - impulse),
             pair + " press with " + shortNumber(at->second) + " N s, was " + shortNumber(impulse) + " N s");
    }
    for (const auto& [pair, impulse] : is)
      if (!was.contains(pair))
        tell(impulse, pair + " touch with " + shortNumber(impulse) + " N s, and did not");
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

/// One side of a comparison at a frame.
struct Side {
  const MotionRecord& record;
  const RecordedShot& shot;
};

std::vector<MovedBody> movedBodies(const Side& actual, const Side& golden) {
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

std::string joined(const std::vector<Change>& changes) {
  std::string text;
  for (std::size_t i = 0; i < std::min(changes.size(), kMostNamed); ++i)
    text += (i == 0 ? "" : "; ") + changes[i].text;
  if (changes.size() > kMostNamed) text += "; and " + std::to_string(changes.size() - kMostNamed) + " more";
  return text;
}

void append(std::vector<Change>& changes, const std::vector<Change>& more) {
  for (const Change& c : more)
    if (changes.size() < kMostChanges) changes.push_back(c);
}

/// What differs between two records, in the order in which it is to be suspected.
struct Differences {
  std::vector<Change> world;  ///< What the motion follows from.
  std::vector<Change> look;   ///< What the picture of a motion follows from.
};

Differences differencesOf(const Side& actual, const Side& golden) {
  Differences found;
  for (const FactChange& c : changedFacts(actual.record.world, golden.record.world))
    found.world.push_back({"world", c.name, changeText(c.name, c)});
  addPresence(actual.record, golden.record, found.world);
  addBodies(actual.record, golden.record, found.world, found.look);
  addCamera(actual.shot.camera, golden.shot.camera, found.look);
  for (const FactChange& c : changedFacts(actual.record.look, golden.record.look))
    found.look.push_back({partOfLook(c.name), c.name, changeText(c.name, c)});
  // Another compiler or driver is suspected last.
  std::stable_partition(found.look.begin(), found.look.end(),
                        [](const Change& c) { return c.part != "renderer" && c.part != "program"; });
  return found;
}

bool onlyProgram(const std::vector<Change>& look) {
  return std::all_of(look.begin(), look.end(),
                     [](const Change& c) { return c.part == "renderer" || c.part == "program"; });
}

/// The states differ.
void blameMotion(const Side& actual, const Side& golden, const Differences& found, Cause& cause) {
  const int step = firstDifferentStep(actual.record, golden.record);
  if (step >= 0) cause.since_s = step * actual.record.step_s;
  std::optional<Event> strike = firstStrike(actual.record, golden.record, actual.shot.time_s);
  const std::optional<Event> touch = firstTouch(actual.record, golden.record, actual.shot.time_s);
  if (touch && (!strike || touch->time_s < strike->time_s)) strike = touch;
  if (strike) cause.first_event = strike->text;
  cause.moved = movedBodies(actual, golden);
  if (!found.world.empty()) {
    cause.headline = "physics moved: " + joined(found.world);
    append(cause.changes, found.world);
    if (!onlyProgram(found.look)) cause.headline += "; also " + found.look.front().text;
    append(cause.changes, found.look);
    return;
  }
  const std::vector<Change> sources = changedSources(actual.record, golden.record, true);
  cause.headline = "physics moved: the same scene";
  if (step >= 0)
    cause.headline +=
        ", other states from step " + std::to_string(step) + " (" + shortNumber(cause.since_s) + " s) on";
  cause.headline += sources.empty() ? "" : "; " + joined(sources);
  append(cause.changes, sources);
  if (sources.empty())
    cause.changes.push_back({"engine", "engine", "the same sources of the engine, other states"});
  if (!onlyProgram(found.look)) cause.headline += "; also " + found.look.front().text;
  append(cause.changes, found.look);
}

/// The states are the same.
void blamePicture(const Side& actual, const Side& golden, const Differences& found, Cause& cause) {
  std::vector<Change> world;  // what shows without moving: shapes, bodies that came or went
  for (const Change& c : found.world)
    if (c.part == "mesh" || c.part == "body") world.push_back(c);
  append(cause.changes, world);
  if (!onlyProgram(found.look) || !world.empty()) {
    append(cause.changes, found.look);
    cause.headline = "the same motion, another look: " + joined(cause.changes);
    return;
  }
  const std::vector<Change> sources = changedSources(actual.record, golden.record, false);
  append(cause.changes, sources);
  append(cause.changes, found.look);
  cause.headline = "the renderer changed: the same states and look";
  if (!cause.changes.empty()) cause.headline += "; " + joined(cause.changes);
  if (cause.changes.empty())
    cause.changes.push_back({"renderer", "renderer", "the same sources, other pixels"});
}

Cause causeAtShots(const Side& actual, const Side& golden) {
  Cause cause;
  if (actual.record.scene != golden.record.scene) {
    cause.headline = "another scene: " + actual.record.scene + ", was " + golden.record.scene;
    cause.changes.push_back({"scene", actual.record.scene, cause.headline});
    return cause;
  }
  if (actual.shot.time_s != golden.shot.time_s) {
    cause.headline = "another moment: " + shortNumber(actual.shot.time_s) + " s, was " +
                     shortNumber(golden.shot.time_s) + " s";
    cause.changes.push_back({"moment", actual.shot.file, cause.headline});
  }
  const Differences found = differencesOf(actual, golden);
  if (!cause.changes.empty()) {
    append(cause.changes, found.world);
    append(cause.changes, found.look);
    return cause;
  }
  // Prints of states of other numbers of bodies or steps differ even where what is drawn does not.
  if (actual.shot.state_hash != golden.shot.state_hash)
    blameMotion(actual, golden, found, cause);
  else
    blamePicture(actual, golden, found, cause);
  return cause;
}

std::string textOf(const renderer::PngText& text, const char* key) {
  for (const auto& [name, value] : text)
    if (name == key) return value;
  return "";
}

/// Whether the pixels are those that the frame's text signs; true where it signs none.
bool isAsDrawn(const renderer::DecodedRaster& frame) {
  const std::string signature = textOf(frame.text, "Pixels");
  if (signature.empty()) return true;
  ContentHash hash;
  const std::vector<std::uint16_t>& samples = frame.raster.samples;
  if (frame.raster.bits == 16) {
    hash.add(samples.data(), samples.size() * sizeof(std::uint16_t));
  } else {
    const std::vector<std::uint8_t> bytes(samples.begin(), samples.end());
    hash.add(bytes.data(), bytes.size());
  }
  return hexText(hash.value()) == signature;
}

Cause single(const std::string& part, const std::string& name, const std::string& text) {
  return {text, {{part, name, text}}, -1.0, "", {}, {}, ""};
}

}  // namespace

Cause causeByText(const renderer::DecodedRaster& actual, const renderer::DecodedRaster& golden) {
  for (const auto& [frame, which] : {std::pair(&actual, "actual"), std::pair(&golden, "golden")})
    if (!isAsDrawn(*frame))
      return single(
          "encoder", which,
          std::string("the pixels of the ") + which +
              " frame are not those that its text signs: the file was changed after it was drawn, or "
              "packed wrongly");
  const auto differs = [&](const char* key) {
    const std::string a = textOf(actual.text, key), g = textOf(golden.text, key);
    return !a.empty() && !g.empty() && a != g;
  };
  const auto change = [&](const char* key) {
    return textOf(golden.text, key) + " became " + textOf(actual.text, key);
  };
  // "sliding 0123456789abcdef"
  const auto scene = [](const renderer::PngText& text) {
    const std::string whole = textOf(text, "Scene");
    return whole.substr(0, whole.rfind(' '));
  };
  if (differs("Scene")) {
    const std::string a = scene(actual.text), g = scene(golden.text);
    if (a != g) return single("scene", a, "another scene: " + a + ", was " + g);
    return single("scene", a, "the scene was edited");
  }
  if (differs("Camera"))
    return single("camera", textOf(actual.text, "Camera"), "another camera: " + change("Camera"));
  if (differs("Time")) return single("moment", "time", "another time: " + change("Time") + " s");
  if (differs("State")) return single("engine", "state", "physics moved: state " + change("State"));
  const std::string state = textOf(golden.text, "State");
  if (state.empty() || textOf(actual.text, "State").empty()) return {};
  for (const char* key : {"Preset", "Style", "Light", "Shutter", "Background", "Overlays"}) {
    const std::string a = textOf(actual.text, key), g = textOf(golden.text, key);
    if (a != g)
      return single(key == std::string("Light") ? "light" : "preset", key,
                    std::string("the same motion, another look: ") + key + " is " +
                        (a.empty() ? "the usual one" : a) + ", was " + (g.empty() ? "the usual one" : g));
  }
  return single(
      "renderer", "renderer",
      "the renderer changed: same state " + state + (differs("Renderer") ? ", " + change("Renderer") : ""));
}

const MotionRecord* RecordShelf::of(const std::filesystem::path& frame) {
  std::filesystem::path folder = frame.parent_path();
  if (folder.extension() == ".variants") folder = folder.parent_path();
  const std::filesystem::path file = folder / kRecordName;
  const auto [at, is_new] = records_.try_emplace(file);
  std::error_code ignored;
  if (is_new && std::filesystem::exists(file, ignored)) {
    try {
      at->second = readRecord(file);
    } catch (const InputError& error) {
      problems_.push_back(error.what());
    }
  }
  return at->second ? &*at->second : nullptr;
}

Cause causeInRecords(const MotionRecord& actual, const MotionRecord& golden) {
  if (actual.scene != golden.scene) return {};
  Cause unseen;
  for (const RecordedShot& was : golden.shots) {
    const RecordedShot* is = actual.shotOf(was.file);
    if (is == nullptr || is->time_s != was.time_s) continue;
    const Side a{actual, *is}, g{golden, was};
    if (is->state_hash != was.state_hash) return causeAtShots(a, g);
    if (unseen.known()) continue;
    append(unseen.changes, differencesOf(a, g).world);
    if (!unseen.changes.empty())
      unseen.headline = "the scene changed, though no state did: " + joined(unseen.changes);
  }
  return unseen;
}

Cause causeOfDifference(const Comparison& c, const Gate& gate, RecordShelf& shelf) {
  const renderer::DecodedRaster actual = renderer::readPngRaster(c.pair.actual);
  const renderer::DecodedRaster golden = renderer::readPngRaster(c.pair.golden);
  const Cause by_text = causeByText(actual, golden);
  if (!by_text.changes.empty() && by_text.changes.front().part == "encoder") return by_text;
  const MotionRecord *a = shelf.of(c.pair.actual), *g = shelf.of(c.pair.golden);
  if (a == nullptr || g == nullptr) return by_text;
  const RecordedShot* shot_a = a->shotOf(c.pair.actual.filename().string());
  const RecordedShot* shot_g = g->shotOf(std::filesystem::path(c.pair.name).filename().string());
  // A record that an earlier run left says nothing of this frame.
  if (shot_a == nullptr || shot_g == nullptr || hexText(shot_a->state_hash) != textOf(actual.text, "State"))
    return by_text;
  Cause cause = causeAtShots({*a, *shot_a}, {*g, *shot_g});
  renderer::Raster looked_at = actual.raster;
  if (gate.mask != nullptr) gate.mask->apply(c.pair, looked_at, golden.raster);
  addPictureEvidence({looked_at, golden.raster, gate.toleranceOf(actual.raster.fullScale())},
                     {{*a, *shot_a}, {*g, *shot_g}}, cause);
  return cause;
}

}  // namespace carom::demos
