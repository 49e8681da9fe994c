#pragma once
// The exact signed-rank test (Wilcoxon 1945; Conover, Practical Nonparametric Statistics, 5.7): differences
// that are as likely positive as negative at every size have positive ones of as high ranks as negative ones.
// That holds for two runs of one program, whichever is called the other; it tells shifts at which the sign
// test, which does not ask how large a difference is, needs half as many pairs again. Tested in
// tests/demos/against/signed_rank_test.cpp.

#include <vector>

namespace carom::demos {

struct SignedRankTest {
  double log_chance = 0.0;  ///< Natural logarithm, two-sided; 0 where all are tied.
  double shift = 0.0;       ///< The median of the means of any two (Hodges and Lehmann).
  /// The smallest shift of all differences that the test would have called one; infinite where there are too
  /// few.
  double smallest_effect = 0.0;
  bool finds(double chance) const;
};

/// Zeros are left out; equal sizes share their ranks, and the chance is that of these ranks. Work and memory
/// grow with the cube and the square of the number of differences: for thousands of them, seconds.
SignedRankTest signedRankTest(const std::vector<double>& differences, double chance);

}  // namespace carom::demos
