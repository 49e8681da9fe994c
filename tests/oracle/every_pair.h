#pragma once
// Candidate pairs by comparing everything with everything.

#include <vector>

#include "engine/broad_phase/candidate_pairs.h"

namespace carom::oracle {

inline bool meet(const Proxy& p, const Proxy& q) {
  if (!p.moves && !q.moves) return false;
  for (int axis = 0; axis < 3; ++axis)
    if (p.bounds.high[axis] < q.bounds.low[axis] || q.bounds.high[axis] < p.bounds.low[axis]) return false;
  return true;
}

/// Ascending.
inline std::vector<IndexPair> everyPair(const std::vector<Proxy>& proxies) {
  std::vector<IndexPair> pairs;
  for (std::size_t i = 0; i < proxies.size(); ++i)
    for (std::size_t j = i + 1; j < proxies.size(); ++j)
      if (meet(proxies[i], proxies[j])) pairs.push_back({static_cast<int>(i), static_cast<int>(j)});
  return pairs;
}

}  // namespace carom::oracle
