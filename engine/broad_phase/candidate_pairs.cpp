#include "engine/broad_phase/candidate_pairs.h"

#include <algorithm>
#include <numeric>

namespace carom {
namespace {

// The axis along which the proxies' centres are spread most: it separates best.
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

}  // namespace

bool canPair(const Proxy& p, const Proxy& q) {
  return p.group != q.group && (p.moves || q.moves) && p.bounds.overlaps(q.bounds);
}

std::vector<IndexPair> candidatePairs(std::span<const Proxy> proxies) {
  const Eigen::Index axis = sweepAxis(proxies);
  const auto low = [&](int i) { return proxies[static_cast<std::size_t>(i)].bounds.low[axis]; };
  const auto high = [&](int i) { return proxies[static_cast<std::size_t>(i)].bounds.high[axis]; };
  std::vector<int> order(proxies.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](int i, int j) { return low(i) < low(j) || (low(i) == low(j) && i < j); });

  std::vector<IndexPair> pairs;
  std::vector<int> open;  // those whose interval on the axis has begun and not ended
  for (int i : order) {
    std::erase_if(open, [&](int j) { return high(j) < low(i); });
    for (int j : open)
      if (canPair(proxies[static_cast<std::size_t>(i)], proxies[static_cast<std::size_t>(j)]))
        pairs.push_back({std::min(i, j), std::max(i, j)});
    open.push_back(i);
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace carom
