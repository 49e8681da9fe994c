#pragma once
// An experiment in plain numbers - bodies, friction, restitution, step - that any rigid-body library can run,
// and what is asked of it on the way. The closed forms of this folder are measured through it by the tests of
// tests/physics/ and, side by side with other libraries, by `physics` (tests/bench/).

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "engine/foundation/frames.h"
#include "engine/foundation/tolerances.h"
#include "engine/solid/convex_hull.h"
#include "engine/solid/solid.h"

namespace carom::physics {

inline constexpr double kGravity = 9.81;

inline double radians(double degrees) {
  return degrees * std::numbers::pi / 180.0;
}

/// By `angle` radians about `axis`.
inline Quat rotatedBy(const Vec3& axis, double angle) {
  return Quat(Eigen::AngleAxisd(angle, axis.normalized()));
}

/// The gap at which a part of this width is held over a large one: bodies that touch are described with it.
inline double restGap(double width_m) {
  return tolerance::kRestGap * std::min(width_m, tolerance::kWindowLargestScale);
}

enum class ShapeKind { kBall, kBox, kCapsule, kHull };

/// About the centre of mass, axes along the principal ones.
struct Shape {
  ShapeKind kind = ShapeKind::kBall;
  double radius_m = 0.0;       ///< Of a ball, or of a capsule.
  Vec3 size_m = Vec3::Zero();  ///< Of a box; of a capsule, which lies along z, how far its caps' centres are.
  Solid solid;                 ///< For all of them; of a hull its vertices and faces.

  static Shape ball(double radius) { return {ShapeKind::kBall, radius, Vec3::Zero(), Solid::ball(radius)}; }
  static Shape box(const Vec3& size) { return {ShapeKind::kBox, 0.0, size, Solid::box(size)}; }
  static Shape capsule(double radius, double length) {
    return {ShapeKind::kCapsule, radius, Vec3(0, 0, length), Solid::capsule(radius, length)};
  }
  static Shape hull(const std::vector<Vec3>& points) {
    return {ShapeKind::kHull, 0.0, Vec3::Zero(), Solid::polyhedron(convexHull(points).polyhedron)};
  }
};

struct ExperimentBody {
  Shape shape;
  Pose X_WB{};
  Vec3 velocity = Vec3::Zero();
  Vec3 spin = Vec3::Zero();
  double mass_kg = 1.0;
  double friction = 0.5;     ///< A pair has the geometric mean of both, ...
  double restitution = 0.0;  ///< ... and the larger restitution: give all bodies of an experiment the same.
  bool is_static = false;
  double rolling_resistance_m = 0.0;  ///< As friction; in libraries that have it (Simulator).
  double spinning_resistance_m = 0.0;

  Mat3 inertia() const { return mass_kg / shape.solid.volume() * shape.solid.unitInertia(); }
};

struct Experiment {
  double step_s = 1.0 / 60.0;
  double gravity = kGravity;          ///< Along -z.
  bool resting = true;                ///< Whether bodies may be put to rest (sleep, be disabled).
  bool continuous_collision = false;  ///< Where a library has it as an option of a body.
  std::vector<ExperimentBody> bodies{};

  int add(ExperimentBody body) {
    bodies.push_back(std::move(body));
    return static_cast<int>(bodies.size()) - 1;
  }

  /// A large static box whose top face is the plane through the origin with normal turned by `tilt` from z.
  int addPlane(double friction, double restitution = 0.0, const Quat& tilt = Quat::Identity()) {
    ExperimentBody plane{Shape::box({100.0, 100.0, 2.0}), {tilt, tilt * Vec3(0, 0, -1)}};
    plane.friction = friction;
    plane.restitution = restitution;
    plane.is_static = true;
    return add(std::move(plane));
  }
};

/// A body at the end of a step.
struct Motion {
  Pose X_WB;
  Vec3 velocity = Vec3::Zero();
  Vec3 spin = Vec3::Zero();
};

/// An experiment that runs in some library.
class Simulation {
 public:
  Simulation() = default;
  virtual ~Simulation() = default;
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  virtual void step() = 0;
  virtual Motion motion(int body) const = 0;
  virtual bool atRest(int body) const = 0;  ///< Put to rest (asleep, disabled) by the library.
};

struct Simulator {
  const char* name;
  std::unique_ptr<Simulation> (*start)(const Experiment& experiment);
  bool keeps_gaps = false;       ///< Bodies in contact are a rest gap apart, and may not touch.
  bool resists_turning = false;  ///< By torques of at most a length times the normal force.
};

/// A running experiment and the sums over its bodies that can move.
class Trial {
 public:
  Trial(const Simulator& simulator, Experiment experiment)
      : experiment_(std::move(experiment)), simulation_(simulator.start(experiment_)) {}

  void step() {
    simulation_->step();
    ++steps_;
  }
  void run(double seconds) {
    for (long n = stepsOf(seconds); n > 0; --n) step();
  }
  long stepsOf(double seconds) const { return std::lround(seconds / experiment_.step_s); }
  double time() const { return static_cast<double>(steps_) * experiment_.step_s; }
  const Experiment& experiment() const { return experiment_; }

  Motion motion(int body) const { return simulation_->motion(body); }
  Vec3 position(int body) const { return motion(body).X_WB.position; }
  Vec3 velocity(int body) const { return motion(body).velocity; }
  Vec3 spin(int body) const { return motion(body).spin; }
  bool atRest(int body) const { return simulation_->atRest(body); }

  /// Kinetic and potential, the latter zero at the world's origin; J.
  double energy() const {
    double sum = kineticEnergy();
    forEachMoving([&](const ExperimentBody& b, const Motion& m) {
      sum += b.mass_kg * experiment_.gravity * m.X_WB.position.z();
    });
    return sum;
  }
  double kineticEnergy() const {
    double sum = 0.0;
    forEachMoving([&](const ExperimentBody& b, const Motion& m) {
      const Vec3 spin_B = m.X_WB.rotation.conjugate() * m.spin;
      sum += 0.5 * b.mass_kg * m.velocity.squaredNorm() + 0.5 * spin_B.dot(b.inertia() * spin_B);
    });
    return sum;
  }
  Vec3 linearMomentum() const {
    Vec3 sum = Vec3::Zero();
    forEachMoving([&](const ExperimentBody& b, const Motion& m) { sum += b.mass_kg * m.velocity; });
    return sum;
  }
  /// About the world's origin.
  Vec3 angularMomentum() const {
    Vec3 sum = Vec3::Zero();
    forEachMoving([&](const ExperimentBody& b, const Motion& m) {
      const Quat& R = m.X_WB.rotation;
      sum += R * (b.inertia() * (R.conjugate() * m.spin)) + b.mass_kg * m.X_WB.position.cross(m.velocity);
    });
    return sum;
  }

 private:
  template <typename Visit>
  void forEachMoving(const Visit& visit) const {
    for (std::size_t i = 0; i < experiment_.bodies.size(); ++i)
      if (!experiment_.bodies[i].is_static) visit(experiment_.bodies[i], motion(static_cast<int>(i)));
  }

  Experiment experiment_;
  std::unique_ptr<Simulation> simulation_;
  long steps_ = 0;
};

/// The largest value in [low, high] for which `holds`, which holds below some value and not above; low when
/// it never holds. To `(high - low) / 2^halvings`.
template <typename Holds>
double thresholdOf(double low, double high, int halvings, const Holds& holds) {
  for (int i = 0; i < halvings; ++i) {
    const double middle = 0.5 * (low + high);
    (holds(middle) ? low : high) = middle;
  }
  return low;
}

}  // namespace carom::physics
