// Rolling and spinning resistance by the closed forms of experiments/resisted_ball.h: what a ball loses and
// how far it goes, that it stops for good, what slopes it stands on; and that energy never grows.
//
// Speeds are exact: forces act evenly over the step. Ways too, but for the last step, which a ball spends on
// the mean of its last speed v and nought while theory stops it within: a dt^2 / 8 at most.

#include <gtest/gtest.h>

#include "tests/physics/experiments/carom_simulation.h"
#include "tests/physics/experiments/resisted_ball.h"
#include "tests/physics/small_world.h"

namespace carom::physics {
namespace {

class RollingResistance : public testing::TestWithParam<double> {};  // Hz

// Rolls some three radii in any size.
ResistedBall rollingBall(double rate_hz, double radius_m, double heading) {
  return {.rate_hz = rate_hz,
          .radius_m = radius_m,
          .mass_kg = 700.0 * radius_m * radius_m * radius_m,
          .rolling = 0.02,
          .heading = heading,
          .velocity_mps = std::sqrt(0.1 * kGravity * radius_m)};
}

TEST_P(RollingResistance, SlowsABallByFiveSeventhsOfGTimesLeverOverRadius) {
  for (double radius : {1e-3, 0.02, 0.25, 10.0})
    for (double heading : {0.0, 0.7, 2.3, 4.0})
      EXPECT_LE(std::abs(rollingLossError(kCarom, rollingBall(GetParam(), radius, heading))), 1e-11)
          << radius << " m, heading " << heading;
}

TEST_P(RollingResistance, SlowsAlikeWhateverTheMass) {
  ResistedBall ball = rollingBall(GetParam(), 0.25, 0.7);
  for (double mass : {1e-3, 1.0, 1e4}) {
    ball.mass_kg = mass;
    EXPECT_LE(std::abs(rollingLossError(kCarom, ball)), 1e-11) << mass;
  }
}

TEST_P(RollingResistance, StopsABallAtItsDistance) {
  const double dt = 1.0 / GetParam();
  for (double radius : {1e-3, 0.02, 0.25, 10.0})
    for (double heading : {0.0, 0.7, 2.3}) {
      const ResistedBall ball = rollingBall(GetParam(), radius, heading);
      const double a = ball.deceleration(), v = ball.velocity_mps;
      const double last_step = 0.125 * a * dt * dt / (0.5 * v * v / a);
      EXPECT_LE(std::abs(rollingWayError(kCarom, ball)), last_step + 1e-10)
          << radius << " m, heading " << heading;
    }
}

TEST_P(RollingResistance, WithRestingMode_StopsABallAtItsDistanceAndPutsItToRest) {
  ResistedBall ball = rollingBall(GetParam(), 0.25, 0.7);
  ball.resting = true;
  ball.velocity_mps = 2.0;
  const double a = ball.deceleration();
  Trial trial = start(kCarom, ball);
  const Vec3 begin = trial.position(kOnSlope);
  trial.run(ball.velocity_mps / a + 1.0);
  EXPECT_TRUE(trial.atRest(kOnSlope));
  EXPECT_EQ(trial.velocity(kOnSlope), Vec3::Zero());
  EXPECT_EQ(trial.spin(kOnSlope), Vec3::Zero());
  // Below 0.01 m/s (its fastest point is twice as fast) it may be put to rest.
  const double way = 0.5 * ball.velocity_mps * ball.velocity_mps / a;
  EXPECT_NEAR((trial.position(kOnSlope) - begin).norm(), way, 0.5 * 0.01 * 0.01 / a);
}

TEST_P(RollingResistance, StopsABallForGood_WithoutReversalOrJitter) {
  for (double radius : {1e-3, 0.25, 10.0}) {
    const ResistedBall ball = rollingBall(GetParam(), radius, 1.1);
    Trial trial = start(kCarom, ball);
    double last = ball.velocity_mps;
    const double rounding = 1e-12 * ball.velocity_mps;
    while (trial.time() < ball.velocity_mps / ball.deceleration() + 1.0) {
      trial.step();
      const Vec3 v = trial.velocity(kOnSlope);
      const double speed = v.dot(ball.along());
      ASSERT_LE(speed, last + rounding) << radius << " m at " << trial.time() << " s";
      ASSERT_GE(speed, -rounding) << radius << " m at " << trial.time() << " s";
      ASSERT_LE((v - speed * ball.along()).norm(), 1e-10 * ball.velocity_mps) << trial.time();
      ASSERT_LE((v - radius * trial.spin(kOnSlope).cross(ball.up())).norm(), 1e-9 * ball.velocity_mps)
          << "rolls by its radius at " << trial.time();
      last = speed;
    }
    EXPECT_LE(last, rounding) << radius;
  }
}

TEST_P(RollingResistance, BallStandsExactlyWhileTheTangentIsWithinLeverOverRadius) {
  for (double rolling : {0.01, 0.1, 0.6})
    for (double heading : {0.0, 0.9}) {
      const ResistedBall ball{.rate_hz = GetParam(), .rolling = rolling, .heading = heading};
      EXPECT_LE(std::abs(standingThresholdError(kCarom, ball)), 3e-4) << rolling << ", heading " << heading;
    }
}

// Resting mode calls balanced what gains less than 1e-4 g at its fastest point: 0.1 % of slopes from 4
// degrees.
TEST_P(RollingResistance, WithRestingMode_NeverFreezesABallThatMustRoll) {
  for (double rolling : {0.1, 0.3, 0.6})
    for (double side : {-1.1e-3, 1.1e-3}) {
      const ResistedBall ball{.rate_hz = GetParam(),
                              .rolling = rolling,
                              .angle = std::atan(rolling * (1.0 + side)),
                              .heading = 0.4,
                              .resting = true};
      Trial trial = start(kCarom, ball);
      trial.run(2.0);
      const double speed = trial.velocity(kOnSlope).dot(ball.along());
      if (side < 0.0) {
        EXPECT_TRUE(trial.atRest(kOnSlope)) << rolling;
      } else {
        EXPECT_NEAR(speed / (-ball.deceleration() * trial.time()), 1.0, 1e-6) << rolling;
      }
    }
}

TEST_P(RollingResistance, BallRollsDownBySineLessResistance) {
  for (double radius : {0.02, 0.25, 1.5}) {
    const ResistedBall ball{
        .rate_hz = GetParam(), .radius_m = radius, .rolling = 0.2, .angle = radians(25.0), .heading = 0.7};
    Trial trial = start(kCarom, ball);
    trial.run(1.0);
    EXPECT_NEAR(trial.velocity(kOnSlope).dot(ball.along()) / -ball.deceleration(), 1.0, 1e-11) << radius;
  }
}

TEST_P(RollingResistance, SpinStopsAfterItsTime) {
  for (double radius : {1e-3, 0.25, 10.0})
    for (double angle : {0.0, 0.3}) {
      const ResistedBall ball{.rate_hz = GetParam(),
                              .radius_m = radius,
                              .spinning = 0.01,
                              .heading = 0.7,
                              .spin_radps = 2.0 * std::sqrt(kGravity / radius)};
      SCOPED_TRACE(testing::Message() << radius << " m, " << angle);
      const double expected = ball.spin_radps / ball.spinDeceleration();
      EXPECT_LE(std::abs(spinLossError(kCarom, ball)), 1e-11);
      const double late = spinTimeError(kCarom, ball);
      EXPECT_GE(late, -1e-9);
      EXPECT_LE(late, 1.0 / GetParam() / expected + 1e-9);
    }
}

TEST_P(RollingResistance, SpinEndsAtNoughtAndTheBallStays) {
  const ResistedBall ball{.rate_hz = GetParam(), .spinning = 0.004, .spin_radps = 7.0};
  Trial trial = start(kCarom, ball);
  const Vec3 begin = trial.position(kOnSlope);
  double last = ball.spin_radps;
  while (trial.time() < ball.spin_radps / ball.spinDeceleration() + 1.0) {
    trial.step();
    const double spin = trial.spin(kOnSlope).dot(ball.up());
    ASSERT_LE(spin, last + 1e-12);
    ASSERT_GE(spin, -1e-12);
    last = spin;
  }
  EXPECT_LE(trial.spin(kOnSlope).norm(), 1e-12);
  EXPECT_LE((trial.position(kOnSlope) - begin).norm(), 1e-9);
}

// On a ball rolling and spinning are turned about axes that do not mix.
TEST_P(RollingResistance, RollingAndSpinningEachLoseTheirOwn) {
  ResistedBall ball = rollingBall(GetParam(), 0.25, 2.0);
  ball.spinning = 0.003;
  ball.spin_radps = 20.0;
  EXPECT_LE(std::abs(rollingLossError(kCarom, ball)), 1e-9);
  EXPECT_LE(std::abs(spinLossError(kCarom, ball)), 1e-9);
}

// A ball that slides first: friction mu g slows it and turns it, against what resistance allows, by
// 5/2 (mu - c / r) g / r, until it rolls.
TEST_P(RollingResistance, ASlidingBallIsTurnedByFrictionLessResistance) {
  const double mu = 0.3, rolling = 0.1, radius = 0.25;
  SmallWorld w(GetParam(), {0, 0, -kGravity}, false);
  Material material = rubbing(mu);
  material.rolling_resistance_m = rolling * radius;
  w.addPlane(material);
  const int ball = w.add({Solid::ball(radius),
                          {Quat::Identity(), Vec3(0, 0, radius + restGap(2.0 * radius))},
                          {6, 0, 0},
                          Vec3::Zero(),
                          material});
  w.start();
  w.run(0.5);
  EXPECT_NEAR(w.velocity(ball).x(), 6.0 - 0.5 * mu * kGravity, 1e-9);
  EXPECT_NEAR(w.spin(ball).y(), 0.5 * 2.5 * (mu - rolling) * kGravity / radius, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Rates, RollingResistance, testing::Values(30.0, 60.0, 240.0));

Material resisting(double friction, double rolling_m, double spinning_m, double restitution = 0.0) {
  Material material = rubbing(friction, restitution);
  material.rolling_resistance_m = rolling_m;
  material.spinning_resistance_m = spinning_m;
  return material;
}

// The upper ball's weight acts r sin beside the contact of the two: tan <= c / r; the lower ball bears twice
// the moment under twice the weight: sin <= c / r.
TEST(ResistedBodies, ABallStandsOnABallExactlyWhileTheTangentIsWithinLeverOverRadius) {
  const double radius = 0.2, rolling = 0.3;
  const auto stands = [&](double share, double heading, bool upper_first) {
    SmallWorld w(240.0);
    const Material material = resisting(1.5, rolling * radius, 0.0);
    w.addPlane(material);
    const double gap = restGap(2.0 * radius), lean = std::atan(share * rolling);
    const Vec3 low(0.3, -0.1, radius + gap);
    const Vec3 between = rotatedBy(Vec3::UnitZ(), heading) * Vec3(std::sin(lean), 0.0, std::cos(lean));
    const Vec3 high = low + (2.0 * radius + gap) * between;
    std::vector<Vec3> centers{low, high};
    if (upper_first) std::swap(centers[0], centers[1]);
    std::vector<int> balls;
    for (const Vec3& center : centers)
      balls.push_back(
          w.add({Solid::ball(radius), {Quat::Identity(), center}, Vec3::Zero(), Vec3::Zero(), material}));
    w.start();
    w.run(3.0);
    const double height = w.position(balls[upper_first ? 0 : 1]).z();
    return w.rests(balls[0]) && w.rests(balls[1]) && std::abs(height - high.z()) < gap;
  };
  for (double heading : {0.0, 0.8})
    for (bool upper_first : {false, true}) {
      EXPECT_TRUE(stands(0.99, heading, upper_first)) << heading << upper_first;
      EXPECT_FALSE(stands(1.01, heading, upper_first)) << heading << upper_first;
    }
}

// Its line of contact shares the weight, so that it stands as a ball of its radius does.
TEST(ResistedBodies, ACapsuleStandsExactlyWhileTheTangentIsWithinLeverOverRadius) {
  const double radius = 0.1, rolling = 0.2;
  for (double heading : {0.0, 0.7})
    for (double side : {-2e-3, 2e-3}) {
      const Quat tilt = Slope{.angle = std::atan(rolling * (1.0 + side)), .heading = heading}.tilt();
      SmallWorld w(60.0);
      const Material material = resisting(1.0, rolling * radius, 0.0);
      w.addPlane(material, tilt);
      const int capsule = w.add({Solid::capsule(radius, 0.5),
                                 {tilt * rotatedBy(Vec3::UnitX(), 0.5 * std::numbers::pi),
                                  tilt * Vec3(0, 0, radius + restGap(2.0 * radius))},
                                 Vec3::Zero(),
                                 Vec3::Zero(),
                                 material});
      w.start();
      w.run(3.0);
      const double way = (tilt.conjugate() * w.position(capsule)).x();
      EXPECT_EQ(w.rests(capsule), side < 0.0) << heading;
      if (side < 0.0) {
        EXPECT_LE(std::abs(way), 1e-6) << heading;
      } else {
        EXPECT_GE(way, 1e-3) << heading;
      }
    }
}

// A box turns about nothing while it slides, so resistance changes nothing of its way.
TEST(ResistedBodies, ABoxSlidesItsCoulombDistanceAllTheSame) {
  for (double heading : {0.0, 0.6}) {
    Experiment e{.step_s = 1.0 / 60.0};
    e.addPlane(0.4);
    e.add({.shape = Shape::box({0.6, 0.5, 0.2}),
           .X_WB = {Quat::Identity(), Vec3(0, 0, 0.1 + restGap(0.2))},
           .velocity = rotatedBy(Vec3::UnitZ(), heading) * Vec3(3, 0, 0),
           .friction = 0.4});
    for (ExperimentBody& body : e.bodies) body.rolling_resistance_m = body.spinning_resistance_m = 0.02;
    Trial trial(kCarom, e);
    trial.run(2.0);
    EXPECT_NEAR(trial.position(1).head<2>().norm() / (4.5 / (0.4 * kGravity)), 1.0, 1e-4) << heading;
    EXPECT_TRUE(trial.atRest(1));
  }
}

// Spinning on its face without friction: the points share the weight, so that it loses s m g / I a second.
TEST(ResistedBodies, ABoxOnItsFaceLosesItsSpinAsItsPointsShareTheWeight) {
  const double spinning = 0.01;
  const Vec3 size(0.6, 0.5, 0.2);
  SmallWorld w(240.0);
  const Material material = resisting(0.0, 0.0, spinning);
  w.addPlane(material);
  const int box =
      w.add({Solid::box(size), lyingBox(size, Quat::Identity(), 0.3), Vec3::Zero(), {0, 0, 4}, material});
  w.start();
  w.run(0.5);
  const double inertia_per_mass = (0.36 + 0.25) / 12.0;
  EXPECT_NEAR(w.spin(box).z(), 4.0 - 0.5 * spinning * kGravity / inertia_per_mass, 1e-6);
}

// Motes that it strikes one after the other within a step take nothing from it, but each has the floor's
// forces found anew for the rest of the step.
TEST(ResistedBodies, ABallThatStrikesMotesWithinAStepRollsOnByItsClosedForm) {
  const double radius = 0.25, mote = 0.02, lever = 0.01, speed = 2.0;
  SmallWorld w(30.0, {0, 0, -kGravity}, false);
  const Material material = resisting(1.0, lever, lever);
  w.addPlane(material);
  const double height = radius + restGap(2.0 * radius);
  const int ball = w.add({Solid::ball(radius),
                          {Quat::Identity(), Vec3(0, 0, height)},
                          {speed, 0, 0},
                          {0, speed / radius, 0},
                          material});
  Material light = rubbing(0.0, 1.0);
  light.density_kgpm3 = 1e-6;
  for (int i = 0; i < 3; ++i) {
    const double angle = 0.15 * (i - 1);
    const Vec3 out(std::cos(angle), std::sin(angle), 0.0);
    w.add({Solid::ball(mote),
           {Quat::Identity(), Vec3(0, 0, height) + (radius + mote + 0.01 + 0.015 * i) * out},
           Vec3::Zero(),
           Vec3::Zero(),
           light});
  }
  w.start();
  w.step();
  EXPECT_GE(w.world().audit().last_step.events, 3);
  w.run(1.0 - 1.0 / 30.0);
  const double expected = speed - 5.0 / 7.0 * kGravity * lever / radius;
  EXPECT_NEAR(w.velocity(ball).x(), expected, 1e-8);
  EXPECT_NEAR(radius * w.spin(ball).y(), expected, 1e-8);
}

// The blow of its landing would take s v / k^2 of the spin besides, if it were resisted, 1.2 of 8 rad/s.
TEST(ResistedBodies, ASpinningBoxThatLandsLosesSpinOnlyAsItLies) {
  const double spinning = 0.02, drop = 0.5, seconds = 0.6;
  const Vec3 size(0.6, 0.5, 0.2);
  SmallWorld w(240.0);
  const Material material = resisting(0.0, 0.0, spinning);
  w.addPlane(material);
  Pose X = lyingBox(size, Quat::Identity(), 0.3);
  X.position.z() += drop;
  const int box = w.add({Solid::box(size), X, Vec3::Zero(), {0, 0, 8}, material});
  w.start();
  w.run(seconds);
  const double lying_s = seconds - std::sqrt(2.0 * drop / kGravity);
  const double loss = spinning * kGravity / ((size.x() * size.x() + size.y() * size.y()) / 12.0) * lying_s;
  EXPECT_NEAR(8.0 - w.spin(box).z(), loss, 5e-3 * loss);
}

// It topples about its lower edge, where resistance bears a moment of c N more: tan <= (half width + c) /
// half height.
TEST(ResistedBodies, ABoxTopplesWhereItsWidthAndResistanceNoLongerHoldIt) {
  const Vec3 size(0.2, 0.5, 0.8);
  for (double lever : {0.0, 0.05, 0.2})
    for (double side : {-1e-2, 1e-2}) {
      const double tangent = (0.5 * size.x() + lever) / (0.5 * size.z());
      const Quat tilt = Slope{.angle = std::atan(tangent * (1.0 + side)), .heading = 0.5}.tilt();
      SmallWorld w(240.0);
      const Material material = resisting(3.0, lever, 0.0);
      w.addPlane(material, tilt);
      const int box =
          w.add({Solid::box(size), lyingBox(size, tilt, 0.0), Vec3::Zero(), Vec3::Zero(), material});
      w.start();
      w.run(3.0);
      const Vec3 up = tilt.conjugate() * (w.state(box).X_WB.rotation * Vec3::UnitZ());
      EXPECT_EQ(up.z() > 0.999, side < 0.0) << lever;
      EXPECT_TRUE(side > 0.0 || w.rests(box)) << lever;
    }
}

// Its centre as far beyond the edge as resistance bears its weight's moment about that: d <= c.
TEST(ResistedBodies, ABoxOverAnEdgeStaysAndRestsWhileItsOverhangIsWithinTheLever) {
  const double lever = 0.1;
  const Vec3 size(0.8, 0.3, 0.2);
  for (double side : {-1e-2, 1e-2}) {
    SmallWorld w(240.0);
    const Material material = resisting(1.0, lever, 0.0);
    w.add({Solid::box({2, 2, 1}),
           {Quat::Identity(), Vec3(-1, 0, -0.5)},
           Vec3::Zero(),
           Vec3::Zero(),
           material,
           true});
    const Vec3 center(lever * (1.0 + side), 0.0, 0.5 * size.z() + restGap(size.minCoeff()));
    const int box =
        w.add({Solid::box(size), {Quat::Identity(), center}, Vec3::Zero(), Vec3::Zero(), material});
    w.start();
    w.run(3.0);
    EXPECT_EQ(w.rests(box), side < 0.0) << side;
    EXPECT_EQ((w.position(box) - center).norm() < 1e-3, side < 0.0) << side;
  }
}

TEST(ResistedBodies, ADodecahedronComesToRestSoonerOnAFace) {
  const auto way = [](double lever) {
    SmallWorld w(240.0);
    const Solid solid = Solid::polyhedron(oracle::dodecahedron());
    const double radius = solid.radius();
    const Material material = resisting(1.0, lever * radius, lever * radius);
    w.addPlane(material);
    const int body = w.add({solid,
                            {rotatedBy({1, 2, 3}, 0.4), Vec3(0, 0, 1.05 * radius)},
                            {6.0, 0, 0},
                            {0, 6.0 / radius, 0},
                            material});
    w.start();
    w.run(12.0);
    EXPECT_TRUE(w.rests(body)) << lever;
    return w.position(body).x();
  };
  const double free = way(0.0);
  EXPECT_LT(way(0.05), 0.9 * free);
}

// What one of the two does not have, the pair has not.
TEST(ResistedBodies, OnAFloorWithoutResistance_NotABitChanges) {
  const auto hashAfter = [](double lever) {
    SmallWorld w(60.0);
    w.addPlane(rubbing(0.5));
    const Material material = resisting(0.5, lever, lever);
    w.add({Solid::ball(0.2), {Quat::Identity(), Vec3(0, 0, 0.3)}, {2, 1, 0}, {0, 0, 5}, material});
    w.start();
    w.run(2.0);
    return w.world().stateHash();
  };
  EXPECT_EQ(hashAfter(0.0), hashAfter(0.1));
}

// Two balls and a box against each other: whoever comes first in the list.
TEST(ResistedBodies, GoTheSameWayInAnyOrder) {
  const auto waysIn = [](const std::vector<int>& order) {
    SmallWorld w(60.0);
    const Material material = resisting(0.6, 0.01, 0.005);
    const std::vector<Placement> placements{
        {Solid::ball(0.25), {Quat::Identity(), Vec3(0, 0, 0.2505)}, {3, 0.2, 0}, {0, 12, 5}, material},
        {Solid::ball(0.15), {Quat::Identity(), Vec3(1.5, 0.1, 0.1503)}, {-1, 0, 0}, {0, 0, -9}, material},
        {Solid::box({0.4, 0.5, 0.3}),
         {Quat::Identity(), Vec3(3, 0, 0.1503)},
         {0, 0, 0},
         {0, 0, 2},
         material}};
    std::vector<int> index(placements.size());
    for (int i : order) index[static_cast<std::size_t>(i)] = w.add(placements[static_cast<std::size_t>(i)]);
    w.addPlane(material);
    w.start();
    w.run(4.0);
    std::vector<Vec3> positions;
    for (int i : index) positions.push_back(w.position(i));
    return positions;
  };
  const std::vector<Vec3> expected = waysIn({0, 1, 2});
  for (const std::vector<int>& order : {std::vector<int>{2, 1, 0}, {1, 2, 0}})
    for (std::size_t i = 0; i < expected.size(); ++i)
      EXPECT_LE((waysIn(order)[i] - expected[i]).norm(), 1e-6) << i;
}

// Balls, boxes, capsules and prisms thrown together, with any friction, restitution and resistance. At coarse
// steps corners that turn cost or give some 1e-4 with and without resistance (midstep_rows.h); the solver's
// own account is exact (turning_resistance_test.cpp).
TEST(ResistedBodies, NeverGainEnergy) {
  const std::uint64_t seed = 505;
  oracle::Random random(seed);
  for (int trial = 0; trial < 60; ++trial) {
    SCOPED_TRACE(testing::Message() << "seed " << seed << " trial " << trial);
    SmallWorld w(trial % 2 == 0 ? 240.0 : 480.0);
    const double lever = random.logUniform(1e-4, 1.0);
    const Material material = resisting(random.uniform(0, 1.5), lever, lever * random.uniform(0, 1),
                                        trial % 3 == 0 ? random.uniform(0, 1) : 0.0);
    w.addPlane(material);
    for (int i = 0; i < 4; ++i) {
      const double size = random.uniform(0.1, 0.4);
      const Solid solid = i == 0   ? Solid::ball(size)
                          : i == 1 ? Solid::box({size, 1.5 * size, 0.7 * size})
                          : i == 2 ? Solid::capsule(0.5 * size, size)
                                   : Solid::polyhedron(oracle::prism(7, size, size));
      w.add({solid,
             {random.rotation(), Vec3(0.2 * i, 0.1 * i, 0.6 + 1.1 * i)},
             random.uniform(0, 4) * random.direction(),
             random.uniform(0, 10) * random.direction(),
             material});
    }
    w.start();
    const auto energy = [&] {
      const Audit audit = w.world().audit();
      return audit.kinetic_energy_J + audit.potential_energy_J;
    };
    const double begin = energy();
    double last = begin;
    while (w.time() < 2.0) {
      w.step();
      ASSERT_LE(energy(), last + 1e-4 * begin) << w.time();
      last = energy();
    }
    EXPECT_LT(last, begin);
  }
}

}  // namespace
}  // namespace carom::physics
