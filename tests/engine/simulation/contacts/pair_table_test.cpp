// What the table pairs and looks at, against asking all shapes.

#include "engine/simulation/contacts/pair_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <set>

#include "tests/oracle/every_pair.h"
#include "tests/oracle/test_shapes.h"

namespace carom {
namespace {

using oracle::Random;

// Bodies of one or two parts, some of them static, thrown anew into a room for every step.
class ManyBodies {
 public:
  ManyBodies(Random& random, int bodies, double room_m = 8.0)
      : room_m_(room_m), random_(random), bodies_(static_cast<std::size_t>(bodies)) {
    settings_.step_s = 0.1;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const int body = static_cast<int>(i);
      all_.push_back(body);
      bodies_[i].is_static = i % 10 == 9;
      bodies_[i].X_WB = bodies_[i].path.X_WB = random_.pose(room_m_);
      shapes_.push_back({body, &block_.parts()[0], block_.radius(), kWidth});
      if (i % 3 == 0) shapes_.push_back({body, &beam_.parts()[0], beam_.radius(), kWidth});
    }
  }

  void beginStep() {
    for (Body& body : bodies_) {
      if (body.is_static) continue;
      body.path = Trajectory{0.0, random_.pose(room_m_), random_.direction()};
      body.X_WB = body.path.X_WB;
    }
    collect();
  }
  // All go on from where they are, side by side but for `most_mps` and so many radians a second.
  void goOn(double most_mps) {
    const Vec3 together = 10.0 * random_.direction();
    for (Body& body : bodies_) {
      if (body.is_static) continue;
      const Pose X_WB = body.path.at(settings_.step_s);
      body.path = Trajectory{0.0, X_WB, together + random_.uniform(0.0, most_mps) * random_.direction()};
      body.path.acceleration = settings_.gravity;
      body.path.spin = random_.uniform(0.0, most_mps) * random_.direction();
      body.X_WB = X_WB;
    }
    collect();
  }
  void collect() {
    table_.requery(world(), counters_);
    table_.updateBounds(bodies_, shapes_, all_, settings_.step_s, crew_);
    table_.collect(world(), counters_, nullptr);
  }

  // A body goes elsewhere.
  void turnOne(double time_s, int index) {
    Body& body = bodies_[static_cast<std::size_t>(index)];
    const Pose X_WB = body.path.at(time_s);
    const double speed_mps = random_.logUniform(1.0, 100.0);
    body.path = Trajectory{time_s, X_WB, speed_mps * random_.direction()};
    table_.extend(std::vector<int>{index}, time_s, world(), counters_);
  }

  std::vector<IndexPair> bodyPairs() const {
    std::vector<IndexPair> pairs;
    for (const BodyPair& pair : table_.bodyPairs())
      if (!pair.isFree()) pairs.push_back({pair.body_a, pair.body_b});
    std::sort(pairs.begin(), pairs.end());
    return pairs;
  }
  // Of all shapes that are not near, those that could touch on their paths from a time on, as far as moments
  // of these tell: of one body, or of all.
  std::vector<IndexPair> missed(double begin_s, int body = -1) const {
    std::set<IndexPair> near;
    for (const int place : table_.active())
      near.insert(table_.pairs()[static_cast<std::size_t>(place)].shapes);
    std::vector<IndexPair> missed;
    for (int i = 0; i < static_cast<int>(shapes_.size()); ++i)
      for (int j = i + 1; j < static_cast<int>(shapes_.size()); ++j) {
        const int a = shapes_[static_cast<std::size_t>(i)].body,
                  b = shapes_[static_cast<std::size_t>(j)].body;
        if (a == b || (body >= 0 && a != body && b != body) || near.contains({i, j})) continue;
        if (bodies_[static_cast<std::size_t>(a)].is_static && bodies_[static_cast<std::size_t>(b)].is_static)
          continue;
        if (smallestGap({i, j}, begin_s, {}) <= 0.0) missed.push_back({i, j});
      }
    return missed;
  }
  // Every second body comes to rest where it is, and the pairs are collected again.
  void restHalf() {
    std::vector<int> active;
    for (const int body : all_) {
      Body& b = bodies_[static_cast<std::size_t>(body)];
      b.active = body % 2 == 0;
      b.resting = !b.active && !b.is_static;
      if (b.active) active.push_back(body);
    }
    table_.updateBounds(bodies_, shapes_, active, settings_.step_s, crew_);
    table_.collect(world(), counters_, nullptr);
  }
  void wake(int body) {
    bodies_[static_cast<std::size_t>(body)].active = true;
    bodies_[static_cast<std::size_t>(body)].resting = false;
    table_.activate(body, bodies_, settings_);
  }
  bool hasActiveBody(const ShapePair& pair) const {
    return bodies_[static_cast<std::size_t>(pair.body_a)].active ||
           bodies_[static_cast<std::size_t>(pair.body_b)].active;
  }
  PairTable& table() { return table_; }
  const Body& body(int index) const { return bodies_[static_cast<std::size_t>(index)]; }
  bool pathsMeetOthers() { return !table_.bodiesThatMeetOthers(world(), all_, settings_.step_s).empty(); }
  // The least gap of shapes from a time of the step on, as far as moments of it tell.
  double smallestGap(const IndexPair& of, double begin_s, FeaturePair tracked) const {
    double smallest = std::numeric_limits<double>::infinity();
    for (int k = 0; k <= 10; ++k) {
      const double t = begin_s + (settings_.step_s - begin_s) * k / 10;
      const Shape &a = shapes_[static_cast<std::size_t>(of.a)], &b = shapes_[static_cast<std::size_t>(of.b)];
      const auto poseOf = [&](int body) { return bodies_[static_cast<std::size_t>(body)].path.at(t); };
      smallest = std::min(
          smallest, closestFeatures(*a.part, poseOf(a.body), *b.part, poseOf(b.body), tracked).distance_m);
    }
    return smallest;
  }
  // Of what is apart, beyond where contacts begin; those of all such.
  std::vector<double> roomsFrom(double begin_s) const {
    std::vector<double> rooms;
    for (const BodyPair& pair : table_.bodyPairs())
      for (const ApartPieces& apart : pair.apart)
        rooms.push_back(smallestGap(apart.shapes, begin_s, apart.tracked) -
                        pair.contactHeight(settings_.step_s));
    return rooms;
  }
  const PairTable& table() const { return table_; }

