#include "demos/compare/comparison_run.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <shared_mutex>
#include <thread>

#include "demos/system/interrupt.h"
#include "demos/system/machine_load.h"
#include "renderer/image/png.h"

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
  std::shared_mutex memory;

  /// Pairs at work together hold no more pixels than the largest that is accepted: one that is larger than
  /// that shared among the threads is at work alone.
  Comparison comparedInMemory(const ImagePair& pair) {
    const std::int64_t pixels = std::max(renderer::pngPixels(pair.actual), renderer::pngPixels(pair.golden));
    const bool is_large = pixels > renderer::kMaxPngPixels / processors();
    std::unique_lock alone(memory, std::defer_lock);
    std::shared_lock beside(memory, std::defer_lock);
    is_large ? alone.lock() : beside.lock();
    return compared(pair, gate);
  }

  void run() {
    try {
      for (std::size_t i = next++; i < pairs.size(); i = next++) {
        throwIfInterrupted();
        results[i] = comparedInMemory(pairs[i]);
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
  Work work{pairs, gate, done, std::vector<Comparison>(pairs.size()), {}, {}, 0, {}, {}};
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
