// The explorer: random worlds and query sequences, each held against oracles; prints what fails, shrunk to
// the smallest scene that still does. See tests/explore.sh and the README of this folder.

#include <CLI/CLI.hpp>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <map>

#include "demos/language/scene_file.h"
#include "engine/foundation/contract.h"
#include "tests/explore/open_failures.h"
#include "tests/explore/scene_text.h"
#include "tests/explore/shrink.h"
#include "tests/explore/trial/query_trial.h"
#include "tests/explore/watch/guarded_run.h"

namespace carom::explore {
namespace {

struct Options {
  std::uint64_t seeds = 2000, from = 0;
  std::optional<std::uint64_t> one;
  int jobs = 1;
  int shrink = 1;  ///< Failures of each kind and family.
  int trials = 150;
  Limits limits;
  std::filesystem::path open, cases, scene, write, out = "build/explored";
};

struct Failure {
  std::uint64_t seed = 0;
  std::string family;
  Finding finding;
};

constexpr long kProgressEvery = 500;       // runs
constexpr double kFrozenBar = 1e-3;        // of the body-steps of a family ...
constexpr long kTellingBodySteps = 10000;  // ... that has so many: ten bodies for a step

/// Of a kind and family.
struct Tally {
  int seen = 0;
  int beyond = 0;  ///< Not covered by what is open.
  Failure worst;
  std::vector<Failure> first;
};

std::string titleOf(const Failure& f) {
  std::ostringstream out;
  out << "seed " << f.seed << ' ' << f.finding.kind << ' ' << f.family << ' ' << std::setprecision(4)
      << f.finding.figure << " step " << f.finding.step << ": " << f.finding.detail;
  return out.str();
}

class Explorer {
 public:
  explicit Explorer(const Options& options) : options_(options) {
    if (!options.open.empty()) open_ = readOpenFailures(options.open);
  }

  int exploreSeeds() {
    printOpen();
    if (!options_.cases.empty()) runCases();
    const Job job = [](std::uint64_t seed, const TrialSettings& settings) { return trySeed(seed, settings); };
    runGuarded(options_.from, options_.seeds, options_.jobs, options_.limits, job,
               [this](const SeedReport& report) { take(report); });
    return conclude();
  }

  /// One seed or scene, with all that is known of it.
  int repeat(const SeedReport& report) {
    const TrialTotals& t = report.outcome.totals;
    std::cout << "family " << report.family << ", " << t.steps << " steps, " << t.body_steps
              << " body-steps, " << t.stopped << " frozen, " << t.queries << " queries, " << t.events
              << " events, " << report.cpu_s << " s; energy gained over its tolerance " << t.worst_gain
              << '\n';
    for (const Finding& finding : report.outcome.findings)
      std::cout << "  " << titleOf({report.seed, report.family, finding}) << '\n';
    return report.outcome.findings.empty() ? 0 : 1;
  }

  int repeatScene() {
    const demos::Scene scene = demos::readSceneFile(options_.scene);
    const std::string name = options_.scene.stem().string();
    const SeedReport report = guardedScene(scene, name, true);
    const int code = repeat(report);
    for (const Finding& finding : report.outcome.findings) shrinkScene({0, name, finding}, scene);
    return code;
  }

  int repeatSeed() {
    const std::uint64_t seed = *options_.one;
    SeedReport report = runGuarded(options_.limits, [&](const TrialSettings& s) { return trySeed(seed, s); });
    report.seed = seed;
    report.family = familyOf(seed);
    const int code = repeat(report);
    if (!asksQueries(seed)) {
      const std::filesystem::path file = options_.out / ("seed-" + std::to_string(seed) + ".json");
      save(file, sceneText(randomWorld(seed).scene));
      std::cout << "scene: " << file.string() << '\n';
    }
    for (const Finding& finding : report.outcome.findings) shrink({seed, report.family, finding});
    return code;
  }

 private:
  SeedReport guardedScene(const demos::Scene& scene, const std::string& family, bool all) const {
    SeedReport report = runGuarded(options_.limits, [&](const TrialSettings& s) {
      TrialSettings with = s;
      with.replays = with.threads = all;
      SeedReport made;
      made.outcome = tryWorld(scene, with);
      return made;
    });
    report.family = family;
    return report;
  }

  void runCases() {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(options_.cases))
      if (entry.path().extension() == ".json") files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    for (const std::filesystem::path& file : files)
      take(guardedScene(demos::readSceneFile(file), "case:" + file.stem().string(), true));
  }

