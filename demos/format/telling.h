#pragma once
// How talkative a job is.

#include <string>

namespace carom::demos {

/// How much is told on stderr.
struct Telling {
  std::string progress = "auto";
  bool quiet = false;
  bool verbose = false;
};

}  // namespace carom::demos
