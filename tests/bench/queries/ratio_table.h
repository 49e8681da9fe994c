#pragma once
// A reporter for Google Benchmark: at the end, one row for each case and size with the CPU time of a query in
// each library and the peers' times as multiples of ours. Benchmarks are named Case/library/size.

#include <iosfwd>
#include <map>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

namespace carom::bench {

class RatioTable : public benchmark::BenchmarkReporter {
 public:
  /// `libraries` names the columns, ours first; a run's time is divided by `queries` of one iteration. Rows
  /// come in the order in which they are added, whatever the order of the runs.
  RatioTable(std::vector<std::string> libraries, int queries)
      : libraries_(std::move(libraries)), queries_(queries) {}

  void addRow(const std::string& name, const std::string& size) { rows_.push_back({name, size, {}}); }

  bool ReportContext(const Context& context) override;
  void ReportRuns(const std::vector<Run>& runs) override;
  void Finalize() override;

 private:
  struct Row {
    std::string name;  ///< Case.
    std::string size;
    std::map<std::string, double> ns;  ///< By library: the median, or the only run.
  };
  void take(const Run& run);
  void printRow(std::ostream& out, const Row& row) const;

  std::vector<std::string> libraries_;
  int queries_;
  std::vector<Row> rows_;
};

}  // namespace carom::bench
