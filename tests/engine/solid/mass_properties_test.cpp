// Mass, centre and inertia against closed forms; turned and far from the origin.

#include "engine/solid/mass_properties.h"

#include <gtest/gtest.h>

#include "tests/oracle/test_shapes.h"

namespace carom {
namespace {

using oracle::Random;

MassProperties moved(const MassProperties& m, const Pose& X) {
  const Mat3 R = X.rotation.toRotationMatrix();
  return {m.mass, X * m.center, R * m.inertia * R.transpose()};
}

ConvexPolyhedron moved(const ConvexPolyhedron& p, const Pose& X) {
  std::vector<Vec3> vertices;
  for (const Vec3& v : p.vertices()) vertices.push_back(X * v);
  std::vector<std::vector<int>> loops;
  for (int f = 0; f < p.faceCount(); ++f)
    loops.emplace_back(p.faceVertices(f).begin(), p.faceVertices(f).end());
  return ConvexPolyhedron::fromFaces(vertices, loops);
}

void expectEqual(const MassProperties& got, const MassProperties& want, double relative, const char* what) {
  const double size = std::cbrt(want.mass);
  EXPECT_NEAR(got.mass, want.mass, relative * want.mass) << what;
  EXPECT_LT((got.center - want.center).norm(), relative * (size + want.center.norm())) << what;
  EXPECT_LT((got.inertia - want.inertia).norm(), relative * want.inertia.norm()) << what;
}

// In its own frame, in a general pose, and 10^4 sizes away, where the vertices themselves are rounded to
// 1e-12.
void expectEverywhere(const ConvexPolyhedron& p, const MassProperties& want, const char* what) {
  expectEqual(polyhedronMass(p), want, 1e-14, what);
  const Pose turned{oracle::turned(Vec3(1, -2, 0.5), 1.1), Vec3(0.3, -0.7, 1.9)};
  expectEqual(polyhedronMass(moved(p, turned)), moved(want, turned), 1e-14, what);
  const Pose far{oracle::turned(Vec3(-3, 1, 2), 2.3), Vec3(1e4, -2e4, 5e3)};
  expectEqual(polyhedronMass(moved(p, far)), moved(want, far), 1e-10, what);
}

TEST(PolyhedronMass, OfABox) {
  const double a = 0.7, b = 1.3, c = 2.9, m = a * b * c;
  const Mat3 inertia = (m / 12 * Vec3(b * b + c * c, a * a + c * c, a * a + b * b)).asDiagonal();
  expectEverywhere(boxPolyhedron({a, b, c}), {m, Vec3::Zero(), inertia}, "box");
  expectEverywhere(oracle::triangulatedBox({a, b, c}), {m, Vec3::Zero(), inertia}, "box of triangles");
}

TEST(PolyhedronMass, OfTheRegularSolids) {
  // With edge length s: volume and the inertia about any axis through the centre, for unit density.
  const double phi = std::numbers::phi, sqrt2 = std::numbers::sqrt2, sqrt5 = std::sqrt(5.0);
  struct Regular {
    const char* name;
    ConvexPolyhedron solid;
    double s, volume, per_mass;
  };
  const Regular solids[] = {
      {"tetrahedron", oracle::tetrahedron(), 2 * sqrt2, 8.0 / 3, 1.0 / 20},
      {"octahedron", oracle::octahedron(), sqrt2, 4.0 / 3, 1.0 / 10},
      {"icosahedron", oracle::icosahedron(), 2.0, 8 * 5 * (3 + sqrt5) / 12, phi * phi / 10},
      {"dodecahedron", oracle::dodecahedron(), 2 / phi, (15 + 7 * sqrt5) / 4 * 8 / (phi * phi * phi),
       (39 * phi + 28) / 150},
  };
  for (const auto& [name, solid, s, volume, per_mass] : solids)
    expectEverywhere(solid, {volume, Vec3::Zero(), volume * per_mass * s * s * Mat3::Identity()}, name);
}

TEST(PolyhedronMass, OfACornerTetrahedron_WithItsProductsOfInertia) {
  // Corners 0, (a,0,0), (0,b,0), (0,0,c): integral of x^2 = a^2 V/10, of xy = ab V/20, centroid at a quarter.
  const double a = 1.2, b = 0.8, c = 2.0, V = a * b * c / 6;
  const ConvexPolyhedron solid = ConvexPolyhedron::fromFaces({{0, 0, 0}, {a, 0, 0}, {0, b, 0}, {0, 0, c}},
                                                             {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}});
  const Vec3 s(a, b, c), center = s / 4;
  Mat3 second = V / 20 * s * s.transpose();
  second.diagonal() *= 2;
  const Mat3 covariance = second - V * center * center.transpose();
  expectEverywhere(solid, {V, center, covariance.trace() * Mat3::Identity() - covariance}, "corner");
}

TEST(PolyhedronMass, OfAPrismOverARegularPolygon) {
  const double R = 0.8, h = 1.7;
  for (int n : {3, 6, 60}) {
    const double turn = 2 * std::numbers::pi / n;
    const double area = 0.5 * n * R * R * std::sin(turn), m = area * h;
    const double polar = m * R * R * (2 + std::cos(turn)) / 6;  // about the axis
    const double across = polar / 2 + m * h * h / 12;
    expectEverywhere(oracle::prism(n, R, h), {m, Vec3::Zero(), Vec3(across, across, polar).asDiagonal()},
                     "prism");
  }
}

TEST(BallMass, IsTwoFifths) {
  const MassProperties m = ballMass({1, 2, 3}, 0.5);
  EXPECT_NEAR(m.mass, std::numbers::pi / 6, 1e-15);
  EXPECT_EQ(m.center, Vec3(1, 2, 3));
  EXPECT_LT((m.inertia - 0.4 * m.mass * 0.25 * Mat3::Identity()).norm(), 1e-15);
}

// Along the axis and across it, integrated numerically over discs: an oracle without half-ball centroids.
MassProperties capsuleByDiscs(double r, double h) {
  MassProperties sum;
  double along = 0, across = 0;
  const int n = 200000;
  const double dz = (h + 2 * r) / n;
  for (int i = 0; i < n; ++i) {
    const double z = -0.5 * h - r + (i + 0.5) * dz;
    const double beyond = std::max(std::abs(z) - 0.5 * h, 0.0);
    const double r2 = r * r - beyond * beyond;
    const double m = std::numbers::pi * r2 * dz;
    sum.mass += m;
    along += 0.5 * m * r2;
    across += m * (0.25 * r2 + z * z);
  }
  sum.inertia = Vec3(across, across, along).asDiagonal();
  return sum;
}

TEST(CapsuleMass, IsTheSumOfItsDiscs) {
  for (const auto& [r, h] : {std::pair{0.5, 2.0}, {0.3, 0.1}, {2.0, 1e-3}})
    expectEqual(capsuleMass({0, 0, -h / 2}, {0, 0, h / 2}, r), capsuleByDiscs(r, h), 1e-8, "capsule");
}

TEST(CapsuleMass, TurnsWithItsAxis) {
  const Pose X{oracle::turned(Vec3(1, 2, 3), 0.9), Vec3(4, -5, 6)};
  expectEqual(capsuleMass(X * Vec3(0, 0, -1), X * Vec3(0, 0, 1), 0.4),
              moved(capsuleMass({0, 0, -1}, {0, 0, 1}, 0.4), X), 1e-14, "turned capsule");
}

TEST(CombinedMass, OfTwoHalvesIsTheWhole) {
  const MassProperties left =
      moved(polyhedronMass(boxPolyhedron({1, 2, 3})), {Quat::Identity(), Vec3(-0.5, 0, 0)});
  const MassProperties right =
      moved(polyhedronMass(boxPolyhedron({1, 2, 3})), {Quat::Identity(), Vec3(0.5, 0, 0)});
  expectEqual(MassProperties::combined(left, right), polyhedronMass(boxPolyhedron({2, 2, 3})), 1e-14,
              "two halves");
}

}  // namespace
}  // namespace carom
