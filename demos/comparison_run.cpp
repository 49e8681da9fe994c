#include "demos/comparison_run.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>

#include "demos/interrupt.h"
#include "demos/machine_load.h"

namespace carom::demos {
namespace {

/// What the threads share.
struct Work {
  const std::vector<ImagePair>& pairs;
  const Gate& gate;
  const std::function<void(int)>& done;
  std::vector<Comparison> results;
  std::atomic<std::size_t> next = 0;
  std::mutex telling;
  int finished = 0;            // guarded by telling
  std::exception_ptr failure;  // guarded by telling; the first

  void run() {
    try {
      for (std::size_t i = next++; i < pairs.size(); i = next++) {
        throwIfInterrupted();
        results[i] = compared(pairs[i], gate);
        const std::lock_guard lock(telling);
        done(++finished);
      }
    } catch (...) {
      next = pairs.size();  // the others finish the pair they are at
      const std::lock_guard lock(telling);
      if (!failure) failure = std::current_exception();
    }
  }
};

}  // namespace

std::vector<Comparison> comparedPairs(const std::vector<ImagePair>& pairs, const Gate& gate,
                                      const std::function<void(int)>& done) {
  Work work{pairs, gate, done, std::vector<Comparison>(pairs.size()), {}, {}, 0, {}};
  {
    const auto cores = static_cast<std::size_t>(processors());
    std::vector<std::jthread> threads;
    for (std::size_t i = 1; i < std::min(cores, pairs.size()); ++i)
      threads.emplace_back([&work] { work.run(); });
    work.run();
  }
  if (work.failure) std::rethrow_exception(work.failure);
  return std::move(work.results);
}

}  // namespace carom::demos
