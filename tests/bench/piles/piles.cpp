// piles [ROW...] | --all | --list: what a step of a pile costs while it moves, from release to quiet, Carom
// beside Bullet and ODE in one run, and how the cost grows with the number of bodies. Without rows it runs
// all but the long ones. Exit code 1 when a body of ours has left the world or is stopped in more than 0.1 %
// of its steps, 2 for what it does not understand.

#include "tests/bench/piles/pile_rows.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <map>
#include <optional>

#include "engine/simulation/world.h"
#include "tests/bench/physics/physics.h"

namespace carom::bench {
namespace {

using physics::Experiment;
using physics::Simulation;

constexpr double kQuiet_mps = 0.05;  // what the slowest 99 of 100 bodies stay below
constexpr double kQuietFor_s = 0.25;
constexpr double kMostStopped = 1e-3;

/// Its radius and its vertices' coordinates.
std::vector<double> keyOf(const ConvexPart& part) {
  std::vector<double> key{part.radius_m};
  for (const Vec3& v : part.core.vertices()) key.insert(key.end(), v.data(), v.data() + 3);
  return key;
}

/// Ours with any number of threads, which counts who was stopped.
class CaromPile final : public Simulation {
 public:
  CaromPile(const Experiment& pile, int threads)
      : world_({.step_s = pile.step_s,
                .gravity = Vec3(0, 0, -pile.gravity),
                .resting_mode = pile.resting,
                .threads = threads}) {
    std::map<std::vector<double>, int> solids;  // bodies of one shape share it
    for (const physics::ExperimentBody& b : pile.bodies) {
      const auto [found, is_new] = solids.try_emplace(keyOf(b.shape.solid.parts()[0]), 0);
      if (is_new) found->second = world_.addSolid(b.shape.solid);
      const Material material{b.friction, b.friction, b.restitution, b.mass_kg / b.shape.solid.volume()};
      world_.addBody({found->second, b.X_WB, b.velocity, b.spin, material, b.is_static});
      moving_ += !b.is_static;
    }
    if (!world_.start().empty()) throw std::runtime_error("bodies overlap at the start");
  }

  void step() override {
    world_.step();
    stopped_ += world_.audit().last_step.stopped_bodies;
    ++steps_;
  }
  physics::Motion motion(int body) const override {
    const BodyState& s = world_.states()[static_cast<std::size_t>(body)];
    return {s.X_WB, s.linear_velocity, s.angular_velocity};
  }
  bool atRest(int body) const override {
    return world_.states()[static_cast<std::size_t>(body)].mode == Mode::kResting;
  }
  double stoppedShare() const {
    return static_cast<double>(stopped_) / static_cast<double>(moving_ * steps_);
  }

