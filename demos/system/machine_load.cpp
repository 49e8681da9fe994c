#include "demos/system/machine_load.h"

#include <algorithm>
#include <ctime>
#include <fstream>
#include <sstream>
#include <thread>

#include <unistd.h>

namespace carom::demos {
namespace {

double ticksPerSecond() {
  return static_cast<double>(std::max(sysconf(_SC_CLK_TCK), 1L));
}

std::optional<CpuTime> cpuTimeNow() {
  std::ifstream in("/proc/stat");
  std::ostringstream text;
  text << in.rdbuf();
  return parseCpuTime(text.str(), ticksPerSecond());
}

}  // namespace

double processSeconds() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

// "cpu user nice system idle iowait irq softirq steal ...": guests are part of user and nice.
std::optional<CpuTime> parseCpuTime(const std::string& proc_stat, double ticks_per_second) {
  std::istringstream in(proc_stat);
  std::string name;
  if (!(in >> name) || name != "cpu") return std::nullopt;
  double total = 0.0, idle = 0.0;
  for (int field = 0; field < 8; ++field) {
    double ticks = 0.0;
    if (!(in >> ticks)) return std::nullopt;
    total += ticks;
    if (field == 3 || field == 4) idle += ticks;
  }
  if (!(total > 0.0)) return std::nullopt;
  return CpuTime{total / ticks_per_second, (total - idle) / ticks_per_second};
}

double outsideShare(const CpuTime& before, const CpuTime& after, double own_s, double resolution_s) {
  const double total_s = after.total_s - before.total_s;
  const double others_s = after.busy_s - before.busy_s - own_s - resolution_s;
  if (!(total_s > 0.0) || !(others_s > 0.0)) return 0.0;
  return std::min(others_s / total_s, 1.0);
}

MachineLoad::MachineLoad() : before_(cpuTimeNow()), own_before_s_(processSeconds()) {}

std::optional<double> MachineLoad::outsideShare() const {
  const std::optional<CpuTime> now = cpuTimeNow();
  if (!before_ || !now) return std::nullopt;
  return demos::outsideShare(*before_, *now, processSeconds() - own_before_s_,
                             processors() / ticksPerSecond());
}

int processors() {
  return static_cast<int>(std::max(std::thread::hardware_concurrency(), 1u));
}

std::string machineName() {
  std::string model = "unknown CPU";
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);) {
    if (line.rfind("model name", 0) != 0) continue;
    const std::size_t colon = line.find(": ");
    if (colon != std::string::npos) model = line.substr(colon + 2);
    break;
  }
  return model + ", " + std::to_string(processors()) + (processors() == 1 ? " core" : " cores");
}

}  // namespace carom::demos
