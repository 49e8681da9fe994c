#pragma once
// Another process of this program, its output in files: for work that is to be done several times at once and
// must not take the whole down with it. Ended with whoever started it. Tested through the program in
// tests/demos/program/regress_program_test.cpp and tests/demos/gallery/gallery_program_test.cpp.

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <sys/types.h>

namespace carom::demos {

class OwnProcess {
 public:
  /// Starts the program with these words. Throws CannotWrite when the system allows no more processes.
  OwnProcess(std::vector<std::string> words, const std::filesystem::path& out,
             const std::filesystem::path& err);
  OwnProcess(OwnProcess&& other) noexcept : id_(std::exchange(other.id_, -1)) {}
  OwnProcess& operator=(OwnProcess&& other) noexcept {
    std::swap(id_, other.id_);
    return *this;
  }
  /// Asks it to end, if it has not, and waits for that.
  ~OwnProcess();

  /// Its exit code, or 128 and the signal, once it has ended; told once.
  std::optional<int> ended();

 private:
  pid_t id_ = -1;
};

}  // namespace carom::demos
