// The pairs that a step's events add, against asking all shapes.

#include "engine/simulation/contacts/pair_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "tests/oracle/test_shapes.h"

namespace carom {
namespace {

using oracle::Random;

// Bodies of one or two parts, some of them static, thrown anew into a room for every step.
class ManyBodies {
 public:
  ManyBodies(Random& random, int bodies) : random_(random), bodies_(static_cast<std::size_t>(bodies)) {
    settings_.step_s = 0.1;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const int body = static_cast<int>(i);
      all_.push_back(body);
      bodies_[i].is_static = i % 10 == 9;
      bodies_[i].X_WB = bodies_[i].path.X_WB = random_.pose(kRoom);
      shapes_.push_back({body, &block_.parts()[0], block_.radius()});
      if (i % 3 == 0) shapes_.push_back({body, &beam_.parts()[0], beam_.radius()});
    }
  }

  void beginStep() {
    for (Body& body : bodies_) {
      if (body.is_static) continue;
      body.path = Trajectory{0.0, random_.pose(kRoom), random_.direction()};
      body.X_WB = body.path.X_WB;
    }
    table_.requery(world(), counters_);
    table_.updateBounds(bodies_, shapes_, all_, settings_.step_s, crew_);
    table_.collect(world(), counters_, nullptr);
  }

  // A body goes elsewhere; the candidates that this adds.
  std::vector<IndexPair> turnOne(double time_s, int index) {
    Body& body = bodies_[static_cast<std::size_t>(index)];
    const Pose X_WB = body.path.at(time_s);
    const double speed_mps = random_.logUniform(1.0, 100.0);
    body.path = Trajectory{time_s, X_WB, speed_mps * random_.direction()};
    const std::size_t before = table_.candidates().size();
    table_.extend(std::vector<int>{index}, time_s, world(), counters_);
    std::vector<IndexPair> added;
    for (const int place : std::span(table_.candidates()).subspan(before))
      added.push_back(table_.pairs()[static_cast<std::size_t>(place)].shapes);
    return added;
  }

  // The pairs of a body that are not known yet, by its shapes, and for each by the other one.
  std::vector<IndexPair> missing(int body, const std::vector<IndexPair>& known) const {
    std::vector<IndexPair> pairs;
    const std::vector<Proxy>& proxies = table_.proxies();
    for (std::size_t i = 0; i < proxies.size(); ++i)
      for (std::size_t j = 0; j < proxies.size(); ++j) {
        if (shapes_[i].body != body || !canPair(proxies[i], proxies[j])) continue;
        const IndexPair pair{static_cast<int>(std::min(i, j)), static_cast<int>(std::max(i, j))};
        if (std::find(known.begin(), known.end(), pair) == known.end()) pairs.push_back(pair);
      }
    return pairs;
  }

  std::vector<IndexPair> pairs() const {
    std::vector<IndexPair> pairs;
    for (const int place : table_.all())
      pairs.push_back(table_.pairs()[static_cast<std::size_t>(place)].shapes);
    return pairs;
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
  bool pathsMeetOthers() { return !table_.bodiesThatMeetOthers(world(), all_, settings_.step_s).empty(); }
  // The least gap of a pair from a time of the step on, as far as moments of it tell, beyond where contacts
  // begin.
  double roomOf(const ShapePair& pair, double begin_s) const {
    double smallest = std::numeric_limits<double>::infinity();
    FeaturePair tracked = pair.tracked;
    for (int k = 0; k <= 10; ++k) {
      const double t = begin_s + (settings_.step_s - begin_s) * k / 10;
      const auto poseOf = [&](int body) { return bodies_[static_cast<std::size_t>(body)].path.at(t); };
      const auto partOf = [&](int shape) { return *shapes_[static_cast<std::size_t>(shape)].part; };
      smallest = std::min(smallest, closestFeatures(partOf(pair.shapes.a), poseOf(pair.body_a),
                                                    partOf(pair.shapes.b), poseOf(pair.body_b), tracked)
                                        .distance_m);
    }
    return smallest - pair.contactHeight(settings_.step_s);
  }
  const PairTable& table() const { return table_; }

 private:
  static constexpr double kRoom = 8.0;

  PairedWorld world() { return {bodies_, shapes_, settings_, crew_}; }

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

TEST(PairTable, ExtendsByThePairsThatAskingAllShapesFinds_InTheirOrder) {
  Random random(44);
  ManyBodies bodies(random, 100);
  std::size_t added_in_all = 0;
  for (int step = 0; step < 10; ++step) {
    bodies.beginStep();
    for (int event = 0; event < 40; ++event) {
      const int body = 10 * random.integer(0, 9) + random.integer(0, 8);  // not a static one
      const std::vector<IndexPair> known = bodies.pairs();
      const std::vector<IndexPair> added = bodies.turnOne(0.002 * event, body);
      ASSERT_EQ(added, bodies.missing(body, known)) << "step " << step << " event " << event;
      if (event == 0) {
        ASSERT_FALSE(bodies.pathsMeetOthers());
      }
      added_in_all += added.size();
    }
    std::vector<IndexPair> pairs = bodies.pairs();
    std::sort(pairs.begin(), pairs.end());
    EXPECT_EQ(pairs, candidatePairs(bodies.table().proxies())) << "step " << step;
  }
  EXPECT_GT(added_in_all, 1000u);
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
    for (const int place : bodies.table().candidates()) {
      const ShapePair& pair = bodies.table().pairs()[static_cast<std::size_t>(place)];
      ++(pair.near ? near : apart);
      if (!pair.near) {
        ASSERT_GT(bodies.roomOf(pair, time_s), 0.0) << "at " << time_s;
      }
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
  ASSERT_LT(table.candidates().size(), before.size()) << "some pairs rest";
  table.scaleImpulses(0.5);
  table.scaleImpulses(0.5);
  for (int body = 1; body < 100; body += 2)
    if (body % 10 != 9) bodies.wake(body);
  EXPECT_EQ(table.candidates().size(), before.size());
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
