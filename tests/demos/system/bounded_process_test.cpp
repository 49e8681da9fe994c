#include "demos/system/bounded_process.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <iostream>
#include <new>

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

namespace carom::demos {
namespace {

using Bytes = std::vector<std::uint8_t>;
using Clock = std::chrono::steady_clock;

constexpr ProcessBounds kBounds{
    .memory_bytes = std::size_t{256} << 20, .cpu_s = 20, .wall_s = 60, .answer_bytes = std::size_t{64} << 20};

bool hasChildren() {
  return ::waitpid(-1, nullptr, WNOHANG) >= 0 || errno != ECHILD;
}

void expectFailure(const std::function<Bytes()>& work, const ProcessBounds& bounds,
                   const std::string& failure) {
  const ProcessAnswer answer = answerOfProcess(work, bounds);
  EXPECT_EQ(answer.failure, failure);
  EXPECT_TRUE(answer.bytes.empty());
  EXPECT_FALSE(hasChildren());
}

TEST(BoundedProcess, AnAnswerLargerThanAPipeArrivesWhole) {
  Bytes wanted(5000000);
  for (std::size_t i = 0; i < wanted.size(); ++i) wanted[i] = static_cast<std::uint8_t>(i * 31);
  const ProcessAnswer answer = answerOfProcess([&wanted] { return wanted; }, kBounds);
  EXPECT_EQ(answer.failure, "");
  EXPECT_TRUE(answer.bytes == wanted);
  EXPECT_TRUE(answerOfProcess([] { return Bytes(); }, kBounds).failure.empty());
  EXPECT_FALSE(hasChildren());
}

TEST(BoundedProcess, OneThatCrashesIsNamedByItsSignalOrCode) {
  const auto raised = [](int signal) {
    return [signal]() -> Bytes {
      std::raise(signal);
      return {};
    };
  };
  expectFailure(raised(SIGSEGV), kBounds, "crashed (Segmentation fault)");
  expectFailure(raised(SIGABRT), kBounds, "crashed (Aborted)");
  expectFailure([]() -> Bytes { ::_exit(9); }, kBounds, "crashed (exit code 9)");
  expectFailure([]() -> Bytes { throw 1; }, kBounds, "crashed (Aborted)");
}

TEST(BoundedProcess, MemoryBeyondTheBoundIsRefusedToIt) {
  const auto taking = [](std::size_t size) {
    return [size]() -> Bytes {
      void* const block = ::mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
      if (block == MAP_FAILED) throw std::bad_alloc();
      return {1};
    };
  };
  EXPECT_EQ(answerOfProcess(taking(std::size_t{100} << 20), kBounds).failure, "");
  expectFailure(taking(std::size_t{1} << 30), kBounds, "needs more than 256 MB of memory");
}

TEST(BoundedProcess, OneThatNeverEndsIsEnded) {
  ProcessBounds bounds = kBounds;
  bounds.cpu_s = 1;
  const auto spin = []() -> Bytes {
    for (;;) ::getppid();
  };
  expectFailure(spin, bounds, "takes more than 1 s");
  bounds.cpu_s = 20;
  bounds.wall_s = 1;
  const auto sleep = []() -> Bytes {
    for (;;) ::pause();
  };
  expectFailure(sleep, bounds, "takes more than 1 s");
}

TEST(BoundedProcess, AnAnswerWithoutEndIsCut) {
  ProcessBounds bounds = kBounds;
  bounds.answer_bytes = std::size_t{1} << 20;
  expectFailure([] { return Bytes(2 << 20); }, bounds, "holds more than 1 MB");
}

TEST(BoundedProcess, ItSaysNothing) {
  testing::internal::CaptureStderr();
  answerOfProcess(
      [] {
        std::cerr << "a library's own words" << std::endl;
        return Bytes();
      },
      kBounds);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
// The least of many, for others use the machine as well.
TEST(BoundedProcess, CostsLessThanFiveMilliseconds) {
  Clock::duration least = std::chrono::hours(1);
  for (int turn = 0; turn < 50; ++turn) {
    const Clock::time_point began = Clock::now();
    answerOfProcess([] { return Bytes{1}; }, kBounds);
    least = std::min(least, Clock::now() - began);
  }
  EXPECT_LT(least, std::chrono::milliseconds(5));
}
#endif

}  // namespace
}  // namespace carom::demos