  void printOpen() const {
    for (const OpenFailure& open : open_)
      std::cout << "open: " << open.kind << ' ' << open.family << " up to " << open.most << ": " << open.cause
                << '\n';
  }

  void take(const SeedReport& report) {
    ++reports_;
    cpu_s_ += report.cpu_s;
    if (reports_ % kProgressEvery == 0)
      std::cerr << reports_ << " runs, " << cpu_s_ << " s of CPU time" << std::endl;
    if (report.cpu_s > longest_.cpu_s) longest_ = report;
    const TrialTotals& t = report.outcome.totals;
    const std::string family = report.family.empty() ? familyOf(report.seed) : report.family;
    auto& [stopped, body_steps] = frozen_[family];
    stopped += t.stopped;
    body_steps += t.body_steps;
    if (t.most_events > most_events_.outcome.totals.most_events) most_events_ = report;
    if (t.most_queries > most_queries_.outcome.totals.most_queries) most_queries_ = report;
    if (t.worst_gain > worst_gain_ && t.worst_gain <= 1.0) worst_gain_ = t.worst_gain;
    refused_ += t.refused;
    for (const Finding& finding : report.outcome.findings) takeFinding({report.seed, family, finding});
  }

  void takeFinding(const Failure& failure) {
    Tally& tally = tallies_[{failure.finding.kind, failure.family}];
    ++tally.seen;
    if (tally.seen == 1 || failure.finding.figure > tally.worst.finding.figure) tally.worst = failure;
    const bool known = std::any_of(open_.begin(), open_.end(), [&](const OpenFailure& open) {
      return open.covers(failure.finding.kind, failure.family, failure.finding.figure);
    });
    if (known) return;
    ++tally.beyond;
    tally.first.push_back(failure);
  }

  int conclude() {
    for (const auto& [family, sums] : frozen_) {
      const double share = static_cast<double>(sums.first) / static_cast<double>(std::max(1L, sums.second));
      if (sums.second >= kTellingBodySteps && share > kFrozenBar)
        takeFinding(
            {options_.from, family, {"frozen-total", share, 0, "of the body-steps of all its seeds"}});
    }
    std::cout << '\n'
              << reports_ << " runs, " << cpu_s_ << " s of CPU time ("
              << 1e3 * cpu_s_ / static_cast<double>(std::max(1L, reports_)) << " ms each; longest "
              << longest_.cpu_s << " s, seed " << longest_.seed << "), " << refused_ << " starts refused\n"
              << "most of a step: " << most_events_.outcome.totals.most_events << " events a body (seed "
              << most_events_.seed << "), " << most_queries_.outcome.totals.most_queries
              << " queries a body (seed " << most_queries_.seed
              << ")\nlargest energy gain within its tolerance: " << worst_gain_ << " of the tolerance\n";
    for (const auto& [family, sums] : frozen_)
      if (sums.first > 0)
        std::cout << "frozen: " << family << ' ' << sums.first << " of " << sums.second << " body-steps ("
                  << 100.0 * static_cast<double>(sums.first) / static_cast<double>(sums.second) << " %)\n";
    int beyond = 0, known = 0;
    std::cout << "\nkind            family       seeds  per 1000  not open  worst figure (seed, step)\n";
    for (const auto& [key, tally] : tallies_) {
      beyond += tally.beyond;
      known += tally.seen - tally.beyond;
      std::cout << std::left << std::setw(16) << key.first << std::setw(12) << key.second << std::right
                << std::setw(6) << tally.seen << std::setw(10) << std::setprecision(3)
                << 1e3 * tally.seen / static_cast<double>(std::max(1L, reports_)) << std::setw(10)
                << tally.beyond << "  " << std::setprecision(4) << tally.worst.finding.figure << " ("
                << tally.worst.seed << ", " << tally.worst.finding.step << ")\n";
    }
    std::cout << std::endl;
    for (const auto& [key, tally] : tallies_)
      for (std::size_t i = 0; i < tally.first.size() && i < static_cast<std::size_t>(options_.shrink); ++i)
        shrink(tally.first[i]);
    for (const auto& [key, tally] : tallies_)
      if (tally.beyond > 0)
        std::cout << "to be mended, or listed with its cause: " << key.first << ' ' << key.second << ' '
                  << std::setprecision(2) << 1.05 * tally.worst.finding.figure << " # ...\n";
    std::cout << '\n' << beyond << " failures, " << known << " more that are known (open.txt)\n";
    return beyond > 0 ? 1 : 0;
  }

  void save(const std::filesystem::path& file, const std::string& text) const {
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file) << text;
  }

