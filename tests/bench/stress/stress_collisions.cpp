// stress collisions: random collisions of two boxes at one to four points, with every friction, restitution
// and mass ratio: is energy found, momentum lost, or a struck point left approaching?

#include <algorithm>

#include "engine/response/collision.h"
#include "tests/bench/stress/stress.h"
#include "tests/engine/response/sweeps/random_contact.h"

namespace carom::bench {
namespace {

constexpr long kBlock = 1000;

struct Worst {
  double gain = -1.0;       ///< Of kinetic energy, relative to that before.
  double momentum = 0.0;    ///< Linear and angular, relative to the sum of both bodies'.
  double approach = 0.0;    ///< After the collision at one point, relative to that before.
  double approaches = 0.0;  ///< The same at several points.

  void join(const Worst& other) {
    gain = std::max(gain, other.gain);
    momentum = std::max(momentum, other.momentum);
    approach = std::max(approach, other.approach);
    approaches = std::max(approaches, other.approaches);
  }
};

double deepestApproach(const Meeting& m) {
  double approach = 0.0;
  for (const ContactRow& row : m.rows) approach = std::max(approach, -rowVelocity(row, m.bodies).x());
  return approach;
}

void collideOnce(oracle::Random& random, Worst& worst) {
  const int points = random.integer(0, 1) == 0 ? 1 : random.integer(2, 4);
  Meeting m = randomMeeting(random, points, random.uniform(0, 2), random.logUniform(1e-6, 1e6));
  const double e = random.integer(0, 3) == 0 ? 1.0 : random.uniform(0, 1);
  const ImpulseBody &a = m.bodies[0], &b = m.bodies[1];
  const double energy = kineticEnergy(a) + kineticEnergy(b), approach = deepestApproach(m);
  const Vec3 p = linearMomentum(a) + linearMomentum(b), L = angularMomentum(a) + angularMomentum(b);
  const double scale = linearMomentum(a).norm() + linearMomentum(b).norm();
  collide(m.rows, m.bodies, std::vector<double>(m.rows.size(), e));
  worst.gain = std::max(worst.gain, (kineticEnergy(a) + kineticEnergy(b)) / energy - 1.0);
  worst.momentum = std::max({worst.momentum, (linearMomentum(a) + linearMomentum(b) - p).norm() / scale,
                             (angularMomentum(a) + angularMomentum(b) - L).norm() / scale});
  if (approach == 0.0) return;
  double& left = points == 1 ? worst.approach : worst.approaches;
  left = std::max(left, deepestApproach(m) / approach);
}

bool tell(const char* what, double figure, double bar) {
  std::printf("  %-44s %9.2g  (bar %g)  %s\n", what, figure, bar, figure <= bar ? "met" : "MISSED");
  return figure <= bar;
}

}  // namespace

bool runCollisions(const CollisionRun& run) {
  std::vector<Worst> of_thread(static_cast<std::size_t>(run.threads));
  const long blocks = (run.collisions + kBlock - 1) / kBlock;
  shareOut(blocks, run.threads, [&](int thread, long block) {
    oracle::Random random(run.seed + 1'000'003 * static_cast<std::uint64_t>(block));
    for (long i = 0; i < kBlock; ++i) collideOnce(random, of_thread[static_cast<std::size_t>(thread)]);
  });
  Worst worst;
  for (const Worst& w : of_thread) worst.join(w);
  std::printf("%ld collisions, e in [0, 1], mu in [0, 2], mass ratios 1e-6 to 1e6; worst of all:\n",
              blocks * kBlock);
  bool met = tell("growth of kinetic energy", worst.gain, 1e-12);
  met &= tell("change of momentum", worst.momentum, 1e-12);
  met &= tell("approach left at one point", worst.approach, 1e-12);
  met &= tell("approach left at several points", worst.approaches, 1e-9);
  return met;
}

}  // namespace carom::bench
