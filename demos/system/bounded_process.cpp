#include "demos/system/bounded_process.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <fstream>
#include <new>
#include <utility>

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "demos/system/exit_code.h"
#include "demos/system/interrupt.h"

namespace carom::demos {
namespace {

constexpr int kTurn_ms = 200;
constexpr int kNoMemory = 70;  // the child's exit codes
constexpr int kNobodyReads = 71;

/// The address space that this process has.
std::size_t ownAddressSpace() {
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

void lower(int resource, std::size_t soft, std::size_t hard) {
  rlimit limit{};
  ::getrlimit(static_cast<__rlimit_resource_t>(resource), &limit);
  limit.rlim_max = std::min(limit.rlim_max, static_cast<rlim_t>(hard));
  limit.rlim_cur = std::min(limit.rlim_max, static_cast<rlim_t>(soft));
  ::setrlimit(static_cast<__rlimit_resource_t>(resource), &limit);
}

void saySilently() {
  const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nowhere < 0) return;
  ::dup2(nowhere, STDOUT_FILENO);
  ::dup2(nowhere, STDERR_FILENO);
}

bool writeAll(int descriptor, const std::vector<std::uint8_t>& bytes) {
  for (std::size_t at = 0; at < bytes.size();) {
    const ssize_t written = ::write(descriptor, bytes.data() + at, bytes.size() - at);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    at += static_cast<std::size_t>(written);
  }
  return true;
}

[[noreturn]] void runChild(const std::function<std::vector<std::uint8_t>()>& work,
                           const ProcessBounds& bounds, std::size_t address_space, pid_t parent,
                           int descriptor) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(kNobodyReads);
  std::signal(SIGPIPE, SIG_IGN);
  for (const int crash : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGTRAP}) std::signal(crash, SIG_DFL);
  saySilently();
  lower(RLIMIT_CORE, 0, 0);
  lower(RLIMIT_AS, address_space + bounds.memory_bytes, address_space + bounds.memory_bytes);
  const auto cpu_s = static_cast<std::size_t>(bounds.cpu_s);
  lower(RLIMIT_CPU, cpu_s, cpu_s + 1);
  try {
    ::_exit(writeAll(descriptor, work()) ? 0 : kNobodyReads);
  } catch (const std::bad_alloc&) {
    ::_exit(kNoMemory);
  } catch (...) {
    std::abort();  // `work` tells its failures itself
  }
}

/// Kills and waits for a child that has not been waited for.
class Child {
 public:
  explicit Child(pid_t id) : id_(id) {}
  ~Child() {
    if (id_ <= 0) return;
    ::kill(id_, SIGKILL);
    end();
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// The status that it ended with.
  int end() {
    int status = 0;
    while (::waitpid(std::exchange(id_, -1), &status, 0) < 0 && errno == EINTR) {
    }
    return status;
  }

 private:
  pid_t id_;
};

struct Descriptor {
  explicit Descriptor(int of) : number(of) {}
  ~Descriptor() { close(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  void close() {
    if (number >= 0) ::close(std::exchange(number, -1));
  }
  int number;
};

std::string failureOf(int status, const ProcessBounds& bounds) {
  const std::string memory = "needs more than " + std::to_string(bounds.memory_bytes >> 20) + " MB of memory";
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU)
    return "takes more than " + std::to_string(bounds.cpu_s) + " s";
  if (WIFSIGNALED(status)) return std::string("crashed (") + strsignal(WTERMSIG(status)) + ")";
  if (WEXITSTATUS(status) == kNoMemory) return memory;
  return WEXITSTATUS(status) == 0 ? "" : "crashed (exit code " + std::to_string(WEXITSTATUS(status)) + ")";
}

/// Everything until the other end is closed; `refusal` says why it is not.
std::vector<std::uint8_t> readAll(int descriptor, const ProcessBounds& bounds, std::string& refusal) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point deadline = Clock::now() + std::chrono::seconds(bounds.wall_s);
  std::vector<std::uint8_t> bytes;
  std::array<std::uint8_t, 65536> part;
  while (true) {
    throwIfInterrupted();
    if (Clock::now() > deadline) {
      refusal = "takes more than " + std::to_string(bounds.wall_s) + " s";
      return {};
    }
    pollfd waited{descriptor, POLLIN, 0};
    if (::poll(&waited, 1, kTurn_ms) <= 0) continue;
    const ssize_t got = ::read(descriptor, part.data(), part.size());
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return bytes;
    bytes.insert(bytes.end(), part.begin(), part.begin() + got);
    if (bytes.size() > bounds.answer_bytes) {
      refusal = "holds more than " + std::to_string(bounds.answer_bytes >> 20) + " MB";
      return {};
    }
  }
}

}  // namespace

ProcessAnswer answerOfProcess(const std::function<std::vector<std::uint8_t>()>& work,
                              const ProcessBounds& bounds) {
  std::array<int, 2> ends{};
  const std::size_t address_space = ownAddressSpace();
  const pid_t parent = ::getpid();
  if (::pipe2(ends.data(), O_CLOEXEC) != 0)
    throw OutOfResources(std::string("cannot start a process: ") + std::strerror(errno));
  Descriptor reading(ends[0]), writing(ends[1]);
  const pid_t id = ::fork();
  if (id < 0) throw OutOfResources(std::string("cannot start a process: ") + std::strerror(errno));
  if (id == 0) runChild(work, bounds, address_space, parent, writing.number);
  Child child(id);
  writing.close();
  ProcessAnswer answer;
  answer.bytes = readAll(reading.number, bounds, answer.failure);
  if (!answer.failure.empty()) return answer;  // and the child is killed
  answer.failure = failureOf(child.end(), bounds);
  if (!answer.failure.empty()) answer.bytes.clear();
  return answer;
}

}  // namespace carom::demos
