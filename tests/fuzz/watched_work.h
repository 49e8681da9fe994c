#pragma once
// Work on many inputs by processes that may crash, hang or eat memory on any of them: each does every n-th;
// what ends or outstays one is reported with its input, and another process goes on after it.

#include <cstdint>
#include <functional>
#include <string>

namespace carom::fuzz {

struct Bounds {
  int seconds =
      20;  ///< Of computing, for one input; on the clock ten times that, for others work here as well.
  std::size_t memory_bytes = std::size_t{2} << 30;  ///< Resident, of a process and its children.
};

struct WatchedWork {
  std::uint64_t count = 0;
  int processes = 2;
  Bounds bounds;
  /// In the process that works: what is wrong with input `index`, or nothing.
  std::function<std::string(std::uint64_t index)> check;
  /// In this process: `wrong` happened at input `index`.
  std::function<void(std::uint64_t index, const std::string& wrong)> report;
};

/// How many inputs were not taken as they should.
std::uint64_t failuresOf(const WatchedWork& work);

}  // namespace carom::fuzz
