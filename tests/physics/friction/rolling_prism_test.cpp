// A prism of 32 sides rolls down a slope from edge to edge (the rimless wheel: McGeer 1990, Coleman 1998).
// About the edge it stands on it swings as a pendulum, I w' = m g R sin(phi); landing flat on the next edge
// without restitution keeps its angular momentum about that: w' = w (J + m R^2 cos(2 pi / n)) / I with I = J
// + m R^2.
//
// Where paths were lifted over a coming edge instead of meeting it, it went up to 14 % too far, and steps
// without an impact gained up to 0.8 % of the energy of motion.

#include "tests/physics/small_world.h"

namespace carom::physics {
namespace {

constexpr int kSides = 32;
constexpr double kHalfFace = std::numbers::pi / kSides;

Solid prism(double radius_m, double length_m) {
  std::vector<Vec3> points;
  for (int i = 0; i < kSides; ++i)
    for (double side : {-0.5, 0.5}) {
      const double angle = (2 * i + 1) * kHalfFace;
      points.emplace_back(radius_m * std::cos(angle), side * length_m, radius_m * std::sin(angle));
    }
  return Solid::polyhedron(convexHull(points).polyhedron);
}

// How far the rimless wheel turns in a time, having just landed on a face at `spin`.
double closedFormAngle(const Solid& solid, double radius_m, double slope, double spin, double time_s) {
  constexpr double kStep = 1e-5;
  const double axial = solid.unitInertia()(1, 1);
  const double lever = solid.volume() * radius_m;
  const double about_edge = axial + lever * radius_m;
  const double kept = (axial + lever * radius_m * std::cos(2.0 * kHalfFace)) / about_edge;
  double phi = slope - kHalfFace;
  double angle = 0.0;
  for (double t = 0.0; t < time_s; t += kStep) {
    spin += kStep * lever * kGravity * std::sin(phi + 0.5 * kStep * spin) / about_edge;
    phi += kStep * spin;
    angle += kStep * spin;
    if (phi < slope + kHalfFace) continue;
    spin *= kept;
    phi -= 2.0 * kHalfFace;
  }
  return angle;
}

class RollingPrism : public testing::TestWithParam<std::tuple<double, double, double>> {};  // m, m, Hz

TEST_P(RollingPrism, TurnsAsTheRimlessWheelAndNeverGainsEnergy) {
  const auto [radius_m, length_m, rate_hz] = GetParam();
  constexpr double kSlope = 4.0 * std::numbers::pi / 180.0;
  constexpr double kSeconds = 5.0;
  const Solid solid = prism(radius_m, length_m);
  const double spin = 1.2 / std::sqrt(radius_m);
  const Quat tilt = oracle::turned(Vec3::UnitY(), kSlope);
  SmallWorld w(rate_hz, Vec3(0.0, 0.0, -kGravity), false);
  w.addPlane(rubbing(0.5), tilt);
  const double height = radius_m * std::cos(kHalfFace);
  const Vec3 edge(radius_m * std::sin(kHalfFace), 0.0, -height);
  const Vec3 omega(0.0, spin, 0.0);
  const int body = w.add({solid,
                          {tilt, tilt * Vec3(-40.0, 0.0, height + restGap(solid.parts()[0].width()))},
                          -omega.cross(tilt * edge),
                          omega,
                          rubbing(0.5)});
  w.start();
  // A path may reopen a gap that was struck lower.
  const double reopening_J = w.world().mass(body) * kGravity * restGap(solid.parts()[0].width());
  double turned = 0.0;
  Quat before = w.state(body).X_WB.rotation;
  Audit last = w.world().audit();
  for (int i = 0; i < static_cast<int>(kSeconds * rate_hz); ++i) {
    w.step();
    const Quat now = w.state(body).X_WB.rotation;
    turned += 2.0 * std::asin((now * before.conjugate()).y());
    before = now;
    const Audit audit = w.world().audit();
    ASSERT_LE(audit.kinetic_energy_J + audit.potential_energy_J,
              last.kinetic_energy_J + last.potential_energy_J + reopening_J)
        << "step " << i;
    last = audit;
  }
  EXPECT_NEAR(turned / closedFormAngle(solid, radius_m, kSlope, spin, kSeconds), 1.0, 0.01);
}

INSTANTIATE_TEST_SUITE_P(SizesAndRates, RollingPrism,
                         testing::Combine(testing::Values(0.2, 0.5, 1.0), testing::Values(0.1, 1.0),
                                          testing::Values(60.0, 240.0, 1000.0)));

}  // namespace
}  // namespace carom::physics
