#include "demos/against/sign_test.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace carom::demos {
namespace {

/// log(exp(a) + exp(b))
double logSum(double a, double b) {
  const double most = std::max(a, b);
  if (most == -std::numeric_limits<double>::infinity()) return most;
  return most + std::log1p(std::exp(std::min(a, b) - most));
}

/// Of at least `heads` heads of `coins`. Terms fall by a ratio each, so that the sum needs no factorial of
/// all.
double logTail(long long heads, long long coins) {
  const auto n = static_cast<double>(coins);
  const auto k0 = static_cast<double>(heads);
  double term = std::lgamma(n + 1.0) - std::lgamma(k0 + 1.0) - std::lgamma(n - k0 + 1.0) - n * std::log(2.0);
  double sum = -std::numeric_limits<double>::infinity();
  for (long long k = heads; k <= coins; ++k) {
    sum = logSum(sum, term);
    if (term < sum - 50.0) break;  // what follows is less than the rounding
    term += std::log(static_cast<double>(coins - k)) - std::log(static_cast<double>(k + 1));
  }
  return sum;
}

}  // namespace

double logSignChance(long long larger, long long pairs) {
  const long long more = std::max(larger, pairs - larger);
  return std::min(0.0, std::log(2.0) + logTail(more, pairs));
}

long long fewestOf(long long pairs, double chance) {
  long long low = (pairs + 1) / 2, high = pairs + 1;
  while (low < high) {
    const long long middle = (low + high) / 2;
    if (logSignChance(middle, pairs) < std::log(chance))
      high = middle;
    else
      low = middle + 1;
  }
  return low;
}

bool SignTest::finds(double chance) const {
  return log_chance < std::log(chance);
}

SignTest signTest(std::vector<double> differences, double chance) {
  SignTest test;
  for (const double d : differences) {
    if (d == 0.0) continue;
    ++test.pairs;
    test.larger += d > 0.0 ? 1 : 0;
  }
  test.smallest_effect = std::numeric_limits<double>::infinity();
  if (differences.empty()) return test;
  test.log_chance = test.pairs > 0 ? logSignChance(test.larger, test.pairs) : 0.0;
  std::sort(differences.begin(), differences.end());
  const auto count = static_cast<long long>(differences.size());
  test.median = differences[static_cast<std::size_t>(count / 2)];
  // Shifted by the effect, so many of the differences about their median must be positive.
  const long long needed = fewestOf(count, chance);
  if (needed <= count)
    test.smallest_effect = std::max(0.0, test.median - differences[static_cast<std::size_t>(count - needed)]);
  return test;
}

}  // namespace carom::demos
