#pragma once
// One shot at something solid, drawn at random from a seed: does it come out on the other side? The verdict
// is topological where the scene allows it (the far side of a wall, the far side of a box met squarely, out
// of a cage), so that it needs no geometry of ours; a rod let loose beside a post must at least have met it.
// The overlap oracle looks at every step's end. Tested in tests/bench/stress/tunnelling_trials_test.cpp.

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "tests/oracle/overlap_oracle.h"
#include "tests/oracle/test_shapes.h"

namespace carom::bench {

enum class Shot { kStaticWall, kMovingWall, kHeadOnSquare, kHeadOnAskew, kRodAtPost, kRodInCage };
inline constexpr int kShots = 6;
inline constexpr std::array<const char*, kShots> kShotNames = {
    "static wall", "moving wall", "head-on square", "head-on askew", "rod at a post", "rod in a cage"};

struct ShotResult {
  bool tunnelled = false;
  bool met = false;                                                 ///< The bodies have acted on each other.
  double smallest_gap_m = std::numeric_limits<double>::infinity();  ///< By the oracle, at the ends of steps.
  int steps = 0;
  int stalled = 0;     ///< Bodies stopped by a budget, over all steps.
  double speed = 0.0;  ///< m/s, or rad/s of a rod: for the report.
  double rate_hz = 0.0;
};

/// A trial: the world, and its question after every step.
class TunnellingTrial {
 public:
  TunnellingTrial(Shot shot, std::uint64_t seed)
      : random_(seed),
        shot_(shot),
        rate_hz_(kRates[static_cast<std::size_t>(random_.integer(0, 3))]),
        world_({1.0 / rate_hz_, Vec3::Zero(), true}) {
    const bool rod = shot == Shot::kRodAtPost || shot == Shot::kRodInCage;
    speed_ = rod ? random_.logUniform(1.0, 500.0) : random_.logUniform(1.0, 1e4);
    switch (shot) {
      case Shot::kStaticWall:
      case Shot::kMovingWall:
        setUpWall();
        break;
      case Shot::kHeadOnSquare:
      case Shot::kHeadOnAskew:
        setUpHeadOn();
        break;
      case Shot::kRodAtPost:
        setUpPost();
        break;
      case Shot::kRodInCage:
        setUpCage();
        break;
    }
  }

  ShotResult run() {
    ShotResult result;
    result.speed = speed_;
    result.rate_hz = rate_hz_;
    if (!world_.start().empty()) return result;  // nothing met: the caller counts it
    const Vec3 velocity = state(bodies_[0]).linear_velocity;
    const double energy = world_.audit().kinetic_energy_J;
    // As long as the shot needs to arrive, and a few steps more.
    const int steps = std::min(kMostSteps, static_cast<int>(arrival_s_ * rate_hz_) + 4);
    for (; result.steps < steps && !result.tunnelled; ++result.steps) {
      world_.step();
      result.stalled += world_.audit().last_step.stopped_bodies;
      result.smallest_gap_m = std::min(result.smallest_gap_m, oracle::smallestGap(world_).gap_m);
      result.tunnelled = beyond();
    }
    result.met = (state(bodies_[0]).linear_velocity - velocity).norm() > 1e-9 * speed_ ||
                 std::abs(world_.audit().kinetic_energy_J - energy) > 1e-9 * energy;
    return result;
  }

  const World& world() const { return world_; }

 private:
  static constexpr std::array<double, 4> kRates = {30.0, 60.0, 120.0, 240.0};
  static constexpr int kMostSteps = 1000;

  const BodyState& state(int body) const { return world_.states()[static_cast<std::size_t>(body)]; }

  int add(const Vec3& size, const Pose& X, const Vec3& velocity = Vec3::Zero(),
          const Vec3& spin = Vec3::Zero(), bool is_static = false) {
    const int solid = world_.addSolid(Solid::box(size));
    return world_.addBody({solid, X, velocity, spin, material_, is_static});
  }

  // A 0.1 m box at a wall of 2 cm. In the wall's frame it comes from -x and aims near the middle.
  void setUpWall() {
    const bool moves = shot_ == Shot::kMovingWall;
    const Quat turn = random_.rotation();
    const double wall_speed = moves ? random_.logUniform(0.1, 100.0) : 0.0;
    material_ = randomMaterial();
    bodies_[1] =
        add({0.02, 4.0, 4.0}, {turn, Vec3::Zero()}, turn * Vec3(-wall_speed, 0, 0), Vec3::Zero(), !moves);
    const Vec3 place(random_.uniform(-1.0, -0.2), random_.uniform(-0.3, 0.3), random_.uniform(-0.3, 0.3));
    const Vec3 drift(0.0, random_.uniform(-0.3, 0.3), random_.uniform(-0.3, 0.3));
    bodies_[0] =
        add(Vec3::Constant(0.1), {random_.rotation(), turn * place},
            turn * (speed_ * (Vec3::UnitX() + drift)), random_.logUniform(0.1, 300.0) * random_.direction());
    arrival_s_ = 1.0 / (speed_ + wall_speed);
  }

