#include "demos/compare/record_changes.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "demos/format/formatted.h"

namespace carom::demos {
namespace {

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
      return names + " starts " + formatted("%.3g", distanceOf(g.change.actual, g.change.golden)) +
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
  if (!missing.empty() || !added.empty()) return;
  const auto [at, was_at] =
      std::mismatch(actual.bodies.begin(), actual.bodies.end(), golden.bodies.begin(), golden.bodies.end(),
                    [](const RecordedBody& a, const RecordedBody& g) { return a.name == g.name; });
  // The engine goes through the bodies in the order of the scene.
  if (at != actual.bodies.end())
    changes.push_back({"body", at->name, "the bodies are in another order from " + at->name + " on"});
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
  return formatted("%.3g", v.x()) + ' ' + formatted("%.3g", v.y()) + ' ' + formatted("%.3g", v.z());
}

void addCamera(const renderer::Camera& actual, const renderer::Camera& golden, std::vector<Change>& look) {
  const auto add = [&](const std::string& text) { look.push_back({"camera", "camera", text}); };
  if (actual.eye != golden.eye)
    add("the camera stands " + formatted("%.3g", (actual.eye - golden.eye).norm()) +
        " m away from where it was (" + vectorText(actual.eye) + ", was " + vectorText(golden.eye) + ")");
  if (actual.target != golden.target)
    add("the camera looks at " + vectorText(actual.target) + ", was " + vectorText(golden.target));
  if (actual.fov_degrees != golden.fov_degrees)
    add("the camera's field of view is " + formatted("%.3g", actual.fov_degrees) + " degrees, was " +
        formatted("%.3g", golden.fov_degrees));
  if (actual.aperture_m != golden.aperture_m)
    add("the camera's aperture is " + formatted("%.3g", actual.aperture_m) + " m, was " +
        formatted("%.3g", golden.aperture_m) + " m");
  if (actual.focus_m != golden.focus_m && actual.aperture_m > 0.0)
    add("the camera is in focus at " + formatted("%.3g", actual.focus_m) + " m, was " +
        formatted("%.3g", golden.focus_m) + " m");
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

}  // namespace

Differences differencesOf(const RecordedPicture& actual, const RecordedPicture& golden) {
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

}  // namespace carom::demos
