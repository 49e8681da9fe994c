#pragma once
// Oracle: mass, inertia, energy and momentum of bodies from textbook formulae and their states alone, in long
// double; shares no code with the engine's mass properties and audits. Polyhedra are summed tetrahedron by
// tetrahedron from the origin, balls and capsules are closed forms, the parts of a compound add up (parallel
// axes). Tested in tests/explore/watch/own_mechanics_test.cpp.

#include <numbers>
#include <span>
#include <vector>

#include "engine/simulation/world.h"

namespace carom::explore {

using Real = long double;
using Vec3R = Eigen::Matrix<Real, 3, 1>;
using Mat3R = Eigen::Matrix<Real, 3, 3>;

/// Of one density: volume, and the integrals of x and x x^T over it.
struct Moments {
  Real volume = 0;
  Vec3R first = Vec3R::Zero();
  Mat3R second = Mat3R::Zero();

  void add(const Moments& other) {
    volume += other.volume;
    first += other.first;
    second += other.second;
  }
};

/// Of a body of unit density with this volume, centre and second moment about its own centre.
inline Moments momentsAbout(Real volume, const Vec3R& centre, const Mat3R& central) {
  return {volume, volume * centre, central + volume * centre * centre.transpose()};
}

inline Moments polyhedronMoments(const ConvexPolyhedron& p) {
  Moments sum;
  const auto corner = [&p](int v) { return Vec3R(p.vertex(v).cast<Real>()); };
  for (int f = 0; f < p.faceCount(); ++f) {
    const std::span<const int> loop = p.faceVertices(f);
    for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
      const Vec3R a = corner(loop[0]), b = corner(loop[i]), c = corner(loop[i + 1]), s = a + b + c;
      const Real six = a.dot(b.cross(c));
      sum.volume += six / 6;
      sum.first += six / 24 * s;
      sum.second +=
          six / 120 * (a * a.transpose() + b * b.transpose() + c * c.transpose() + s * s.transpose());
    }
  }
  return sum;
}

inline Moments ballMoments(const Vec3R& centre, Real r) {
  const Real volume = 4 * std::numbers::pi_v<Real> / 3 * r * r * r;
  return momentsAbout(volume, centre, volume * r * r / 5 * Mat3R::Identity());
}

/// A cylinder between the ends and half a ball on each.
inline Moments capsuleMoments(const Vec3R& a, const Vec3R& b, Real r) {
  const Vec3R along = b - a;
  const Real length = along.norm();
  if (!(length > 0)) return ballMoments(a, r);
  const Vec3R u = along / length;
  const Mat3R axial = u * u.transpose(), across = Mat3R::Identity() - axial;
  const Real pi = std::numbers::pi_v<Real>;
  const Real tube = pi * r * r * length, ball = 4 * pi / 3 * r * r * r;
  // Of the two half balls, each with its centroid 3/8 r beyond the end of the tube.
  const Real h = length / 2;
  const Real caps_axial = ball * (r * r / 5 + h * h + 2 * h * 3 * r / 8);
  const Mat3R central =
      (tube * length * length / 12 + caps_axial) * axial + (tube * r * r / 4 + ball * r * r / 5) * across;
  return momentsAbout(tube + ball, (a + b) / 2, central);
}

inline Moments partMoments(const ConvexPart& part) {
  const ConvexPolyhedron& core = part.core;
  if (core.faceCount() > 0) return polyhedronMoments(core);
  const Vec3R a = core.vertex(0).cast<Real>();
  if (core.vertexCount() == 1) return ballMoments(a, part.radius_m);
  return capsuleMoments(a, core.vertex(1).cast<Real>(), part.radius_m);
}

/// A body that moves, as mechanics knows it.
struct OwnBody {
  int index = -1;
  Real mass = 0;
  Vec3R center_B = Vec3R::Zero();
  Mat3R inertia_B = Mat3R::Zero();  ///< About the centre of mass.
  Real reach_m = 0;                 ///< Of any point of it, from the centre of mass.
};

inline OwnBody ownBody(int index, const Solid& solid, Real density) {
  Moments sum;
  for (const ConvexPart& part : solid.parts()) sum.add(partMoments(part));
  OwnBody body;
  body.index = index;
  body.mass = density * sum.volume;
  body.center_B = sum.first / sum.volume;
  const Mat3R central = sum.second - sum.volume * body.center_B * body.center_B.transpose();
  body.inertia_B = density * (central.trace() * Mat3R::Identity() - central);
  for (const ConvexPart& part : solid.parts())
    for (const Vec3& v : part.core.vertices())
      body.reach_m = std::max(body.reach_m, v.cast<Real>().norm() + Real{part.radius_m});
  return body;
}

inline std::vector<OwnBody> ownBodies(const World& world) {
  std::vector<OwnBody> bodies;
  for (std::size_t i = 0; i < world.bodies().size(); ++i) {
    const BodyDescription& d = world.bodies()[i];
    if (!d.is_static && !d.is_kinematic)
      bodies.push_back(ownBody(static_cast<int>(i), world.solids()[static_cast<std::size_t>(d.solid)],
                               d.material.density_kgpm3));
  }
  return bodies;
}

struct Mechanics {
  Real kinetic_J = 0;
  Real potential_J = 0;        ///< -m g . x.
  Real kinetic_scale_J = 0;    ///< What rounding of velocities is relative to: the kinetic energy without ...
  Real potential_scale_J = 0;  ///< ... and that of positions: m |g| (|x| + reach).
  Vec3R momentum = Vec3R::Zero();
  Real momentum_scale = 0;        ///< Sum of m |v|.
  Vec3R angular = Vec3R::Zero();  ///< About the centre of mass of all.
  Real angular_scale = 0;

  Real total() const { return kinetic_J + potential_J; }
};

inline Mechanics mechanicsOf(std::span<const OwnBody> bodies, std::span<const BodyState> states,
                             const Vec3& gravity) {
  Mechanics sum;
  const Vec3R g = gravity.cast<Real>();
  Vec3R middle = Vec3R::Zero();
  Real mass = 0;
  for (const OwnBody& body : bodies) {
    middle += body.mass * states[static_cast<std::size_t>(body.index)].X_WB.position.cast<Real>();
    mass += body.mass;
  }
  if (mass > 0) middle /= mass;
  for (const OwnBody& body : bodies) {
    const BodyState& s = states[static_cast<std::size_t>(body.index)];
    const Vec3R x = s.X_WB.position.cast<Real>(), v = s.linear_velocity.cast<Real>();
    const Mat3R R = s.X_WB.rotation.cast<Real>().normalized().toRotationMatrix();
    const Vec3R w = R.transpose() * s.angular_velocity.cast<Real>();
    const Vec3R spin = body.inertia_B * w;
    const Real kinetic = (body.mass * v.squaredNorm() + w.dot(spin)) / 2;
    sum.kinetic_J += kinetic;
    sum.kinetic_scale_J += kinetic;
    sum.potential_J -= body.mass * g.dot(x);
    sum.potential_scale_J += body.mass * g.norm() * (x.norm() + body.reach_m);
    sum.momentum += body.mass * v;
    sum.momentum_scale += body.mass * v.norm();
    sum.angular += (x - middle).cross(body.mass * v) + R * spin;
    sum.angular_scale += body.mass * ((x - middle).norm() + body.reach_m) * v.norm() + spin.norm();
  }
  return sum;
}

}  // namespace carom::explore
