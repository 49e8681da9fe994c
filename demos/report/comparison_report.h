#pragma once
// The report of a comparison for people: one HTML file that needs nothing else, with the worst pairs' images
// inside it. Images are read again, one pair at a time, so that a report of thousands of frames needs memory
// for two. Tested in tests/demos/report/comparison_report_test.cpp, and in a browser by
// tests/demos/report/report_browser_test.cpp.

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "demos/compare/comparison.h"
#include "demos/compare/golden_update.h"

namespace carom::demos {

struct ReportPlan {
  std::string actual;  ///< The paths that were compared, as given.
  std::string golden;
  Gate gate;
  int embedded = 20;                    ///< Of this many pairs, the worst, the report holds the images.
  int amplify = 16;                     ///< See renderer::DifferencePicture.
  bool updates = false;                 ///< The golden images are about to be replaced.
  std::set<std::string> accepted = {};  ///< Only those of these pairs; empty: all that do not pass.
  std::string accept_command = {};      ///< What the names of chosen pairs are to be put behind; empty: none.
  std::string undo_command = {};        ///< What takes the last update back; empty: none.
};

/// Throws CannotWrite.
void writeComparisonReport(const std::filesystem::path& path, const std::vector<Comparison>& comparisons,
                           const ReportPlan& plan);

}  // namespace carom::demos
