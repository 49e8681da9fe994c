#pragma once
// Runs the built carom program as a person would, and holds what it said.

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "demos/asset/asset_path.h"
#include "tests/support/shell.h"
#include "tests/support/temporary_folder.h"

namespace carom::demos {

struct ProgramEnd {
  int code = 0;  ///< Exit code, or 128 + the signal that killed it.
  std::string out;
  std::string err;
};

/// Where standard output goes instead of to `ProgramEnd::out`: a descriptor of this process, or nowhere.
struct Outlet {
  static constexpr int kHeld = -1, kClosed = -2;
  int descriptor = kHeld;
};

class Program {
 public:
  /// Starts it in a folder of its own with `environment` ("NAME=value") added.
  explicit Program(const std::vector<std::string>& arguments,
                   const std::vector<std::string>& environment = {}, Outlet outlet = {})
      : outlet_(outlet) {
    for (const std::filesystem::path& stream : {out(), err()})
      std::ofstream{stream};  // even if it never runs
    child_ = fork();
    if (child_ < 0) throw std::runtime_error("cannot fork");
    if (child_ == 0) exec(arguments, environment);
  }

  const std::filesystem::path& folder() const { return folder_.path(); }
  void signal(int number) const { kill(child_, number); }
  /// Returns once the program catches that signal, however slowly it starts; throws after a minute without.
  void awaitHandler(int number) const {
    const std::string status = "/proc/" + std::to_string(child_) + "/status";
    for (int turn = 0; turn < 6000; ++turn) {
      std::ifstream lines(status);
      for (std::string word; lines >> word;)
        if (word == "SigCgt:" && lines >> word && (std::stoull(word, nullptr, 16) >> (number - 1) & 1u) != 0)
          return;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    throw std::runtime_error("the program does not catch the signal");
  }
  pid_t id() const { return child_; }

  ProgramEnd wait() const {
    int status = 0;
    if (waitpid(child_, &status, 0) != child_) throw std::runtime_error("cannot wait");
    return {exitCodeOf(status), outlet_.descriptor == Outlet::kHeld ? readTextFile(out()) : "",
            readTextFile(err())};
  }

 private:
  std::filesystem::path out() const { return streams_.path() / "out"; }
  std::filesystem::path err() const { return streams_.path() / "err"; }

  [[noreturn]] void exec(const std::vector<std::string>& arguments,
                         const std::vector<std::string>& environment) const {
    for (const std::string& variable : environment) {
      const std::size_t equals = variable.find('=');
      setenv(variable.substr(0, equals).c_str(), variable.substr(equals + 1).c_str(), 1);
    }
    std::vector<std::string> words{CAROM_BINARY};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    const int held = open(out().c_str(), O_WRONLY | O_CLOEXEC);
    const int err_file = open(err().c_str(), O_WRONLY | O_CLOEXEC);
    const int out_file = outlet_.descriptor >= 0 ? outlet_.descriptor : held;
    const bool ready = chdir(folder_.path().c_str()) == 0 && dup2(out_file, 1) == 1 && dup2(err_file, 2) == 2;
    if (outlet_.descriptor == Outlet::kClosed) close(1);
    if (ready) execv(argv[0], argv.data());
    _exit(127);
  }

  TemporaryFolder folder_, streams_;
  Outlet outlet_;
  pid_t child_ = -1;
};

/// It told its user why it ended in one line that names the program and says `part`.
inline void expectOneLine(const ProgramEnd& end, const std::string& part = "") {
  EXPECT_EQ(end.err.rfind("carom: ", 0), 0u) << end.err;
  EXPECT_EQ(std::count(end.err.begin(), end.err.end(), '\n'), 1) << end.err;
  EXPECT_NE(end.err.find(part), std::string::npos) << end.err;
  EXPECT_EQ(end.err.find('\033'), std::string::npos) << end.err;
}
inline void expectOneLine(const ProgramEnd& end, int code, const std::string& part = "") {
  EXPECT_EQ(end.code, code) << end.err;
  expectOneLine(end, part);
}

inline ProgramEnd runCarom(const std::vector<std::string>& arguments,
                           const std::vector<std::string>& environment = {}) {
  return Program(arguments, environment).wait();
}

/// File names and contents.
using Files = std::map<std::string, std::string>;

/// What `render` left in a folder but for its JSON; anything hidden counts as well.
inline Files framesOf(const std::filesystem::path& folder) {
  Files files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() != ".json")
      files[entry.path().filename().string()] = readTextFile(entry.path());
  return files;
}

/// How many whole frames are there: they are not finished in order.
inline std::ptrdiff_t framesIn(const std::filesystem::path& folder) {
  if (!std::filesystem::exists(folder)) return 0;
  const std::filesystem::directory_iterator entries(folder);
  return std::count_if(begin(entries), end(entries),
                       [](const auto& entry) { return entry.path().extension() == ".png"; });
}

}  // namespace carom::demos
