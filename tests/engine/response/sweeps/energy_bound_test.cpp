// Whatever impulses rows have, within their cones and beyond what is right for them: after `takeBackGain`
// they have given no energy. What has converged, and what only takes energy, stays as it is.

#include "engine/response/sweeps/energy_bound.h"

#include <gtest/gtest.h>

#include "engine/response/sweeps/turning_resistance.h"
#include "tests/engine/response/sweeps/random_contact.h"

namespace carom {
namespace {

using oracle::Random;

double energyOf(std::span<const ImpulseBody> bodies) {
  double sum = 0.0;
  for (const ImpulseBody& body : bodies) sum += kineticEnergy(body);
  return sum;
}

Meeting meetingAt(Random& random) {
  return randomMeeting(random, random.integer(1, 4), random.uniform(0.0, 1.0), random.logUniform(1e-3, 1e3));
}

TEST(TakeBackGain, LeavesNoEnergyFromNothing) {
  Random random(311);
  int gained = 0;
  for (int i = 0; i < 2000; ++i) {
    Meeting m = meetingAt(random);
    const double before = energyOf(m.bodies);
    const double size = random.logUniform(1e-3, 1e3);
    for (ContactRow& row : m.rows) {
      row.lowest_speed = -random.uniform(0.0, 1.0);
      row.impulse = size * Vec3(1.0, 0.0, 0.0);
      row.impulse.tail<2>() = row.coefficient * size * random.direction().head<2>();
      applyLoad(row, m.bodies);
    }
    gained += energyOf(m.bodies) > before;
    takeBackGain(m.rows, m.bodies);
    EXPECT_LE(energyOf(m.bodies), before * (1.0 + 1e-12)) << i;
    for (const ContactRow& row : m.rows) EXPECT_TRUE(isInCone(row, row.impulse * (1.0 - 1e-12))) << i;
  }
  EXPECT_GT(gained, 500);
}

TEST(TakeBackGain, TakesWhatItLeavesOutFromTheBodiesToo) {
  Random random(312);
  for (int i = 0; i < 200; ++i) {
    Meeting m = meetingAt(random);
    const std::vector<ImpulseBody> before = m.bodies;
    for (ContactRow& row : m.rows) {
      row.impulse = Vec3(random.logUniform(1e-2, 1e4), 0.0, 0.0);
      applyLoad(row, m.bodies);
    }
    takeBackGain(m.rows, m.bodies);
    std::vector<ImpulseBody> again = before;
    for (const ContactRow& row : m.rows) applyLoad(row, again);
    for (std::size_t k = 0; k < again.size(); ++k)
      EXPECT_NEAR(kineticEnergy(again[k]), kineticEnergy(m.bodies[k]), 1e-9 * (1e-6 + energyOf(before)));
  }
}

TEST(TakeBackGain, LeavesWhatHasConvergedAsItIs) {
  Random random(313);
  for (int i = 0; i < 200; ++i) {
    Meeting m = meetingAt(random);
    solveContacts(m.rows, m.bodies, {.sweeps = 100000, .residual_mps = 1e-14});
    const Meeting before = m;
    takeBackGain(m.rows, m.bodies);
    for (std::size_t k = 0; k < m.rows.size(); ++k)
      EXPECT_LT((m.rows[k].impulse - before.rows[k].impulse).norm(),
                1e-9 * (1e-12 + before.rows[k].impulse.norm()));
  }
}

}  // namespace
}  // namespace carom
