#pragma once
// The exact sign test (Arbuthnot 1710; Conover, Practical Nonparametric Statistics, 3.4): of n pairs that are
// not tied, as many are larger one way as the other where nothing differs. Needs no shape of the noise, only
// that it strikes both of a pair alike. Tested in tests/demos/against/sign_test_test.cpp.

#include <vector>

namespace carom::demos {

/// The logarithm of the chance that of `pairs` fair coins at least `larger` or at most pairs - `larger` show
/// heads, whichever of the two is the rarer, doubled: two-sided. At most 0.
double logSignChance(long long larger, long long pairs);

/// The fewest heads of `pairs` coins that are rarer than `chance`; pairs + 1 where none are.
long long fewestOf(long long pairs, double chance);

struct SignTest {
  long long pairs = 0;      ///< Without ties.
  long long larger = 0;     ///< Of them, those with a positive difference.
  double log_chance = 0.0;  ///< Natural logarithm.
  double median = 0.0;      ///< Of all differences.
  /// The smallest shift of all differences that the test would have called one; infinite where there are too
  /// few pairs.
  double smallest_effect = 0.0;
  bool finds(double chance) const;
};
SignTest signTest(std::vector<double> differences, double chance);

}  // namespace carom::demos
