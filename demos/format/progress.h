#pragma once
// Progress on stderr: redrawn in place on a terminal, one line a second elsewhere, or JSON lines for
// programs. The clock is handed in, so that the tests need not wait. Tested in
// tests/demos/format/progress_test.cpp.

#include <functional>
#include <iosfwd>
#include <optional>
#include <string>

namespace carom::demos {

enum class ProgressStyle { kTerminal, kLines, kJson, kNone };

/// auto, json or none; auto looks at stderr. None when `quiet`.
ProgressStyle progressStyle(const std::string& name, bool quiet);

class Progress {
 public:
  using Seconds = std::function<double()>;

  struct Plan {
    std::string unit;  ///< "frame", "step"
    int total = 0;
  };
  Progress(const Plan& plan, ProgressStyle style, std::ostream& out, Seconds now);
  /// Wipes the line that is being redrawn, so that what follows starts clean.
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void done(int count);

 private:
  std::string line(int count, double elapsed_s) const;
  std::string json(int count, double elapsed_s) const;

  Plan plan_;
  ProgressStyle style_;
  std::ostream& out_;
  Seconds now_;
  double started_s_;
  std::optional<double> shown_s_;  // when the last line was written
};

/// Seconds on the steady clock.
double steadySeconds();

}  // namespace carom::demos
