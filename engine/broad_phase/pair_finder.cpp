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

void PairFinder::startAgain(std::span<const Proxy> proxies) {
  first_.clear();
  for (int i = 0; i < static_cast<int>(proxies.size()); ++i)
    if (first_.empty() || proxies[at(i)].group != proxies[at(i) - 1].group) first_.push_back(i);
  const std::size_t groups = first_.size();
  first_.push_back(static_cast<int>(proxies.size()));
  near_.clear();
  whole_.clear();
  for (int group = 0; group < static_cast<int>(groups); ++group) whole_.push_back(wholeOf(proxies, group));
  fat_ = whole_;
  active_in_.assign(groups, -1);
  left_in_.assign(groups, -1);
  round_ = 0;
}

Proxy PairFinder::wholeOf(std::span<const Proxy> proxies, int group) const {
  Proxy whole = proxies[at(begin(group))];
  whole.group = group;
  for (const Proxy& proxy : proxies.subspan(at(begin(group)) + 1, at(end(group) - begin(group)) - 1)) {
    whole.bounds = {whole.bounds.low.cwiseMin(proxy.bounds.low),
                    whole.bounds.high.cwiseMax(proxy.bounds.high)};
    whole.moves = whole.moves || proxy.moves;
  }
  return whole;
}

bool PairFinder::hasLeft(int group) const {
  const Proxy &whole = whole_[at(group)], &fat = fat_[at(group)];
  return whole.moves != fat.moves || !fat.bounds.contains(whole.bounds);
}

// To give all groups other bounds costs no more than to put half of them elsewhere.
void PairFinder::fatten() {
  for (const int i : left_) fat_[at(i)] = fattened(whole_[at(i)]);
  if (2 * left_.size() <= fat_.size()) {
    for (const int i : left_) tree_.move(i, fat_[at(i)].bounds);
    return;
  }
  std::vector<Bounds> bounds;
  bounds.reserve(fat_.size());
  for (const Proxy& fat : fat_) bounds.push_back(fat.bounds);
  tree_.moveAll(bounds);
}

void PairFinder::pairAnew() {
  std::erase_if(near_, [&](const IndexPair& pair) {
    return isLeft(pair.a) || isLeft(pair.b) || !(isActive(pair.a) || isActive(pair.b));
  });
  const auto known = static_cast<std::ptrdiff_t>(near_.size());
  for (const int i : left_) {
    tree_.find(fat_[at(i)].bounds, found_);
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

void PairFinder::add(int a, int b) {
  if (pairs_.size() >= kMostPairs) throw TooManyPairs();
  pairs_.push_back({a, b});
}

// Of groups that are near one, the first of each: the pairs of their proxies, ascending.
void PairFinder::addPairsOf(std::span<const IndexPair> near, std::span<const Proxy> proxies) {
  const int group = near.front().a;
  reaching_.clear();
  ends_.clear();
  for (const IndexPair& pair : near) {
    if (canPair(whole_[at(group)], whole_[at(pair.b)]))
      for (int j = begin(pair.b); j < end(pair.b); ++j)
        if (isSingle(pair.b) || canPair(whole_[at(group)], proxies[at(j)])) reaching_.push_back(j);
    ends_.push_back(reaching_.size());
  }
  if (reaching_.empty()) return;
  for (int i = begin(group); i < end(group); ++i) {
    const Proxy& proxy = proxies[at(i)];
    for (std::size_t k = 0; k < near.size(); ++k) {
      const std::size_t from = k == 0 ? 0 : ends_[k - 1];
      if (from == ends_[k] || !(isSingle(group) || canPair(proxy, whole_[at(near[k].b)]))) continue;
      for (std::size_t j = from; j < ends_[k]; ++j)
        if (canPair(proxy, proxies[at(reaching_[j])])) add(i, reaching_[j]);
    }
  }
}

const std::vector<IndexPair>& PairFinder::find(std::span<const Proxy> proxies, std::span<const int> active) {
  if (first_.empty() || at(first_.back()) != proxies.size()) startAgain(proxies);
  ++round_;
  left_.clear();
  for (const int i : active) {
    whole_[at(i)] = wholeOf(proxies, i);
    const bool stays = active_in_[at(i)] == round_ - 1 && !hasLeft(i);
    active_in_[at(i)] = round_;
    if (stays) continue;
    left_in_[at(i)] = round_;
    left_.push_back(i);
  }
  if (!left_.empty()) fatten();
  pairAnew();
  pairs_.clear();
  for (std::size_t i = 0, next = 0; i < near_.size(); i = next) {
    while (next < near_.size() && near_[next].a == near_[i].a) ++next;
    addPairsOf(std::span<const IndexPair>(near_).subspan(i, next - i), proxies);
  }
  return pairs_;
}

void PairFinder::grow(int group, const Bounds& bounds) {
  Bounds& whole = whole_[at(group)].bounds;
  whole = {whole.low.cwiseMin(bounds.low), whole.high.cwiseMax(bounds.high)};
  if (tree_.bounds(group).contains(bounds)) return;
  tree_.grow(group, bounds);
  // Paired anew by the next call: its fat bounds are no longer what the tree holds.
  active_in_[at(group)] = -1;
}

void PairFinder::findPartners(std::span<const Proxy> proxies, std::span<const int> some,
                              std::vector<IndexPair>& found) {
  found.clear();
  if (some.empty()) return;
  tree_.find(whole_[at(proxies[at(some.front())].group)].bounds, found_);
  for (const int i : some) {
    const Proxy& mine = proxies[at(i)];
    const auto first = static_cast<std::ptrdiff_t>(found.size());
    for (const int group : found_) {
      if (!canPair(mine, whole_[at(group)])) continue;
      for (int j = begin(group); j < end(group); ++j)
        if (canPair(mine, proxies[at(j)])) found.push_back({i, j});
    }
    std::sort(found.begin() + first, found.end());
  }
}

}  // namespace carom
