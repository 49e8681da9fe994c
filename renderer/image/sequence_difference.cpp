#include "renderer/image/sequence_difference.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <utility>

#include "engine/foundation/contract.h"

namespace carom::renderer {
namespace {

constexpr std::size_t kNone = ~std::size_t{0};

// FNV-1a by words, in two lanes that do not wait for each other; equal hashes are compared anyway.
std::uint64_t hashOf(const std::byte* value, std::size_t size) {
  constexpr std::uint64_t kPrime = 1099511628211u;
  std::array<std::uint64_t, 2> lanes{14695981039346656037u, 0xcbf29ce4u};
  for (std::size_t i = 0; i < size; i += sizeof(lanes)) {
    std::array<std::uint64_t, 2> words{};
    std::memcpy(&words, value + i, std::min(sizeof(words), size - i));
    for (std::size_t k = 0; k < 2; ++k) {
      lanes[k] = (lanes[k] ^ words[k]) * kPrime;
      lanes[k] ^= lanes[k] >> 32;
    }
  }
  return (lanes[0] * kPrime) ^ lanes[1];
}

// For each of `now` its equal in `before`, no two the same.
std::vector<std::size_t> partners(std::span<const std::byte> before, std::span<const std::byte> now,
                                  std::size_t size) {
  std::vector<std::pair<std::uint64_t, std::size_t>> by_hash;
  for (std::size_t i = 0; i < before.size() / size; ++i)
    by_hash.emplace_back(hashOf(before.data() + i * size, size), i);
  std::sort(by_hash.begin(), by_hash.end());
  std::vector<std::size_t> used(by_hash.size());  // Of the values of one hash, where those begin.
  std::vector<std::size_t> partner(now.size() / size, kNone);
  for (std::size_t i = 0; i < partner.size(); ++i) {
    const std::uint64_t hash = hashOf(now.data() + i * size, size);
    const auto first = std::lower_bound(by_hash.begin(), by_hash.end(), std::pair(hash, std::size_t{0}));
    const auto begin = static_cast<std::size_t>(first - by_hash.begin());
    if (begin == by_hash.size()) continue;
    const std::size_t next = begin + used[begin];
    if (next == by_hash.size() || by_hash[next].first != hash) continue;
    if (std::memcmp(before.data() + by_hash[next].second * size, now.data() + i * size, size) != 0) continue;
    ++used[begin];
    partner[i] = by_hash[next].second;
  }
  return partner;
}

// Leaves a longest ascending part of `partner`; the others lose theirs. Patience sorting: `piles` holds, by
// length, the place with the least partner that ends an ascending part of that length.
void keepAscending(std::vector<std::size_t>& partner) {
  std::vector<std::size_t> piles, previous(partner.size(), kNone);
  for (std::size_t i = 0; i < partner.size(); ++i) {
    if (partner[i] == kNone) continue;
    const auto at = std::lower_bound(piles.begin(), piles.end(), partner[i],
                                     [&](std::size_t k, std::size_t p) { return partner[k] < p; });
    if (at != piles.begin()) previous[i] = *(at - 1);
    if (at == piles.end())
      piles.push_back(i);
    else
      *at = i;
  }
  std::vector<std::size_t> kept(partner.size(), kNone);
  for (std::size_t i = piles.empty() ? kNone : piles.back(); i != kNone; i = previous[i])
    kept[i] = partner[i];
  partner.swap(kept);
}

}  // namespace

SequenceDifference differenceOfBytes(std::span<const std::byte> before, std::span<const std::byte> now,
                                     std::size_t size, Order order) {
  REQUIRE(size > 0 && before.size() % size == 0 && now.size() % size == 0, size, before.size(), now.size());
  SequenceDifference difference;
  if (before.size() == now.size() && (now.empty() || std::memcmp(before.data(), now.data(), now.size()) == 0))
    return difference;
  std::vector<std::size_t> partner = partners(before, now, size);
  if (order == Order::kMatters) keepAscending(partner);
  std::vector<std::uint8_t> stayed(before.size() / size);
  for (std::size_t i = 0; i < partner.size(); ++i) {
    if (partner[i] == kNone)
      difference.come.push_back(i);
    else
      stayed[partner[i]] = 1;
  }
  for (std::size_t i = 0; i < stayed.size(); ++i)
    if (stayed[i] == 0) difference.gone.push_back(i);
  return difference;
}

}  // namespace carom::renderer
