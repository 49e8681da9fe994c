#include "demos/against/signed_rank.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <numeric>

namespace carom::demos {
namespace {

/// Twice the rank of each size, so that shared ranks are whole numbers too. No size may be zero.
std::vector<std::size_t> doubledRanks(const std::vector<double>& differences) {
  std::vector<std::size_t> order(differences.size()), ranks(differences.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto size = [&](std::size_t i) { return std::abs(differences[order[i]]); };
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::abs(differences[a]) < std::abs(differences[b]);
  });
  for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
    while (end < order.size() && size(end) == size(begin)) ++end;
    for (std::size_t i = begin; i < end; ++i) ranks[order[i]] = begin + end + 1;
  }
  return ranks;
}

/// at[s]: the chance that the ranks that fair coins pick add up to s or more.
std::vector<double> chancesOf(const std::vector<std::size_t>& ranks) {
  std::vector<double> at(1, 1.0);
  for (const std::size_t rank : ranks) {
    std::vector<double> longer(at.size() + rank, 0.0);
    for (std::size_t s = 0; s < at.size(); ++s) {
      longer[s] += 0.5 * at[s];
      longer[s + rank] += 0.5 * at[s];
    }
    at.swap(longer);
  }
  for (std::size_t s = at.size() - 1; s-- > 0;) at[s] += at[s + 1];
  return at;
}

/// The means of any two differences, of each with itself as well, from the largest on: as many are positive
/// as the ranks of the positive differences add up to (Tukey 1949).
std::vector<double> meansOfTwo(const std::vector<double>& differences) {
  std::vector<double> means;
  means.reserve(differences.size() * (differences.size() + 1) / 2);
  for (std::size_t i = 0; i < differences.size(); ++i)
    for (std::size_t j = i; j < differences.size(); ++j)
      means.push_back(0.5 * (differences[i] + differences[j]));
  std::sort(means.begin(), means.end(), std::greater<>());
  return means;
}

/// By how much differences must be moved from where they lie evenly about zero to be found.
double smallestEffect(const std::vector<double>& means, double shift, std::size_t count, double chance) {
  std::vector<std::size_t> ranks(count);
  for (std::size_t i = 0; i < count; ++i) ranks[i] = i + 1;
  const std::vector<double> at = chancesOf(ranks);
  std::size_t needed = 0;
  while (needed < at.size() && 2.0 * at[needed] >= chance) ++needed;
  if (needed == at.size()) return std::numeric_limits<double>::infinity();
  return std::max(0.0, shift - means[needed - 1]);
}

}  // namespace

bool SignedRankTest::finds(double chance) const {
  return log_chance < std::log(chance);
}

SignedRankTest signedRankTest(const std::vector<double>& differences, double chance) {
  SignedRankTest test;
  test.smallest_effect = std::numeric_limits<double>::infinity();
  if (differences.empty()) return test;
  const std::vector<double> means = meansOfTwo(differences);
  test.shift = 0.5 * (means[means.size() / 2] + means[(means.size() - 1) / 2]);
  test.smallest_effect = smallestEffect(means, test.shift, differences.size(), chance);

  std::vector<double> untied;
  std::copy_if(differences.begin(), differences.end(), std::back_inserter(untied),
               [](double d) { return d != 0.0; });
  const std::vector<std::size_t> ranks = doubledRanks(untied);
  std::size_t positive = 0, all = 0;
  for (std::size_t i = 0; i < untied.size(); ++i) {
    all += ranks[i];
    if (untied[i] > 0.0) positive += ranks[i];
  }
  const double more = chancesOf(ranks)[std::max(positive, all - positive)];
  test.log_chance = std::min(0.0, std::log(2.0 * more));
  return test;
}

}  // namespace carom::demos
