#pragma once
// A pile of equal-sized bodies dropped into an open bin: the stress of lasting contact. Layers of a lattice,
// every body turned at random; the bin grows with the number, so that the heap's shape stays. Tested in
// tests/bench/bin_pile_test.cpp.

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/simulation/world.h"
#include "tests/oracle/test_shapes.h"

namespace carom::bench {

enum class PileOf { kHulls, kBoxes };

struct PilePlan {
  PileOf of = PileOf::kHulls;  ///< Hulls of 12 to 20 vertices and 1 m, or boxes of 0.5 m.
  int bodies = 1000;
  double friction = 0.5;
  double rate_hz = 60.0;
  std::uint64_t seed = 1;
  bool resting_mode = true;
  int threads = 1;
};

class BinPile {
 public:
  explicit BinPile(const PilePlan& plan)
      : plan_(plan),
        world_({.step_s = 1.0 / plan.rate_hz,
                .gravity = Vec3(0, 0, -9.81),
                .resting_mode = plan.resting_mode,
                .threads = plan.threads}) {
    material_ = {plan.friction, plan.friction, 0.0, 1000.0};
    const double pitch = plan.of == PileOf::kHulls ? 1.08 : 0.9;  // no body's ball meets its neighbour's
    const int side = std::max(1, static_cast<int>(std::lround(std::cbrt(plan.bodies))));
    half_width_m_ = 0.5 * side * pitch + 0.05;
    buildBin((plan.bodies / (side * side) + 3) * pitch);
    oracle::Random random(plan.seed);
    chooseSolids(random);
    for (int i = 0; i < plan.bodies; ++i) {
      const Vec3 cell(i % side, i / side % side, i / (side * side));
      const Vec3 place = pitch * (cell - 0.5 * Vec3(side - 1, side - 1, 0)) + Vec3(0, 0, 0.6 * pitch);
      const int solid = solids_[static_cast<std::size_t>(i) % solids_.size()];
      world_.addBody({solid, {random.rotation(), place}, Vec3::Zero(), Vec3::Zero(), material_, false});
    }
  }

  World& world() { return world_; }
  const World& world() const { return world_; }
  const PilePlan& plan() const { return plan_; }

  /// Bodies whose centre is no longer in the bin.
  int escaped() const {
    int n = 0;
    for (std::size_t i = 0; i < world_.states().size(); ++i) {
      const Vec3& p = world_.states()[i].X_WB.position;
      n += !world_.bodies()[i].is_static &&
           (std::max(std::abs(p.x()), std::abs(p.y())) > half_width_m_ || p.z() < 0.0);
    }
    return n;
  }

 private:
  void buildBin(double height_m) {
    const double outer = 2.0 * half_width_m_ + 2.0, beside = half_width_m_ + 0.5;
    wall({outer, outer, 1.0}, Vec3(0, 0, -0.5));
    for (double s : {-1.0, 1.0}) {
      wall({1.0, outer, height_m}, Vec3(s * beside, 0, 0.5 * height_m));
      wall({outer, 1.0, height_m}, Vec3(0, s * beside, 0.5 * height_m));
    }
  }
  void wall(const Vec3& size, const Vec3& position) {
    const int solid = world_.addSolid(Solid::box(size));
    world_.addBody({solid, {Quat::Identity(), position}, Vec3::Zero(), Vec3::Zero(), material_, true});
  }

  void chooseSolids(oracle::Random& random) {
    if (plan_.of == PileOf::kBoxes) {
      solids_.push_back(world_.addSolid(Solid::box(Vec3::Constant(0.5))));
      return;
    }
    constexpr int kKinds = 32;
    while (solids_.size() < std::size_t{kKinds}) {
      Solid hull = Solid::polyhedron(oracle::randomHull(random, random.integer(12, 20), Vec3::Constant(0.5)));
      if (hull.radius() < 0.53)
        solids_.push_back(world_.addSolid(std::move(hull)));  // its centre near the middle
    }
  }

  PilePlan plan_;
  World world_;
  Material material_;
  double half_width_m_ = 0.0;
  std::vector<int> solids_;
};

}  // namespace carom::bench
