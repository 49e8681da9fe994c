#include "engine/broad_phase/pair_finder.h"

#include <algorithm>

#include "engine/foundation/index.h"

namespace carom {
namespace {

constexpr double kFatShare = 0.1;                  // of the smallest width, on every side of what moves
constexpr std::size_t kMostNear = 4 * kMostPairs;  // of fat bounds: eight bytes each

Proxy fattened(Proxy proxy) {
  if (!proxy.moves) return proxy;
  proxy.bounds = widened(proxy.bounds, kFatShare * (proxy.bounds.high - proxy.bounds.low).minCoeff());
  return proxy;
}

}  // namespace

bool PairFinder::hasLeft(const Proxy& proxy, int i) const {
  const Proxy& fat = fat_[at(i)];
  return proxy.group != fat.group || proxy.moves != fat.moves || !fat.bounds.contains(proxy.bounds);
}

// To give all things other bounds costs no more than to put half of them elsewhere.
void PairFinder::fatten(std::span<const Proxy> proxies) {
  for (const int i : left_) fat_[at(i)] = fattened(proxies[at(i)]);
  if (2 * left_.size() <= proxies.size()) {
    for (const int i : left_) tree_.move(i, fat_[at(i)].bounds, fat_[at(i)].group);
    return;
  }
  std::vector<Bounds> bounds;
  std::vector<int> groups;
  bounds.reserve(fat_.size());
  groups.reserve(fat_.size());
  for (const Proxy& fat : fat_) {
    bounds.push_back(fat.bounds);
    groups.push_back(fat.group);
  }
  tree_.moveAll(bounds, groups);
}

void PairFinder::pairAnew() {
  std::erase_if(near_, [&](const IndexPair& pair) {
    return isLeft(pair.a) || isLeft(pair.b) || !(isActive(pair.a) || isActive(pair.b));
  });
  const auto known = static_cast<std::ptrdiff_t>(near_.size());
  for (const int i : left_) {
    tree_.find(fat_[at(i)].bounds, found_, fat_[at(i)].group);
    for (const int j : found_) {
      if (isLeft(j) && j <= i) continue;  // once
      if (!canPair(fat_[at(i)], fat_[at(j)])) continue;
      if (near_.size() >= kMostNear) throw TooManyPairs();
      near_.push_back({std::min(i, j), std::max(i, j)});
    }
  }
  std::sort(near_.begin() + known, near_.end());
  std::inplace_merge(near_.begin(), near_.begin() + known, near_.end());
}

const std::vector<IndexPair>& PairFinder::find(std::span<const Proxy> proxies, std::span<const int> active) {
  if (fat_.size() != proxies.size()) {
    near_.clear();
    fat_.assign(proxies.begin(), proxies.end());
    active_in_.assign(proxies.size(), -1);
    left_in_.assign(proxies.size(), -1);
    round_ = 0;
  }
  ++round_;
  left_.clear();
  for (const int i : active) {
    const bool stays = active_in_[at(i)] == round_ - 1 && !hasLeft(proxies[at(i)], i);
    active_in_[at(i)] = round_;
    if (stays) continue;
    left_in_[at(i)] = round_;
    left_.push_back(i);
  }
  if (!left_.empty()) fatten(proxies);
  pairAnew();
  pairs_.clear();
  for (const IndexPair& pair : near_) {
    if (!canPair(proxies[at(pair.a)], proxies[at(pair.b)])) continue;
    if (pairs_.size() >= kMostPairs) throw TooManyPairs();
    pairs_.push_back(pair);
  }
  return pairs_;
}

void PairFinder::grow(int proxy, const Bounds& bounds) {
  if (tree_.bounds(proxy).contains(bounds)) return;
  tree_.grow(proxy, bounds);
  active_in_[at(proxy)] =
      -1;  // paired anew by the next call: its fat bounds are no longer what the tree holds
}

void PairFinder::findPartners(std::span<const Proxy> proxies, int proxy, std::vector<int>& found) const {
  const Proxy& mine = proxies[at(proxy)];
  tree_.find(mine.bounds, found, mine.group);
  std::erase_if(found, [&](int other) { return !canPair(mine, proxies[at(other)]); });
  std::sort(found.begin(), found.end());
}

}  // namespace carom
