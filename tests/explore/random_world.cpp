#include "tests/explore/random_world.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/explore/random_shapes.h"
#include "tests/explore/worlds/coarse_worlds.h"
#include "tests/explore/worlds/driven_heaps.h"
#include "tests/explore/worlds/hanging_worlds.h"
#include "tests/explore/worlds/ice_worlds.h"
#include "tests/explore/worlds/loaded_worlds.h"
#include "tests/explore/worlds/moved_worlds.h"

namespace carom::explore {
namespace {

using demos::Body;
using demos::CapsuleShape;
using demos::Scene;
using demos::Shape;
using demos::SphereShape;
using oracle::Random;

class WorldMaker {
 public:
  explicit WorldMaker(std::uint64_t seed) : random_(seed * 0x9e3779b97f4a7c15ull + 1) {}

  ExploredWorld make() {
    chooseSetting();
    struct Choice {
      const char* name;
      void (WorldMaker::*fill)();
      int weight;
    };
    static constexpr Choice kChoices[] = {
        {"scatter", &WorldMaker::scatter, 16},  {"closed", &WorldMaker::closed, 10},
        {"glide", &WorldMaker::glide, 8},       {"tiles", &WorldMaker::tiles, 8},
        {"stack", &WorldMaker::stack, 10},      {"bin", &WorldMaker::bin, 10},
        {"touching", &WorldMaker::touching, 8}, {"thin", &WorldMaker::thin, 12},
        {"ratio", &WorldMaker::ratio, 5},       {"spinning", &WorldMaker::spinning, 6},
        {"fluid", &WorldMaker::fluid, 5},       {"bullet", &WorldMaker::bullet, 5},
        {"many", &WorldMaker::many, 1}};
    int total = 0;
    for (const Choice& choice : kChoices) total += choice.weight;
    int at = random_.integer(0, total - 1);
    const Choice* chosen = kChoices;
    while (at >= chosen->weight) at -= (chosen++)->weight;
    world_.family = chosen->name;
    (this->*chosen->fill)();
    if (steps_ == 0) steps_ = random_.integer(40, 120);
    return world_.lasting(steps_);
  }

 private:
  Scene& scene() { return world_.scene; }
  double stepsLength() const { return 60.0 / world_.scene.rate_hz; }

  void chooseSetting() {
    constexpr double kRates[] = {30, 60, 60, 100, 120, 240, 240, 500, 1000};
    scene().rate_hz = kRates[random_.integer(0, 8)];
    size_ = random_.logUniform(1e-2, 30.0);
    if (oneIn(random_, 4)) size_ = 1.0;
    material_ = anyMaterial(random_);
    const int gravity = random_.integer(0, 9);
    if (gravity == 0) scene().gravity = Vec3::Zero();
    if (gravity == 1) scene().gravity = random_.logUniform(0.1, 100.0) * random_.direction();
    if (gravity == 2) scene().gravity = Vec3(1.0, 0.0, -9.81);
  }

  int fewBodies() { return random_.integer(1, oneIn(random_, 4) ? 12 : 5); }
  double anySize() { return std::max(2e-3, size_ * random_.logUniform(0.1, 1.0)); }
  /// A speed that takes a body of the world's size `far` in half the run, or up to a thousand times that.
  double anySpeed(double far) {
    const double crossing = far / stepsLength();
    const double fast = oneIn(random_, 6) ? random_.logUniform(1.0, 1000.0) : random_.uniform(0.2, 3.0);
    return std::min(kLargestSpeed, fast * crossing);
  }
  Material bodyMaterial() { return oneIn(random_, 4) ? anyMaterial(random_) : material_; }