  // Two such boxes at each other: face to face and centre to centre, where they can never change sides, or
  // turned anyhow.
  void setUpHeadOn() {
    const bool square = shot_ == Shot::kHeadOnSquare;
    const Quat turn = random_.rotation();
    axis_ = turn * Vec3::UnitX();
    material_ = randomMaterial();
    const double other = random_.logUniform(1.0, 1e4);
    const double apart = random_.uniform(0.3, 1.0);
    const auto attitude = [&] { return square ? turn : random_.rotation(); };
    const auto spin = [&] {
      return square ? Vec3(Vec3::Zero()) : Vec3(random_.logUniform(0.1, 300.0) * random_.direction());
    };
    const Quat turn_a = attitude(), turn_b = attitude();
    const Vec3 spin_a = spin(), spin_b = spin();
    bodies_[0] = add(Vec3::Constant(0.1), {turn_a, -0.5 * apart * axis_}, speed_ * axis_, spin_a);
    bodies_[1] = add(Vec3::Constant(0.1), {turn_b, 0.5 * apart * axis_}, -other * axis_, spin_b);
    arrival_s_ = apart / (speed_ + other);
  }

  // A rod of 2 m that spins beside a static post within its reach.
  void setUpPost() {
    material_ = randomMaterial();
    const double bearing = random_.uniform(0.0, 2.0 * std::numbers::pi);
    const double away = random_.uniform(0.3, 0.8);
    bodies_[1] = add({0.1, 0.1, 1.0},
                     {oracle::turned(Vec3::UnitZ(), random_.uniform(0.0, 1.5)),
                      away * Vec3(std::cos(bearing), std::sin(bearing), 0.0)},
                     Vec3::Zero(), Vec3::Zero(), true);
    const double behind = random_.uniform(0.5, 2.6);  // radians to turn until they meet, less their widths
    bodies_[0] = add({2.0, 0.04, 0.04}, {oracle::turned(Vec3::UnitZ(), bearing - behind), Vec3::Zero()},
                     Vec3::Zero(), Vec3(0, 0, speed_));
    arrival_s_ = behind / speed_;
  }

  // A rod between four posts, two end walls and two plates: it can rattle, but never turn round or leave.
  void setUpCage() {
    material_ = {0.0, 0.0, random_.uniform(0.0, 1.0), 1000.0};
    bodies_[0] =
        add({2.0, 0.04, 0.04}, Pose{}, random_.uniform(0.0, 3.0) * random_.direction(), Vec3(0, 0, speed_));
    const auto bar = [&](const Vec3& size, const Vec3& position) {
      bodies_[1] = add(size, {Quat::Identity(), position}, Vec3::Zero(), Vec3::Zero(), true);
    };
    for (double x : {-0.6, 0.6})
      for (double y : {-0.2, 0.2}) bar({0.1, 0.1, 1.0}, {x, y, 0.0});
    for (double side : {-1.0, 1.0}) {
      bar({0.02, 4.0, 4.0}, {side * 1.1, 0.0, 0.0});
      bar({4.0, 4.0, 0.02}, {0.0, 0.0, side * 0.12});
    }
    arrival_s_ = 0.25 + 1.0 / speed_;
  }

  Material randomMaterial() {
    const double friction = random_.uniform(0.0, 0.8);
    return {friction, friction, random_.uniform(0.0, 1.0), 1000.0};
  }

  bool beyond() const {
    const Pose &X_W0 = state(bodies_[0]).X_WB, &X_W1 = state(bodies_[1]).X_WB;
    switch (shot_) {
      case Shot::kStaticWall:
      case Shot::kMovingWall: {
        const Vec3 p = X_W1.inverse() * X_W0.position;
        return p.x() > 0.0 && std::abs(p.y()) < 1.9 && std::abs(p.z()) < 1.9;
      }
      case Shot::kHeadOnSquare:
        return axis_.dot(X_W1.position - X_W0.position) <= 0.0;
      case Shot::kRodInCage: {
        const Vec3 along = X_W0.rotation * Vec3::UnitX();
        return along.x() < 0.7 || (X_W0.position.cwiseAbs() - Vec3(0.2, 0.3, 0.2)).maxCoeff() > 0.0;
      }
      case Shot::kHeadOnAskew:  // having met, they may glance off and pass beside each other
      case Shot::kRodAtPost:
        return false;
    }
    return false;
  }

  oracle::Random random_;
  Shot shot_;
  double rate_hz_;
  World world_;
  Material material_;
  std::array<int, 2> bodies_{-1, -1};
  double speed_ = 0.0, arrival_s_ = 0.0;
  Vec3 axis_ = Vec3::UnitX();
};

/// Trial `number` of a run: its kind and seed follow from it.
inline Shot shotOf(long number) {
  return static_cast<Shot>(number % kShots);
}
inline std::uint64_t seedOf(std::uint64_t seed, long number) {
  return seed * 0x9e3779b97f4a7c15ull + static_cast<std::uint64_t>(number);
}

}  // namespace carom::bench
