#include "tests/explore/worlds/ice_worlds.h"

#include <algorithm>

#include "tests/explore/random_shapes.h"

namespace carom::explore {
namespace {

using demos::Body;
using demos::Shape;
using oracle::Random;

constexpr double kSmallest_m = 2e-3;  // What any shape of the explorer can be made of.
constexpr double kFloorSize = 100.0;  // In sizes of bodies: few leave it within a run.

// A few bodies that slide, tumble and land on ice.
class IceMaker {
 public:
  explicit IceMaker(std::uint64_t seed) : random_(seed * 0x9e3779b97f4a7c15ull + 23) {}

  ExploredWorld make() {
    constexpr double kRates[] = {20, 30, 60, 60, 120, 240, 240, 500};
    world_.family = "ice";
    world_.scene.rate_hz = kRates[random_.integer(0, 7)];
    size_ = oneIn(random_, 3) ? 1.0 : random_.logUniform(5e-3, 10.0);
    steps_ = random_.integer(30, 100);
    rubs_ = oneIn(random_, 3);
    chooseGravity();
    addFloor();
    const int count = oneIn(random_, 2) ? 1 : random_.integer(2, 6);
    if (oneIn(random_, 2))
      addTower(count);
    else
      addScattered(count);
    for (std::size_t i = 1; i < bodies().size(); ++i) hurl(bodies()[i]);
    if (oneIn(random_, 2)) turnAll(random_.rotation());
    return world_.lasting(steps_);
  }

 private:
  std::vector<Body>& bodies() { return world_.scene.bodies; }
  double length_s() const { return steps_ / world_.scene.rate_hz; }

  // One in eight is a slope: weights have a part along the floor.
  void chooseGravity() {
    const double g = oneIn(random_, 2) ? 9.81 : random_.logUniform(0.1, 10.0) * size_ * 10.0;
    world_.scene.gravity = g * (oneIn(random_, 8) ? Vec3(0.1, 0.2, -0.97) : Vec3(0, 0, -1));
  }
  // Of the floor and all bodies, a floor without friction has none with any of them.
  Body& add(Shape shape, const Pose& X) {
    Body& body = addBody(world_.scene, std::move(shape), X, anyMaterial(random_));
    if (!rubs_ || bodies().size() == 1) body.material.static_friction = body.material.dynamic_friction = 0.0;
    if (bodies().size() == 1 && oneIn(random_, 2)) body.material.restitution = 0.0;
    return body;
  }
  void addFloor() {
    const Vec3 floor = size_ * Vec3(kFloorSize, kFloorSize, 1.0);
    add(boxOf(floor), {Quat::Identity(), Vec3(0, 0, -0.5 * size_)}).is_static = true;
  }
  Shape someShape() {
    const double size = std::max(kSmallest_m, size_ * random_.uniform(0.2, 1.0));
    return oneIn(random_, 8) ? concaveOf(random_, size) : anyShape(random_, size);
  }

  // Each clear above those before it.
  void addTower(int count) {
    double top = size_ * random_.logUniform(1e-4, 0.3);
    for (int i = 0; i < count; ++i) {
      Shape shape = someShape();
      const double reach = 1.001 * reachOf(shape);
      const double y = 0.3 * size_ * random_.uniform(-1, 1), x = 0.3 * size_ * random_.uniform(-1, 1);
      const Vec3 place(x, y, top + reach);
      top += 2.0 * reach;
      add(std::move(shape), {random_.rotation(), place});
    }
  }
  // Their bounding balls are clear of each other and of the floor.
  void addScattered(int count) {
    for (int i = 0; i < count; ++i) {
      Shape shape = someShape();
      const double reach = 1.001 * reachOf(shape);
      const Pose X = scatteredPose(random_, reach, std::span(bodies()).subspan(1), {1.5 * size_, 1e-3, 0.5});
      add(std::move(shape), X);
    }
  }
  // Towards the middle, up to five sizes in the run, and turning by up to some radians a step.
  void hurl(Body& body) {
    const Vec3 place = body.X_WS.position;
    const Vec3 inwards = (-Vec3(place.x(), place.y(), 0.0) - 1e-9 * Vec3::UnitX()).normalized();
    const Vec3 towards = (inwards + 0.7 * random_.direction()).normalized();
    body.linear_velocity = random_.uniform(0.0, 5.0) * size_ / length_s() * towards;
    if (oneIn(random_, 4)) return;
    const double turn =
        oneIn(random_, 3) ? random_.logUniform(0.01, 3.0) * steps_ : random_.uniform(0.0, 10.0);
    body.angular_velocity = turn / length_s() * random_.direction();
  }

  // The floor's normal may have any direction; gravity turns along.
  void turnAll(const Quat& R) {
    world_.scene.gravity = R * world_.scene.gravity;
    for (Body& body : bodies()) {
      body.X_WS = Pose{R, Vec3::Zero()} * body.X_WS;
      body.linear_velocity = R * body.linear_velocity;
      body.angular_velocity = R * body.angular_velocity;
    }
  }

  Random random_;
  ExploredWorld world_;
  double size_ = 1.0;  ///< Of the largest bodies, m.
  bool rubs_ = false;  ///< Whether bodies have friction among themselves.
  int steps_ = 0;
};

}  // namespace

ExploredWorld iceWorld(std::uint64_t seed) {
  return IceMaker(seed).make();
}

}  // namespace carom::explore
