#pragma once
// A hash over the bits of the state: equal states, equal hash, on any machine of one byte order.
// Tested in tests/engine/simulation/bodies/state_hash_test.cpp.

#include <bit>
#include <cstdint>

#include "engine/foundation/frames.h"

namespace carom {

/// FNV-1a, 64 bit, fed with the bits of numbers.
class StateHash {
 public:
  void add(std::uint64_t bits) {
    for (int i = 0; i < 8; ++i) {
      hash_ ^= (bits >> (8 * i)) & 0xff;
      hash_ *= 0x100000001b3ull;
    }
  }
  void add(double x) { add(std::bit_cast<std::uint64_t>(x + 0.0)); }  // -0 and +0 are one state
  void add(const Vec3& v) {
    for (double x : v) add(x);
  }
  void add(const Quat& q) {
    add(q.w());
    add(Vec3(q.vec()));
  }
  std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325ull;
};

}  // namespace carom
