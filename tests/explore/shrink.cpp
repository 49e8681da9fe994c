#include "tests/explore/shrink.h"

#include <algorithm>
#include <cmath>

namespace carom::explore {
namespace {

using demos::Body;
using demos::Scene;

constexpr double kShareOfFigure = 0.1;

double rounded(double x, int digits) {
  if (x == 0.0 || !std::isfinite(x)) return x;
  const double unit = std::pow(10.0, std::floor(std::log10(std::abs(x))) - digits + 1);
  // Divided by the inverse where the unit is a fraction, which gives the double nearest to the decimal.
  return unit < 1.0 ? std::round(x / unit) / std::round(1.0 / unit) : std::round(x / unit) * unit;
}

Vec3 rounded(const Vec3& v, int digits) {
  // To a share of the largest coordinate, so that what is nearly zero becomes zero.
  const double largest = v.cwiseAbs().maxCoeff();
  if (largest == 0.0) return v;
  const double unit = std::pow(10.0, std::floor(std::log10(largest)) - digits + 1);
  Vec3 r;
  for (int i = 0; i < 3; ++i)
    r[i] = unit < 1.0 ? std::round(v[i] / unit) / std::round(1.0 / unit) : std::round(v[i] / unit) * unit;
  return r;
}

void roundShape(demos::Shape& shape, int digits) {
  if (auto* box = std::get_if<demos::BoxShape>(&shape.form))
    for (double& side : box->size_m) side = std::max(1e-4, rounded(side, digits));
  if (auto* ball = std::get_if<demos::SphereShape>(&shape.form))
    ball->radius_m = rounded(ball->radius_m, digits);
  if (auto* capsule = std::get_if<demos::CapsuleShape>(&shape.form)) {
    capsule->radius_m = rounded(capsule->radius_m, digits);
    capsule->length_m = rounded(capsule->length_m, digits);
  }
  if (auto* hull = std::get_if<demos::HullShape>(&shape.form))
    for (Vec3& p : hull->points) p = rounded(p, digits);
  if (auto* compound = std::get_if<demos::CompoundShape>(&shape.form))
    for (demos::CompoundPart& part : compound->parts) {
      roundShape(part.shape, digits);
      part.X_SP.position = rounded(part.X_SP.position, digits);
    }
}

void roundBody(Body& body, int digits) {
  roundShape(body.shape, digits);
  body.X_WS.position = rounded(body.X_WS.position, digits);
  const int turn_digits = std::max(4, digits);
  for (double& q : body.X_WS.rotation.coeffs()) q = rounded(q, turn_digits);
  body.linear_velocity = rounded(body.linear_velocity, digits);
  body.angular_velocity = rounded(body.angular_velocity, digits);
  for (Vec3* load : {&body.load.force_W, &body.load.torque_W, &body.load.force_B, &body.load.torque_B})
    *load = rounded(*load, digits);
  if (body.mass_kg) body.mass_kg = rounded(*body.mass_kg, digits);
  Material& m = body.material;
  for (double* number : {&m.static_friction, &m.dynamic_friction, &m.restitution, &m.density_kgpm3})
    *number = rounded(*number, digits);
  m.dynamic_friction = std::min(m.dynamic_friction, m.static_friction);
}

class Shrinker {
 public:
  Shrinker(const Scene& scene, const Finding& finding, const Trial& trial, int most_trials)
      : best_{scene, finding, 0},
        least_(kShareOfFigure * finding.figure),
        trial_(trial),
        most_(most_trials) {}

  Shrunk run() {
    shorten();
    dropBodies();
    shorten();
    simplify();
    dropBodies();
    roundNumbers();
    shorten();
    return best_;
  }

 private:
  bool keep(const Scene& scene) {
    if (best_.trials >= most_) return false;
    ++best_.trials;
    const std::optional<Finding> finding = trial_(scene);
    if (!finding || finding->kind != best_.finding.kind || !(finding->figure >= least_)) return false;
    best_.scene = scene;
    best_.finding = *finding;
    return true;
  }

