// soak: one world for a simulated day, every step held against the explorer's oracles, and the memory that it
// takes looked at all the while. bash tests/soak.sh builds and runs it; a line for every twenty-fourth of the
// time.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <limits>
#include <vector>

#include <time.h>
#include <unistd.h>

#include "demos/language/scene_file.h"
#include "demos/scene/scene_world.h"
#include "tests/explore/open_failures.h"
#include "tests/explore/watch/world_judge.h"

namespace carom::explore {
namespace {

constexpr int kLines = 24;
// Kilobytes that an allocator may move about: what leaks a byte a step is beyond it within a day.
constexpr long kFlat_kB = 1024;

struct Options {
  double hours = 24.0;
  std::filesystem::path open = CAROM_SOURCE_DIR "/tests/explore/open.txt";
  std::filesystem::path scene = CAROM_SOURCE_DIR "/tests/explore/soak/soak.json";
};

long residentKb() {
  long all = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> all >> resident;
  return resident * (::sysconf(_SC_PAGESIZE) / 1024);
}

double cpuSeconds() {
  timespec now{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

class Soak {
 public:
  explicit Soak(const Options& options)
      : options_(options),
        open_(readOpenFailures(options.open)),
        scene_(demos::readSceneFile(options.scene)),
        world_(demos::makeSceneWorld(scene_, {}).world),
        judge_(scene_, world_) {}

  int run() {
    std::cout << "hours   memory kB  smallest gap m    kinetic J      events   held  CPU s\n";
    const auto lines = std::max(1, static_cast<int>(std::min<double>(kLines, steps())));
    for (int line = 1; line <= lines; ++line) {
      const double share = static_cast<double>(line) / lines;
      while (world_.stepCount() < std::lround(share * steps()))
        if (!step()) return conclude();  // Nothing more can be said.
      tell();
    }
    return conclude();
  }

 private:
  double steps() const { return 3600.0 * options_.hours * scene_.rate_hz; }

  /// False when a state is not finite.
  bool step() {
    world_.step();
    const Audit audit = world_.audit();
    smallest_gap_m_ = std::min(smallest_gap_m_, audit.smallest_gap_m);
    if (!(audit.smallest_gap_m > 0.0))
      judge_.findings().add("gap", -audit.smallest_gap_m, world_.stepCount(), "the engine says so itself");
    events_ += audit.last_step.events;
    held_ += audit.last_step.stopped_bodies;
    return judge_.look(world_.states(), audit.last_step, world_.stepCount());
  }

  void tell() {
    memory_kB_.push_back(residentKb());
    std::cout << std::fixed << std::setprecision(2) << std::setw(5) << world_.time() / 3600.0 << std::setw(12)
              << memory_kB_.back() << std::setw(16) << std::scientific << smallest_gap_m_ << std::fixed
              << std::setw(13) << world_.audit().kinetic_energy_J << std::setw(12) << events_ << std::setw(7)
              << held_ << std::setw(7) << std::lround(cpuSeconds()) << std::endl;
  }

  int conclude() {
    judge_.conclude(world_.stepCount());
    int beyond = 0;
    for (const Finding& finding : judge_.findings().list()) {
      const bool known = std::any_of(open_.begin(), open_.end(), [&](const OpenFailure& failure) {
        return failure.covers(finding.kind, "soak", finding.figure);
      });
      beyond += known ? 0 : 1;
      std::cout << "step " << finding.step << ": " << finding.kind << ' ' << shown(finding.figure) << ": "
                << finding.detail << (known ? " (known: open.txt)\n" : "\n");
    }
    const long grown = memory_kB_.size() < 2 ? 0 : memory_kB_.back() - memory_kB_.front();
    std::cout << world_.stepCount() << " steps, " << beyond
              << " findings that are not known, memory grown since the first line by " << grown << " kB\n";
    return beyond == 0 && grown <= kFlat_kB ? 0 : 1;
  }

  Options options_;
  std::vector<OpenFailure> open_;
  demos::Scene scene_;
  World world_;
  WorldJudge judge_;
  std::vector<long> memory_kB_;
  double smallest_gap_m_ = std::numeric_limits<double>::infinity();
  long events_ = 0, held_ = 0;
};

}  // namespace
}  // namespace carom::explore

int main(int argc, char** argv) {
  carom::explore::Options options;
  CLI::App app{"One world for a simulated day, every step held against oracles.", "soak"};
  app.add_option("--hours", options.hours, "Of simulated time")->check(CLI::PositiveNumber);
  app.add_option("--open", options.open, "What is known, of family \"soak\" (open.txt)");
  app.add_option("--scene", options.scene, "One that goes on for ever");
  CLI11_PARSE(app, argc, argv);
  try {
    return carom::explore::Soak(options).run();
  } catch (const std::exception& error) {
    std::cerr << "soak: " << error.what() << '\n';
    return 2;
  }
}
