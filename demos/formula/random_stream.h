#pragma once
// Chance in scene files: SplitMix64 (Steele, Lea, Flood 2014), whose numbers are the same on every machine.
// Tested in tests/demos/language/scene_expansion_test.cpp.

#include <cstdint>

#include "engine/foundation/frames.h"

namespace carom::demos {

class RandomStream {
 public:
  explicit RandomStream(std::uint64_t state) : state_(state) { next(); }
  /// Uniform in [-1, 1), a multiple of 2^-52: no rounding.
  double signedUnit() { return static_cast<double>(next() >> 11) * 0x1p-52 - 1.0; }
  /// A direction, uniform on the sphere: the first of a bounded number of points of the cube that lies in the
  /// ball.
  Vec3 direction() {
    for (int i = 0; i < 64; ++i) {
      const Vec3 p = vector();
      if (p.squaredNorm() < 1.0 && p.squaredNorm() > 1e-4) return p.normalized();
    }
    return Vec3::UnitZ();
  }
  /// In the cube [-1, 1)^3.
  Vec3 vector() {
    const double x = signedUnit();
    const double y = signedUnit();
    return {x, y, signedUnit()};
  }

 private:
  std::uint64_t next() {
    state_ += 0x9e3779b97f4a7c15ull;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    return z ^ (z >> 31);
  }
  std::uint64_t state_;
};

}  // namespace carom::demos