  void shorten() {
    Scene scene = best_.scene;
    const int step = std::max(1, best_.finding.step);
    if (step >= stepsOf(scene)) return;
    scene.duration_s = step / scene.rate_hz;
    keep(scene);
  }

  void dropBodies() {
    for (std::size_t chunk = std::max<std::size_t>(1, best_.scene.bodies.size() / 2);; chunk /= 2) {
      for (std::size_t at = 0; at + chunk <= best_.scene.bodies.size() && best_.scene.bodies.size() > 1;) {
        Scene scene = best_.scene;
        const auto begin = scene.bodies.begin() + static_cast<std::ptrdiff_t>(at);
        scene.bodies.erase(begin, begin + static_cast<std::ptrdiff_t>(chunk));
        if (scene.bodies.empty() || !keep(scene)) at += chunk;
      }
      if (chunk <= 1) return;
    }
  }

  template <typename Change>
  void tryEach(const Change& change) {
    for (std::size_t i = 0; i < best_.scene.bodies.size(); ++i) {
      Scene scene = best_.scene;
      if (change(scene.bodies[i])) keep(scene);
    }
  }

  void simplify() {
    Scene still = best_.scene;
    still.fluids.clear();
    if (!best_.scene.fluids.empty()) keep(still);
    still = best_.scene;
    still.air = Air{};
    if (best_.scene.air.density_kgpm3 > 0.0) keep(still);
    tryEach([](Body& body) {
      const bool turns = !body.angular_velocity.isZero(0.0);
      body.angular_velocity.setZero();
      return turns;
    });
    tryEach([](Body& body) {
      const bool moves = !body.linear_velocity.isZero(0.0);
      body.linear_velocity.setZero();
      return moves;
    });
    tryEach([](Body& body) {
      const bool twists = !body.load.torque_W.isZero(0.0) || !body.load.torque_B.isZero(0.0);
      body.load.torque_W = body.load.torque_B = Vec3::Zero();
      return twists;
    });
    tryEach([](Body& body) {
      const bool pushes = !body.load.isZero();
      body.load = {};
      return pushes;
    });
    tryEach([](Body& body) {
      const bool turned = !body.X_WS.rotation.vec().isZero(0.0);
      body.X_WS.rotation = Quat::Identity();
      return turned;
    });
    tryEach([](Body& body) {
      const bool bounces = body.material.restitution != 0.0;
      body.material.restitution = 0.0;
      return bounces;
    });
    tryEach([](Body& body) {
      const bool rubs = body.material.static_friction != 0.0;
      body.material.static_friction = body.material.dynamic_friction = 0.0;
      return rubs;
    });
    tryEach([](Body& body) {
      auto* compound = std::get_if<demos::CompoundShape>(&body.shape.form);
      if (compound == nullptr) return false;
      const demos::CompoundPart part = compound->parts[0];
      body.shape = part.shape;
      body.X_WS = body.X_WS * part.X_SP;
      return true;
    });
  }

  void roundNumbers() {
    for (const int digits : {1, 2, 3, 4, 6, 8}) {
      Scene scene = best_.scene;
      for (Body& body : scene.bodies) roundBody(body, digits);
      scene.gravity = rounded(scene.gravity, std::max(3, digits));
      if (keep(scene)) break;
    }
    for (const int digits : {1, 2, 3})
      tryEach([digits](Body& body) {
        roundBody(body, digits);
        return true;
      });
  }

  Shrunk best_;
  double least_;
  const Trial& trial_;
  int most_;
};

}  // namespace

Shrunk shrunkScene(const Scene& scene, const Finding& finding, const Trial& trial, int most_trials) {
  return Shrinker(scene, finding, trial, most_trials).run();
}

}  // namespace carom::explore
