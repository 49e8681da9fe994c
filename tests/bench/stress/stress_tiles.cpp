// stress tiles: bodies of seven kinds glide over floors of ten thousand flush tiles of random sizes, at
// random speeds and rates, without friction and with it (tests/physics/tiled_floor.h).

#include <cstdio>
#include <mutex>

#include "tests/bench/stress/stress.h"
#include "tests/physics/tiled_floor.h"

namespace carom::bench {
namespace {

using physics::Glide;
using physics::Glider;
using physics::GlideResult;

constexpr double kBar = 1e-6;          // of the speed, and metres
constexpr double kDistanceBar = 1e-4;  // of v^2 / 2 mu g
constexpr double kLeastSliding = 2.0;  // m/s: slower, the step in which it stops shows in the distance
constexpr double kMostFriction = 0.8;
constexpr double kMostOfABox = 0.4;  // the narrowest (makeGlider) tips over where there is more

// What rolls, or may tip over its own legs, does not slide to a stop by the closed form.
bool slides(Glider glider) {
  return glider != Glider::kBall && glider != Glider::kRollingCapsule && glider != Glider::kStool;
}

Glide randomGlide(long number, std::uint64_t seed, bool rubbing) {
  oracle::Random random(seed * 1000003 + static_cast<std::uint64_t>(number));
  Glide glide;
  glide.seed = static_cast<std::uint64_t>(random.integer(1, 1 << 30));
  do glide.glider = static_cast<Glider>(random.integer(0, physics::kGliders - 1));
  while (rubbing && !slides(glide.glider));
  glide.size_m = random.uniform(0.3, 1.2);
  glide.rate_hz = random.logUniform(60.0, 1000.0);
  glide.speed_mps = random.logUniform(rubbing ? kLeastSliding : 0.2, 30.0);
  glide.seconds = 100.0 / glide.speed_mps;
  if (rubbing) {
    glide.friction = random.uniform(0.2, glide.glider == Glider::kBox ? kMostOfABox : kMostFriction);
    const double farthest = std::sqrt(2.0 * glide.friction * 9.81 * (glide.length_m - 4.0 * glide.size_m));
    glide.speed_mps = std::min(glide.speed_mps, farthest);
    glide.seconds = 1.2 * glide.speed_mps / (glide.friction * 9.81) + 1.0;
  }
  glide.seconds = std::min(glide.seconds, 20.0);
  return glide;
}

}  // namespace

bool runTiles(const TilesRun& run) {
  std::mutex mutex;
  long missed = 0, tiles = 0;
  double worst_speed = 0.0, worst_lift = 0.0, worst_distance = 0.0;
  shareOut(run.glides, run.threads, [&](int, long i) {
    const bool rubbing = i % 4 == 3;
    const Glide glide = randomGlide(run.first + i, run.seed, rubbing);
    const GlideResult result = physics::glideOverTiles(glide);
    const double off = rubbing ? std::abs(result.travelled_m / result.coulomb_m - 1.0) : 0.0;
    const double lost = rubbing ? 0.0 : std::max(std::abs(result.speed_lost), result.strayed);
    const double lift = rubbing ? 0.0 : result.lift_m;
    const std::lock_guard lock(mutex);
    tiles += result.tiles;
    worst_speed = std::max(worst_speed, lost);
    worst_lift = std::max(worst_lift, lift);
    worst_distance = std::max(worst_distance, off);
    if (lost <= kBar && lift <= kBar && off <= kDistanceBar) return;
    ++missed;
    std::printf(
        "  glide %ld: %s of %.2f m at %.2f m/s, %.0f Hz, friction %.2f: speed %.2g, lift %.2g m, distance "
        "%.2g\n",
        run.first + i, physics::gliderName(glide.glider), glide.size_m, glide.speed_mps, glide.rate_hz,
        glide.friction, lost, lift, off);
  });
  std::printf(
      "%ld glides over %ld tiles: speed lost or gained at most %.2g (bar %g), lift %.2g m (bar %g), "
      "stopping distance off by %.2g (bar %g); %ld outside  %s\n",
      run.glides, tiles, worst_speed, kBar, worst_lift, kBar, worst_distance, kDistanceBar, missed,
      missed == 0 ? "met" : "MISSED");
  return missed == 0;
}

}  // namespace carom::bench
