#pragma once
// The sources of this checkout, for tests that judge their text.

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "tests/architecture/include_rules.h"

namespace carom::architecture {

/// Headers and sources below the folders, by path.
inline std::vector<Source> sourcesOfTheTree(const std::vector<std::string>& folders = {"engine", "renderer",
                                                                                       "demos"}) {
  namespace fs = std::filesystem;
  const fs::path root = CAROM_SOURCE_DIR;
  std::vector<Source> sources;
  for (const std::string& folder : folders)
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      const std::string extension = entry.path().extension().string();
      if (!entry.is_regular_file() || (extension != ".h" && extension != ".cpp")) continue;
      std::ifstream in(entry.path());
      std::ostringstream text;
      text << in.rdbuf();
      sources.push_back({fs::relative(entry.path(), root).generic_string(), text.str()});
    }
  std::sort(sources.begin(), sources.end(), [](const Source& a, const Source& b) { return a.path < b.path; });
  return sources;
}

}  // namespace carom::architecture
