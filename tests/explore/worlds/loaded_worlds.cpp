#include "tests/explore/worlds/loaded_worlds.h"

#include <algorithm>
#include <cmath>

#include "tests/explore/random_shapes.h"

namespace carom::explore {
namespace {

using demos::Body;
using demos::Shape;
using oracle::Random;

// Groups of bodies about the origin, each pressed together by loads whose sum is zero or nearly so.
class LoadedMaker {
 public:
  explicit LoadedMaker(std::uint64_t seed) : random_(seed * 0x9e3779b97f4a7c15ull + 13) {}

  ExploredWorld make() {
    constexpr double kRates[] = {30, 60, 60, 120, 240};
    world_.family = "loaded";
    world_.scene.rate_hz = kRates[random_.integer(0, 4)];
    world_.scene.gravity = Vec3::Zero();
    size_ = oneIn(random_, 3) ? 1.0 : random_.logUniform(0.05, 10.0);
    steps_ = random_.integer(60, 120);
    material_ = someMaterial();
    pushes_ = random_.logUniform(1.0, 1000.0) * size_ / (length_s() * length_s());
    const int surroundings = random_.integer(0, 9);
    if (surroundings == 0) lieOnAFloor();
    if (surroundings > 0) floatAbout();
    if (surroundings == 1) hover();
    return world_.lasting(steps_);
  }

 private:
  std::vector<Body>& bodies() { return world_.scene.bodies; }
  double length_s() const { return steps_ / world_.scene.rate_hz; }

  Material someMaterial() {
    Material m;
    m.static_friction = oneIn(random_, 3) ? 0.0 : random_.uniform(0.0, 1.0);
    m.dynamic_friction = m.static_friction * (oneIn(random_, 3) ? 0.7 : 1.0);
    m.restitution = oneIn(random_, 2) ? 0.0 : random_.uniform(0.0, 1.0);
    return m;
  }
  Body& add(Shape shape, const Pose& X) {
    Body& body = addBody(world_.scene, std::move(shape), X, oneIn(random_, 4) ? someMaterial() : material_);
    const double side = reachOf(body.shape);
    body.mass_kg = 1000.0 * side * side * side * (oneIn(random_, 4) ? random_.logUniform(0.1, 10.0) : 1.0);
    return body;
  }
  Shape someShape(double size) {
    const int kind = random_.integer(0, 5);
    if (kind == 0) return {demos::SphereShape{0.5 * size}, {}};
    if (kind == 1) return {demos::CapsuleShape{0.25 * size, 0.5 * size}, {}};
    const double x = random_.uniform(0.3, 1.0), y = random_.uniform(0.3, 1.0);
    return boxOf(size * Vec3(x, y, 1.0));
  }

  // Bodies in free space: one group or two that meet, struck by what flies at them.
  void floatAbout() {
    addGroup(Vec3::Zero());
    if (oneIn(random_, 4)) {
      const std::size_t first = bodies().size();
      const Vec3 away = 2.5 * spread_ * random_.direction();
      addGroup(away);
      const Vec3 velocity = -random_.uniform(1.0, 4.0) / length_s() * away;
      for (std::size_t i = first; i < bodies().size(); ++i) bodies()[i].linear_velocity = velocity;
      spread_ *= 3.0;
    }
    for (int strikers = random_.integer(0, 2); strikers > 0; --strikers) addStriker();
    if (oneIn(random_, 2)) turnAll(random_.rotation());
  }
  /// About `middle`; its loads are of itself alone. Its bodies lie within `spread_` of there.
  void addGroup(const Vec3& middle) {
    const std::size_t first = bodies().size();
    spread_ = 0.0;
    if (oneIn(random_, 2))
      addChain();
    else
      addCluster();
    for (std::size_t i = first; i < bodies().size(); ++i) {
      spread_ = std::max(spread_, bodies()[i].X_WS.position.norm() + reachOf(bodies()[i].shape));
      bodies()[i].X_WS.position += middle;
    }
    if (oneIn(random_, 3)) twist(first);
    if (oneIn(random_, 6)) turnLoadsAlong(first);
  }

  // Boxes in a row along x, some beside its line, of which the ends are pushed towards each other.
  void addChain() {
    const std::size_t first = bodies().size();
    double end = 0.0;
    for (int i = random_.integer(2, 6); i > 0; --i) {
      const double x = random_.uniform(0.3, 1.0), y = random_.uniform(0.3, 1.0);
      const Vec3 box = size_ * Vec3(x, y, random_.uniform(0.3, 1.0));
      const double aside = oneIn(random_, 3) ? 0.0 : 0.2 * size_ * random_.uniform(-1.0, 1.0);
      const Vec3 place(end + 0.5 * box.x(), aside, oneIn(random_, 2) ? 0.0 : 0.5 * aside);
      end += box.x() + size_ * random_.logUniform(3e-3, 0.1);
      add(boxOf(box), {Quat::Identity(), place});
    }
    for (std::size_t i = first; i < bodies().size(); ++i) bodies()[i].X_WS.position.x() -= 0.5 * end;
    const double force = *bodies()[first].mass_kg * pushes_;
    bodies()[first].load.force_W = Vec3(force, 0, 0);
    // Now and then a little is left over.
    const double back = oneIn(random_, 4) ? 1.0 + random_.logUniform(1e-9, 0.1) : 1.0;
    bodies().back().load.force_W = Vec3(-back * force, 0, 0);
  }

