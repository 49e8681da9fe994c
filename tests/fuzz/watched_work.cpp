#include "tests/fuzz/watched_work.h"

#include <array>
#include <atomic>
#include <cstdio>
#include <chrono>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <new>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

namespace carom::fuzz {
namespace {

using Clock = std::chrono::steady_clock;
constexpr auto kTurn = std::chrono::milliseconds(50);

/// Written by a working process, read by the watching one.
struct Slate {
  std::atomic<std::uint64_t> index{0};  ///< The input that it is at.
  std::atomic<bool> is_wrong{false};    ///< With what `text` says; the watching process takes it down.
  std::array<char, 4000> text{};
};

struct Worker {
  pid_t id = -1;
  std::uint64_t first = 0;
  Slate* slate = nullptr;
  std::uint64_t seen = ~0ull;
  Clock::time_point since;
  double computed_s = 0.0;  ///< Before that input.
  bool has_ended = false;
};

/// Of the memory that it shares with its parents and children, its part: a process that has just been started
/// has all of its parent's.
std::size_t residentBytes(pid_t id) {
  const std::string process = "/proc/" + std::to_string(id);
  std::size_t bytes = 0;
  std::ifstream in(process + "/smaps_rollup");
  for (std::string line; std::getline(in, line);) {
    constexpr std::string_view kPart = "Pss:";
    if (line.starts_with(kPart)) bytes = std::stoull(line.substr(kPart.size())) << 10;
  }
  std::ifstream children(process + "/task/" + std::to_string(id) + "/children");
  for (pid_t child = 0; children >> child;) bytes += residentBytes(child);
  return bytes;
}

/// What a process, its children and those before them have computed.
double computedSeconds(pid_t id) {
  const std::string process = "/proc/" + std::to_string(id);
  std::ifstream in(process + "/stat");
  std::string line;
  std::getline(in, line, '\0');  // which does not throw where the process has just ended
  const std::size_t name_end = line.rfind(')');
  if (name_end == std::string::npos) return 0.0;
  std::istringstream fields(line.substr(name_end + 1));
  std::string skipped;
  for (int i = 0; i < 11; ++i) fields >> skipped;
  double seconds = 0.0, ticks = 0.0;
  for (int i = 0; i < 4 && fields >> ticks; ++i)
    seconds += ticks / static_cast<double>(::sysconf(_SC_CLK_TCK));
  std::ifstream children(process + "/task/" + std::to_string(id) + "/children");
  for (pid_t child = 0; children >> child;) seconds += computedSeconds(child);
  return seconds;
}

std::filesystem::path logOf(pid_t id) {
  return std::filesystem::temp_directory_path() / ("carom-fuzz-" + std::to_string(id) + ".log");
}

/// What the process said last, as one that a sanitizer ends does.
std::string lastWords(pid_t id) {
  std::ifstream in(logOf(id));
  std::string text{std::istreambuf_iterator<char>(in), {}};
  std::filesystem::remove(logOf(id));
  return text.substr(0, 3000);
}

[[noreturn]] void runWorker(const WatchedWork& work, Worker& worker) {
  const int log = ::open(logOf(::getpid()).c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  ::dup2(log, STDERR_FILENO);
  for (std::uint64_t i = worker.first; i < work.count; i += static_cast<std::uint64_t>(work.processes)) {
    worker.slate->index.store(i);
    const std::string wrong = work.check(i);
    if (wrong.empty()) continue;
    std::snprintf(worker.slate->text.data(), worker.slate->text.size(), "%s", wrong.c_str());
    worker.slate->is_wrong.store(true);
    while (worker.slate->is_wrong.load()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  std::fflush(nullptr);
  ::_exit(0);
}

class Watch {
 public:
  explicit Watch(const WatchedWork& work) : work_(work), workers_(static_cast<std::size_t>(work.processes)) {
    void* const shared = ::mmap(nullptr, workers_.size() * sizeof(Slate), PROT_READ | PROT_WRITE,
                                MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (shared == MAP_FAILED) throw std::bad_alloc();
    for (std::size_t i = 0; i < workers_.size(); ++i) {
      workers_[i].slate = new (static_cast<Slate*>(shared) + i) Slate;
      workers_[i].first = i;
      start(workers_[i]);
    }
  }

  std::uint64_t run() {
    while (looksAt()) std::this_thread::sleep_for(kTurn);
    return failures_;
  }

 private:
  void start(Worker& worker) {
    worker.seen = ~0ull;
    worker.since = Clock::now();
    worker.has_ended = worker.first >= work_.count;
    if (worker.has_ended) return;
    worker.slate->index.store(worker.first);
    std::fflush(nullptr);
    worker.id = ::fork();
    if (worker.id < 0) throw std::runtime_error("no process");
    if (worker.id == 0) runWorker(work_, worker);
  }

  void fail(Worker& worker, const std::string& wrong) {
    ++failures_;
    work_.report(worker.slate->index.load(), wrong);
  }

  /// It has ended at its input, or is ended there; another goes on after it.
  void replace(Worker& worker, const std::string& wrong) {
    ::kill(worker.id, SIGKILL);
    while (::waitpid(worker.id, nullptr, 0) < 0 && errno == EINTR) {
    }
    fail(worker, wrong + "\n" + lastWords(worker.id));
    worker.first = worker.slate->index.load() + static_cast<std::uint64_t>(work_.processes);
    worker.slate->is_wrong.store(false);
    start(worker);
  }

  /// Whether it goes on working.
  bool looksAt(Worker& worker) {
    if (worker.has_ended) return false;
    if (worker.slate->is_wrong.load()) {
      fail(worker, worker.slate->text.data());
      worker.slate->is_wrong.store(false);
    }
    if (worker.seen != worker.slate->index.load()) {
      worker.seen = worker.slate->index.load();
      worker.since = Clock::now();
      worker.computed_s = computedSeconds(worker.id);
    }
    siginfo_t ended{};
    if (::waitid(P_PID, static_cast<id_t>(worker.id), &ended, WEXITED | WNOHANG | WNOWAIT) == 0 &&
        ended.si_pid == worker.id) {
      worker.has_ended = ended.si_code == CLD_EXITED && ended.si_status == 0;
      if (!worker.has_ended) {
        replace(worker, "ends with " + std::to_string(ended.si_status));
        return true;
      }
      ::waitpid(worker.id, nullptr, 0);
      std::filesystem::remove(logOf(worker.id));
      return false;
    }
    if (Clock::now() - worker.since > std::chrono::seconds(10 * work_.bounds.seconds) ||
        computedSeconds(worker.id) - worker.computed_s > work_.bounds.seconds)
      replace(worker, "takes more than " + std::to_string(work_.bounds.seconds) + " s");
    else if (residentBytes(worker.id) > work_.bounds.memory_bytes)
      replace(worker, "takes more than " + std::to_string(work_.bounds.memory_bytes >> 20) + " MB");
    return true;
  }

  bool looksAt() {
    bool any = false;
    for (Worker& worker : workers_) any = looksAt(worker) || any;
    return any;
  }

  const WatchedWork& work_;
  std::vector<Worker> workers_;
  std::uint64_t failures_ = 0;
};

}  // namespace

std::uint64_t failuresOf(const WatchedWork& work) {
  return Watch(work).run();
}

}  // namespace carom::fuzz
