#include "demos/system/exit_code.h"

#include <csignal>
#include <new>
#include <system_error>

#include <gtest/gtest.h>

#include "engine/foundation/contract.h"
#include "renderer/frame/frame_renderer.h"

namespace carom::demos {
namespace {

template <typename Exception>
Failure failureOfThrown(const Exception& exception) {
  return failureOf(std::make_exception_ptr(exception));
}

TEST(ExitCode, EachKindOfFailureHasItsOwn) {
  EXPECT_EQ(failureOfThrown(UsageError("x")).code, 2);
  EXPECT_EQ(failureOfThrown(InputError("x")).code, 3);
  EXPECT_EQ(failureOfThrown(CannotWrite("x")).code, 4);
  EXPECT_EQ(failureOfThrown(renderer::NoImageMemory("images", 32, 32)).code, 4);
  EXPECT_EQ(failureOfThrown(SimulationInvalid("x")).code, 5);
  EXPECT_EQ(failureOfThrown(renderer::NoRenderer("x")).code, 6);
  EXPECT_EQ(failureOfThrown(PipeClosed("x")).code, 141);
  EXPECT_EQ(failureOfThrown(Interrupted(SIGINT)).code, 130);
  EXPECT_EQ(failureOfThrown(Interrupted(SIGTERM)).code, 143);
  EXPECT_FALSE(failureOfThrown(InputError("x")).is_bug);
}

TEST(ExitCode, ABrokenContractIsABugOfOurs) {
  const Failure failure = failureOfThrown(ContractViolation("bug: x"));
  EXPECT_TRUE(failure.is_bug);
  EXPECT_EQ(failure.line, "bug: x");
  EXPECT_EQ(failure.code, 128 + SIGABRT);
}

TEST(ExitCode, NoMoreMemoryThreadsOrProcessesIs4AndNoBug) {
  const auto again = std::make_error_code(std::errc::resource_unavailable_try_again);
  EXPECT_EQ(failureOfThrown(std::bad_alloc()).code, 4);
  EXPECT_EQ(failureOfThrown(std::system_error(again)).code, 4);
  EXPECT_EQ(failureOfThrown(OutOfResources("x")).code, 4);
  EXPECT_FALSE(failureOfThrown(std::bad_alloc()).is_bug);
  EXPECT_TRUE(failureOfThrown(std::system_error(std::make_error_code(std::errc::bad_address))).is_bug);
}

TEST(ExitCode, WhateverAMessageQuotesItIsOneLineWithoutControlCharacters) {
  EXPECT_EQ(failureOfThrown(InputError("a\nb\x1b[31m")).line, "a\\nb\\x1b[31m");
}

}  // namespace
}  // namespace carom::demos
