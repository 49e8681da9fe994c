#include "engine/broad_phase/pair_finder.h"

#include <algorithm>

#include "engine/foundation/index.h"

namespace carom {
namespace {

constexpr double kFatShare = 0.1;                  // of the smallest width, on every side of what moves
constexpr std::size_t kMostNear = 4 * kMostPairs;  // of fat bounds: eight bytes each

Bounds fattened(const Proxy& proxy) {
  if (!proxy.moves) return proxy.bounds;
  return widened(proxy.bounds, kFatShare * (proxy.bounds.high - proxy.bounds.low).minCoeff());
}

}  // namespace

void PairFinder::tellLeft(std::span<const Proxy> proxies, std::span<const int> active) {
  left_.clear();
  for (const int i : active) {
    LastCalls& last = last_[at(i)];
    const bool stays = last.active == call_ - 1 && tree_.bounds(i).contains(proxies[at(i)].bounds);
    last.active = call_;
    if (stays) continue;
    last.left = call_;
    left_.push_back(i);
  }
}

// To give all things other bounds costs no more than to put half of them elsewhere.
void PairFinder::fatten(std::span<const Proxy> proxies) {
  if (2 * left_.size() <= proxies.size()) {
    for (const int i : left_) tree_.move(i, fattened(proxies[at(i)]));
    return;
  }
  std::vector<Bounds> bounds;
  bounds.reserve(proxies.size());
  for (int i = 0; i < static_cast<int>(proxies.size()); ++i)
    bounds.push_back(isLeft(i) ? fattened(proxies[at(i)]) : tree_.bounds(i));
  tree_.moveAll(bounds);
}

void PairFinder::pairAnew(std::span<const Proxy> proxies) {
  std::erase_if(near_, [&](const IndexPair& pair) {
    return isLeft(pair.a) || isLeft(pair.b) || !(isActive(pair.a) || isActive(pair.b));
  });
  const auto known = static_cast<std::ptrdiff_t>(near_.size());
  for (const int i : left_) {
    tree_.find(tree_.bounds(i), found_);
    for (const int j : found_) {
      if (isLeft(j) && j <= i) continue;  // once
      if (!(proxies[at(i)].moves || proxies[at(j)].moves)) continue;
      if (near_.size() >= kMostNear) throw TooManyPairs();
      near_.push_back({std::min(i, j), std::max(i, j)});
    }
  }
  std::sort(near_.begin() + known, near_.end());
  std::inplace_merge(near_.begin(), near_.begin() + known, near_.end());
}

const std::vector<IndexPair>& PairFinder::find(std::span<const Proxy> proxies, std::span<const int> active) {
  if (last_.size() != proxies.size()) {
    last_.assign(proxies.size(), {});
    near_.clear();
  }
  ++call_;
  tellLeft(proxies, active);
  if (!left_.empty()) fatten(proxies);
  pairAnew(proxies);
  pairs_.clear();
  for (const IndexPair& pair : near_) {
    if (!canPair(proxies[at(pair.a)], proxies[at(pair.b)])) continue;
    if (pairs_.size() >= kMostPairs) throw TooManyPairs();
    pairs_.push_back(pair);
  }
  return pairs_;
}

void PairFinder::grow(int thing, const Bounds& bounds) {
  if (tree_.bounds(thing).contains(bounds)) return;
  tree_.grow(thing, bounds);
  last_[at(thing)].active = -1;  // paired anew by the next call: the fat bounds have grown
}

void PairFinder::findPartners(std::span<const Proxy> proxies, int thing, std::vector<int>& found) const {
  tree_.find(proxies[at(thing)].bounds, found);
  std::erase_if(found, [&](int j) { return j == thing || !canPair(proxies[at(thing)], proxies[at(j)]); });
  std::sort(found.begin(), found.end());
}

}  // namespace carom
