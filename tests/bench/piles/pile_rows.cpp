#include "tests/bench/piles/pile_rows.h"

#include <Eigen/Eigenvalues>

#include "tests/oracle/test_shapes.h"

namespace carom::bench {
namespace {

using physics::Experiment;
using physics::ExperimentBody;
using physics::restGap;
using physics::Shape;

constexpr double kDensity = 1000.0;  // kg / m^3

ExperimentBody bodyOf(const Shape& shape, const Pose& X_WB) {
  ExperimentBody body{shape, X_WB};
  body.mass_kg = kDensity * shape.solid.volume();
  return body;
}

/// Four walls of a metre, inner faces `half_width` from the middle, on the plane z = 0.
void addBin(Experiment& world, double half_width, double height) {
  world.addPlane(0.5);
  const double outer = 2.0 * half_width + 2.0, beside = half_width + 0.5;
  const auto wall = [&](const Vec3& size, const Vec3& centre) {
    ExperimentBody body = bodyOf(Shape::box(size), {Quat::Identity(), centre});
    body.is_static = true;
    world.add(body);
  };
  for (const double side : {-1.0, 1.0}) {
    wall({1.0, outer, height}, Vec3(side * beside, 0, 0.5 * height));
    wall({outer, 1.0, height}, Vec3(0, side * beside, 0.5 * height));
  }
}

using ShapeOf = std::function<Shape(int)>;

/// Layers of a lattice of `pitch`, each body turned at random, into a bin as wide as the lattice.
Experiment drop(int count, double pitch, const ShapeOf& shapeOf) {
  Experiment world;
  const int side = std::max(1, static_cast<int>(std::lround(std::cbrt(count))));
  addBin(world, 0.5 * side * pitch + 0.05, (count / (side * side) + 3) * pitch);
  oracle::Random random(1);
  for (int i = 0; i < count; ++i) {
    const Vec3 cell(i % side, i / side % side, i / (side * side));
    const Vec3 place = pitch * (cell - 0.5 * Vec3(side - 1, side - 1, 0)) + Vec3(0, 0, 0.6 * pitch);
    world.add(bodyOf(shapeOf(i), {random.rotation(), place}));
  }
  return world;
}

Experiment boxes(int count) {
  const Shape box = Shape::box(Vec3::Constant(0.5));
  return drop(count, 0.9, [&](int) { return box; });
}

Experiment bouncing(Experiment world, double restitution) {
  for (ExperimentBody& body : world.bodies) body.restitution = restitution;
  return world;
}

/// As an experiment has it: about the centre of mass, axes along the principal ones.
Shape principalHull(const std::vector<Vec3>& points) {
  const Solid solid = Shape::hull(points).solid;
  const Eigen::SelfAdjointEigenSolver<Mat3> axes(solid.unitInertia());
  Mat3 R = axes.eigenvectors();
  if (R.determinant() < 0.0) R.col(0) = -R.col(0);
  std::vector<Vec3> turned;
  for (const Vec3& v : solid.parts()[0].core.vertices()) turned.emplace_back(R.transpose() * v);
  return Shape::hull(turned);
}

Experiment hulls(int count, int least_vertices, int most_vertices) {
  constexpr int kKinds = 32;
  oracle::Random random(2);
  std::vector<Shape> kinds;
  while (kinds.size() < std::size_t{kKinds}) {
    std::vector<Vec3> points;
    for (int n = random.integer(least_vertices, most_vertices); n > 0; --n)
      points.push_back(0.5 * random.direction());
    const Shape hull = principalHull(points);
    if (hull.solid.radius() < 0.53) kinds.push_back(hull);  // within the pitch, however it is turned
  }
  return drop(count, 1.08, [&](int i) { return kinds[static_cast<std::size_t>(i % kKinds)]; });
}

Experiment roundOnes(int count) {
  const Shape ball = Shape::ball(0.25), capsule = Shape::capsule(0.15, 0.3);
  return drop(count, 0.65, [&](int i) { return i % 2 == 0 ? ball : capsule; });
}

/// Heaps of 15 turned boxes, 6 m from each other.
Experiment heaps(int count) {
  Experiment world;
  world.addPlane(0.5);
  const Shape box = Shape::box(Vec3::Constant(0.5));
  const int side = static_cast<int>(std::ceil(std::sqrt(count)));
  oracle::Random random(3);
  for (int heap = 0; heap < count; ++heap)
    for (int i = 0; i < 15; ++i) {
      const Vec3 corner(6.0 * (heap % side - 0.5 * side), 6.0 * (heap / side - 0.5 * side), 0.0);
      const Vec3 place = corner + 0.9 * Vec3(i % 2, i / 2 % 2, 0.6 + i / 4);
      world.add(bodyOf(box, {random.rotation(), place}));
    }
  // Six metres a heap, and room about them.
  world.bodies.front().shape = Shape::box({6.0 * side + 40.0, 6.0 * side + 40.0, 2.0});
  return world;
}

/// Upright at the rest gap on the plane z = 0, or on the course below.
void lay(Experiment& world, const Shape& box, const Vec3& foot) {
  world.add(bodyOf(box, {Quat::Identity(), foot + Vec3(0, 0, 0.5 * box.size_m.z())}));
}

Experiment stack() {
  Experiment world;
  world.addPlane(0.5);
  const Shape cube = Shape::box(Vec3::Constant(0.5));
  const double gap = restGap(0.5);
  for (int i = 0; i < 10; ++i) lay(world, cube, Vec3(0, 0, gap + i * (0.5 + gap)));
  return world;
}

Experiment pyramid() {
  Experiment world;
  world.addPlane(0.5);
  const Shape cube = Shape::box(Vec3::Constant(0.5));
  const double gap = restGap(0.5);
  for (int row = 0; row < 20; ++row)
    for (int i = 0; i < 20 - row; ++i)
      lay(world, cube, Vec3(0.55 * (i - 0.5 * (20 - row)), 0, gap + row * (0.5 + gap)));
  return world;
}

/// Half a brick further in every other course; the bricks touch.
Experiment wall() {
  Experiment world;
  world.addPlane(0.5);
  const Vec3 size(0.5, 0.25, 0.25);
  const Shape brick = Shape::box(size), half = Shape::box({0.25, 0.25, 0.25});
  for (int course = 0; course < 20; ++course) {
    const double z = course * size.z();
    for (int i = 0; i < 30; ++i)
      if (course % 2 == 0 || i > 0)
        lay(world, brick, Vec3((i - (course % 2 == 0 ? 0.0 : 0.5)) * size.x(), 0, z));
    if (course % 2 == 0) continue;
    lay(world, half, Vec3(-0.25 * size.x(), 0, z));
    lay(world, half, Vec3((29 + 0.25) * size.x(), 0, z));
  }
  return world;
}

Experiment awake(Experiment world) {
  world.resting = false;
  return world;
}

PileRow boxRow(int count, bool is_long) {
  PileRow row{"boxes-" + std::to_string(count), std::to_string(count) + " boxes of 0.5 m dropped into a bin",
              [=] { return boxes(count); }};
  row.size = count;
  row.is_long = is_long;
  return row;
}
PileRow longRow(const char* name, const char* what, Experiment (*describe)()) {
  PileRow row{name, what, describe};
  row.is_long = true;
  return row;
}
PileRow standing(const char* name, const char* what, Experiment (*describe)()) {
  return {name, what, [=] { return awake(describe()); }, 3.0, false, 0.0};
}

}  // namespace

std::vector<PileRow> dropRows() {
  return {
      boxRow(250, false),
      boxRow(500, false),
      boxRow(1000, false),
      boxRow(2000, true),
      boxRow(4000, true),
      {"bouncing-500", "500 boxes of 0.5 m, restitution 0.5, dropped into a bin",
       [] { return bouncing(boxes(500), 0.5); }},
      longRow("hulls-1000", "1000 hulls of 1 m, 12 to 20 points, dropped into a bin",
              [] { return hulls(1000, 12, 20); }),
      {"hulls-300", "300 hulls of 250 points dropped into a bin", [] { return hulls(300, 250, 250); }},
      longRow("round-2000", "2000 balls and capsules dropped into a bin", [] { return roundOnes(2000); }),
      longRow("heaps-200", "200 heaps of 15 boxes (3000 bodies)", [] { return heaps(200); }),
      standing("stack-10", "stack of 10, awake", stack),
      standing("pyramid-210", "pyramid of 210, awake", pyramid),
      standing("wall-610", "wall of 610 touching bricks, awake", wall),
      {"hulls-1000-settled", "1000 hulls, settled, awake", [] { return awake(hulls(1000, 12, 20)); }, 8.0,
       false, 6.0, 0, true},
  };
}

}  // namespace carom::bench
