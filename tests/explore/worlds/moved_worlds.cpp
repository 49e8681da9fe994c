#include "tests/explore/worlds/moved_worlds.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/explore/random_shapes.h"

namespace carom::explore {
namespace {

using demos::Body;
using demos::Shape;
using oracle::Random;

class MovedMaker {
 public:
  explicit MovedMaker(std::uint64_t seed) : random_(seed * 0x9e3779b97f4a7c15ull + 7) {}

  ExploredWorld make() {
    constexpr double kRates[] = {60, 100, 240, 240, 500};
    world_.scene.rate_hz = kRates[random_.integer(0, 4)];
    size_ = oneIn(random_, 3) ? 1.0 : random_.logUniform(0.05, 10.0);
    steps_ = random_.integer(40, 110);
    const int family = random_.integer(0, 2);
    world_.family = family == 0 ? "kinematic" : family == 1 ? "locked" : "concave";
    addFloor();
    if (family == 0) fillMoved();
    if (family == 1) fillLocked();
    if (family == 2) fillConcave();
    return world_.lasting(steps_);
  }

 private:
  double length_s() const { return steps_ / world_.scene.rate_hz; }

  Body& add(Shape shape, const Pose& X) {
    return addBody(world_.scene, std::move(shape), X, anyMaterial(random_));
  }
  void addFloor() {
    Body& floor = add(boxOf(size_ * Vec3(20.0, 20.0, 1.0)), {Quat::Identity(), Vec3(0, 0, -0.5 * size_)});
    floor.is_static = true;
  }
  /// Each clear above those before it.
  void addTower(int count, double from_z, bool concave) {
    double top = from_z;
    for (int i = 0; i < count; ++i) {
      const double size = size_ * random_.uniform(0.2, 1.0);
      Shape shape = concave ? concaveOf(random_, size) : anyShape(random_, size);
      const double reach = 1.001 * reachOf(shape);
      const Vec3 place(0.4 * size_ * random_.uniform(-1, 1), 0.4 * size_ * random_.uniform(-1, 1),
                       top + reach);
      top += 2.0 * reach;
      Body& body = add(std::move(shape), {random_.rotation(), place});
      body.linear_velocity =
          Vec3(0, 0, -std::min(kLargestSpeed, random_.uniform(0.0, 2.0) * size_ / length_s()));
      if (oneIn(random_, 3))
        body.angular_velocity = random_.uniform(0.0, 6.0) / length_s() * random_.direction();
    }
  }

  // A slab, a blade or a plunger that goes its way under, through or onto what lies there.
  void fillMoved() {
    const int kind = random_.integer(0, 3);
    const double z = size_ * random_.uniform(0.3, 0.6);
    const Vec3 slab = size_ * Vec3(2.0, random_.uniform(0.2, 2.0), 0.2);
    Body& moved = add(boxOf(slab), {Quat::Identity(), Vec3(0, 0, z)});
    moved.is_kinematic = true;
    if (kind == 0)
      moved.linear_velocity =
          random_.uniform(0.2, 3.0) * size_ / length_s() * Vec3(1, random_.uniform(-1, 1), 0);
    if (kind == 1) moved.angular_velocity = Vec3(0, 0, random_.uniform(1.0, 20.0) / length_s());
    if (kind == 2) moved.angular_velocity = random_.uniform(0.1, 2.0) / length_s() * Vec3(1, 0, 0);
    if (kind == 3) moved.linear_velocity = Vec3(0, 0, random_.uniform(0.1, 2.0) * size_ / length_s());
    const bool keyed = oneIn(random_, 2) && kind != 2;
    if (keyed) {  // There and back again, at most to where it does not meet the floor.
      const Vec3 far = moved.linear_velocity * 0.5 * length_s();
      const Quat turned =
          oracle::turned(Vec3::UnitZ(), std::min(3.0, 0.5 * moved.angular_velocity.z() * length_s()));
      moved.keyframes = {{0.0, moved.X_WS},
                         {0.5 * length_s(), {turned, moved.X_WS.position + far}},
                         {length_s(), moved.X_WS}};
      moved.linear_velocity = moved.angular_velocity = Vec3::Zero();
      moved.interpolation = oneIn(random_, 2) ? Interpolation::kSmooth : Interpolation::kLinear;
      moved.path_repeats = oneIn(random_, 2);
      moved.X_WS = {};
    }
    addTower(random_.integer(1, 4), z + 1.5 * size_, oneIn(random_, 4));
  }

  void fillLocked() {
    addTower(random_.integer(1, 5), 0.1 * size_, oneIn(random_, 5));
    for (Body& body : world_.scene.bodies) {
      if (body.is_static) continue;
      lockAtRandom(random_, body);
      body.linear_velocity = body.locks.movingPart(body.linear_velocity);
      body.angular_velocity = body.locks.turningPart(body.angular_velocity);
      // What is light for its size would reach any speed at once.
      const auto* box = std::get_if<demos::BoxShape>(&body.shape.form);
      if (box == nullptr || box->size_m.minCoeff() < 0.25 * box->size_m.maxCoeff()) continue;
      const double weight = body.material.density_kgpm3 * box->size_m.prod() * 9.81;
      if (oneIn(random_, 2)) body.load.force_W = weight * random_.uniform(0.0, 1.0) * random_.direction();
      if (oneIn(random_, 2))
        body.load.torque_W =
            weight * box->size_m.minCoeff() * random_.uniform(0.0, 1.0) * random_.direction();
    }
  }

  void fillConcave() {
    if (oneIn(random_, 3)) {
      Shape shape = concaveOf(random_, 4.0 * size_);
      const double reach = reachOf(shape);
      Body& still = add(std::move(shape), {random_.rotation(), Vec3(0, 0, 1.001 * reach)});
      still.is_static = true;
      addTower(random_.integer(1, 4), 2.002 * reach, true);
    } else {
      addTower(random_.integer(2, 5), 0.0, true);
    }
  }

  Random random_;
  ExploredWorld world_;
  double size_ = 1.0;
  int steps_ = 0;
};

}  // namespace

ExploredWorld movedWorld(std::uint64_t seed) {
  return MovedMaker(seed).make();
}

}  // namespace carom::explore
