// stress landings: thin boxes of random aspect and attitude land on a floor without restitution. No step may
// end with more energy than it began with; the figure is the gain over the energy of the blow.

#include <cstdio>
#include <mutex>

#include "tests/bench/stress/stress.h"
#include "tests/oracle/test_shapes.h"

namespace carom::bench {
namespace {

constexpr double kBar = 0.1;  // of the blow's energy, in any step

struct Landing {
  double aspect = 1.0;
  double gain = 0.0;  // the largest of a step
};

double energyOf(const World& world) {
  const Audit now = world.audit();
  return now.kinetic_energy_J + now.potential_energy_J;
}

Landing land(std::uint64_t seed, double largest_aspect) {
  oracle::Random random(seed);
  Landing landing;
  landing.aspect = random.logUniform(1.0, largest_aspect);
  const double friction = random.uniform(0.0, 1.0);
  const Material material{friction, friction, 0.0, 1000.0};
  const double rate = random.uniform(0.0, 1.0) < 0.5 ? 60.0 : 240.0;
  World world(WorldSettings{1.0 / rate, Vec3(0.0, 0.0, -9.81)});
  const double width = 0.3 * random.uniform(0.5, 1.0) / landing.aspect;
  const double thickness = width * random.uniform(0.3, 1.0);
  const int floor = world.addSolid(Solid::box({20.0, 20.0, 1.0}));
  Solid box = Solid::box({0.3, width, thickness});
  const double height = box.radius() + 0.01;
  const int solid = world.addSolid(std::move(box));
  world.addBody({floor, {Quat::Identity(), Vec3(0, 0, -0.5)}, Vec3::Zero(), Vec3::Zero(), material, true});
  Vec3 velocity = Vec3(0.0, 0.0, -5.0);
  velocity.x() = random.uniform(-3.0, 3.0);
  const Vec3 spin = random.uniform(0.0, 5.0) * random.direction();
  const Quat attitude = random.rotation();
  world.addBody({solid, {attitude, Vec3(0, 0, height)}, velocity, spin, material, false});
  if (!world.start().empty()) return landing;
  const double blow = world.audit().kinetic_energy_J;
  double before = energyOf(world);
  for (int i = 0; i < static_cast<int>(rate); ++i) {
    world.step();
    const double now = energyOf(world);
    landing.gain = std::max(landing.gain, (now - before) / blow);
    before = now;
  }
  return landing;
}

}  // namespace

bool runLandings(const LandingsRun& run) {
  std::mutex mutex;
  long missed = 0, above_thousandth = 0;
  double worst = 0.0;
  shareOut(run.landings, run.threads, [&](int, long i) {
    const std::uint64_t seed = run.seed * 1000003 + static_cast<std::uint64_t>(run.first + i);
    const Landing landing = land(seed, run.largest_aspect);
    const std::lock_guard lock(mutex);
    worst = std::max(worst, landing.gain);
    above_thousandth += landing.gain > 1e-3;
    if (landing.gain <= kBar) return;
    ++missed;
    std::printf("  landing %ld: aspect %.1f gains %.3g of the blow's energy in a step\n", run.first + i,
                landing.aspect, landing.gain);
  });
  std::printf(
      "%ld landings of aspects to %g: the largest gain of a step %.2g of the blow's energy; %ld above 0.001, "
      "%ld above %g (bar 0)  %s\n",
      run.landings, run.largest_aspect, worst, above_thousandth, missed, kBar,
      missed == 0 ? "met" : "MISSED");
  return missed == 0;
}

}  // namespace carom::bench
