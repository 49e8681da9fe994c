#include "tests/explore/watch/guarded_run.h"

#include <poll.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <ctime>
#include <exception>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace carom::explore {
namespace {

constexpr std::uint64_t kJobsOfAWorker = 64;  // then a fresh process takes over

double cpuTime() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// SIGPROF ends the process when this much CPU time has passed; 0: never.
void armClock(double cpu_s) {
  itimerval timer{};
  timer.it_value.tv_sec = static_cast<time_t>(cpu_s);
  timer.it_value.tv_usec =
      static_cast<suseconds_t>(1e6 * (cpu_s - static_cast<double>(timer.it_value.tv_sec)));
  setitimer(ITIMER_PROF, &timer, nullptr);
}

/// What a worker is at, for its parent to see when it has died.
struct Progress {
  std::atomic<std::uint64_t> job;
  std::atomic<int> step;
  std::atomic<bool> is_last;  ///< What the run has left is less than a step may take.
};

std::string oneLine(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\n' || c == '\t'; }, ' ');
  return text;
}

std::string written(std::uint64_t job, const SeedReport& report) {
  std::ostringstream out;
  out.precision(17);
  const TrialTotals& t = report.outcome.totals;
  out << "R\t" << job << '\t' << report.seed << '\t' << report.family << '\t' << report.cpu_s << '\t'
      << t.steps << '\t' << t.body_steps << '\t' << t.stopped << '\t' << t.queries << '\t' << t.events << '\t'
      << t.worst_gain << '\t' << t.most_events << '\t' << t.most_queries << '\t' << t.refused << '\n';
  for (const Finding& f : report.outcome.findings)
    out << "F\t" << f.kind << '\t' << f.figure << '\t' << f.step << '\t' << oneLine(f.detail) << '\n';
  out << "E\n";
  return out.str();
}

std::vector<std::string> fieldsOf(const std::string& line) {
  std::vector<std::string> fields;
  std::istringstream in(line);
  for (std::string field; std::getline(in, field, '\t');) fields.push_back(field);
  fields.resize(std::max<std::size_t>(fields.size(), 14));
  return fields;
}

SeedReport readReport(const std::vector<std::string>& f) {
  SeedReport report;
  report.seed = std::stoull(f[2]);
  report.family = f[3];
  report.cpu_s = std::stod(f[4]);
  TrialTotals& t = report.outcome.totals;
  t.steps = std::stol(f[5]);
  t.body_steps = std::stol(f[6]);
  t.stopped = std::stol(f[7]);
  t.queries = std::stol(f[8]);
  t.events = std::stol(f[9]);
  t.worst_gain = std::stod(f[10]);
  t.most_events = std::stod(f[11]);
  t.most_queries = std::stod(f[12]);
  t.refused = std::stoi(f[13]);
  return report;
}

class Worker {
 public:
  Worker(std::uint64_t first, std::uint64_t end, const Limits& limits, const Job& job)
      : next_(first), end_(end) {
    void* page = mmap(nullptr, sizeof(Progress), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    int ends[2];
    if (page == MAP_FAILED || pipe(ends) != 0) throw std::runtime_error("no pipe or page for a worker");
    progress_ = static_cast<Progress*>(page);
    id_ = fork();
    if (id_ < 0) throw std::runtime_error("cannot fork");
    if (id_ == 0) {
      close(ends[0]);
      work(ends[1], limits, job);
    }
    close(ends[1]);
    descriptor_ = ends[0];
  }
  ~Worker() {
    if (descriptor_ >= 0) close(descriptor_);
    munmap(progress_, sizeof(Progress));
  }
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  int descriptor() const { return descriptor_; }
  std::uint64_t next() const { return next_; }
  std::uint64_t end() const { return end_; }

  /// False when the worker has gone.
  bool takeLines(const std::function<void(const SeedReport&)>& take) {
    char buffer[1 << 14];
    const ssize_t got = read(descriptor_, buffer, sizeof buffer);
    if (got < 0 && errno == EINTR) return true;
    if (got <= 0) return false;
    arrived_.append(buffer, static_cast<std::size_t>(got));
    for (std::size_t at; (at = arrived_.find('\n')) != std::string::npos; arrived_.erase(0, at + 1))
      takeLine(arrived_.substr(0, at), take);
    return true;
  }

  /// Waits for it; what killed it, as a finding of the job it was at, when it has not done all.
  void endOf(const std::function<void(const SeedReport&)>& take) {
    int status = 0;
    while (waitpid(id_, &status, 0) < 0 && errno == EINTR) {
    }
    if (next_ == end_) return;
    SeedReport report;
    report.seed = next_;
    const int step = progress_->step;
    const bool over = WIFSIGNALED(status) && WTERMSIG(status) == SIGPROF;
    const std::string how = WIFSIGNALED(status) ? "signal " + std::to_string(WTERMSIG(status))
                                                : "exit code " + std::to_string(WEXITSTATUS(status));
    if (!over)
      report.outcome.findings.push_back({"crash", 1.0, step, how});
    else if (progress_->is_last)
      report.outcome.findings.push_back({"slow", 1.0, step, "the run takes more CPU time than it may"});
    else
      report.outcome.findings.push_back({"hang", 1.0, step, "the step takes more CPU time than it may"});
    ++next_;
    take(report);
  }

 private:
  [[noreturn]] void work(int out, const Limits& limits, const Job& job) {
    for (std::uint64_t i = next_; i < end_; ++i) {
      const double begin_s = cpuTime();
      progress_->job = i;
      progress_->step = 0;
      progress_->is_last = false;
      double run_s = begin_s;  // when the first step of the present run began
      bool starts = false;
      TrialSettings settings;
      settings.before_start = [&] {
        starts = true;
        progress_->step = 0;
        progress_->is_last = false;
        armClock(limits.start_cpu_s);
      };
      settings.before_step = [&] {
        if (std::exchange(starts, false)) run_s = cpuTime();
        ++progress_->step;
        const double left_s = limits.run_cpu_s - (cpuTime() - run_s);
        progress_->is_last = left_s < limits.step_cpu_s;
        if (!(left_s > 0.0)) raise(SIGPROF);
        armClock(std::min(limits.step_cpu_s, left_s) + 1e-3);
      };
      SeedReport report;
      try {
        report = job(i, settings);
      } catch (const std::exception& error) {
        report.seed = i;
        report.outcome.findings.push_back({"abort", 1.0, progress_->step, error.what()});
      }
      armClock(0.0);
      report.cpu_s = cpuTime() - begin_s;
      const std::string text = written(i, report);
      for (std::size_t at = 0; at < text.size();) {
        const ssize_t put = ::write(out, text.data() + at, text.size() - at);
        if (put <= 0) _exit(9);
        at += static_cast<std::size_t>(put);
      }
    }
    _exit(0);
  }

  void takeLine(const std::string& line, const std::function<void(const SeedReport&)>& take) {
    const std::vector<std::string> fields = fieldsOf(line);
    if (fields[0] == "R") report_ = readReport(fields);
    if (fields[0] == "F")
      report_.outcome.findings.push_back({fields[1], std::stod(fields[2]), std::stoi(fields[3]), fields[4]});
    if (fields[0] != "E") return;
    ++next_;
    take(report_);
  }

  std::uint64_t next_ = 0, end_ = 0;  ///< The jobs not yet reported.
  Progress* progress_ = nullptr;
  pid_t id_ = -1;
  int descriptor_ = -1;
  std::string arrived_;
  SeedReport report_;
};

}  // namespace

void runGuarded(std::uint64_t first, std::uint64_t count, int processes, const Limits& limits, const Job& job,
                const std::function<void(const SeedReport&)>& take) {
  const std::uint64_t last = first + count;
  std::uint64_t next = first;
  std::vector<std::unique_ptr<Worker>> workers;
  const auto begin = [&](std::uint64_t from, std::uint64_t to) {
    workers.push_back(std::make_unique<Worker>(from, to, limits, job));
  };
  while (next < last || !workers.empty()) {
    while (next < last && workers.size() < static_cast<std::size_t>(processes)) {
      const std::uint64_t end = std::min(last, next + kJobsOfAWorker);
      begin(next, end);
      next = end;
    }
    std::vector<pollfd> watched;
    for (const auto& worker : workers) watched.push_back({worker->descriptor(), POLLIN, 0});
    poll(watched.data(), watched.size(), -1);
    for (std::size_t i = watched.size(); i-- > 0;) {
      if (watched[i].revents == 0 || workers[i]->takeLines(take)) continue;
      const std::unique_ptr<Worker> gone = std::move(workers[i]);
      workers.erase(workers.begin() + static_cast<std::ptrdiff_t>(i));
      gone->endOf(take);
      if (gone->next() < gone->end()) begin(gone->next(), gone->end());
    }
  }
}

SeedReport runGuarded(const Limits& limits, const std::function<SeedReport(const TrialSettings&)>& job) {
  SeedReport report;
  runGuarded(
      0, 1, 1, limits, [&job](std::uint64_t, const TrialSettings& settings) { return job(settings); },
      [&report](const SeedReport& taken) { report = taken; });
  return report;
}

}  // namespace carom::explore