  Body& add(Shape shape, const Pose& X, bool is_static = false) {
    Body body;
    body.name.assign(1, is_static ? 's' : 'b').append(std::to_string(scene().bodies.size()));
    body.shape = std::move(shape);
    body.X_WS = X;
    body.is_static = is_static;
    body.material = is_static ? material_ : bodyMaterial();
    scene().bodies.push_back(std::move(body));
    return scene().bodies.back();
  }
  Body& addStaticBox(const Vec3& size, const Vec3& position) {
    return add(boxOf(size), {Quat::Identity(), position}, true);
  }
  void addFloor(double size) {
    Body& floor = addStaticBox({size, size, 0.2 * size}, {0, 0, -0.1 * size});
    if (oneIn(random_, 4)) {  // a slope, about its middle
      floor.X_WS.rotation = oracle::turned(Vec3::UnitX(), random_.uniform(-0.6, 0.6));
      floor.X_WS.position = floor.X_WS.rotation * floor.X_WS.position;
    }
  }

  /// Adds bodies about `middle` whose bounding balls stay clear of each other and above `lowest`.
  void addScattered(int count, const Vec3& middle, double spread, double lowest) {
    std::vector<std::pair<Vec3, double>> balls;
    for (int i = 0; i < count; ++i) {
      Shape shape = anyShape(random_, anySize());
      const double reach = 1.001 * reachOf(shape);
      Pose X{random_.rotation(), middle};
      double wider = spread;
      for (int trial = 0;; ++trial, wider *= 1.1) {
        Vec3 away;
        for (int k = 0; k < 3; ++k) away[k] = random_.uniform(-wider, wider);
        X.position = middle + away;
        X.position.z() = std::max(X.position.z(), lowest + reach);
        const bool clear = std::all_of(balls.begin(), balls.end(), [&](const auto& ball) {
          return (ball.first - X.position).norm() > ball.second + reach;
        });
        if (clear) break;
      }
      balls.emplace_back(X.position, reach);
      add(std::move(shape), X);
    }
  }
  void hurl(Body& body, const Vec3& towards, double far) {
    const double speed = anySpeed(far);
    body.linear_velocity = speed * (towards + 0.5 * random_.direction()).normalized();
    if (oneIn(random_, 2)) {
      const double turning = random_.uniform(0.0, 2.0) * speed / reachOf(body.shape);
      body.angular_velocity = std::min(kLargestSpeed, turning) * random_.direction();
    }
  }

  void scatter() {
    const double room = 6.0 * size_;
    addFloor(room);
    const std::size_t first = scene().bodies.size();
    // Above the highest point of any slope, which is less than 0.3 of the room.
    addScattered(fewBodies(), {0, 0, 0.5 * room}, 0.2 * room, 0.3 * room);
    for (std::size_t i = first; i < scene().bodies.size(); ++i)
      hurl(scene().bodies[i], -Vec3::UnitZ(), 0.3 * room);
  }

  void closed() {
    scene().gravity = Vec3::Zero();
    const double room = 4.0 * size_;
    addScattered(random_.integer(2, 8), Vec3::Zero(), 0.5 * room, -1e9);
    for (Body& body : scene().bodies) {
      const Vec3 inwards = -body.X_WS.position;
      hurl(body, inwards.norm() > 0.0 ? inwards.normalized() : Vec3::UnitX(), room);
    }
  }

  // A row of flush tiles and one frictionless slider over it: it must keep its speed and height.
  void glide() {
    scene().gravity = Vec3(0.0, 0.0, -9.81);
    material_.static_friction = material_.dynamic_friction = 0.0;
    material_.restitution = 0.0;
    const double tile = size_;
    const double speed = std::min(random_.uniform(0.2, 30.0) * std::sqrt(size_), 8.0 * tile / stepsLength());
    const int tiles = random_.integer(3, 12);
    for (int i = 0; i < tiles; ++i)
      addStaticBox({tile, 4.0 * tile, tile}, {(i - 1) * tile, 0.0, -0.5 * tile});
    const double extent = tile * random_.uniform(0.1, 0.9);
    const Vec3 box = extent * Vec3(1.0, random_.uniform(0.3, 1.0), random_.uniform(0.1, 0.6));
    double half = 0.5 * box.z();
    Shape shape = boxOf(box);
    const int kind = random_.integer(0, 5);
    if (kind == 0) {
      half = 0.25 * extent;
      shape = {SphereShape{half}, {}};
    }
    Pose X{Quat::Identity(), {0, 0, half}};
    if (kind == 1) {  // lies along y or across
      half = 0.2 * extent;
      shape = {CapsuleShape{half, extent}, {}};
      X.rotation = oracle::turned(oneIn(random_, 2) ? Vec3::UnitX() : Vec3::UnitY(), std::numbers::pi / 2);
      X.position.z() = half;
    } else if (kind >= 2 && oneIn(random_, 2)) {
      X.rotation = oracle::turned(Vec3::UnitZ(), random_.uniform(0.0, 3.0));
    }
    const Vec3 direction = Vec3(1.0, oneIn(random_, 2) ? random_.uniform(-0.1, 0.1) : 0.0, 0.0).normalized();
    Body& slider = add(std::move(shape), X);
    slider.material = material_;
    slider.linear_velocity = speed * direction;
  }

