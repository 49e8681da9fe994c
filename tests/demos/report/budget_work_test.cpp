// The exact work that `carom budget` counts, from outside: the same on every run, for any number of threads
// and with either GL library, and of everything that costs time one change is seen. The scenes between them
// have large islands, events, landings and a ground that mirrors.
#include <map>

#include <gtest/gtest.h>

#include "demos/format/json.h"
#include "demos/motion/frame_cost.h"
#include "tests/demos/support/program_run.h"

namespace carom::demos {
namespace {

using WorkByName = std::map<std::string, std::vector<double>>;

WorkByName workOf(const std::string& scene, const std::vector<std::string>& more = {}) {
  std::vector<std::string> words = {"budget", scene,      "-q",     "--size",    "64x48", "--duration",
                                    "1",      "--fps",    "20",     "--replays", "2",     "--percentile",
                                    "50",     "--budget", "100000", "--json",    "-"};
  words.insert(words.end(), more.begin(), more.end());
  const ProgramEnd end = runCarom(words);
  EXPECT_EQ(end.code, 0) << end.err;
  WorkByName work;
  const Json json = Json::parse(end.out, "stdout");
  for (const Json& kind : json.at("work").items())
    for (const Json& frame : kind.at("frames").items())
      work[kind.at("name").asString()].push_back(frame.asNumber());
  EXPECT_EQ(work.size(), kWorkKinds);
  return work;
}

TEST(BudgetWork, IsTheSameOnEveryRunForAnyThreadsAndWithEitherGl) {
  for (const char* scene : {"tower-hit", "fifty-bodies"}) {
    const WorkByName first = workOf(scene, {"--gl", "osmesa"});
    EXPECT_EQ(workOf(scene, {"--gl", "osmesa"}), first) << scene;
    EXPECT_EQ(workOf(scene, {"--gl", "osmesa", "--threads", "2"}), first) << scene;
    if (runCarom({"doctor", "--gl", "egl"}).code != 0) continue;
    EXPECT_EQ(workOf(scene, {"--gl", "egl"}), first) << scene;
  }
}

// What no scene brings about need not be counted.
TEST(BudgetWork, OfEveryKindSomeSceneHasSome) {
  std::map<std::string, double> most;
  for (const auto& [scene, preset] : std::map<std::string, std::string>{
           {"tower-hit", "realtime"}, {"fifty-bodies", "cinematic"}, {"bouncing-ball", "realtime"}})
    for (const auto& [name, counts] : workOf(scene, {"--preset", preset}))
      for (const double count : counts) most[name] = std::max(most[name], count);
  for (const auto& [name, count] : most) EXPECT_GT(count, 0.0) << name;
}

/// The kinds that are not the same in every frame.
std::vector<std::string> changedKinds(const WorkByName& a, const WorkByName& b) {
  std::vector<std::string> names;
  for (const auto& [name, counts] : a)
    if (counts != b.at(name)) names.push_back(name);
  return names;
}

TEST(BudgetWork, AnotherTextureIsSeenAndIsNoOtherMotion) {
  const std::vector<std::string> changed =
      changedKinds(workOf("tower-hit"), workOf("tower-hit", {"--preset", "fast"}));
  for (const char* drawn : {"shadow texels", "bytes packed"})
    EXPECT_NE(std::find(changed.begin(), changed.end(), drawn), changed.end()) << drawn;
  for (const char* moved : {"queries", "states walked", "row visits", "contact points", "events"})
    EXPECT_EQ(std::find(changed.begin(), changed.end(), moved), changed.end()) << moved;
}

}  // namespace
}  // namespace carom::demos
