#pragma once
// The worlds of the explorer: a seed makes one of some families, each a kind of situation that has gone wrong
// somewhere before. Sizes from 1e-3 to 100 m, speeds to 1e4 m/s, any gravity, rates 10 to 1000. Nothing
// overlaps at the start unless a family says so. Tested in tests/explore/random_world_test.cpp.

#include <cstdint>
#include <string>

#include "demos/scene/scene.h"

namespace carom::explore {

struct ExploredWorld {
  std::string family;
  demos::Scene scene;  ///< Its duration is that of the run.

  /// Told how long it goes on, at the rate that it has, and what it is.
  ExploredWorld& lasting(int steps) {
    scene.duration_s = steps / scene.rate_hz;
    scene.description = "explorer: " + family;
    return *this;
  }
};

/// Seeds from here on make worlds of moved, locked and concave bodies (moved_worlds.h).
inline constexpr std::uint64_t kMovedWorlds = 1'000'000'000;
/// And from here on of heaps that are driven (driven_heaps.h).
inline constexpr std::uint64_t kDrivenHeaps = 2'000'000'000;
/// And from here on of bodies that loads press together (loaded_worlds.h).
inline constexpr std::uint64_t kLoadedWorlds = 3'000'000'000;
/// And from here on of small bodies in coarse steps, or under a great weight (coarse_worlds.h).
inline constexpr std::uint64_t kCoarseWorlds = 4'000'000'000;
/// And from here on of chains and nets with a load (hanging_worlds.h).
inline constexpr std::uint64_t kHangingWorlds = 5'000'000'000;
/// And from here on of bodies over a floor without friction (ice_worlds.h).
inline constexpr std::uint64_t kIceWorlds = 6'000'000'000;

ExploredWorld randomWorld(std::uint64_t seed);

/// Steps of a run: the scene's duration at its rate.
int stepsOf(const demos::Scene& scene);

}  // namespace carom::explore
