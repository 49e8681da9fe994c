#pragma once
// Work that may crash, eat memory or never end (a library that reads files of strangers), done by a child
// process under limits of memory and time. Its answer comes back as plain bytes, which are to be read like
// those of a stranger's file: a library that has written over its memory may say anything. For processes that
// live and talk see worker_process.h. Tested in tests/demos/system/bounded_process_test.cpp.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace carom::demos {

struct ProcessBounds {
  std::size_t memory_bytes = 0;  ///< Of address space, beyond what this process has.
  int cpu_s = 0;
  int wall_s = 0;
  std::size_t answer_bytes = 0;
};

struct ProcessAnswer {
  std::vector<std::uint8_t> bytes;
  std::string
      failure;  ///< Why there are none, as the end of a sentence ("crashed (...)"); empty: they are whole.
};

/// Forks; the child calls `work`, which shares nothing with this process, says nothing (its standard output
/// and error go nowhere), and ends. Takes less than a millisecond where `work` does. Throws OutOfResources
/// where the system allows no more processes, Interrupted as throwIfInterrupted does.
ProcessAnswer answerOfProcess(const std::function<std::vector<std::uint8_t>()>& work,
                              const ProcessBounds& bounds);

}  // namespace carom::demos
