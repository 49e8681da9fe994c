#pragma once
// Two random bodies that meet at one to four points of a common plane, for the tests of this folder.

#include <vector>

#include "engine/response/sweeps/contact_solver.h"
#include "tests/oracle/test_shapes.h"

namespace carom {

inline Inertia boxInertia(double mass_kg, const Vec3& size_m) {
  const Solid box = Solid::box(size_m);
  return inertiaOf(mass_kg / box.volume(), box.volume(), box.unitInertia());
}

inline ImpulseBody impulseBody(const Inertia& inertia, const Quat& R_WB, const Vec3& center,
                               const Velocity& velocity) {
  return {velocity, center, inertia.inverse_mass, inverseTensorInWorld(inertia, R_WB)};
}

inline ImpulseBody immovable() {
  return {};
}

inline double kineticEnergy(const ImpulseBody& b) {
  if (b.inverse_mass == 0.0) return 0.0;
  return 0.5 * b.velocity.linear.squaredNorm() / b.inverse_mass +
         0.5 * b.velocity.angular.dot(b.inverse_tensor.inverse() * b.velocity.angular);
}
inline Vec3 linearMomentum(const ImpulseBody& b) {
  return b.inverse_mass == 0.0 ? Vec3(Vec3::Zero()) : Vec3(b.velocity.linear / b.inverse_mass);
}
/// About the world's origin.
inline Vec3 angularMomentum(const ImpulseBody& b) {
  if (b.inverse_mass == 0.0) return Vec3::Zero();
  return b.center.cross(linearMomentum(b)) + b.inverse_tensor.inverse() * b.velocity.angular;
}

/// A point of contact between two bodies of a list.
struct RowSetting {
  int a = 0;
  int b = 1;
  Vec3 n = Vec3::UnitZ();
  Vec3 p_W = Vec3::Zero();
  Friction friction = {};
  TurningResistance resistance = {};
};

/// Its row, prepared.
inline ContactRow rowAt(const RowSetting& s, std::span<const ImpulseBody> bodies) {
  ContactRow row;
  row.a = s.a;
  row.b = s.b;
  row.n = s.n;
  row.r_a = s.p_W - bodies[static_cast<std::size_t>(s.a)].center;
  row.r_b = s.p_W - bodies[static_cast<std::size_t>(s.b)].center;
  row.friction = s.friction;
  row.resistance = s.resistance;
  prepareRow(row, bodies);
  return row;
}

struct Meeting {
  std::vector<ImpulseBody> bodies;
  std::vector<ContactRow> rows;
};

/// B above A (along n) at `points` places; they approach on the whole.
inline Meeting randomMeeting(oracle::Random& random, int points, double friction, double mass_ratio) {
  const Vec3 n = random.direction();
  Meeting m;
  for (double side : {-1.0, 1.0}) {
    const Vec3 size(random.uniform(0.3, 1), random.uniform(0.3, 1), random.uniform(0.3, 1));
    const Inertia inertia = boxInertia(side < 0 ? 1.0 : mass_ratio, size);
    const Velocity v{-side * random.uniform(0.5, 3) * n + random.uniform(0, 3) * random.direction(),
                     random.uniform(0, 2) * random.direction()};
    m.bodies.push_back(impulseBody(inertia, random.rotation(), side * 0.5 * n + 0.1 * random.direction(), v));
  }
  const TangentBasis t = tangentBasis(n);
  for (int i = 0; i < points; ++i) {
    const Vec3 p_W = random.uniform(-0.4, 0.4) * t.t1 + random.uniform(-0.4, 0.4) * t.t2;
    m.rows.push_back(rowAt({.n = n, .p_W = p_W, .friction = {friction, friction}}, m.bodies));
  }
  return m;
}

}  // namespace carom
