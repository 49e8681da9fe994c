// Kinematic bodies: their paths are what was prescribed, to the rounding, and others meet them as theory
// says: impacts with restitution, friction on turntables and belts, weight in an elevator, and the work they
// do.

#include "tests/physics/small_world.h"
#include "tests/support/world_energy.h"

namespace carom::physics {
namespace {

BodyDescription kinematic(int solid, const Pose& X, const Vec3& velocity, const Vec3& spin,
                          const Material& material) {
  BodyDescription d{solid, X, velocity, spin, material};
  d.is_kinematic = true;
  return d;
}

class KinematicWorld {
 public:
  explicit KinematicWorld(const WorldSettings& settings) : world(settings) {}
  int add(const Solid& solid, const Pose& X, const Vec3& v, const Vec3& spin, const Material& material) {
    return world.addBody({world.addSolid(solid), X, v, spin, material});
  }
  int addStatic(const Solid& solid, const Pose& X, const Material& material) {
    return world.addBody({world.addSolid(solid), X, Vec3::Zero(), Vec3::Zero(), material, true});
  }
  int addDriven(const Solid& solid, const Pose& X, const Vec3& v, const Vec3& spin,
                const Material& material) {
    return world.addBody(kinematic(world.addSolid(solid), X, v, spin, material));
  }
  int addAlong(const Solid& solid, std::vector<Keyframe> keyframes, Interpolation how,
               const Material& material, bool repeats = false) {
    BodyDescription d;
    d.solid = world.addSolid(solid);
    d.material = material;
    d.is_kinematic = true;
    d.keyframes = std::move(keyframes);
    d.interpolation = how;
    d.repeats = repeats;
    return world.addBody(d);
  }
  void start() { ASSERT_TRUE(world.start().empty()); }
  void run(double seconds) {
    const int steps = static_cast<int>(std::round(seconds / world.settings().step_s));
    for (int i = 0; i < steps; ++i) {
      world.step();
      ASSERT_GT(world.audit().smallest_gap_m, 0.0) << world.time();
    }
  }
  const BodyState& state(int body) const { return world.states()[static_cast<std::size_t>(body)]; }
  double energy() const { return energyOf(world); }
  World world;
};

const Vec3 kDown(0.0, 0.0, -kGravity);
const Vec3 kNoGravity(0.0, 0.0, 0.0);

TEST(KinematicPiston, HitsABallWithItsRestitution) {
  for (const double e : {0.0, 0.4, 1.0})
    for (const double u : {0.7, 2.0}) {
      KinematicWorld w({1.0 / 240.0, kNoGravity});
      const double v = 1.3;
      w.addDriven(Solid::box(Vec3(1.0, 1.0, 0.4)), {oracle::turned(Vec3::UnitZ(), 0.3), Vec3(0, 0, -0.5)},
                  Vec3(0, 0, u), Vec3::Zero(), rubbing(0.5, e));
      const int ball = w.add(Solid::ball(0.2), {Quat::Identity(), Vec3(0.01, 0.02, 0.71)}, Vec3(0, 0, -v),
                             Vec3::Zero(), rubbing(0.5, e));
      w.start();
      const double before = w.energy();
      w.run(0.5);
      const double after = e * v + (1.0 + e) * u;
      EXPECT_NEAR(w.state(ball).linear_velocity.z(), after, e == 0.0 ? 1e-3 : 1e-9) << e << " " << u;
      // In an elastic impact nothing is lost: what the ball gained is the piston's work.
      if (e == 1.0) {
        EXPECT_NEAR(w.energy() - before, w.world.audit().work_J, 1e-9 * w.energy());
      }
      EXPECT_EQ(w.world.audit().kinematic_late_s, 0.0);
    }
}

TEST(KinematicBody, IsWhereItsPathSays_AfterALongTime) {
  KinematicWorld w({1.0 / 60.0, kDown});
  const Quat start = oracle::turned(Vec3(1, 2, 3).normalized(), 0.7);
  const Vec3 velocity(0.3, -0.2, 0.1), spin(1.0, 2.0, -0.5);
  const int box =
      w.addDriven(Solid::box(Vec3(0.3, 0.4, 0.5)), {start, Vec3(1, 2, 3)}, velocity, spin, rubbing(0.5));
  w.start();
  w.run(100.0);
  const double t = w.world.time();
  EXPECT_LT((w.state(box).X_WB.position - (Vec3(1, 2, 3) + t * velocity)).norm(), 1e-12);
  EXPECT_LT(w.state(box).X_WB.rotation.angularDistance(rotationBy(t * spin) * start), 1e-11);
  EXPECT_EQ(w.state(box).linear_velocity, velocity);
  EXPECT_EQ(w.state(box).mode, Mode::kKinematic);
}

// Where a piston stops to accelerate, whatever it throws leaves it: at that time, which no step meets, and at
// its speed, but for changes that are too small to be passed on from contact to contact.
TEST(KeyframedPiston, ThrowsAStackAtItsOwnSpeed) {
  for (const double rate : {60.0, 240.0})
    for (const double half_s : {0.1, 0.1037, 0.105, 0.1083}) {
      SCOPED_TRACE(testing::Message() << rate << " Hz, brakes at " << half_s << " s");
      KinematicWorld w({1.0 / rate, kDown});
      const double rise = 0.5, speed = rise / half_s;
      w.addAlong(Solid::box(Vec3(1.0, 1.0, 0.2)),
                 {{0.0, {Quat::Identity(), Vec3(0, 0, -0.1)}},
                  {2.0 * half_s, {Quat::Identity(), Vec3(0, 0, rise - 0.1)}}},
                 Interpolation::kSmooth, rubbing(0.5));
      std::vector<int> stack;
      for (int i = 0; i < 3; ++i)
        stack.push_back(w.add(Solid::box(Vec3::Constant(0.3)),
                              {Quat::Identity(), Vec3(0, 0, 0.15 + 0.3 * i + (i + 1) * restGap(0.3))},
                              Vec3::Zero(), Vec3::Zero(), rubbing(0.5)));
      w.start();
      const double before = w.energy();
      w.run(0.3);
      for (const int body : stack)
        EXPECT_NEAR(w.state(body).linear_velocity.z(), speed - kGravity * (w.world.time() - half_s),
                    5e-4 * speed);
      EXPECT_NEAR((w.energy() - before) / w.world.audit().work_J, 1.0, 1e-3);
    }
}

TEST(KeyframedBody, PassesItsKeyframes_BetweenSteps) {
  for (const Interpolation how : {Interpolation::kLinear, Interpolation::kSmooth}) {
    KinematicWorld w({1.0 / 64.0, kDown});
    const Quat turned = oracle::turned(Vec3::UnitX(), 1.1);
    // Times that no step of 1/64 s meets, but those at which it is asked.
    const std::vector<Keyframe> keys{{0.25, {Quat::Identity(), Vec3(0, 0, 1)}},
                                     {0.7, {turned, Vec3(1, 0, 1)}},
                                     {1.3, {turned, Vec3(1, 2, 1)}}};
    const int body = w.addAlong(Solid::box(Vec3(0.3, 0.4, 0.5)), keys, how, rubbing(0.5));
    w.start();
    w.run(0.25);
    EXPECT_LT((w.state(body).X_WB.position - Vec3(0, 0, 1)).norm(), 1e-15);
    w.run(0.5);  // 0.05 s after the second
    const double s = how == Interpolation::kLinear ? 0.05 / 0.6 : 2.0 * (0.05 / 0.6) * (0.05 / 0.6);
    EXPECT_LT((w.state(body).X_WB.position - Vec3(1, 2.0 * s, 1)).norm(), 1e-14);
    EXPECT_LT(w.state(body).X_WB.rotation.angularDistance(turned), 1e-14);
    w.run(1.0);
    EXPECT_LT((w.state(body).X_WB.position - Vec3(1, 2, 1)).norm(), 1e-14);
    EXPECT_EQ(w.state(body).linear_velocity, Vec3::Zero());
  }
}

// A ball that floats before a plate, which sets off between two steps.
TEST(KeyframedBody, StrikesWhatItComesToWithinTheStepInWhichItSetsOff) {
  KinematicWorld w({1.0 / 60.0, kNoGravity});
  const double u = 3.0;
  w.addAlong(Solid::box(Vec3(1, 1, 0.2)),
             {{0.0, {}}, {0.105, {}}, {1.105, {Quat::Identity(), Vec3(0, 0, u)}}}, Interpolation::kLinear,
             rubbing(0.3, 1.0));
  // It is struck 3 ms later, in the same step.
  const int ball = w.add(Solid::ball(0.1), {Quat::Identity(), Vec3(0, 0, 0.2 + 0.003 * u)}, Vec3::Zero(),
                         Vec3::Zero(), rubbing(0.3, 1.0));
  w.start();
  w.run(0.1);
  EXPECT_EQ(w.state(ball).linear_velocity, Vec3::Zero());
  w.run(1.0 / 60.0);
  EXPECT_NEAR(w.state(ball).linear_velocity.z(), 2.0 * u, 1e-9);
  EXPECT_NEAR(w.state(ball).X_WB.position.z(), 0.2 + 0.003 * u + (7.0 / 60.0 - 0.108) * 2.0 * u, 1e-3);
}

TEST(BlockOnABelt, ComesToItsSpeedAsFrictionLets) {
  KinematicWorld w({1.0 / 240.0, kDown});
  const double mu = 0.3, v = 1.5;
  w.addDriven(Solid::box(Vec3(20, 2, 0.2)), {Quat::Identity(), Vec3(0, 0, -0.1)}, Vec3(v, 0, 0), Vec3::Zero(),
              rubbing(mu));
  const Vec3 size(0.4, 0.3, 0.2);
  const int block =
      w.add(Solid::box(size), lyingBox(size, Quat::Identity(), 0.2), Vec3::Zero(), Vec3::Zero(), rubbing(mu));
  w.start();
  const double seconds = v / (mu * kGravity);
  const double m = w.world.mass(block);
  while (w.world.time() + w.world.settings().step_s < seconds) w.world.step();
  const double t = w.world.time();
  EXPECT_NEAR(w.state(block).linear_velocity.x() / (mu * kGravity * t), 1.0, 1e-4);
  EXPECT_NEAR(w.state(block).X_WB.position.x() / (0.5 * mu * kGravity * t * t), 1.0, 1e-3);
  w.run(2.0);
  EXPECT_NEAR(w.state(block).linear_velocity.x(), v, 1e-9);
  // Half of the belt's work is the block's, half is heat.
  EXPECT_NEAR(w.world.audit().work_J / (m * v * v), 1.0, 1e-4);
}

// A small block that turns with the table from the start.
bool slipsOnTurntable(double radius_m, double spin, double mu, double heading) {
  KinematicWorld w({1.0 / 240.0, kDown});
  w.addDriven(Solid::box(Vec3(8, 8, 0.2)), {Quat::Identity(), Vec3(0, 0, -0.1)}, Vec3::Zero(),
              Vec3(0, 0, spin), rubbing(mu));
  const Vec3 size(0.1, 0.1, 0.04);
  const Vec2 at(radius_m * std::cos(heading), radius_m * std::sin(heading));
  const Pose X = lyingBox(size, Quat::Identity(), 0.4, at);
  const int block =
      w.add(Solid::box(size), X, Vec3(0, 0, spin).cross(X.position), Vec3(0, 0, spin), rubbing(mu));
  w.start();
  w.run(3.0);
  return std::abs(w.state(block).X_WB.position.head<2>().norm() - radius_m) > 1e-3;
}

TEST(BlockOnATurntable, SlipsBeyondTheRadiusOfItsFriction) {
  const double mu = 0.4, spin = 2.5;
  const double limit = mu * kGravity / (spin * spin);
  for (const double heading : {0.3, 2.0}) {
    EXPECT_FALSE(slipsOnTurntable(0.99 * limit, spin, mu, heading));
    EXPECT_TRUE(slipsOnTurntable(1.01 * limit, spin, mu, heading));
  }
}

TEST(BlockOnATurntable, RidesAndDoesNotComeToRest) {
  KinematicWorld w({1.0 / 240.0, kDown});
  w.addDriven(Solid::box(Vec3(2, 2, 0.2)), {Quat::Identity(), Vec3(0, 0, -0.1)}, Vec3::Zero(),
              Vec3(0, 0, 0.01), rubbing(0.5));
  const Vec3 size(0.2, 0.3, 0.1);
  const Pose X = lyingBox(size, Quat::Identity(), 0.0);
  const int block = w.add(Solid::box(size), X, Vec3::Zero(), Vec3::Zero(), rubbing(0.5));
  w.start();
  w.run(20.0);
  EXPECT_NE(w.state(block).mode, Mode::kResting);
  EXPECT_NEAR(w.state(block).X_WB.rotation.angularDistance(X.rotation), 0.2, 1e-3);
}

// Rolling, a ball's centre has 5/7 of the acceleration that friction alone would give it, and its lowest
// point the table's velocity: dv/dt = 2/7 W x v, W the table's spin. Its path is a circle, whatever the
// radius and the start.
TEST(BallOnATurntable, RollsInACircleAtTwoSeventhsOfItsSpin) {
  const double spin = 1.5, radius = 0.1, speed = 0.5;
  for (const double rate_hz : {60.0, 240.0})
    for (const double heading : {0.0, 2.0}) {
      KinematicWorld w({1.0 / rate_hz, kDown});
      w.addDriven(Solid::box(Vec3(20, 20, 0.2)), {Quat::Identity(), Vec3(0, 0, -0.1)}, Vec3::Zero(),
                  Vec3(0, 0, spin), rubbing(1.0));
      const Quat turn = oracle::turned(Vec3::UnitZ(), heading);
      const Vec3 p = turn * Vec3(2, 0, radius + restGap(2.0 * radius)), v = turn * Vec3(0, speed, 0);
      const Vec3 roll = Vec3::UnitZ().cross(v - Vec3(0, 0, spin).cross(p)) / radius;
      const int ball =
          w.add(Solid::ball(radius), {Quat::Identity(), p}, v, roll + Vec3(0, 0, spin), rubbing(1.0));
      w.start();
      for (int second = 1; second <= 10; ++second) {
        w.run(1.0);
        const Vec3 expected = oracle::turned(Vec3::UnitZ(), 2.0 / 7.0 * spin * second) * v;
        EXPECT_LE((w.state(ball).linear_velocity - expected).norm(), 1e-5 * speed)
            << rate_hz << " Hz, heading " << heading << ", " << second << " s";
      }
    }
}

TEST(BoxInAnElevator, WeighsWhatItsAccelerationSays_AndIsLiftedByItsWork) {
  KinematicWorld w({1.0 / 240.0, kDown});
  const double height = 3.0, seconds = 2.0;
  w.addAlong(Solid::box(Vec3(2, 2, 1)),
             {{0.5, {Quat::Identity(), Vec3(0, 0, -0.5)}},
              {0.5 + seconds, {Quat::Identity(), Vec3(0, 0, height - 0.5)}}},
             Interpolation::kSmooth, rubbing(0.5));
  const Vec3 size(0.4, 0.5, 0.3);
  const int box = w.add(Solid::box(size), lyingBox(size, Quat::Identity(), 0.3), Vec3::Zero(), Vec3::Zero(),
                        rubbing(0.5));
  w.start();
  StepView view;
  w.world.watch(&view);
  const double start = w.energy();
  const double m = w.world.mass(box);
  const double a = 4.0 * height / (seconds * seconds);
  const auto weight = [&] {
    double impulse = 0.0;
    for (const ContactView& contact : view.lasting) impulse += std::abs(contact.impulse_W.z());
    return impulse / w.world.settings().step_s;
  };
  w.run(1.0);
  EXPECT_NEAR(weight() / (m * (kGravity + a)), 1.0, 1e-6);
  w.run(1.0);
  EXPECT_NEAR(weight() / (m * (kGravity - a)), 1.0, 1e-6);
  const double height_now = w.state(box).X_WB.position.z();
  EXPECT_NEAR((w.energy() - start) / w.world.audit().work_J, 1.0, 1e-9);
  EXPECT_NEAR(w.world.audit().work_J, m * kGravity * height, 0.3 * m * kGravity * height);
  w.run(2.0);
  EXPECT_NEAR((w.energy() - start) / w.world.audit().work_J, 1.0, 1e-9);
  EXPECT_GT(w.state(box).X_WB.position.z(), height_now);
  EXPECT_EQ(w.state(box).mode, Mode::kResting) << "on an elevator that stands still";
}

TEST(KinematicBody, WakesWhatRestsOnItWhenItSetsOff) {
  KinematicWorld w({1.0 / 240.0, kDown});
  w.addAlong(Solid::box(Vec3(2, 2, 0.2)),
             {{3.0, {Quat::Identity(), Vec3(0, 0, -0.1)}}, {4.0, {Quat::Identity(), Vec3(0.5, 0, -0.1)}}},
             Interpolation::kSmooth, rubbing(0.5));
  const Vec3 size(0.4, 0.5, 0.3);
  Pose X = lyingBox(size, Quat::Identity(), 0.3);
  const int box = w.add(Solid::box(size), X, Vec3::Zero(), Vec3::Zero(), rubbing(0.5));
  X.position.z() += size.z() + restGap(size.minCoeff());
  const int upper = w.add(Solid::box(size), X, Vec3::Zero(), Vec3::Zero(), rubbing(0.5));
  w.start();
  w.run(2.5);
  EXPECT_EQ(w.state(box).mode, Mode::kResting);
  EXPECT_EQ(w.state(upper).mode, Mode::kResting);
  w.run(2.5);
  EXPECT_NEAR(w.state(box).X_WB.position.x(), 0.5, 1e-6);
  EXPECT_NEAR(w.state(upper).X_WB.position.x(), 0.5, 1e-6);
  EXPECT_EQ(w.state(upper).mode, Mode::kResting);
}

// It cannot push through a wall: it stops, is late, and goes on when the way is free.
TEST(KinematicPress, StopsRatherThanOverlap_AndSaysSo) {
  for (const double u : {0.05, 1.0}) {
    KinematicWorld w({1.0 / 240.0, kDown});
    w.addDriven(Solid::box(Vec3(0.4, 0.4, 0.2)), {Quat::Identity(), Vec3(0, 0, 0.6)}, Vec3(0, 0, -u),
                Vec3::Zero(), rubbing(0.5));
    w.addStatic(Solid::box(Vec3(4, 4, 1)), {Quat::Identity(), Vec3(0, 0, -0.5)}, rubbing(0.5));
    const Vec3 size(0.3, 0.3, 0.3);
    const int box = w.add(Solid::box(size), lyingBox(size, Quat::Identity(), 0.3), Vec3::Zero(), Vec3::Zero(),
                          rubbing(0.5));
    w.start();
    const double blocked_s = 0.5;
    w.run(0.2 / u + blocked_s);
    EXPECT_NEAR(w.world.audit().kinematic_late_s, blocked_s, 0.05 + 0.01 / u) << u;
    EXPECT_LT(w.state(box).linear_velocity.norm(), 2.0 * u);
    EXPECT_LT(w.state(box).X_WB.position.head<2>().norm(), 1e-2);
    EXPECT_GT(w.world.audit().last_step.stopped_kinematic, 0);
  }
}

// Boxes in a row between it and a wall: they lie still once it has stopped for them, as soon as they touch.
TEST(KinematicPress, LeavesARowThatItCannotPressAtRest) {
  KinematicWorld w({1.0 / 240.0, kDown});
  w.addStatic(Solid::box(Vec3(8, 8, 1)), {Quat::Identity(), Vec3(0, 0, -0.5)}, rubbing(0.3));
  w.addStatic(Solid::box(Vec3(1, 2, 2)), {Quat::Identity(), Vec3(2.0, 0, 1.0)}, rubbing(0.3));
  const double side = 0.3, u = 0.2;
  std::vector<int> boxes;
  for (int i = 0; i < 4; ++i)
    boxes.push_back(
        w.add(Solid::box(Vec3::Constant(side)),
              {Quat::Identity(), Vec3(1.5 - 1.02 * side * (i + 0.5), 0, 0.5 * side + restGap(side))},
              Vec3::Zero(), Vec3::Zero(), rubbing(0.3)));
  w.addDriven(Solid::box(Vec3(0.2, 1.0, 0.2)), {Quat::Identity(), Vec3(0.0, 0, 0.2)}, Vec3(u, 0, 0),
              Vec3::Zero(), rubbing(0.3));
  w.start();
  w.run(2.0);
  EXPECT_GT(w.world.audit().kinematic_late_s, 0.5);
  for (const int box : boxes) EXPECT_LT(w.state(box).linear_velocity.norm(), 0.01 * u) << box;
}

// A box between it and a wall: as it stops, its contacts are found anew for a press that stands. What they
// take of the box is at most the momentum that it had with the press, and what reopens a gap that is too
// small, not what comes of pressing it against the wall until the solver gives up.
TEST(KinematicPress, TakesNoMoreThanABoxsMomentumWhereItStops) {
  for (const double u : {0.02, 0.05})
    for (const double friction : {0.0, 0.3}) {
      SCOPED_TRACE(testing::Message() << u << " m/s, friction " << friction);
      KinematicWorld w({1.0 / 240.0, kDown});
      w.addStatic(Solid::box(Vec3(8, 8, 1)), {Quat::Identity(), Vec3(0, 0, -0.5)}, rubbing(friction));
      w.addStatic(Solid::box(Vec3(1, 2, 2)), {Quat::Identity(), Vec3(0.5, 0, 1.0)}, rubbing(friction));
      const double side = 0.3, gap = restGap(side), room = 0.005;
      const int box = w.add(Solid::box(Vec3::Constant(side)),
                            {Quat::Identity(), Vec3(-gap - 0.5 * side, 0, 0.5 * side + gap)}, Vec3::Zero(),
                            Vec3::Zero(), rubbing(friction));
      const int press = w.addDriven(Solid::box(Vec3(0.2, 1.0, 0.2)),
                                    {Quat::Identity(), Vec3(-2.0 * gap - room - side - 0.1, 0, 0.5 * side)},
                                    Vec3(u, 0, 0), Vec3::Zero(), rubbing(friction));
      w.start();
      StepView view;
      w.world.watch(&view);
      while (w.world.time() < room / u + 0.2) {
        const double late_s = w.world.audit().kinematic_late_s;
        w.world.step();
        if (w.world.audit().kinematic_late_s == late_s) continue;
        double pressed = 0.0;
        for (const ContactView& contact : view.lasting)
          if (contact.body_a == press || contact.body_b == press) pressed += std::abs(contact.impulse_W.x());
        ASSERT_LE(pressed, w.world.mass(box) * (u + tolerance::kGapSpeed)) << w.world.time();
      }
      EXPECT_GT(w.world.audit().kinematic_late_s, 0.1);
    }
}

TEST(KinematicBodies, StopAtStaticOnes) {
  KinematicWorld w({1.0 / 240.0, kDown});
  const int moved =
      w.addDriven(Solid::box(Vec3(0.4, 0.4, 0.4)), {oracle::turned(Vec3::UnitX(), 0.3), Vec3(0, 0, 1.0)},
                  Vec3(0, 0, -1), Vec3::Zero(), rubbing(0.5));
  w.addStatic(Solid::box(Vec3(4, 4, 1)), {Quat::Identity(), Vec3(0, 0, -0.5)}, rubbing(0.5));
  w.start();
  w.run(2.0);
  EXPECT_NEAR(w.state(moved).X_WB.position.z(), 0.2 * (std::cos(0.3) + std::sin(0.3)), 1e-3);
  EXPECT_EQ(w.state(moved).linear_velocity, Vec3::Zero());
  EXPECT_NEAR(w.world.audit().kinematic_late_s, 2.0 - (1.0 - w.state(moved).X_WB.position.z()), 1e-9);
}

TEST(KinematicWorlds, HaveTheSameBitsOnEveryNumberOfThreads) {
  std::vector<std::uint64_t> hashes;
  for (const int threads : {1, 3}) {
    WorldSettings settings{1.0 / 120.0, kDown};
    settings.threads = threads;
    KinematicWorld w(settings);
    w.addDriven(Solid::box(Vec3(6, 6, 0.2)), {Quat::Identity(), Vec3(0, 0, -0.1)}, Vec3::Zero(),
                Vec3(0, 0, 1), rubbing(0.5));
    for (int i = 0; i < 5; ++i)
      for (int j = 0; j < 5; ++j)
        w.add(Solid::box(Vec3(0.3, 0.4, 0.3)),
              {oracle::turned(Vec3(1, i, j).normalized(), 0.4), Vec3(i - 2, j - 2, 0.6)}, Vec3::Zero(),
              Vec3::Zero(), rubbing(0.5, 0.2));
    w.start();
    w.run(1.5);
    hashes.push_back(w.world.stateHash());
  }
  EXPECT_EQ(hashes[0], hashes[1]);
}

}  // namespace
}  // namespace carom::physics