 private:
  static constexpr double kWidth = 0.2;

  PairedWorld world() { return {bodies_, shapes_, settings_, crew_}; }

  double room_m_;
  Random& random_;
  Solid block_ = Solid::box({0.5, 0.6, 0.7});
  Solid beam_ = Solid::box({3.0, 0.2, 0.2});
  std::vector<Body> bodies_;
  std::vector<int> all_;
  std::vector<Shape> shapes_;
  WorldSettings settings_;
  StepCounters counters_;
  PairTable table_;
  Crew crew_;
};

/// Of a ball of 5 mm on the ground, in steps of gravity.
double collisionSpeedOfABall(double restitution, bool supported) {
  const Solid ball = Solid::ball(5e-3), ground = Solid::box(Vec3::Ones());
  const WorldSettings settings{.step_s = 1.0 / 240.0};
  std::vector<Body> bodies(2);
  bodies[0].is_static = true;
  bodies[0].material.restitution = 0.0;
  bodies[1].material.restitution = restitution;
  bodies[1].supported = supported;
  bodies[1].pull = pullOf({}, settings.gravity, bodies[1].inertia, ball.radius());
  bodies[0].X_WB.position = bodies[0].path.X_WB.position = Vec3(0, 0, -0.5);
  bodies[1].X_WB.position = bodies[1].path.X_WB.position = Vec3(0, 0, 5.01e-3);
  const std::vector<Shape> shapes{{0, &ground.parts()[0], ground.radius(), 1e300},
                                  {1, &ball.parts()[0], ball.radius(), 1e-2}};
  PairTable table;
  Crew crew;
  StepCounters counters;
  table.updateBounds(bodies, shapes, std::vector<int>{0, 1}, settings.step_s, crew);
  table.collect({bodies, shapes, settings, crew}, counters, nullptr);
  return table.pairs().at(0).collision_speed_mps / (settings.gravity.norm() * settings.step_s);
}

// A bounce that is thrown up at so many steps of gravity lasts twice as many steps.
TEST(CollisionSpeed, OfWhatLiesOnOthers_LeavesElasticBouncesOfASixteenthOfAStep) {
  EXPECT_LT(collisionSpeedOfABall(1.0, true), 0.5 / 14.0);
  EXPECT_GT(collisionSpeedOfABall(1.0, true), 0.5 / 18.0);
  EXPECT_GT(collisionSpeedOfABall(0.0, true), 1.0) << "what does not bounce lands";
  EXPECT_LT(collisionSpeedOfABall(1.0, false), collisionSpeedOfABall(1.0, true)) << "nothing brings it back";
}

// Neither on the paths that are planned nor on those that events give them.
TEST(PairTable, PairsTheBodiesThatAskingAllBoundsFinds_AndMissesNoShapes) {
  Random random(44);
  ManyBodies bodies(random, 100);
  for (int step = 0; step < 10; ++step) {
    bodies.beginStep();
    ASSERT_EQ(bodies.missed(0.0), std::vector<IndexPair>{}) << "step " << step;
    for (int event = 0; event < 40; ++event) {
      const int body = 10 * random.integer(0, 9) + random.integer(0, 8);  // not a static one
      bodies.turnOne(0.002 * event, body);
      ASSERT_EQ(bodies.missed(0.002 * event, body), std::vector<IndexPair>{})
          << "step " << step << " event " << event;
      if (event == 0) {
        ASSERT_FALSE(bodies.pathsMeetOthers());
      }
    }
    EXPECT_EQ(bodies.bodyPairs(), oracle::everyPair(bodies.table().proxies())) << "step " << step;
  }
}

// What is known of pieces is used for many steps in which bodies hardly move against each other.
TEST(PairTable, MissesNothingThatComesNearByAndBy) {
  Random random(48);
  ManyBodies bodies(random, 60, 4.0);
  bodies.beginStep();
  std::size_t kept = 0, measured = 0;
  for (int step = 0; step < 120; ++step) {
    bodies.goOn(step % 20 == 19 ? 3.0 : 0.002);
    ASSERT_EQ(bodies.missed(0.0), std::vector<IndexPair>{}) << "step " << step;
    for (const double room : bodies.roomsFrom(0.0)) ASSERT_GT(room, 0.0) << "step " << step;
    bodies.turnOne(0.05, 1);
    ASSERT_EQ(bodies.missed(0.05, 1), std::vector<IndexPair>{}) << "step " << step;
    for (const BodyPair& pair : bodies.table().bodyPairs()) {
      if (pair.apart.empty()) continue;
      const Body& a = bodies.body(pair.body_a);
      const Body& b = bodies.body(pair.body_b);
      ++(pair.room.since.offset_m == b.X_WB.position - a.X_WB.position ? measured : kept);
    }
  }
  EXPECT_GT(kept, measured) << "few have to be looked at again";
}

// Two bodies of two pieces each, one above the other.
class Fall {
 public:
  explicit Fall(double gap_m) {
    for (const int body : {0, 1}) {
      bodies_[static_cast<std::size_t>(body)].path.X_WB.position.z() = body * (1.0 + gap_m);
      bodies_[static_cast<std::size_t>(body)].material.restitution = 1.0;  // contact begins low
      for (const Solid& part : parts_) shapes_.push_back({body, &part.parts()[0], part.radius(), 0.2});
    }
  }
  // One more step, in which they fall so fast; how many pairs of their pieces are candidates.
  int step(double lower_mps, double upper_mps) {
    for (const int body : {0, 1}) {
      Body& b = bodies_[static_cast<std::size_t>(body)];
      const Pose X_WB = b.path.at(b.path.start_s + kStep);
      b.path =
          Trajectory{0.0, steps_ > 0 ? X_WB : b.path.X_WB, Vec3(0, 0, body == 0 ? -lower_mps : -upper_mps)};
      b.path.acceleration = Vec3(0, 0, -10);
      b.X_WB = b.path.X_WB;
    }
    ++steps_;
    StepCounters counters;
    table_.requery(world(), counters);
    table_.updateBounds(bodies_, shapes_, std::vector<int>{0, 1}, kStep, crew_);
    table_.collect(world(), counters, nullptr);
    return counters.candidate_pairs;
  }
  const BodyPair& pair() const { return table_.bodyPairs().at(0); }

