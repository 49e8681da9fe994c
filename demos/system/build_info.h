#pragma once
// What this program is: its version, how it was built, with which libraries, and on what kind of CPU it runs.

#include <string>
#include <utility>
#include <vector>

namespace carom::demos {

/// "0.2.0"
std::string programVersion();
/// "gcc 12.2.0, Release"
std::string buildName();
/// (library, version it was built with)
std::vector<std::pair<std::string, std::string>> libraryVersions();
/// The widest instructions of this CPU that change pixels: "x86-64 avx2 fma".
std::string cpuClass();

}  // namespace carom::demos
