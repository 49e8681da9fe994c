// Whatever impulses rows have, within their cones and beyond what is right for them: after `takeBackGain`,
// and `takeBackWork` where other forces act too, they have given no energy. What has converged, and what only
// takes energy, stays as it is.

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

// Within their cones.
void giveAnyImpulses(Random& random, Meeting& m) {
  const double size = random.logUniform(1e-3, 1e3);
  for (ContactRow& row : m.rows) {
    row.lowest_speed = -random.uniform(0.0, 1.0);
    row.impulse = size * Vec3(1.0, 0.0, 0.0);
    row.impulse.tail<2>() = row.coefficient * size * random.direction().head<2>();
    applyLoad(row, m.bodies);
  }
}

TEST(TakeBackGain, LeavesNoEnergyFromNothing) {
  Random random(311);
  int gained = 0;
  for (int i = 0; i < 2000; ++i) {
    Meeting m = meetingAt(random);
    const double before = energyOf(m.bodies);
    giveAnyImpulses(random, m);
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

// What contacts give is what the bodies' energy grows by beyond the work of the other forces, and that is the
// momentum which these give on the mean of the velocities.
TEST(TakeBackWork, LeavesContactsNoWorkOverAStepInWhichOtherForcesAct) {
  Random random(314);
  int gave = 0, passed_the_other = 0;
  for (int i = 0; i < 2000; ++i) {
    Meeting m = meetingAt(random);
    std::vector<Velocity> before;
    std::vector<Vec3> gained;
    double energy = 0.0, scale = 0.0;
    const auto workOfOthers = [&] {
      double work = 0.0;
      for (std::size_t k = 0; k < m.bodies.size(); ++k)
        if (m.bodies[k].inverse_mass > 0.0)
          work +=
              0.5 * gained[k].dot(before[k].linear + m.bodies[k].velocity.linear) / m.bodies[k].inverse_mass;
      return work;
    };
    const double slow = random.logUniform(1e-3, 1.0);
    for (ImpulseBody& body : m.bodies) {
      body.velocity.linear *= slow;
      body.velocity.angular *= slow;
      before.push_back(body.velocity);
      gained.push_back(random.logUniform(1e-3, 10.0) * random.direction());
      energy += kineticEnergy(body);
      if (body.inverse_mass > 0.0) body.velocity.linear += gained.back();
      scale += kineticEnergy(body);
    }
    if (i % 2 == 0) {  // what would hold them, and up to that again
      solveContacts(m.rows, m.bodies, {.sweeps = 1000, .residual_mps = 1e-12});
      const double more = random.uniform(0.0, 1.0);
      for (ContactRow& row : m.rows) {
        applyToRow(row, more * row.impulse, m.bodies);
        row.impulse *= 1.0 + more;
      }
    } else {
      giveAnyImpulses(random, m);
    }
    scale += energyOf(m.bodies);
    const bool gives = energyOf(m.bodies) - energy - workOfOthers() > 0.0;
    gave += gives;
    Meeting other = m;
    takeBackGain(other.rows, other.bodies);
    passed_the_other += gives && other.rows[0].impulse == m.rows[0].impulse;
    const Meeting given = m;
    takeBackWork(m.rows, m.bodies, before);
    EXPECT_LE(energyOf(m.bodies) - energy - workOfOthers(), 1e-12 * (energy + scale)) << i;
    EXPECT_TRUE(gives || m.rows[0].impulse == given.rows[0].impulse) << i;
  }
  EXPECT_GT(gave, 500);
  EXPECT_GT(passed_the_other, 50) << "a bound that counts the others' speed as lost lets them give";
}

TEST(TakeBackWork, LeavesTheWorkThatBoundsAboveZeroAskFor) {
  Random random(315);
  for (int i = 0; i < 200; ++i) {
    Meeting m = meetingAt(random);
    std::vector<Velocity> before;
    for (const ImpulseBody& body : m.bodies) before.push_back(body.velocity);
    for (ContactRow& row : m.rows) row.lowest_speed = random.uniform(0.5, 1.0);
    solveContacts(m.rows, m.bodies, {.sweeps = 100000, .residual_mps = 1e-14});
    const Meeting solved = m;
    takeBackWork(m.rows, m.bodies, before);
    for (std::size_t k = 0; k < m.rows.size(); ++k)
      EXPECT_LT((m.rows[k].impulse - solved.rows[k].impulse).norm(),
                1e-9 * (1e-12 + solved.rows[k].impulse.norm()));
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
