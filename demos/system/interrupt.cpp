#include "demos/system/interrupt.h"

#include <atomic>
#include <csignal>

#include "demos/system/exit_code.h"

namespace carom::demos {
namespace {

// A signal handler can reach nothing but a global; lock-free, so that it may touch it.
std::atomic<int> arrived_signal{0};
static_assert(std::atomic<int>::is_always_lock_free);

}  // namespace

void catchInterrupts() {
  struct sigaction action = {};
  action.sa_handler = [](int number) { arrived_signal.store(number, std::memory_order_relaxed); };
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

void throwIfInterrupted() {
  const int number = arrived_signal.load(std::memory_order_relaxed);
  if (number != 0) throw Interrupted(number);
}

}  // namespace carom::demos
