#pragma once
// Elements of an array are gone through by their places, which lie far apart in memory.

#include <algorithm>
#include <cstddef>
#include <span>

#include "engine/foundation/index.h"

namespace carom {

/// Asks for the first bytes of what is looked at soon, as many as tell most about it.
template <typename T>
void fetchAhead(const T& soon) {
  constexpr std::size_t kCacheLine = 64, kFetchedBytes = 256;
  const char* bytes = reinterpret_cast<const char*>(&soon);
  for (std::size_t line = 0; line < std::min(sizeof(T), kFetchedBytes); line += kCacheLine)
    __builtin_prefetch(bytes + line);
}

/// Calls look(i, all[places[i]]) for each i, in their order.
template <typename T, typename Look>
void visit(std::span<T> all, std::span<const int> places, const Look& look) {
  constexpr std::size_t kAhead = 6;  // as many as memory fetches at once
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (i + kAhead < places.size()) fetchAhead(all[at(places[i + kAhead])]);
    look(i, all[at(places[i])]);
  }
}

}  // namespace carom
