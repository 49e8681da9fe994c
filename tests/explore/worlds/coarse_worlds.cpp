#include "tests/explore/worlds/coarse_worlds.h"

#include <algorithm>
#include <cmath>

#include "tests/explore/random_shapes.h"

namespace carom::explore {
namespace {

using demos::Body;
using demos::Shape;
using oracle::Random;

constexpr double kSmallest_m = 2e-3;  // What any shape of the explorer can be made of.

// A few bodies scattered over a floor, or above each other.
class CoarseMaker {
 public:
  explicit CoarseMaker(std::uint64_t seed) : random_(seed * 0x9e3779b97f4a7c15ull + 17) {}

  ExploredWorld make() {
    world_.family = "coarse";
    size_ = random_.logUniform(kSmallest_m, 0.3);
    steps_ = random_.integer(10, 40);
    if (oneIn(random_, 2))
      chooseLongSteps();
    else
      chooseHeavyWeight();
    addFloor();
    const int count = random_.integer(1, 5);
    if (oneIn(random_, 2))
      addTower(count);
    else
      addScattered(count);
    if (oneIn(random_, 2)) hurlAll();
    return world_.lasting(steps_);
  }

 private:
  std::vector<Body>& bodies() { return world_.scene.bodies; }
  double length_s() const { return steps_ / world_.scene.rate_hz; }

  void chooseLongSteps() {
    constexpr double kRates[] = {10, 15, 20, 30};
    world_.scene.rate_hz = kRates[random_.integer(0, 3)];
    world_.scene.gravity = Vec3(0, 0, -9.81);
  }
  // Straight down or aslant.
  void chooseHeavyWeight() {
    constexpr double kRates[] = {30, 60, 120, 240};
    world_.scene.rate_hz = kRates[random_.integer(0, 3)];
    const double g = random_.logUniform(30.0, 1000.0);
    world_.scene.gravity = g * (oneIn(random_, 2) ? Vec3(0, 0, -1) : Vec3(0.3, 0, -0.95));
  }

  Body& add(Shape shape, const Pose& X) {
    return addBody(world_.scene, std::move(shape), X, anyMaterial(random_));
  }
  void addFloor() {
    Body& floor = add(boxOf(size_ * Vec3(20.0, 20.0, 1.0)), {Quat::Identity(), Vec3(0, 0, -0.5 * size_)});
    floor.is_static = true;
  }
  Shape someShape() {
    const double size = std::max(kSmallest_m, size_ * random_.uniform(0.2, 1.0));
    return oneIn(random_, 6) ? concaveOf(random_, size) : anyShape(random_, size);
  }

  // Each clear above those before it.
  void addTower(int count) {
    double top = 0.02 * size_;
    for (int i = 0; i < count; ++i) {
      Shape shape = someShape();
      const double reach = 1.001 * reachOf(shape);
      const Vec3 place(0.4 * size_ * random_.uniform(-1, 1), 0.4 * size_ * random_.uniform(-1, 1),
                       top + reach);
      top += 2.0 * reach;
      add(std::move(shape), {random_.rotation(), place});
    }
  }
  // Their bounding balls are clear of each other and of the floor.
  void addScattered(int count) {
    for (int i = 0; i < count; ++i) {
      Shape shape = someShape();
      const double reach = 1.001 * reachOf(shape);
      const Pose X = scatteredPose(random_, reach, std::span(bodies()).subspan(1), {2.0 * size_, 0.02, 1.0});
      add(std::move(shape), X);
    }
  }
  // Two sizes in the run, a radian a few times.
  void hurlAll() {
    for (std::size_t i = 1; i < bodies().size(); ++i) {
      Body& body = bodies()[i];
      const Vec3 towards = oneIn(random_, 2) ? Vec3(0, 0, -1) : random_.direction();
      body.linear_velocity = random_.uniform(0.0, 2.0) * size_ / length_s() * towards;
      if (oneIn(random_, 2))
        body.angular_velocity = random_.uniform(0.0, 6.0) / length_s() * random_.direction();
    }
  }

  Random random_;
  ExploredWorld world_;
  double size_ = 0.1;  ///< Of the largest bodies, m.
  int steps_ = 0;
};

}  // namespace

ExploredWorld coarseWorld(std::uint64_t seed) {
  return CoarseMaker(seed).make();
}

}  // namespace carom::explore
