// Programs that are told of a processor with fused multiply-add round every product all the same. Compiled
// for such a processor, after which come the rules that every floor is compiled with.

#include <gtest/gtest.h>

namespace carom {
namespace {

// Vectors of a difference and a sum: gcc fuses these where it may use the instruction, though it is told not
// to contract.
[[gnu::noinline]] void subtractAndAdd(const double* __restrict factors, const double* __restrict others,
                                      const double* __restrict addends, double* __restrict sums) {
  const double first = factors[0] * others[0];
  const double second = factors[1] * others[1];
  sums[0] = first - addends[0];
  sums[1] = second + addends[1];
}

TEST(FusedMultiplyAdd, IsNotUsed) {
#if defined(__x86_64__) || defined(__i386__)
  if (!__builtin_cpu_supports("avx2")) GTEST_SKIP() << "compiled for a processor with AVX2";
#endif
  volatile double third = 1.0 / 3.0;  // its square is rounded: fused, what is left is that rounding
  const double factors[2] = {third, third};
  const double squared = third * third;
  const double addends[2] = {squared, -squared};
  double sums[2];
  subtractAndAdd(factors, factors, addends, sums);
  EXPECT_EQ(sums[0], 0.0);
  EXPECT_EQ(sums[1], 0.0);
}

}  // namespace
}  // namespace carom
