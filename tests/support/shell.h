#pragma once
// Lines for a shell, and how they end.

#include <array>
#include <cstdio>
#include <cstdlib>
#include <string>

#include <sys/wait.h>

namespace carom {

/// The exit code that a status of `wait` or `system` says, or 128 + the signal that ended the process.
inline int exitCodeOf(int status) {
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

struct ShellEnd {
  int code = 0;
  std::string out;
};

/// What the line writes to its standard output, and how it ends.
inline ShellEnd endOfShell(const std::string& line) {
  std::FILE* pipe = popen(line.c_str(), "r");
  ShellEnd end;
  std::array<char, 4096> chunk{};
  while (std::fgets(chunk.data(), static_cast<int>(chunk.size()), pipe) != nullptr) end.out += chunk.data();
  end.code = exitCodeOf(pclose(pipe));
  return end;
}

/// Whether a line that asks for a tool, "idiff --help", ends well.
inline bool succeeds(const std::string& line) {
  return std::system(("{ " + line + "; } >/dev/null 2>&1").c_str()) == 0;
}

}  // namespace carom
