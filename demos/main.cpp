// carom: carries out the command line; what it throws becomes one line on stderr and an exit code.
#include <csignal>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <string>

#include <fcntl.h>
#include <malloc.h>
#include <unistd.h>

#include "demos/cli/command_line.h"
#include "demos/system/exit_code.h"
#include "demos/system/limited_memory.h"

namespace {

using namespace carom::demos;

/// Descriptors 0 to 2 that were closed (`carom ... >&-`) are opened on /dev/null, or the first file that is
/// written would take their number, and get what is meant for them. Data has nowhere to go, so that writing
/// it fails; what is told is dropped.
void occupyStandardDescriptors() {
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(descriptor, F_GETFD) != -1) continue;
    if (::open("/dev/null", descriptor == STDERR_FILENO ? O_WRONLY : O_RDONLY) != descriptor) std::abort();
  }
}

/// A file that grows beyond the process's limit (`ulimit -f`) is an error of its write, whichever file it is:
/// also what a library keeps for the next time.
void takeFileLimitsAsErrors() {
  std::signal(SIGXFSZ, SIG_IGN);
}

/// What one frame frees serves the next: given back to the system, its pages would be fetched and cleared
/// again for every frame, a tenth of the time of drawing it.
void keepFreedMemory() {
#ifdef __GLIBC__
  constexpr int kLargestFromHeap = 64 << 20, kMostKept = 256 << 20;  // Bytes.
  ::mallopt(M_MMAP_THRESHOLD, kLargestFromHeap);
  ::mallopt(M_TRIM_THRESHOLD, kMostKept);
#endif
}

int run(int argc, char** argv) {
  const ExitCode code = runCommandLine(argc, argv);
  if (!std::cout.flush()) throw CannotWrite("cannot write to standard output");
  return static_cast<int>(code);
}

/// Red on a terminal, unless NO_COLOR asks for none (no-color.org).
void tell(const std::string& message) {
  const char* no_color = std::getenv("NO_COLOR");
  const bool colored = ::isatty(STDERR_FILENO) != 0 && (no_color == nullptr || *no_color == '\0');
  std::cerr << (colored ? "\033[31mcarom:\033[0m " : "carom: ") << message << std::endl;
}

}  // namespace

int main(int argc, char** argv) {
  occupyStandardDescriptors();
  takeFileLimitsAsErrors();
  tellCrashesOfLimitedMemory();
  keepFreedMemory();
  try {
    return returned(run(argc, argv));
  } catch (...) {
    const Failure failure = failureOf(std::current_exception());
    tell(failure.line);
    if (failure.is_bug) abortAsBug();
    return returned(failure.code);
  }
}
