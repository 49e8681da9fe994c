#include "tests/explore/worlds/driven_heaps.h"

#include <cmath>

#include "tests/explore/random_shapes.h"

namespace carom::explore {
namespace {

using demos::Body;
using demos::Shape;
using oracle::Random;

// A shaft of square section about z; what lies in it has its place in a lattice, whose cells hold it however
// it is turned.
class HeapMaker {
 public:
  explicit HeapMaker(std::uint64_t seed) : random_(seed * 0x9e3779b97f4a7c15ull + 11) {}

  ExploredWorld make() {
    constexpr double kRates[] = {60, 60, 100, 240};
    world_.scene.rate_hz = kRates[random_.integer(0, 3)];
    pitch_ = oneIn(random_, 3) ? 0.5 : random_.logUniform(0.02, 5.0);
    side_ = random_.integer(1, 3);
    layers_ = side_ == 1 ? random_.integer(2, 8) : random_.integer(1, 4);
    steps_ = random_.integer(60, 150);
    material_ = anyMaterial(random_);
    if (oneIn(random_, 3)) {  // of rolling, spinning or both
      material_.rolling_resistance_m = oneIn(random_, 3) ? 0.0 : pitch_ * random_.logUniform(1e-4, 0.1);
      material_.spinning_resistance_m = oneIn(random_, 3) ? 0.0 : pitch_ * random_.logUniform(1e-4, 0.1);
    }
    const int family = random_.integer(0, 2);
    world_.family = family == 0 ? "pressed" : family == 1 ? "mixed" : "guided";
    if (family == 0) press();
    if (family == 1) mix();
    if (family == 2) guide();
    return world_.lasting(steps_);
  }

 private:
  double length_s() const { return steps_ / world_.scene.rate_hz; }
  double width() const { return (side_ + 0.1) * pitch_; }
  double height() const { return layers_ * pitch_; }

  Body& add(Shape shape, const Pose& X) {
    return addBody(world_.scene, std::move(shape), X, oneIn(random_, 4) ? anyMaterial(random_) : material_);
  }
  Body& addBox(const Vec3& size, const Vec3& position) {
    return add(boxOf(size), {Quat::Identity(), position});
  }
  void addShaft() {
    const double wall = pitch_, high = 4.0 * (height() + pitch_);
    for (const double side : {-1.0, 1.0}) {
      const double beside = side * 0.5 * (width() + wall);
      addBox({wall, width() + 2.0 * wall, high}, {beside, 0, 0}).is_static = true;
      addBox({width(), wall, high}, {0, beside, 0}).is_static = true;
    }
  }
  void addFloor() {
    addBox({width() + 2.0 * pitch_, width() + 2.0 * pitch_, pitch_}, {0, 0, -0.5 * pitch_}).is_static = true;
  }
  void addHeap() {
    const bool boxes = oneIn(random_, 2);
    for (int i = 0; i < side_ * side_ * layers_; ++i) {
      const double size = pitch_ * random_.uniform(0.3, 0.9);
      Shape shape = boxes ? boxOf(size * Vec3(1.0, random_.uniform(0.4, 1.0), random_.uniform(0.4, 1.0)))
                          : anyShape(random_, size);
      const double reach = reachOf(shape);
      const Vec3 cell(i % side_ - 0.5 * (side_ - 1), i / side_ % side_ - 0.5 * (side_ - 1),
                      i / (side_ * side_) + 0.5);
      if (2.0 * reach > 0.999 * pitch_) shape = boxOf(Vec3::Constant(0.5 * pitch_));
      add(std::move(shape), {random_.rotation(), pitch_ * cell});
    }
  }
  // A piston that goes up by more than there is room for, below a lid that cannot, or will hardly, give way.
  void press() {
    addShaft();
    const double free = width() - 0.02 * pitch_;
    Body& piston = addBox({free, free, pitch_}, {0, 0, -0.5 * pitch_});
    piston.is_kinematic = true;
    piston.linear_velocity = Vec3(0, 0, random_.uniform(0.2, 2.0) * (height() + pitch_) / length_s());
    addHeap();
    Body& lid = addBox({free, free, 0.5 * pitch_}, {0, 0, height() + 0.5 * pitch_});
    const int kind = random_.integer(0, 3);
    if (kind == 0) lid.is_static = true;
    if (kind == 1) lid.material.density_kgpm3 *= 100.0;
    if (kind == 2) lockAtRandom(random_, lid);
    if (kind == 3) {
      lid.locks.free_axes.z() = 0.0;
      lid.locks.turning = AxisLocks::Turning::kLocked;
    }
  }

  // An arm that turns, or sweeps to and fro, among what falls on it.
  void mix() {
    addShaft();
    addFloor();
    addHeap();
    for (Body& body : world_.scene.bodies)
      if (!body.is_static) body.X_WS.position.z() += pitch_;
    const double reach = 0.95 * width();
    Body& arm = addBox({reach / std::sqrt(2.0), 0.2 * pitch_, 0.4 * pitch_}, {0, 0, 0.3 * pitch_});
    arm.is_kinematic = true;
    arm.angular_velocity = Vec3(0, 0, random_.logUniform(0.5, 40.0) / length_s());
  }

  // A heap in which bodies may not move as they would.
  void guide() {
    addShaft();
    addFloor();
    addHeap();
    for (Body& body : world_.scene.bodies)
      if (!body.is_static && oneIn(random_, 3)) lockAtRandom(random_, body);
  }

  Random random_;
  ExploredWorld world_;
  double pitch_ = 1.0;  ///< Of the lattice, metres.
  int side_ = 1;        ///< Of a layer, in cells.
  int layers_ = 1;
  int steps_ = 0;
  Material material_;
};

}  // namespace

ExploredWorld drivenHeap(std::uint64_t seed) {
  return HeapMaker(seed).make();
}

}  // namespace carom::explore
