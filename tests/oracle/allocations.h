#pragma once
// How often this thread has called operator new, in programs that replace it (no_allocation_tests: the
// operators are in tests/engine/closest_features/no_allocation_test.cpp).

namespace carom::oracle {

inline thread_local long allocations = 0;

inline long allocationsOf(auto&& work) {
  const long before = allocations;
  work();
  return allocations - before;
}

}  // namespace carom::oracle
