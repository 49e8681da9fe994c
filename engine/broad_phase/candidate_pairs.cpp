#include "engine/broad_phase/candidate_pairs.h"

#include <algorithm>
#include <numeric>
#include <string>

namespace carom {

Eigen::Index sweepAxis(std::span<const Proxy> proxies) {
  Vec3 sum = Vec3::Zero();
  Vec3 squares = Vec3::Zero();
  for (const Proxy& p : proxies) {
    const Vec3 c = 0.5 * (p.bounds.low + p.bounds.high);
    sum += c;
    squares += c.cwiseProduct(c);
  }
  const Vec3 spread =
      squares - sum.cwiseProduct(sum) / static_cast<double>(std::max<std::size_t>(proxies.size(), 1));
  Eigen::Index axis = 0;
  spread.maxCoeff(&axis);
  return axis;
}

namespace {

void add(std::vector<IndexPair>& pairs, const IndexPair& pair, std::size_t most) {
  if (pairs.size() >= most) throw TooManyPairs();
  pairs.push_back(pair);
}

}  // namespace

TooManyPairs::TooManyPairs()
    : InputError("more than " + std::to_string(kMostPairs) +
                 " pairs of bodies overlap or come near each other within a step; accepted: fewer, slower or "
                 "farther apart bodies, or more steps a second") {}

std::vector<IndexPair> candidatePairs(std::span<const Proxy> proxies, std::size_t most) {
  const Eigen::Index axis = sweepAxis(proxies);
  std::vector<int> order(proxies.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int i, int j) {
    return proxies[static_cast<std::size_t>(i)].bounds.low[axis] <
           proxies[static_cast<std::size_t>(j)].bounds.low[axis];
  });
  std::vector<Proxy> sorted;  // side by side, as the sweep meets them
  sorted.reserve(order.size());
  for (int i : order) sorted.push_back(proxies[static_cast<std::size_t>(i)]);

  std::vector<IndexPair> pairs;
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    const double end = sorted[i].bounds.high[axis];
    for (std::size_t j = i + 1; j < sorted.size() && sorted[j].bounds.low[axis] <= end; ++j)
      if (canPair(sorted[i], sorted[j]))
        add(pairs, {std::min(order[i], order[j]), std::max(order[i], order[j])}, most);
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

namespace {

Bounds aroundAll(std::span<const Bounds> all) {
  Bounds whole = all.front();
  for (const Bounds& bounds : all) whole = {whole.low.cwiseMin(bounds.low), whole.high.cwiseMax(bounds.high)};
  return whole;
}

}  // namespace

void overlapsBetween(std::span<const Bounds> a, std::span<const Bounds> b, std::size_t most,
                     std::vector<IndexPair>& found) {
  found.clear();
  if (a.empty() || b.empty()) return;
  const Bounds whole_a = aroundAll(a), whole_b = aroundAll(b);
  std::vector<int> reaching;
  for (std::size_t j = 0; j < b.size(); ++j)
    if (b[j].overlaps(whole_a)) reaching.push_back(static_cast<int>(j));
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!a[i].overlaps(whole_b)) continue;
    for (const int j : reaching) {
      if (!a[i].overlaps(b[static_cast<std::size_t>(j)])) continue;
      if (found.size() == most) return;
      found.push_back({static_cast<int>(i), j});
    }
  }
}

}  // namespace carom
