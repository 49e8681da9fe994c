#include "engine/foundation/crew.h"

#include <atomic>
#include <exception>
#include <limits>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "engine/foundation/contract.h"

namespace carom {
namespace {

constexpr int kLooks = 4000;  // at what a thread waits for, some 50 us, before it sleeps

void pause() {
#if defined(__x86_64__) || defined(__i386__)
  __builtin_ia32_pause();
#endif
}

// Until `ends(value)` of what others set.
template <typename Ends>
int await(const std::atomic<int>& value, Ends ends) {
  for (int look = 0; look < kLooks; ++look) {
    const int seen = value.load(std::memory_order_acquire);
    if (ends(seen)) return seen;
    pause();
  }
  for (;;) {
    const int seen = value.load(std::memory_order_acquire);
    if (ends(seen)) return seen;
    value.wait(seen, std::memory_order_acquire);
  }
}

}  // namespace

// A job is given out by setting how many of its parts nobody has taken. Whoever takes one may read the job,
// which stays until all parts are done.
struct Crew::State {
  explicit State(int count) : threads(count) {}
  ~State() {
    untaken.store(kEnd, std::memory_order_release);
    untaken.notify_all();
  }

  static constexpr int kEnd = -1;

  // A system that has no more threads to give is served by those there are.
  void start() {
    if (started) return;
    started = true;
    try {
      for (int i = 1; i < threads; ++i) others.emplace_back([this] { serve(); });
    } catch (const std::system_error&) {
    }
  }
  void serve() {
    while (await(untaken, [](int n) { return n != 0; }) != kEnd) takeParts();
  }
  void takeParts() {
    int n = untaken.load(std::memory_order_acquire);
    while (n > 0)
      if (untaken.compare_exchange_weak(n, n - 1, std::memory_order_acq_rel)) {
        doPart(n - 1);
        n = untaken.load(std::memory_order_acquire);
      }
  }
  void doPart(int part) {
    try {
      job(part);
    } catch (...) {
      while (failing.test_and_set(std::memory_order_acquire)) pause();
      if (part < failed_part) {
        failed_part = part;
        failure = std::current_exception();
      }
      failing.clear(std::memory_order_release);
    }
    if (undone.fetch_sub(1, std::memory_order_acq_rel) == 1) undone.notify_one();
  }

  const int threads;
  bool started = false;
  Job job;
  std::atomic<int> untaken{0};  // parts, or kEnd
  std::atomic<int> undone{0};
  std::atomic_flag failing;  // guards the two below
  int failed_part = std::numeric_limits<int>::max();
  std::exception_ptr failure;
  std::vector<std::jthread> others;  // last: they end before what they use
};

Crew::Crew(int threads) {
  REQUIRE(threads >= 1, threads);
  state_ = std::make_unique<State>(threads);
}
Crew::~Crew() = default;
Crew::Crew(Crew&&) noexcept = default;
Crew& Crew::operator=(Crew&&) noexcept = default;

int Crew::threads() const {
  return state_->threads;
}

void Crew::share(int parts, Job job) {
  State& s = *state_;
  if (s.threads == 1 || parts <= 1) {
    for (int part = 0; part < parts; ++part) job(part);
    return;
  }
  s.start();
  s.job = job;
  s.failed_part = std::numeric_limits<int>::max();
  s.undone.store(parts, std::memory_order_relaxed);
  s.untaken.store(parts, std::memory_order_release);
  s.untaken.notify_all();
  s.takeParts();
  await(s.undone, [](int n) { return n == 0; });
  if (s.failure) std::rethrow_exception(std::exchange(s.failure, nullptr));
}

}  // namespace carom