  // A floor of tiles, flush or nearly so, and what slides and tumbles over it.
  void tiles() {
    const double tile = size_;
    const bool nearly = oneIn(random_, 2);
    const int across = random_.integer(2, 4), along = random_.integer(2, 4);
    for (int i = 0; i < along; ++i)
      for (int j = 0; j < across; ++j) {
        const double step = nearly ? tile * random_.logUniform(1e-7, 1e-2) : 0.0;
        addStaticBox({tile, tile, tile}, {i * tile, j * tile, -0.5 * tile - step});
      }
    const int count = random_.integer(1, 3);
    for (int k = 0; k < count; ++k) {
      const double side = tile * random_.uniform(0.2, 0.8);
      const Vec3 box(side, side, side * random_.uniform(0.1, 1.0));
      Body& slider = add(boxOf(box), {Quat::Identity(), {0, k * tile, 0.5 * box.z()}});
      const double aside = random_.uniform(-0.2, 0.2);
      slider.linear_velocity = anySpeed(2.0 * tile) * Vec3(1.0, aside, 0.0);
    }
    steps_ = random_.integer(40, 90);
  }

  // Boxes or plates on each other: exactly touching, or a hair apart, some shifted.
  void stack() {
    addStaticBox({6 * size_, 6 * size_, size_}, {0, 0, -0.5 * size_});
    double top = 0.0;
    const int count = random_.integer(2, 9);
    const bool shifted = oneIn(random_, 2), apart = oneIn(random_, 3);
    const double flat = oneIn(random_, 3) ? random_.logUniform(0.01, 0.2) : random_.uniform(0.3, 1.0);
    for (int i = 0; i < count; ++i) {
      const double side = size_ * (oneIn(random_, 3) ? random_.logUniform(0.2, 1.0) : 1.0);
      const double height = std::max(kSmallestShape_m, flat * side);
      const double gap = apart ? height * random_.logUniform(1e-6, 1e-1) : 0.0;
      Pose X{Quat::Identity(), {0, 0, top + gap + 0.5 * height}};
      if (shifted) {
        X.position.x() = 0.3 * side * random_.uniform(-1, 1);
        X.rotation = oracle::turned(Vec3::UnitZ(), random_.uniform(-0.5, 0.5));
      }
      add(boxOf({side, side, height}), X);
      top += gap + height;
    }
    if (oneIn(random_, 3)) {
      Body& ball =
          add({SphereShape{0.2 * size_}, {}}, {Quat::Identity(), {-3 * size_, 0, 0.5 * top + 0.2 * size_}});
      ball.linear_velocity = Vec3(anySpeed(4 * size_), 0, 0);
    }
  }

