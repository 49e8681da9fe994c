#include "demos/exit_code.h"

#include <csignal>

#include <gtest/gtest.h>

#include "engine/foundation/contract.h"
#include "renderer/frame_renderer.h"

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

}  // namespace
}  // namespace carom::demos
