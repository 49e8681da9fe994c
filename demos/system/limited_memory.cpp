#include "demos/system/limited_memory.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <streambuf>
#include <string>

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include "demos/system/exit_code.h"

namespace carom::demos {
namespace {

constexpr std::array kCrashes{SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGTRAP};

// What a signal handler needs; it can reach nothing but globals, and must not allocate.
int line_descriptor = -1;
pid_t process = 0;
std::array<char, 200> line{};
alignas(16) std::array<char, 65536> handler_stack{};

rlim_t memoryLimit() {
  rlim_t least = RLIM_INFINITY;
  for (const auto resource : {RLIMIT_AS, RLIMIT_DATA}) {
    rlimit limit{};
    if (::getrlimit(resource, &limit) == 0) least = std::min(least, limit.rlim_cur);
  }
  return least;
}

void endByCrash(int) {
  if (::getpid() == process) {
    const ssize_t ignored = ::write(line_descriptor, line.data(), std::strlen(line.data()));
    static_cast<void>(ignored);
  }
  ::_exit(static_cast<int>(ExitCode::kCannotWrite));
}

bool returns = false;

// A library that has no more memory may call exit itself (Mesa's lexer does, with code 2).
void endByExit() {
  if (!returns) endByCrash(0);
}

/// Hands everything on at once.
class LineBuffer final : public std::streambuf {
 protected:
  std::streamsize xsputn(const char* text, std::streamsize count) override {
    std::streamsize done = 0;
    while (done < count) {
      const ssize_t written = ::write(line_descriptor, text + done, static_cast<std::size_t>(count - done));
      if (written < 0 && errno != EINTR) return done;
      if (written > 0) done += written;
    }
    return done;
  }
  int_type overflow(int_type c) override {
    if (traits_type::eq_int_type(c, traits_type::eof())) return traits_type::not_eof(c);
    const char one = traits_type::to_char_type(c);
    return xsputn(&one, 1) == 1 ? c : traits_type::eof();
  }
};

/// Standard error is std::cerr's alone.
void silenceLibraries() {
  static LineBuffer buffer;  // std::cerr outlives every scope
  line_descriptor = ::fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
  const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (line_descriptor < 0 || nowhere < 0) return;
  ::dup2(nowhere, STDERR_FILENO);
  ::close(nowhere);
  std::cerr.rdbuf(&buffer);
}

}  // namespace

void tellCrashesOfLimitedMemory() {
  const rlim_t limit = memoryLimit();
  if (limit == RLIM_INFINITY) return;
  const std::string text = "carom: out of memory: a library needs more than the limit of " +
                           std::to_string(limit >> 20) + " MB (ulimit -v)\n";
  std::copy_n(text.c_str(), std::min(text.size() + 1, line.size() - 1), line.begin());
  process = ::getpid();
  silenceLibraries();
  stack_t stack{};
  stack.ss_sp = handler_stack.data();
  stack.ss_size = handler_stack.size();
  ::sigaltstack(&stack, nullptr);
  struct sigaction action = {};
  action.sa_handler = endByCrash;
  action.sa_flags = SA_ONSTACK;
  sigfillset(&action.sa_mask);
  for (const int crash : kCrashes) ::sigaction(crash, &action, nullptr);
  std::atexit(endByExit);
}

int returned(int code) {
  returns = true;
  return code;
}

void abortAsBug() {
  std::signal(SIGABRT, SIG_DFL);
  std::abort();
}

}  // namespace carom::demos
