// A crew does every part of a job once, whoever does it.

#include "engine/foundation/crew.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace carom {
namespace {

class Crews : public testing::TestWithParam<int> {};

TEST_P(Crews, DoEveryPartOnce) {
  Crew crew(GetParam());
  for (int parts = 0; parts < 70; ++parts) {
    std::vector<int> done(static_cast<std::size_t>(parts), 0);
    crew.run(parts, [&](int part) { ++done[static_cast<std::size_t>(part)]; });
    EXPECT_EQ(done, std::vector<int>(done.size(), 1)) << parts;
  }
}

// What one job leaves, the next one finds: thousands of short ones, with pauses after which threads sleep.
TEST_P(Crews, EndAJobBeforeItsCallerGoesOn) {
  Crew crew(GetParam());
  std::vector<int> values(8, 0);
  for (int job = 1; job <= 5000; ++job) {
    if (job % 1000 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(2));
    crew.run(8, [&](int part) { ++values[static_cast<std::size_t>((part + job) % 8)]; });
    ASSERT_EQ(values, std::vector<int>(8, job));
  }
}

TEST_P(Crews, TellTheFailureOfTheLowestPart_AndGoOn) {
  Crew crew(GetParam());
  for (int round = 0; round < 200; ++round) {
    const auto failing = [](int part) {
      if (part == 2 || part == 5) throw std::runtime_error(std::to_string(part));
    };
    try {
      crew.run(8, failing);
      ADD_FAILURE() << "nothing was thrown";
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "2");
    }
    std::atomic<int> done = 0;
    crew.run(8, [&](int) { ++done; });
    EXPECT_EQ(done, 8);
  }
}

TEST_P(Crews, CutACountIntoStretchesThatAreAllOfIt) {
  Crew crew(GetParam());
  for (const std::size_t count : {0u, 1u, 9u, 10u, 11u, 19u, 20u, 1000u, 1001u}) {
    std::vector<int> met(count, 0);
    std::atomic<int> short_ones = 0;
    crew.runStretches(count, 10, [&](std::size_t begin, std::size_t end) {
      if (end - begin < std::min<std::size_t>(10, count)) ++short_ones;
      for (std::size_t i = begin; i < end; ++i) ++met[i];
    });
    EXPECT_EQ(met, std::vector<int>(count, 1));
    EXPECT_EQ(short_ones, 0) << count;
  }
}

TEST_P(Crews, CanBeMoved) {
  Crew crew(GetParam());
  std::atomic<int> done = 0;
  crew.run(8, [&](int) { ++done; });
  Crew moved(std::move(crew));
  moved.run(8, [&](int) { ++done; });
  moved = Crew(2);  // its threads end
  moved.run(8, [&](int) { ++done; });
  EXPECT_EQ(done, 24);
  EXPECT_EQ(moved.threads(), 2);
}

INSTANTIATE_TEST_SUITE_P(OfThreads, Crews, testing::Values(1, 2, 3, 8));

TEST(Crew, OfOneThread_WorksInItsCallersThread_InTheOrderOfTheParts) {
  Crew crew;
  const std::thread::id caller = std::this_thread::get_id();
  std::vector<int> order;
  crew.run(5, [&](int part) {
    order.push_back(part);
    EXPECT_EQ(std::this_thread::get_id(), caller);
  });
  EXPECT_EQ(order, (std::vector<int>{0, 1, 2, 3, 4}));
}

// Parts that wait for each other end only where several threads take them.
TEST(Crew, OfTwoThreads_WorksOnTwoPartsAtATime) {
  Crew crew(2);
  for (int round = 0; round < 100; ++round) {
    std::atomic<int> begun = 0;
    crew.run(2, [&](int) {
      ++begun;
      while (begun < 2) std::this_thread::yield();
    });
    EXPECT_EQ(begun, 2);
  }
}

// A thread that has waited for so long that it sleeps would leave the caller to do the work alone.
TEST(Crew, OfTwoThreads_WorksOnTwoPartsAtATimeAfterAPauseToo) {
  using namespace std::chrono_literals;
  Crew crew(2);
  crew.run(2, [](int) {});
  for (int round = 0; round < 5; ++round) {
    std::this_thread::sleep_for(50ms);
    const auto deadline = std::chrono::steady_clock::now() + 20s;
    std::atomic<int> begun = 0, alone = 0;
    crew.run(2, [&](int) {
      ++begun;
      while (begun < 2 && std::chrono::steady_clock::now() < deadline) std::this_thread::yield();
      if (begun < 2) ++alone;
    });
    ASSERT_EQ(alone, 0) << round;
  }
}

}  // namespace
}  // namespace carom
