#pragma once
// How busy others keep the machine: the share of all its CPU time that went neither to this process nor to
// idling, from /proc/stat. Tested in tests/demos/system/machine_load_test.cpp.

#include <optional>
#include <string>

namespace carom::demos {

/// CPU seconds since the machine's start.
struct CpuTime {
  double total_s = 0.0;
  double busy_s = 0.0;  ///< Neither idle nor waiting for a disk; what a host stole counts as busy.
};
/// From the text of /proc/stat; nothing when it is not that.
std::optional<CpuTime> parseCpuTime(const std::string& proc_stat, double ticks_per_second);

/// `own_s`: CPU time of this process between the two. 0 where the time is too short to tell from the ticks.
double outsideShare(const CpuTime& before, const CpuTime& after, double own_s, double resolution_s);

/// CPU seconds of all threads of this process.
double processSeconds();

/// Counts from its making.
class MachineLoad {
 public:
  MachineLoad();
  /// Nothing where the system does not tell.
  std::optional<double> outsideShare() const;

 private:
  std::optional<CpuTime> before_;
  double own_before_s_;
};

/// At least one.
int processors();

/// "AMD EPYC 7763, 2 cores"
std::string machineName();

}  // namespace carom::demos