  void bin() {
    const double wide = size_ * random_.uniform(1.2, 2.5), high = 6.0 * size_, wall = 0.2 * size_;
    addStaticBox({wide + 2 * wall, wide + 2 * wall, wall}, {0, 0, -0.5 * wall});
    for (const double side : {-1.0, 1.0}) {
      addStaticBox({wall, wide + 2 * wall, high}, {side * 0.5 * (wide + wall), 0, 0.5 * high});
      addStaticBox({wide, wall, high}, {0, side * 0.5 * (wide + wall), 0.5 * high});
    }
    const int count = oneIn(random_, 5) ? random_.integer(6, 16) : random_.integer(2, 6);
    double top = 0.05 * size_;
    for (int i = 0; i < count; ++i) {
      Shape shape = anyShape(random_, size_ * random_.uniform(0.3, 0.9));
      const double reach = 1.001 * reachOf(shape);
      if (2.0 * reach > 0.99 * wide) continue;
      const double free = 0.5 * wide - reach;
      Pose X{random_.rotation(), {}};
      X.position.x() = random_.uniform(-free, free);
      X.position.y() = random_.uniform(-free, free);
      X.position.z() = top + reach;
      top += 2.0 * reach;
      Body& body = add(std::move(shape), X);
      body.linear_velocity = Vec3(0, 0, -anySpeed(2.0 * size_));
    }
    steps_ = random_.integer(50, 120);
  }

  // Boxes on exact lattice places that touch: rows, walls of half and whole bricks, blocks.
  void touching() {
    addStaticBox({20 * size_, 20 * size_, 2 * size_}, {0, 0, -size_});
    const Vec3 brick = size_ * Vec3(1.0, 0.5, 0.5);
    const int rows = random_.integer(1, 3), wide = random_.integer(2, 4), deep = random_.integer(1, 2);
    const bool bonded = oneIn(random_, 2);
    for (int k = 0; k < rows; ++k)
      for (int j = 0; j < deep; ++j)
        for (int i = 0; i < wide; ++i) {
          const double shift = bonded && k % 2 == 1 ? 0.5 * brick.x() : 0.0;
          add(boxOf(brick),
              {Quat::Identity(), {i * brick.x() + shift, j * brick.y(), (k + 0.5) * brick.z()}});
        }
    // The order of bodies must not matter.
    for (std::size_t i = scene().bodies.size() - 1; i > 1; --i)
      std::swap(scene().bodies[i],
                scene().bodies[static_cast<std::size_t>(random_.integer(1, static_cast<int>(i)))]);
    steps_ = random_.integer(30, 60);
  }

  // One needle or plate that lands on a floor.
  void thin() {
    addFloor(8.0 * size_);
    const double thin = random_.logUniform(1e-3, 0.1);
    const Vec3 box =
        size_ *
        Vec3(1.0, oneIn(random_, 2) ? thin * random_.uniform(0.3, 3.0) : random_.uniform(0.3, 1.0), thin);
    const int count = oneIn(random_, 4) ? 2 : 1;
    for (int i = 0; i < count; ++i) {
      Shape shape = boxOf(box);
      const double high = 3.0 * size_ + (i + 1) * 2.0 * reachOf(shape);
      Body& body = add(std::move(shape), {random_.rotation(), {0, 0, high}});
      hurl(body, -Vec3::UnitZ(), high);
      if (!oneIn(random_, 4)) body.material.restitution = 0.0;
    }
  }

  void ratio() {
    addStaticBox({20 * size_, 20 * size_, size_}, {0, 0, -0.5 * size_});
    const double heavy = random_.logUniform(10.0, 1e4);
    double top = 0.0;
    const int count = random_.integer(2, 4);
    for (int i = 0; i < count; ++i) {
      const double side = size_ * (i % 2 == 0 ? 0.3 : random_.uniform(0.3, 1.0));
      const double gap = oneIn(random_, 2) ? 0.0 : side * random_.logUniform(1e-4, 1.0);
      const Vec3 aside(0.1 * size_ * random_.uniform(-1, 1), 0.1 * size_ * random_.uniform(-1, 1),
                       top + gap + 0.5 * side);
      Body& body = add(boxOf({side, side, side}), {Quat::Identity(), aside});
      body.material.density_kgpm3 = i % 2 == 0 ? 100.0 : 100.0 * heavy;
      top += gap + side;
    }
  }

