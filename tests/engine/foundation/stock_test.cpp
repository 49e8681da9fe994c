// What is given back is lent again; two that borrow at once have two.

#include "engine/foundation/stock.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>
#include <vector>

namespace carom {
namespace {

TEST(Stock, LendsAgainWhatWasGivenBack) {
  Stock<std::vector<int>> stock;
  const int* room = nullptr;
  {
    const auto lent = stock.borrow();
    (*lent).reserve(100);
    room = (*lent).data();
    EXPECT_NE((*stock.borrow()).data(), room);
  }
  // The one that came back last.
  EXPECT_EQ((*stock.borrow()).data(), room);
}

TEST(Stock, GivesEachThreadItsOwn) {
  Stock<int> stock;
  std::atomic<bool> shared = false;
  std::vector<std::thread> threads;
  for (int mark = 1; mark <= 4; ++mark)
    threads.emplace_back([&, mark] {
      for (int i = 0; i < 2000; ++i) {
        const auto lent = stock.borrow();
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
