#include "engine/broad_phase/candidate_pairs.h"

#include <algorithm>
#include <numeric>
#include <string>

namespace carom {
namespace {

constexpr double kRoom = 0.1;                      // of the smallest width, on every side of what moves
constexpr std::size_t kMostNear = 4 * kMostPairs;  // with room: eight bytes each
constexpr std::size_t kFewIn = 50;  // one in so many, or fewer, are paired anew with each of the others

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

Proxy withRoom(Proxy proxy) {
  if (!proxy.moves) return proxy;
  proxy.bounds = widened(proxy.bounds, kRoom * (proxy.bounds.high - proxy.bounds.low).minCoeff());
  return proxy;
}

bool hasLeft(const Proxy& proxy, const Proxy& roomy) {
  return proxy.group != roomy.group || proxy.moves != roomy.moves || !roomy.bounds.contains(proxy.bounds);
}

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
    const double low_i = proxies[static_cast<std::size_t>(i)].bounds.low[axis];
    const double low_j = proxies[static_cast<std::size_t>(j)].bounds.low[axis];
    return low_i < low_j || (low_i == low_j && i < j);
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

void PairFinder::startAgain(std::span<const Proxy> proxies) {
  roomy_.clear();
  for (const Proxy& proxy : proxies) roomy_.push_back(withRoom(proxy));
  near_ = candidatePairs(roomy_, kMostNear);
}

void PairFinder::pairAnew(std::span<const Proxy> proxies, std::span<const std::size_t> left) {
  std::vector<char> is_new(proxies.size(), 0);
  for (const std::size_t i : left) {
    roomy_[i] = withRoom(proxies[i]);
    is_new[i] = 1;
  }
  const auto isNew = [&](int i) { return is_new[static_cast<std::size_t>(i)] != 0; };
  std::erase_if(near_, [&](const IndexPair& pair) { return isNew(pair.a) || isNew(pair.b); });
  const auto known = static_cast<std::ptrdiff_t>(near_.size());
  for (const std::size_t i : left)
    for (std::size_t j = 0; j < roomy_.size(); ++j) {
      const bool once = is_new[j] == 0 || i < j;
      if (once && canPair(roomy_[i], roomy_[j]))
        add(near_, {static_cast<int>(std::min(i, j)), static_cast<int>(std::max(i, j))}, kMostNear);
    }
  std::sort(near_.begin() + known, near_.end());
  std::inplace_merge(near_.begin(), near_.begin() + known, near_.end());
}

std::vector<IndexPair> PairFinder::find(std::span<const Proxy> proxies) {
  std::vector<std::size_t> left;
  const bool known = roomy_.size() == proxies.size();
  for (std::size_t i = 0; known && i < proxies.size(); ++i)
    if (hasLeft(proxies[i], roomy_[i])) left.push_back(i);
  if (!known || left.size() > proxies.size() / kFewIn)
    startAgain(proxies);
  else if (!left.empty())
    pairAnew(proxies, left);
  std::vector<IndexPair> pairs;
  for (const IndexPair& pair : near_)
    if (canPair(proxies[static_cast<std::size_t>(pair.a)], proxies[static_cast<std::size_t>(pair.b)]))
      add(pairs, pair, kMostPairs);
  return pairs;
}

}  // namespace carom