  void spinning() {
    if (oneIn(random_, 2)) addStaticBox({40 * size_, 40 * size_, size_}, {0, 0, -0.5 * size_});
    const int count = random_.integer(1, 3);
    for (int i = 0; i < count; ++i) {
      Shape shape = anyShape(random_, anySize());
      const double reach = reachOf(shape);
      Body& body = add(std::move(shape),
                       {random_.rotation(), {i * 4.0 * size_, 0, reach * random_.uniform(1.001, 1.5)}});
      const double turn = random_.logUniform(0.1, 300.0) / stepsLength();
      body.angular_velocity = std::min(kLargestSpeed, turn) * random_.direction();
    }
  }

  void fluid() {
    scene().gravity = Vec3(0, 0, -9.81);
    addStaticBox({10 * size_, 10 * size_, size_}, {0, 0, -4 * size_});
    if (!oneIn(random_, 3)) {
      demos::NamedFluid named;
      named.name = "water";
      named.fluid.max.z() = size_ * random_.uniform(-3.0, 1.0);
      named.fluid.density_kgpm3 = random_.logUniform(500.0, 2000.0);
      if (oneIn(random_, 3)) named.fluid.flow = Vec3(random_.uniform(-2, 2), 0, 0);
      if (oneIn(random_, 3)) named.fluid.added_mass = 0.5;
      scene().fluids.push_back(named);
    }
    if (scene().fluids.empty() || oneIn(random_, 2)) {
      scene().air.density_kgpm3 = 1.2;
      if (oneIn(random_, 2)) scene().air.wind = random_.logUniform(1.0, 30.0) * random_.direction();
    }
    const std::size_t first = scene().bodies.size();
    addScattered(random_.integer(1, 5), Vec3::Zero(), 2.0 * size_, -3.4 * size_);
    for (std::size_t i = first; i < scene().bodies.size(); ++i)
      if (oneIn(random_, 2)) hurl(scene().bodies[i], -Vec3::UnitZ(), size_);
  }

  // A small fast body against bodies, walls and plates.
  void bullet() {
    if (oneIn(random_, 2)) addStaticBox({0.05 * size_, 4 * size_, 4 * size_}, {3 * size_, 0, 2 * size_});
    const int count = random_.integer(1, 4);
    for (int i = 0; i < count; ++i) {
      const Vec3 target(0.05 * size_, size_, size_);
      add(boxOf(target), {Quat::Identity(), {0.5 * i * size_, 0, 2.0 * size_}});
    }
    Body& shot = add(anyShape(random_, 0.1 * size_), {random_.rotation(), {-2 * size_, 0, 2 * size_}});
    const double speed = random_.logUniform(10.0, kLargestSpeed);
    shot.linear_velocity = speed * (Vec3::UnitX() + 0.1 * random_.direction()).normalized();
    shot.angular_velocity = std::min(kLargestSpeed, random_.logUniform(1.0, 1e4)) * random_.direction();
    steps_ = random_.integer(30, 90);
  }

  void many() {
    const double room = 10.0 * size_;
    addStaticBox({room, room, size_}, {0, 0, -0.5 * size_});
    const std::size_t first = scene().bodies.size();
    addScattered(random_.integer(20, 59), {0, 0, 0.3 * room}, 0.25 * room, 0.0);
    for (std::size_t i = first; i < scene().bodies.size(); ++i)
      scene().bodies[i].linear_velocity = Vec3(0, 0, -anySpeed(0.3 * room));
    steps_ = random_.integer(30, 60);
  }

  Random random_;
  ExploredWorld world_;
  double size_ = 1.0;
  Material material_;
  int steps_ = 0;
};

}  // namespace

ExploredWorld randomWorld(std::uint64_t seed) {
  if (seed >= kIceWorlds) return iceWorld(seed);
  if (seed >= kHangingWorlds) return hangingWorld(seed);
  if (seed >= kCoarseWorlds) return coarseWorld(seed);
  if (seed >= kLoadedWorlds) return loadedWorld(seed);
  if (seed >= kDrivenHeaps) return drivenHeap(seed);
  return seed >= kMovedWorlds ? movedWorld(seed) : WorldMaker(seed).make();
}

int stepsOf(const demos::Scene& scene) {
  return static_cast<int>(std::llround(scene.duration_s * scene.rate_hz));
}

}  // namespace carom::explore
