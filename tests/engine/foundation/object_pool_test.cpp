// What is given back is lent again; two that borrow at once have two.

#include "engine/foundation/object_pool.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>
#include <vector>

namespace carom {
namespace {

TEST(ObjectPool, GivesAgainWhatWasReleased) {
  ObjectPool<std::vector<int>> pool;
  const int* room = nullptr;
  {
    const auto lent = pool.acquire();
    (*lent).reserve(100);
    room = (*lent).data();
    EXPECT_NE((*pool.acquire()).data(), room);
  }
  // The one that came back last.
  EXPECT_EQ((*pool.acquire()).data(), room);
}

TEST(ObjectPool, GivesEachThreadItsOwn) {
  ObjectPool<int> pool;
  std::atomic<bool> shared = false;
  std::vector<std::thread> threads;
  for (int mark = 1; mark <= 4; ++mark)
    threads.emplace_back([&, mark] {
      for (int i = 0; i < 2000; ++i) {
        const auto lent = pool.acquire();
        *lent = mark;
        std::this_thread::yield();
        if (*lent != mark) shared = true;
      }
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_FALSE(shared);
}

}  // namespace
}  // namespace carom
