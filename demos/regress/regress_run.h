#pragma once
// Draws and compares the scenes of a suite by processes of this program, several at a time. Tested in
// tests/demos/program/regress_program_test.cpp.

#include <functional>
#include <string>
#include <vector>

#include "demos/format/json.h"
#include "demos/regress/regress_suite.h"

namespace carom::demos {

struct SceneOutcome {
  std::string name;
  int code = 0;                  ///< The exit code of the last of its two commands.
  std::string problem;           ///< What a command that could not do its work said, in one line.
  Json comparison;               ///< What `compare --json` said; null where it did not come to that.
  std::string junit;             ///< The suite's element of its JUnit file.
  std::filesystem::path report;  ///< Relative to the output folder; empty: none.
};

struct RegressPlan {
  std::filesystem::path output;
  int jobs = 1;
  bool update = false;
};

/// In the suite's order. `done` is told how many are finished. Throws Interrupted, after ending what runs.
std::vector<SceneOutcome> runSuite(const RegressSuite& suite, const RegressPlan& plan,
                                   const std::function<void(int)>& done);

}  // namespace carom::demos