  // Bodies about a middle that all are pushed to, though not all as hard; what is left over of these forces
  // pulls at one of them.
  void addCluster() {
    const std::size_t first = bodies().size();
    for (int i = random_.integer(3, 8); i > 0; --i) {
      Shape shape = someShape(size_ * random_.uniform(0.3, 1.0));
      Body& body = add(std::move(shape), {random_.rotation(), Vec3::Zero()});
      placeClear(body, first);
    }
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = first; i < bodies().size(); ++i) {
      Body& body = bodies()[i];
      if (oneIn(random_, 4)) continue;
      const Vec3 inwards = (-body.X_WS.position - 1e-9 * Vec3::UnitX()).normalized();
      const Vec3 towards = (inwards + 0.3 * random_.direction()).normalized();
      body.load.force_W = *body.mass_kg * pushes_ * random_.uniform(0.3, 1.0) * towards;
      sum += body.load.force_W;
    }
    bodies()[first].load.force_W -= sum;
  }
  /// Clear of those from `first` on, about the origin.
  void placeClear(Body& body, std::size_t first) {
    const double reach = reachOf(body.shape);
    for (double wide = size_;; wide *= 1.1) {
      body.X_WS.position = wide * random_.uniform(0.0, 1.0) * random_.direction();
      const bool clear = std::all_of(
          bodies().begin() + static_cast<std::ptrdiff_t>(first), bodies().end(), [&](const Body& other) {
            const Vec3 apart = other.X_WS.position - body.X_WS.position;
            return &other == &body || apart.norm() > 1.01 * (reach + reachOf(other.shape));
          });
      if (clear) return;
    }
  }

  // Torques that cancel: each is another's opposite.
  void twist(std::size_t first) {
    for (std::size_t i = first; i + 1 < bodies().size(); i += 2) {
      Body &one = bodies()[i], &other = bodies()[i + 1];
      const double arm = std::min(reachOf(one.shape), reachOf(other.shape));
      const double most = 0.3 * pushes_ * arm * std::min(*one.mass_kg, *other.mass_kg);
      one.load.torque_W = most * random_.uniform(0.0, 1.0) * random_.direction();
      other.load.torque_W = -one.load.torque_W;
    }
  }
  // Some loads are the body's own: they turn with it.
  void turnLoadsAlong(std::size_t first) {
    for (std::size_t i = first; i < bodies().size(); ++i) {
      if (oneIn(random_, 2)) continue;
      AppliedLoad& load = bodies()[i].load;
      const Quat R_SW = bodies()[i].X_WS.rotation.conjugate();
      load = {Vec3::Zero(), load.torque_W, R_SW * load.force_W, Vec3::Zero()};
      if (oneIn(random_, 2)) load = {Vec3::Zero(), Vec3::Zero(), load.force_B, R_SW * load.torque_W};
    }
  }

  // A ball or box that comes from beside all others.
  void addStriker() {
    const double size = size_ * random_.uniform(0.1, 0.5);
    Shape shape = oneIn(random_, 2) ? Shape{demos::SphereShape{0.5 * size}, {}} : boxOf(Vec3::Constant(size));
    const Vec3 from = random_.direction();
    Body& body = add(std::move(shape), {random_.rotation(), Vec3::Zero()});
    spread_ += 1.1 * reachOf(body.shape);
    body.X_WS.position = spread_ * from;
    spread_ += 1.1 * reachOf(body.shape);
    const double speed = random_.logUniform(1.0, 30.0) * spread_ / length_s();
    body.linear_velocity = speed * (0.3 * random_.direction() - from).normalized();
    if (oneIn(random_, 2))
      body.angular_velocity = random_.uniform(0.0, 2.0) * speed / reachOf(body.shape) * random_.direction();
  }
  void turnAll(const Quat& R) {
    for (Body& body : bodies()) {
      body.X_WS = Pose{R, Vec3::Zero()} * body.X_WS;
      body.linear_velocity = R * body.linear_velocity;
      body.angular_velocity = R * body.angular_velocity;
      body.load.force_W = R * body.load.force_W;
      body.load.torque_W = R * body.load.torque_W;
    }
  }

  // Each weight is borne by a force of the body's own.
  void hover() {
    world_.scene.gravity = Vec3(0, 0, -9.81);
    for (Body& body : bodies()) body.load.force_W -= *body.mass_kg * world_.scene.gravity;
  }

  // A row that lies, and is pressed together by forces along the floor.
  void lieOnAFloor() {
    world_.scene.gravity = Vec3(0, 0, -9.81);
    addChain();
    for (Body& body : bodies()) {
      const double half = 0.5 * std::get<demos::BoxShape>(body.shape.form).size_m.z();
      body.X_WS.position.z() = half + size_ * random_.logUniform(1e-3, 0.1);
      spread_ = std::max(spread_, body.X_WS.position.norm() + reachOf(body.shape));
    }
    if (oneIn(random_, 3)) twist(0);
    const double wide = 20.0 * spread_;
    Body& floor = add(boxOf({wide, wide, spread_}), {Quat::Identity(), Vec3(0, 0, -0.5 * spread_)});
    floor.mass_kg.reset();
    floor.is_static = true;
  }

  Random random_;
  ExploredWorld world_;
  double size_ = 1.0;    ///< Of the largest bodies, m.
  double spread_ = 0.0;  ///< All bodies so far lie within it of the origin, m.
  double pushes_ = 0.0;  ///< What a force makes of a body that is free, m/s^2.
  int steps_ = 0;
  Material material_;
};

}  // namespace

ExploredWorld loadedWorld(std::uint64_t seed) {
  return LoadedMaker(seed).make();
}

}  // namespace carom::explore