 private:
  static constexpr double kStep = 1.0 / 60.0;
  PairedWorld world() { return {bodies_, shapes_, settings_, crew_}; }

  WorldSettings settings_{.step_s = kStep};
  std::vector<Solid> parts_{Solid::box({1, 1, 1}), Solid::box({0.9, 0.9, 0.9})};
  std::vector<Body> bodies_ = std::vector<Body>(2);
  std::vector<Shape> shapes_;
  PairTable table_;
  Crew crew_;
  int steps_ = 0;
};

TEST(PairTable, WhatFallsSideBySide_HasNoPiecesToLookAt) {
  EXPECT_EQ(Fall(0.3).step(60.0, 60.0), 0) << "a metre a step, the same for both";
  EXPECT_GT(Fall(0.3).step(0.0, 60.0), 0) << "one falls on the other";
}

TEST(PairTable, LooksAgainWhenBodiesHaveMovedAgainstEachOtherByTheRoomThereWas) {
  Fall fall(4e-3);
  EXPECT_EQ(fall.step(5.0, 5.0), 1);
  const auto offset = [&] { return fall.pair().room.since.offset_m.z(); };
  const double first = offset();
  EXPECT_NEAR(fall.pair().room.gap_m, 4e-3, 1e-12);
  for (int step = 0; step < 10; ++step) fall.step(5.0, 5.0);
  EXPECT_EQ(offset(), first) << "they hardly move against each other";
  for (int step = 0; step < 4; ++step) fall.step(5.0, 5.03);
  EXPECT_LT(offset(), first - 4e-4) << "half a millimetre a step";
}

// Bounds of a shape that turns slowly are not made anew in every step.
TEST(PairTable, HoldsWhatTurnsSlowly_InHardlyMoreThanItNeeds) {
  constexpr double kWidth = 0.4, kMargin = 2.0 * tolerance::kManifoldHeight * kWidth;
  const Solid block = Solid::box({kWidth, 0.5, 0.7});
  const ConvexPart& part = block.parts()[0];
  const std::vector<Shape> shapes{{0, &part, block.radius(), kWidth}};
  std::vector<Body> bodies(1);
  Random random(47);
  PairTable table;
  Crew crew;
  const double turn = 0.2 * kMargin / block.radius();  // in a step
  Trajectory& path = bodies[0].path;
  for (int step = 0; step < 500; ++step) {
    path = Trajectory{0.0, {path.at(1.0).rotation, 0.1 * random.direction()}};
    path.spin = turn * random.direction();
    table.updateBounds(bodies, shapes, std::vector<int>{0}, 1.0, crew);
    const Bounds& bounds = table.proxies()[0].bounds;
    for (const double t : {0.0, 0.5, 1.0}) {
      Vec3 low = Vec3::Constant(1e9), high = -low;
      for (int v = 0; v < part.core.vertexCount(); ++v) {
        const Vec3 p_W = path.at(t) * part.core.vertex(v);
        low = low.cwiseMin(p_W);
        high = high.cwiseMax(p_W);
      }
      ASSERT_GE((low - bounds.low).minCoeff(), 0.5 * kMargin) << step;
      ASSERT_GE((bounds.high - high).minCoeff(), 0.5 * kMargin) << step;
      ASSERT_LE((low - bounds.low).maxCoeff(), 4.0 * kMargin) << step;
      ASSERT_LE((bounds.high - high).maxCoeff(), 4.0 * kMargin) << step;
    }
  }
}

// Neither on the paths that are planned nor on those that events give them.
TEST(PairTable, LooksAtAllThatComesNearWithinTheStep) {
  Random random(46);
  ManyBodies bodies(random, 200);
  std::size_t apart = 0, near = 0;
  const auto expectRoom = [&](double time_s) {
    near += bodies.table().active().size();
    for (const double room : bodies.roomsFrom(time_s)) {
      ++apart;
      ASSERT_GT(room, 0.0) << "at " << time_s;
    }
  };
  for (int step = 0; step < 20; ++step) {
    bodies.beginStep();
    ASSERT_NO_FATAL_FAILURE(expectRoom(0.0));
    for (int event = 0; event < 10; ++event) {
      bodies.turnOne(0.009 * event, 10 * random.integer(0, 19) + random.integer(0, 8));
      ASSERT_NO_FATAL_FAILURE(expectRoom(0.009 * event));
    }
  }
  EXPECT_GT(apart, 20000u);
  EXPECT_GT(near, 20000u);
}

// What rests keeps its pairs, at their places, with what they remember; nobody looks at them. When it wakes
// they are in the order they were in, and their impulses are those of steps as long as they are now.
TEST(PairTable, KeepsThePairsOfWhatRests_AndBringsThemBackWhenItWakes) {
  Random random(45);
  ManyBodies bodies(random, 100);
  bodies.beginStep();
  PairTable& table = bodies.table();
  const std::vector<int> before = table.all(), near = table.active();
  for (const int place : near)
    table.pairs()[static_cast<std::size_t>(place)].remembered.push_back({.impulse_W = Vec3(0, 0, place + 1)});
  bodies.restHalf();
  EXPECT_EQ(table.all(), before);
  for (const int place : table.active())
    EXPECT_TRUE(bodies.hasActiveBody(table.pairs()[static_cast<std::size_t>(place)]));
  ASSERT_LT(table.active().size(), before.size()) << "some pairs rest";
  table.scaleImpulses(0.5);
  table.scaleImpulses(0.5);
  for (int body = 1; body < 100; body += 2)
    if (body % 10 != 9) bodies.wake(body);
  EXPECT_EQ(table.active().size(), before.size());
  for (const int place : near) {
    const ShapePair& pair = table.pairs()[static_cast<std::size_t>(place)];
    ASSERT_EQ(pair.remembered.size(), 1u);
    EXPECT_EQ(pair.remembered[0].impulse_W.z(), 0.25 * (place + 1));
  }
  for (int body = 0; body < 100; ++body) {
    const std::vector<int>& of_body = table.pairsOf(body);
    EXPECT_TRUE(std::is_sorted(of_body.begin(), of_body.end(), [&](int p, int q) {
      return table.pairs()[static_cast<std::size_t>(p)].shapes <
             table.pairs()[static_cast<std::size_t>(q)].shapes;
    }));
  }
}

}  // namespace
}  // namespace carom