 private:
  World world_;
  long moving_ = 0, stopped_ = 0, steps_ = 0;
};

/// CPU time of all threads of this process.
double cpuSeconds() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}
double wallSeconds() {
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// The speed that 99 of 100 moving bodies stay below.
double fastSpeed(const Experiment& pile, const Simulation& simulation) {
  std::vector<double> speeds;
  for (std::size_t i = 0; i < pile.bodies.size(); ++i)
    if (!pile.bodies[i].is_static) speeds.push_back(simulation.motion(static_cast<int>(i)).velocity.norm());
  const auto at = speeds.begin() + static_cast<std::ptrdiff_t>(speeds.size() * 99 / 100);
  std::nth_element(speeds.begin(), at, speeds.end());
  return *at;
}

struct Run {
  std::vector<double> steps_ms;  ///< CPU; from release to quiet.
  double wall_s = 0.0;
  std::optional<double> quiet_s;
  double first_ms = 0.0;
  double at(double share) const {
    std::vector<double> sorted = steps_ms;
    std::sort(sorted.begin(), sorted.end());
    return sorted[std::min(sorted.size() - 1,
                           static_cast<std::size_t>(share * static_cast<double>(sorted.size())))];
  }
  double total_s() const {
    double sum = 0.0;
    for (const double ms : steps_ms) sum += 1e-3 * ms;
    return sum;
  }
};

Run runOf(const PileRow& row, const Experiment& pile, Simulation& simulation) {
  Run run;
  for (double t = 0.0; t < row.settling_s; t += pile.step_s) simulation.step();
  const double begin_wall_s = wallSeconds();
  double still_s = 0.0;
  for (double t = pile.step_s; t <= row.longest_s - row.settling_s; t += pile.step_s) {
    const double begin_s = cpuSeconds();
    simulation.step();
    run.steps_ms.push_back(1e3 * (cpuSeconds() - begin_s));
    if (!row.until_quiet) continue;
    // A pile that is let go is slow at first.
    still_s = t > 1.0 && fastSpeed(pile, simulation) < kQuiet_mps ? still_s + pile.step_s : 0.0;
    if (still_s < kQuietFor_s) continue;
    run.quiet_s = t;
    break;
  }
  run.wall_s = wallSeconds() - begin_wall_s;
  return run;
}

std::string quietText(const PileRow& row, const Run& run) {
  if (!row.until_quiet) return "-";
  char text[32];
  std::snprintf(text, sizeof text, run.quiet_s ? "%.1f s" : "> %.1f s", run.quiet_s.value_or(row.longest_s));
  return text;
}

void printRun(const char* name, const PileRow& row, const Run& run, double beside_ms,
              const std::string& more) {
  std::printf("  %-16s %8.3f %8.3f %8.3f %8.3f %9.3f %8s %7.2f%s\n", name, run.at(0.5), run.at(0.99),
              run.at(1.0), run.steps_ms.front(), run.total_s(), quietText(row, run).c_str(),
              run.at(0.5) / beside_ms, more.c_str());
  std::fflush(stdout);
}

/// Whether nothing of ours is wrong; medians[name]: of that library, of every size.
using Medians = std::map<std::string, std::vector<std::pair<int, double>>>;
bool measure(const PileRow& row, Medians& medians) {
  const Experiment pile = row.describe();
  std::printf("%s: %s\n", row.name.c_str(), row.what.c_str());
  bool right = true;
  std::vector<std::pair<std::string, Run>> runs;
  std::vector<std::string> notes;
  const auto keep = [&](const std::string& name, Run run, const std::string& note) {
    if (row.size > 0) medians[name].push_back({row.size, run.at(0.5)});
    runs.emplace_back(name, std::move(run));
    notes.push_back(note);
  };
  for (const int threads : {1, 2}) {
    CaromPile ours(pile, threads);
    Run run = runOf(row, pile, ours);
    char note[64];
    std::snprintf(note, sizeof note, "  stopped %.3f %%, wall %.2f s", 100.0 * ours.stoppedShare(),
                  run.wall_s);
    right = right && ours.stoppedShare() <= kMostStopped;
    keep(threads == 1 ? "Carom" : "Carom, 2 threads", std::move(run), note);
  }
  for (const physics::Simulator& peer : simulators()) {
    if (std::string(peer.name) == "Carom") continue;
    const std::unique_ptr<Simulation> simulation = peer.start(pile);
    keep(peer.name, runOf(row, pile, *simulation), "");
  }
  // The first peer is Bullet, where it was there when this was built; else ours.
  const double beside_ms = runs[runs.size() > 2 ? 2 : 0].second.at(0.5);
  for (std::size_t i = 0; i < runs.size(); ++i)
    printRun(runs[i].first.c_str(), row, runs[i].second, beside_ms, notes[i]);
  return right;
}

/// The slope of log(median) over log(bodies), by least squares.
void printGrowth(const Medians& medians) {
  for (const auto& [name, sizes] : medians) {
    if (sizes.size() < 2) continue;
    double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
    for (const auto& [bodies, ms] : sizes) {
      const double a = std::log(bodies), b = std::log(ms);
      n += 1.0, x += a, y += b, xx += a * a, xy += a * b;
    }
    std::printf("%s: the median grows with the number of boxes to the %.2f\n", name.c_str(),
                (n * xy - x * y) / (n * xx - x * x));
  }
}

std::vector<PileRow> chosenRows(const std::vector<std::string>& names, bool long_ones) {
  const std::vector<PileRow> rows = dropRows();
  for (const std::string& name : names)
    if (std::ranges::none_of(rows, [&](const PileRow& row) { return row.name == name; }))
      throw CLI::ValidationError("no row \"" + name + "\"; --list names them all");
  std::vector<PileRow> chosen;
  for (const PileRow& row : rows)
    if (names.empty() ? long_ones || !row.is_long : std::ranges::count(names, row.name) > 0)
      chosen.push_back(row);
  return chosen;
}

}  // namespace
}  // namespace carom::bench

int main(int argc, char** argv) {
  using namespace carom::bench;
  CLI::App app{"Piles in motion: Carom, Bullet and ODE on the same descriptions."};
  std::vector<std::string> names;
  bool list = false, all = false;
  app.add_option("rows", names, "rows to run; none: all but the long ones");
  app.add_flag("--list", list, "name the rows");
  app.add_flag("--all", all, "the long rows, too");
  try {
    app.parse(argc, argv);
    const std::vector<PileRow> rows = chosenRows(names, all || list);
    bool right = true;
    Medians medians;
    if (!list)
      std::printf(
          "CPU ms a step of 1/60 s    median      p99    worst    first  CPU s all    quiet  ratio\n");
    for (const PileRow& row : rows)
      if (list)
        std::printf("%-20s %s%s\n", row.name.c_str(), row.what.c_str(), row.is_long ? " (long)" : "");
      else
        right = measure(row, medians) && right;
    printGrowth(medians);
    return right ? 0 : 1;
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
}