  void shrink(const Failure& failure) {
    std::cout << titleOf(failure) << std::endl;
    if (options_.shrink <= 0) return;
    const std::string kind = failure.finding.kind;
    const std::filesystem::path file = fileFor(failure);
    if (failure.family == "queries") {
      save(file.string() + ".txt", queryText(shrunkQueries(randomQueries(failure.seed), kind)));
      std::cout << "  shrunk: " << file.string() << ".txt\n";
      return;
    }
    if (failure.family.starts_with("case:") || kind == "frozen-total")
      return;  // small already; of many seeds
    shrinkScene(failure, randomWorld(failure.seed).scene);
  }

  std::filesystem::path fileFor(const Failure& failure) const {
    const std::string number = failure.seed > 0 ? "-" + std::to_string(failure.seed) : "";
    return options_.out / (failure.finding.kind + "-" + failure.family + number);
  }

  void shrinkScene(const Failure& failure, const demos::Scene& scene) const {
    if (options_.shrink <= 0) return;
    const std::string kind = failure.finding.kind;
    const std::filesystem::path file = fileFor(failure);
    const Trial trial = [&](const demos::Scene& smaller) -> std::optional<Finding> {
      const bool bits = kind == "replay" || kind == "threads";
      for (const Finding& finding : guardedScene(readBack(smaller), "", bits).outcome.findings)
        if (finding.kind == kind) return finding;
      return std::nullopt;
    };
    const int trials = kind == "hang" || kind == "slow" ? options_.trials / 3 : options_.trials;
    Shrunk shrunk = shrunkScene(scene, failure.finding, trial, trials);
    std::ostringstream what;
    what << shrunk.scene.description << ", seed " << failure.seed << ": " << kind << ' '
         << std::setprecision(4) << shrunk.finding.figure << " at step " << shrunk.finding.step << " ("
         << shrunk.finding.detail << ')';
    shrunk.scene.description = what.str();
    save(file.string() + ".json", sceneText(shrunk.scene));
    std::cout << "  shrunk: " << file.string() << ".json: " << shrunk.scene.bodies.size() << " bodies, "
              << stepsOf(shrunk.scene) << " steps, " << std::setprecision(4) << shrunk.finding.figure
              << std::endl;
  }

  Options options_;
  std::vector<OpenFailure> open_;
  std::map<std::pair<std::string, std::string>, Tally> tallies_;
  std::map<std::string, std::pair<long, long>> frozen_;
  long reports_ = 0;
  double cpu_s_ = 0.0, worst_gain_ = 0.0;
  int refused_ = 0;
  SeedReport longest_, most_events_, most_queries_;
};

int writeScenes(const Options& options) {
  std::filesystem::create_directories(options.write);
  for (std::uint64_t seed = options.from; seed < options.from + options.seeds; ++seed)
    std::ofstream(options.write / ("seed-" + std::to_string(seed) + ".json"))
        << sceneText(randomWorld(seed).scene);
  return 0;
}

int runExplorer(int argc, char** argv) {
  Options options;
  CLI::App app{"Random worlds and closest-feature queries, held against oracles."};
  app.add_option("--seeds", options.seeds, "how many");
  app.add_option("--from", options.from, "the first");
  app.add_option("--seed", options.one, "only this one, in detail, shrunk");
  app.add_option("--scene", options.scene, "only this scene file");
  app.add_option("--jobs,--threads", options.jobs, "processes at a time")->check(CLI::Range(1, 64));
  app.add_option("--shrink", options.shrink, "failures of each kind and family to shrink");
  app.add_option("--trials", options.trials, "runs to shrink one failure with");
  app.add_option("--step-limit", options.limits.step_cpu_s, "seconds of CPU time that a step may take");
  app.add_option("--open", options.open, "list of known failures");
  app.add_option("--cases", options.cases, "folder of scenes that are run first");
  app.add_option("--out", options.out, "folder for shrunken scenes");
  app.add_option("--write", options.write, "a folder for the seeds' scenes, which are not run");
  CLI11_PARSE(app, argc, argv);
  if (!options.write.empty()) return writeScenes(options);
  Explorer explorer(options);
  if (!options.scene.empty()) return explorer.repeatScene();
  return options.one ? explorer.repeatSeed() : explorer.exploreSeeds();
}

}  // namespace
}  // namespace carom::explore

int main(int argc, char** argv) {
  try {
    return carom::explore::runExplorer(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << "explore: " << error.what() << '\n';
    return 3;
  }
}
