#include "engine/broad_phase/candidate_pairs.h"

#include <string>

namespace carom {
namespace {

Bounds aroundAll(std::span<const Bounds> all) {
  Bounds whole = all.front();
  for (const Bounds& bounds : all) whole = together(whole, bounds);
  return whole;
}

}  // namespace

TooManyPairs::TooManyPairs()
    : InputError("more than " + std::to_string(kMostPairs) +
                 " pairs of bodies overlap or come near each other within a step; accepted: fewer, slower or "
                 "farther apart bodies, or more steps a second") {}

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
