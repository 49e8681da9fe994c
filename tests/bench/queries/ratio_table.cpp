// The table of the benchmarks.

#include "tests/bench/queries/ratio_table.h"

#include <iomanip>
#include <ostream>
#include <sstream>

namespace carom::bench {

bool RatioTable::ReportContext(const Context& context) {
  GetErrorStream() << "timing on " << context.cpu_info.num_cpus << " cores\n";
  return true;
}

void RatioTable::ReportRuns(const std::vector<Run>& runs) {
  for (const Run& run : runs) {
    const bool median = run.run_type == Run::RT_Aggregate && run.aggregate_name == "median";
    const bool only = run.run_type == Run::RT_Iteration && run.repetitions <= 1;
    if (run.error_occurred)
      GetErrorStream() << run.benchmark_name() << ": " << run.error_message << "\n";
    else if (median || only)
      take(run);
  }
}

void RatioTable::take(const Run& run) {
  std::istringstream words(run.run_name.function_name);
  std::string name, library, size;
  std::getline(words, name, '/');
  std::getline(words, library, '/');
  std::getline(words, size, '/');
  const double unit_ns = 1e9 / benchmark::GetTimeUnitMultiplier(run.time_unit);
  for (Row& row : rows_)
    if (row.name == name && row.size == size) row.ns[library] = run.GetAdjustedCPUTime() * unit_ns / queries_;
}

void RatioTable::printRow(std::ostream& out, const Row& row) const {
  out << std::left << std::setw(19) << row.name << std::right << std::setw(5) << row.size << std::fixed;
  for (const std::string& library : libraries_) {
    out << std::setw(10);
    if (const auto found = row.ns.find(library); found != row.ns.end())
      out << std::setprecision(0) << found->second;
    else
      out << "-";
  }
  const auto ours = row.ns.find(libraries_.front());
  for (std::size_t i = 1; i < libraries_.size(); ++i) {
    out << std::setw(10);
    if (const auto found = row.ns.find(libraries_[i]); found != row.ns.end() && ours != row.ns.end())
      out << std::setprecision(1) << found->second / ours->second;
    else
      out << "-";
  }
  out << "\n";
}

void RatioTable::Finalize() {
  std::ostream& out = GetOutputStream();
  out << std::left << std::setw(19) << "ns a query (CPU)" << std::right << std::setw(5) << "n";
  for (const std::string& library : libraries_) out << std::setw(10) << library;
  for (std::size_t i = 1; i < libraries_.size(); ++i) out << std::setw(10) << ("/" + libraries_.front());
  out << "\n";
  for (const Row& row : rows_)
    if (!row.ns.empty()) printRow(out, row);
}

}  // namespace carom::bench
